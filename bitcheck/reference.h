// The reference that every machine's bits are compared with: hashes per tile, as a short text.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "bitcheck/bit_case.h"

namespace etalon {

struct CaseHashes {
    std::string name;
    std::vector<PlaneHashes> planes;
    friend bool operator==(const CaseHashes&, const CaseHashes&) = default;
};

struct BitReference {
    int rulesVersion = 0;
    std::string reason;  // why it is as it is; one line
    std::vector<CaseHashes> cases;

    // The hashes of that case, or null.
    const CaseHashes* find(std::string_view name) const;
};

CaseHashes hashCase(const std::string& name, const std::vector<BitPlane>& planes);

// One hash over names, shapes and tiles of all cases: two machines agree if it does.
uint64_t hashOfAll(const std::vector<CaseHashes>& cases);

// The text: "etalon bits 1", "rules N", "reason TEXT", then for each case "case NAME" and for each plane
// "plane NAME KIND WIDTHxHEIGHTxLAYERS" and a line of hashes (16 hexadecimal digits) for each row of tiles;
// last "all HASH", the hash over all.
std::string referenceText(const BitReference& reference);

// Reads it. InputError "file:line: reason" for whatever is not exactly such a text, a text that ends early
// included.
BitReference readReference(std::string_view text, const std::string& file);

}  // namespace etalon
