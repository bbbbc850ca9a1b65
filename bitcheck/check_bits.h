// Computes cases in many ways and compares every word with the reference.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bitcheck/reference.h"
#include "bitcheck/way.h"

namespace etalon {

// The planes of one case, as one machine computed them.
struct CasePlanes {
    std::string name;
    std::vector<BitPlane> planes;
};

// A word that is not as expected.
struct DifferentPixel {
    int x, y, layer;
    uint64_t expected, found;
};

// The first difference of a case.
struct BitDifference {
    BitWay way;  // the first one that differs
    std::string plane;
    WordKind kind;
    std::string layerName;
    int tileX, tileY;  // the first tile's upper left pixel
    // The first word of the tile that differs, in rows of pixels; known if another way of this machine gives
    // the tile as expected, or if the other machine's words are at hand.
    std::optional<DifferentPixel> pixel;
    std::optional<BitWay> agreeingWay;
};

enum class BitVerdict {
    same,
    different,  // in at least one way
    missing,    // the reference has no such case
    reshaped,   // the reference has other planes for it
    obsolete,   // the reference has it, the program does not
};
const char* verdictName(BitVerdict verdict);

struct BitResult {
    std::string name, what;
    BitVerdict verdict = BitVerdict::same;
    std::string message;  // one line; empty for `same`
    std::vector<BitWay> ways, differing;
    std::optional<BitDifference> difference;
};

// Computes the case in every way and compares with the reference; `expected` null: without words.
BitResult checkCase(const BitCase& c, const std::vector<BitWay>& ways, const BitReference& reference,
                    const std::vector<CasePlanes>* expected = nullptr);

// A result `obsolete` for each case of the reference that is not among the program's.
std::vector<BitResult> findObsolete(const BitReference& reference, const std::vector<BitCase>& cases);

}  // namespace etalon
