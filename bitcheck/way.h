// The ways in which one machine can compute a case: none of them changes a bit.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bitcheck/bit_case.h"
#include "numeric/isa.h"

namespace etalon {

struct BitWay {
    IsaLevel level;
    int threads, tileSize;
    friend bool operator==(const BitWay&, const BitWay&) = default;
};

// "v3, 2 threads, tile 32", without what the case is not cut by.
std::string wayText(const BitWay& way, const BitCase& c);

// Which ways to try.
struct WaySelection {
    std::optional<IsaLevel> level;  // only this one; else every usable level
    std::optional<int> threads;     // else 1, 2 and 7
    std::optional<int> tileSize;    // else 16, 32 and 64
    bool everyCombination =
        false;  // false: the narrower levels with each number of threads and tile size once
};

// The ways of a case, at least one; the first is the widest level with one thread and the largest tile. What
// the case is not cut by is not varied.
std::vector<BitWay> waysOf(const WaySelection& selection, const BitCase& c);

// Computes a case in one way; the active level is as before afterwards.
std::vector<BitPlane> runCase(const BitCase& c, const BitWay& way);

}  // namespace etalon
