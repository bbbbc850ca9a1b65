// Names of what a profile may be beside its formats, and of the faces of a cube.
#pragma once

#include "numeric/names.h"
#include "raster/cube_face.h"
#include "raster/profile.h"

namespace etalon {

template <>
inline constexpr auto kNames<RasterReal> = std::to_array<std::string_view>({"fp32", "fp64"});
static_assert(isLastName(RasterReal::fp64));
template <>
inline constexpr auto kNames<DepthFormat> = std::to_array<std::string_view>({"d16", "d24", "d32f", "d64f"});
static_assert(isLastName(DepthFormat::d64f));
template <>
inline constexpr auto kNames<DepthOrder> = std::to_array<std::string_view>({"stored", "exact"});
static_assert(isLastName(DepthOrder::exact));
template <>
inline constexpr auto kNames<DepthDirection> = std::to_array<std::string_view>({"forward", "reversed"});
static_assert(isLastName(DepthDirection::reversed));
template <>
inline constexpr auto kNames<VolumeStencil> = std::to_array<std::string_view>({"exact", "8-bit"});
static_assert(isLastName(VolumeStencil::bits8));
template <>
inline constexpr auto kNames<DepthRounding> = std::to_array<std::string_view>({"exact", "driver",
                                                                               "fixed-function"});
static_assert(isLastName(DepthRounding::fixedFunction));
template <>
inline constexpr auto kNames<BiasUnit> = std::to_array<std::string_view>({"step", "driver"});
static_assert(isLastName(BiasUnit::driver));
template <>
inline constexpr auto kNames<Filter> = std::to_array<std::string_view>({"nearest", "bilinear"});
static_assert(isLastName(Filter::bilinear));
template <>
inline constexpr auto kNames<FilterPosition> = std::to_array<std::string_view>({"rounded", "fixed-point"});
static_assert(isLastName(FilterPosition::fixedPoint));
template <>
inline constexpr auto kNames<FilterWeights> = std::to_array<std::string_view>({"product", "8-bit"});
static_assert(isLastName(FilterWeights::bits8));
template <>
inline constexpr auto kNames<FilterSum> = std::to_array<std::string_view>({"arithmetic", "fixed-function"});
static_assert(isLastName(FilterSum::fixedFunction));
template <>
inline constexpr auto kNames<TexelFormat> = std::to_array<std::string_view>({"float", "half", "unorm16",
                                                                             "unorm8"});
static_assert(isLastName(TexelFormat::unorm8));
template <>
inline constexpr auto kNames<CubeFace> = std::to_array<std::string_view>({"+x", "-x", "+y", "-y", "+z",
                                                                          "-z"});
static_assert(isLastName(CubeFace::minusZ));

}  // namespace etalon
