// Planar shadows of a scene's lights.
#pragma once

#include <span>
#include <vector>

#include "lighting/surface_scene.h"
#include "shadows/planar_visibility.h"

namespace etalon {

struct PlanarLightSettings {
    int samples = 25;               // of the light, up to kMaxLightSamples
    int resolution = 1024;          // PlanarShadowOptions
    double blurSigma_m = 0;         // PlanarShadowOptions
    double lightSize_m = 0;         // diameter of a point or spot light
    double tangentOfHalfAngle = 0;  // of the angle that a directional light subtends
    uint64_t seed = 0;
};

// The samples of a light: a disc that faces `towards_m`, or of directions.
std::vector<glm::dvec4> planarLightSamples(const SurfaceLight& light, const PlanarLightSettings& settings,
                                           const glm::dvec3& towards_m);

// The shadows that a light's casters, all other instances, throw on each instance that is a plane
// (planarReceiverOf) and marked in `receivers`, on the side that the light's centre is on; empty: all. Those
// without any shadow are left out. number: of the light; its samples have their own random numbers, from the
// seed and it. A light whose numbers are not finite has none.
std::vector<PlanarVisibility::Entry> planarShadowsOf(const SurfaceLight& light, size_t number,
                                                     std::span<const PlacedMesh> placed,
                                                     const PlanarLightSettings& settings,
                                                     const std::vector<bool>& receivers,
                                                     const Profile& profile, const RasterOptions& raster);

}  // namespace etalon
