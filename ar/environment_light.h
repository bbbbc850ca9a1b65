// The environment of a scene as light for its surfaces.
#pragma once

#include <string>
#include <vector>

#include "lighting/surface_scene.h"
#include "probes/probe_light.h"
#include "raster/profile.h"
#include "scene/scene.h"

namespace etalon {

// Directional lights (median cut, or the dominant ones), or what reaches diffuse surfaces from everywhere.
struct EnvironmentIllumination {
    std::vector<ProbeLight> lights;  // black ones are left out
    EnvironmentLight diffuse;
    std::vector<std::string> warnings;
};

// The light as which a light of a probe shines on surfaces.
SurfaceLight surfaceLightOf(const ProbeLight& light);

// What the environment lights surfaces with, as `environment.lighting` says. radiance: its image, or the constant,
// and its rotation. Computed in profile.environment, but: the blurred map is blurred in profile.fragment, harmonics
// of radiance become those of irradiance in double (one product each), and dominant lights are found in double.
EnvironmentIllumination environmentIllumination(const Environment& environment,
                                                const SurfaceEnvironment& radiance, const Profile& profile,
                                                int threads);

}  // namespace etalon
