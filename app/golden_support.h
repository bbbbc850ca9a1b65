// How check and accept render their cases.
#pragma once

#include <string>

#include "golden/golden.h"

namespace etalon {

struct GoldenSupport {
    GoldenRenderer render;
    std::string rulesVersion;
};

}  // namespace etalon
