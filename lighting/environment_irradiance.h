// What the environment gives a point of a surface, over a number type T, for the outputs that show it alone: the text
// lighting/kernels/environment_irradiance.glsl with the lights that it reads.
#pragma once

#include <vector>

#include "lighting/environment_lighting.h"
#include "lighting/surface_scene.h"
#include "probes/irradiance.h"

namespace etalon {

template <class T>
class EnvironmentIrradiance {
  public:
#include "numeric/kernel_scope.inc"
#include "lighting/light_scope.inc"
#include "numeric/kernels/vector.glsl"
#include "probes/flux_scope.inc"
#include "probes/kernels/flux.glsl"
#include "probes/kernels/irradiance.glsl"

    // environment: its light from everywhere; it outlives this. lights: the numbers, among `all`, of the
    // directional lights that it is cut into. sampler: of maps. casts: for each of `all` whether its visibility is
    // asked for, which then is in the row of the light's number; empty: of none.
    EnvironmentIrradiance(const EnvironmentLight& environment, const std::vector<SurfaceLight>& all,
                          const std::vector<size_t>& lights, const SamplerSettings& sampler,
                          const std::vector<bool>& casts)
        : everywhere_(environment, sampler) {
        const auto constant = [](const glm::dvec3& v) { return vec3(T(v.x), T(v.y), T(v.z)); };
        for (const size_t l : lights) {
            const int shadowRow = !casts.empty() && casts[l] ? static_cast<int>(l) : -1;
            lights_.push_back(
                {{flooredTerm3(constant(all[l].toLight)), 0, constant(all[l].irradiance), shadowRow, 0}, {}});
        }
    }

    LightBuffer lights() const { return {lights_.data(), static_cast<int>(lights_.size())}; }

    // What the text calls.
    vec3 environmentIrradiance(const vec3& n) { return everywhere_.environmentIrradiance(n); }

#include "lighting/kernels/environment_irradiance.glsl"

  private:
    EnvironmentLighting<T> everywhere_;
    std::vector<LightRecord> lights_;
};

}  // namespace etalon
