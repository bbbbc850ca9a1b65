// A comparison as text for people and as JSON for machines.
#pragma once

#include <string>

#include "files/json.h"
#include "golden/compare.h"

namespace etalon {

// Several lines; the first says the verdict. a and b are named as given.
std::string comparisonText(const Comparison& comparison, const std::string& a, const std::string& b);

// An object; the keys are those of the structures in golden/compare.h in snake case. Infinities and NaN, which
// JSON has not, are the texts "inf", "-inf" and "nan"; the ULP distance of incomparable samples is null.
Json comparisonJson(const Comparison& comparison);

}  // namespace etalon
