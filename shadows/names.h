// Names of what a shadow map may be.
#pragma once

#include "numeric/names.h"
#include "shadows/shadow_map.h"

namespace etalon {

template <>
inline constexpr auto kNames<ShadowDepth> = std::to_array<std::string_view>({"d16", "d24", "d32f", "linear"});
static_assert(isLastName(ShadowDepth::linear));
template <>
inline constexpr auto kNames<ShadowFaces> = std::to_array<std::string_view>({"both", "front", "back"});
static_assert(isLastName(ShadowFaces::back));
template <>
inline constexpr auto kNames<ShadowFilter> = std::to_array<std::string_view>({"hard", "pcf", "disc", "soft"});
static_assert(isLastName(ShadowFilter::soft));
template <>
inline constexpr auto kNames<ShadowReference> = std::to_array<std::string_view>({"clamped", "quantised"});
static_assert(isLastName(ShadowReference::quantised));

}  // namespace etalon
