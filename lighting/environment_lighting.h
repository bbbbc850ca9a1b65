// Diffuse light of the environment, over a number type T. The text is lighting/kernels/environment_light.glsl.
#pragma once

#include <array>
#include <vector>

#include "lighting/surface_scene.h"
#include "numeric/number.h"
#include "probes/irradiance.h"
#include "raster/cube_face.h"
#include "raster/texture.h"

namespace etalon {

template <class T>
class EnvironmentLighting {
  public:
#include "numeric/kernel_scope.inc"

    // The scene's light as T; it outlives this. sampler: of the map.
    EnvironmentLighting(const EnvironmentLight& light, const SamplerSettings& sampler) : light_(light) {
        if (light.kind == EnvironmentLight::Kind::harmonics) harmonics_.setCoefficients(light.harmonics);
        if (light.kind == EnvironmentLight::Kind::texels)
            for (size_t i = 0; i < light.flux.size(); i++) {
                store(light.directions[i]);
                store(light.flux[i]);
            }
        if (light.kind == EnvironmentLight::Kind::map) {
            map_ = TextureView(light.map);
            sampling_ = samplingOf<Cube>(sampler, map_.width(), map_.height());
        }
    }

    // What the text reads, and the functions of other texts that it calls.
    int environmentKind() const { return static_cast<int>(light_.kind); }
    int environmentDegree() const { return light_.harmonics.degree; }
    vec3 sumOfHarmonics(vec3 direction, int degree) { return harmonics_.sumOfHarmonics(direction, degree); }
    int texelLightCount() const { return static_cast<int>(texels_.size() / 6); }
    vec3 irradianceOfSources(const vec3& n, int first, int last) {
        irradiance_.sources = texels_.data();
        return irradiance_.irradianceOfSources(n, first, last);
    }
    vec3 mapAlong(vec3 direction) { return cube_.sampleCubeRgb(map_, direction, sampling_); }

#include "lighting/kernels/environment_light.glsl"

  private:
    using Harmonics = HarmonicsKernel<T>;
    using Cube = CubeFaceKernel<T>;
    using Kept = typename Number<T>::Kept;

    // A vector as T is stored, the same in every lane.
    void store(const glm::dvec3& v) {
        for (int c = 0; c < 3; c++) {
            std::array<Kept, Number<T>::lanes> lanes;
            Number<T>::storeKept(irradiance_.flooredTerm(T(v[c])), lanes.data());
            texels_.push_back(lanes[0]);
        }
    }

    const EnvironmentLight& light_;
    Harmonics harmonics_;
    IrradianceKernel<T> irradiance_;
    Cube cube_;
    TextureView map_;
    typename Cube::Sampling sampling_{};
    std::vector<Kept> texels_;  // direction and flux of each
};

}  // namespace etalon
