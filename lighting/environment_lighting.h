// Diffuse light of the environment, over a number type T.
#pragma once

#include <vector>

#include "lighting/surface_scene.h"
#include "numeric/number_lanes.h"
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
    using Stored = TexelStorage<T>;

    // A vector as T is stored, the same in every lane.
    void store(const glm::dvec3& v) {
        for (int c = 0; c < 3; c++) {
            Stored lanes[NumberTraits<T>::lanes];
            TexelFetch<T>::store(kernel_.flooredTerm(T(v[c])), lanes, NumberTraits<T>::lanes);
            texels_.push_back(lanes[0]);
        }
    }
    vec3 load(size_t i) const { return {number(texels_[i]), number(texels_[i + 1]), number(texels_[i + 2])}; }
    static T number(Stored value) {
        if constexpr (requires { T::ofRepresentable(Lanes<Stored, NumberTraits<T>::lanes>(value)); })
            return T::ofRepresentable(Lanes<Stored, NumberTraits<T>::lanes>(value));
        else
            return T(static_cast<double>(value));
    }

    const EnvironmentLight& light_;
    SamplerSettings sampler_;
    Harmonics harmonics_;
    IrradianceKernel<T> kernel_;
    Cube cube_;
    std::vector<Stored> texels_;  // direction and flux of each
};

}  // namespace etalon
