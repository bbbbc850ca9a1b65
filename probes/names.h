// Names of the choices that there are about probes, as files and commands have them.
#pragma once

#include "numeric/names.h"
#include "probes/convert.h"
#include "probes/cube_layout.h"
#include "probes/harmonics_layout.h"
#include "probes/median_cut.h"
#include "probes/probe.h"

namespace etalon {

template <>
inline constexpr auto kNames<Mapping> = std::to_array<std::string_view>({"latlong", "cube", "angular",
                                                                         "mirror_ball", "octahedral",
                                                                         "latlong_pedersen"});
static_assert(isLastName(Mapping::latLongPedersen));
template <>
inline constexpr auto kNames<CubeLayout> =
    std::to_array<std::string_view>({"openexr", "strip", "horizontal_cross", "vertical_cross"});
static_assert(isLastName(CubeLayout::verticalCross));
template <>
inline constexpr auto kNames<Resampling> = std::to_array<std::string_view>({"nearest", "bilinear", "area"});
static_assert(isLastName(Resampling::area));
template <>
inline constexpr auto kNames<LongerSide> = std::to_array<std::string_view>({"angle", "arc"});
static_assert(isLastName(LongerSide::arc));
template <>
inline constexpr auto kNames<LightPlace> = std::to_array<std::string_view>({"centre", "centroid", "median",
                                                                            "centroid-twice"});
static_assert(isLastName(LightPlace::centroidTwice));
template <>
inline constexpr auto kNames<TexelWeight> = std::to_array<std::string_view>({"exact", "midpoint", "edge",
                                                                             "uniform"});
static_assert(isLastName(TexelWeight::uniform));
template <>
inline constexpr auto kNames<CoefficientLayout> = std::to_array<std::string_view>({"interleaved", "planar"});
static_assert(isLastName(CoefficientLayout::planar));

}  // namespace etalon
