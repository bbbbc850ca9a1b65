// A group of pixels in lanes: kGroupWidth x kGroupRows pixels at any place of a tile. Included by sources
// that are compiled once per level.
#pragma once

#include <algorithm>
#include <array>

#include "numeric/lanes.h"

namespace etalon {

// One pixel, half a row of 8, a row, or two rows.
inline constexpr int kGroup = std::min(kLanes, 16);
inline constexpr int kGroupWidth = std::min(kGroup, 8);
inline constexpr int kGroupRows = kGroup / kGroupWidth;

using GroupInt = Lanes<int32_t, kGroup>;
using GroupMask = Mask<int32_t, kGroup>;

// The group in registers of double.
inline constexpr int kPart = std::min(kGroup, kNativeLanes<double>);
inline constexpr int kParts = kGroup / kPart;
static_assert(kParts <= 2 && kGroupRows <= 2);
using PartDouble = Lanes<double, kPart>;
using GroupDouble = std::array<PartDouble, kParts>;

inline GroupInt splat(int32_t value) { return GroupInt(GroupInt::Vector{} + value); }

// Position of each lane's pixel in the group.
inline GroupInt laneX() {
    return GroupInt::generate([](int i) { return i % kGroupWidth; });
}
inline GroupInt laneY() {
    return GroupInt::generate([](int i) { return i / kGroupWidth; });
}

// f(i) for lane i.
template <class F>
GroupDouble generateDoubles(F f) {
    GroupDouble doubles;
    for (int part = 0; part < kParts; part++)
        doubles[static_cast<size_t>(part)] = PartDouble::generate([&](int i) { return f(part * kPart + i); });
    return doubles;
}

// Each lane rounded once to Real.
template <class Real>
[[gnu::always_inline]] inline Lanes<Real, kGroup> groupOf(const GroupDouble& a) {
    if constexpr (kParts == 1)
        return convertLanes<Real>(a[0]);
    else
        return joinLanes(convertLanes<Real>(a[0]), convertLanes<Real>(a[1]));
}

// The rows of a group, `stride` values apart.
template <int kRows = kGroupRows>
[[gnu::always_inline]] inline auto loadGroup(const int32_t* from, size_t stride) {
    using Row = Lanes<int32_t, kGroupWidth>;
    if constexpr (kRows == 1)
        return Row::load(from);
    else
        return joinLanes(Row::load(from), Row::load(from + stride));
}
template <int N>
[[gnu::always_inline]] inline void storeGroup(Lanes<int32_t, N> group, int32_t* to, size_t stride) {
    if constexpr (N == kGroupWidth) {
        group.store(to);
    } else {
        lowerLanes(group).store(to);
        upperLanes(group).store(to + stride);
    }
}

}  // namespace etalon
