// What the environment gives a point of a surface, over a number type T, for the outputs that show it alone.
#pragma once

#include <utility>
#include <vector>

#include "lighting/environment_lighting.h"
#include "lighting/surface_scene.h"
#include "probes/irradiance.h"

namespace etalon {

template <class T>
class EnvironmentIrradiance {
  public:
    using vec3 = glm::vec<3, T>;

    // environment: its light from everywhere; it outlives this. lights: the numbers, among `all`, of the
    // directional lights that it is cut into. sampler: of maps.
    EnvironmentIrradiance(const EnvironmentLight& environment, const std::vector<SurfaceLight>& all,
                          const std::vector<size_t>& lights, const SamplerSettings& sampler)
        : everywhere_(environment, sampler) {
        for (const size_t l : lights)
            lights_.push_back({l, floored(all[l].toLight), floored(all[l].irradiance)});
    }

    // W/m^2 on a plane with the unit normal n. open, bentNormal: what the plane sees of its surroundings
    // (lighting/occlusion.h): the light from everywhere is that in the bent normal, times what is open.
    // reaching(l): the part of light l that reaches it. Lights are added in their order, behind the rest.
    template <class Reaching>
    vec3 at(const vec3& n, const T& open, const vec3& bentNormal, const Reaching& reaching) {
        vec3 sum = kernel_.scale3(everywhere_.environmentIrradiance(bentNormal), open);
        for (const Light& light : lights_)
            sum = kernel_.addIrradiance(sum, n, light.toLight,
                                        kernel_.scale3(light.irradiance, reaching(light.number)));
        return sum;
    }

  private:
    struct Light {
        size_t number;
        vec3 toLight, irradiance;
    };
    vec3 floored(const glm::dvec3& v) {
        return {kernel_.flooredTerm(T(v.x)), kernel_.flooredTerm(T(v.y)), kernel_.flooredTerm(T(v.z))};
    }

    IrradianceKernel<T> kernel_;
    EnvironmentLighting<T> everywhere_;
    std::vector<Light> lights_;
};

}  // namespace etalon
