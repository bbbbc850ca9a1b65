// Names of what a number format may be (numeric/format.h).
#pragma once

#include "numeric/format.h"
#include "numeric/names.h"

namespace etalon {

template <>
inline constexpr auto kNames<Rounding> = std::to_array<std::string_view>({"nearest-even", "toward-zero",
                                                                          "nearest-away", "up", "down",
                                                                          "stochastic"});
static_assert(isLastName(Rounding::stochastic));
template <>
inline constexpr auto kNames<Subnormals> = std::to_array<std::string_view>({"keep", "flush"});
static_assert(isLastName(Subnormals::flush));
template <>
inline constexpr auto kNames<Overflow> = std::to_array<std::string_view>({"infinity", "saturate"});
static_assert(isLastName(Overflow::saturate));
template <>
inline constexpr auto kNames<Division> = std::to_array<std::string_view>({"exact", "reciprocal"});
static_assert(isLastName(Division::reciprocal));
template <>
inline constexpr auto kNames<Power> = std::to_array<std::string_view>({"exact", "exp2log2"});
static_assert(isLastName(Power::exp2log2));

}  // namespace etalon
