// The order of depths at a sample, decided without their rounding (DepthOrder::exact).
#pragma once

#include <array>
#include <cstdint>

namespace etalon {

// The depth (e_0 z_0 + e_1 z_1 + e_2 z_2) / area + bias of rules 5 and 7, without a rounding.
struct ExactDepth {
    std::array<int64_t, 3> e;  // below 2^53
    std::array<double, 3> z;
    int64_t area;  // > 0
    double bias;
    bool isCut = true;  // to [0, 1]

    // A stored number, which may be that behind all depths.
    static ExactDepth of(double stored) { return {{1, 0, 0}, {stored, 0, 0}, 1, 0, false}; }
};

// -1, 0 or 1: the first depth is smaller than, as large as or larger than the second. In numbers of 192 bits, in which
// sums are exact whose parts are within 2^80 of each other.
int compareDepths(const ExactDepth& a, const ExactDepth& b);

}  // namespace etalon
