// Diffuse light of the environment, over a number type T.
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
    using vec3 = glm::vec<3, T>;

    // The scene's light as T; it outlives this. sampler: of the map.
    EnvironmentLighting(const EnvironmentLight& light, const SamplerSettings& sampler)
        : light_(light), sampler_(sampler) {
        if (light.kind == EnvironmentLight::Kind::harmonics) harmonics_.setCoefficients(light.harmonics);
        if (light.kind != EnvironmentLight::Kind::texels) return;
        for (size_t i = 0; i < light.flux.size(); i++) {
            store(light.directions[i]);
            store(light.flux[i]);
        }
    }

    bool empty() const { return light_.kind == EnvironmentLight::Kind::none; }

    // The irradiance of a plane with the unit normal n. Texels are added in their order from 0.
    vec3 irradiance(const vec3& n) {
        const T zero(0.0);
        switch (light_.kind) {
            case EnvironmentLight::Kind::none:
                break;
            case EnvironmentLight::Kind::harmonics: {
                const vec3 e = harmonics_.sumOfHarmonics(n, light_.harmonics.degree);
                return {Harmonics::maxOf(zero, e.x), Harmonics::maxOf(zero, e.y),
                        Harmonics::maxOf(zero, e.z)};
            }
            case EnvironmentLight::Kind::texels: {
                vec3 sum(zero, zero, zero);
                for (size_t i = 0; i < texels_.size(); i += 6)
                    sum = kernel_.addIrradiance(sum, n, load(i), load(i + 3));
                return sum;
            }
            case EnvironmentLight::Kind::map: {
                const TextureView texture(light_.map);
                return cube_.sampleCubeRgb(texture, n,
                                           samplingOf<Cube>(sampler_, texture.width(), texture.height()));
            }
        }
        return {zero, zero, zero};
    }

  private:
    using Harmonics = HarmonicsKernel<T>;
    using Cube = CubeFaceKernel<T>;
    using Kept = typename Number<T>::Kept;

    // A vector as T is stored, the same in every lane.
    void store(const glm::dvec3& v) {
        for (int c = 0; c < 3; c++) {
            std::array<Kept, Number<T>::lanes> lanes;
            Number<T>::storeKept(kernel_.flooredTerm(T(v[c])), lanes.data());
            texels_.push_back(lanes[0]);
        }
    }
    vec3 load(size_t i) const {
        const auto number = [&](size_t j) { return Number<T>::broadcast(texels_[j]); };
        return {number(i), number(i + 1), number(i + 2)};
    }

    const EnvironmentLight& light_;
    SamplerSettings sampler_;
    Harmonics harmonics_;
    IrradianceKernel<T> kernel_;
    Cube cube_;
    std::vector<Kept> texels_;  // direction and flux of each
};

}  // namespace etalon
