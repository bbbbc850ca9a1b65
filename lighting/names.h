// Names of what surfaces and lights may be, and of tone maps.
#pragma once

#include "lighting/surface_scene.h"
#include "lighting/tone_map.h"
#include "numeric/names.h"

namespace etalon {

template <>
inline constexpr auto kNames<MaterialKind> = std::to_array<std::string_view>({"lambert", "blinn_phong",
                                                                              "mirror"});
static_assert(isLastName(MaterialKind::mirror));
template <>
inline constexpr auto kNames<LightKind> = std::to_array<std::string_view>({"directional", "point", "spot"});
static_assert(isLastName(LightKind::spot));
template <>
inline constexpr auto kNames<Reflection> = std::to_array<std::string_view>({"environment", "scene"});
static_assert(isLastName(Reflection::scene));
template <>
inline constexpr auto kNames<ToneMap> = std::to_array<std::string_view>({"linear", "reinhard", "filmic"});
static_assert(isLastName(ToneMap::filmic));

}  // namespace etalon
