// The environment of a scene as light for its surfaces.
#pragma once

#include "ar/scene.h"
#include "lighting/surface_scene.h"
#include "probes/probe_light.h"
#include "raster/profile.h"

namespace etalon {

// Adds to the surfaces what the environment lights them with, as `environment.lighting` says: lights behind
// those of the scene (median cut, or the dominant ones), or the light of surfaces.environment.
// `surfaces.environment` holds the image, or the constant radiance, and its rotation. Everything is computed
// in double; only the blurred map is blurred in the profile's arithmetic. Returns the lights that were added,
// in their order; black ones are left out.
std::vector<ProbeLight> addEnvironmentLight(const Environment& environment, const Profile& profile,
                                            int threads, SurfaceScene& surfaces);

}  // namespace etalon
