// The words of cases as a file, so that another machine can name the first pixel that differs.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "bitcheck/check_bits.h"

namespace etalon {

struct BitDump {
    int rulesVersion = 0;
    std::vector<CasePlanes> cases;
};

// The reference text (bitcheck/reference.h) of the cases, an empty line, and the words of all planes in that
// order, little-endian in their own size.
std::vector<std::byte> encodeDump(const BitDump& dump);

// InputError "file: reason" for anything else, words that do not have the hashes of the text included.
BitDump decodeDump(std::span<const std::byte> bytes, const std::string& file);

// The hashes of a dump, as a reference.
BitReference referenceOf(const BitDump& dump, const std::string& reason);

}  // namespace etalon
