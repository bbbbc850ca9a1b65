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
#include "numeric/kernels/vector.glsl"

    // The scene's light as T; it outlives this. sampler: of the map.
    EnvironmentLighting(const EnvironmentLight& light, const SamplerSettings& sampler) : light_(light) {
        if (light.kind == EnvironmentLight::Kind::harmonics) harmonics_.setCoefficients(light.harmonics);
        if (light.kind == EnvironmentLight::Kind::texels) setTexels(light);
        if (light.kind == EnvironmentLight::Kind::map) {
            map_ = TextureView(light.map);
            sampling_ = samplingOf<Cube>(sampler, map_.width(), map_.height());
        }
    }

    // What the text reads, and the functions of other texts that it calls.
    int environmentKind() const { return static_cast<int>(light_.kind); }
    int environmentDegree() const { return light_.harmonics.degree; }
    vec3 sumOfHarmonics(vec3 direction, int degree) { return harmonics_.sumOfHarmonics(direction, degree); }
    static int texelRunLength() { return kIrradianceRun; }
    int texelRunCount() const { return static_cast<int>(texels_.size() / (kTexelNumbers * kIrradianceRun)); }
    real texelUnscale(int part) const { return part == 0 ? texelUnscale_.first : texelUnscale_.second; }
    vec3 irradianceOfRuns(const vec3& n, int runs, int length) {
        vec3 normal;
        std::array<vec3, IrradianceKernel<T>::kPendingSums> sums;
        irradiance_.sources = texels_.data();
        irradiance_.planeNormals = &normal;
        irradiance_.pendingSums = sums.data();
        return irradiance_.irradianceOfRuns(n, runs, length);
    }
    vec3 mapAlong(vec3 direction) { return cube_.sampleCubeRgb(map_, direction, sampling_); }

#include "lighting/kernels/environment_light.glsl"

  private:
    using Harmonics = HarmonicsKernel<T>;
    using Cube = CubeFaceKernel<T>;
    using Kept = typename Number<T>::Kept;

    static constexpr size_t kTexelNumbers = 6;

    // Directions and scaled flux, the last run filled up with black texels.
    void setTexels(const EnvironmentLight& light) {
        const int exponent = sumExponent<T>(light.flux);
        texelUnscale_ = PowerOfTwoHalves<T>(-exponent);
        const size_t runs = (light.flux.size() + kIrradianceRun - 1) / kIrradianceRun;
        texels_.assign(std::max(runs, size_t{1}) * kIrradianceRun * kTexelNumbers, Kept(0.0));
        for (size_t i = 0; i < light.flux.size(); i++)
            for (int c = 0; c < 3; c++) {
                Kept* const numbers = texels_.data() + i * kTexelNumbers + c;
                numbers[0] = keptTerm(light.directions[i][c]);
                numbers[3] = keptTerm(std::ldexp(light.flux[i][c], exponent));
            }
    }
    Kept keptTerm(double a) {
        std::array<Kept, Number<T>::lanes> lanes;
        Number<T>::storeKept(irradiance_.flooredTerm(T(a)), lanes.data());
        return lanes[0];
    }

    const EnvironmentLight& light_;
    Harmonics harmonics_;
    IrradianceKernel<T> irradiance_;
    Cube cube_;
    TextureView map_;
    typename Cube::Sampling sampling_{};
    std::vector<Kept> texels_;  // direction and scaled flux of each
    PowerOfTwoHalves<T> texelUnscale_{0};
};

}  // namespace etalon
