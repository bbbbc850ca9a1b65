// What the lights of a scene reflect from a point of a surface, over a number type T: per fragment and per
// vertex the same text.
#pragma once

#include <vector>

#include "lighting/shading_kernels.h"
#include "lighting/surface_scene.h"

namespace etalon {

template <class T>
class SurfaceLighting {
  public:
    using K = ShadingKernels<T>;
    using vec3 = typename K::vec3;

    // What the lights of a point add up to.
    struct Reflected {
        vec3 diffuse, specular;
    };

    // The lights as T; the scene outlives this.
    explicit SurfaceLighting(const SurfaceScene& scene) {
        for (const SurfaceLight& light : scene.lights) {
            toLight_.push_back(constant(light.toLight));
            irradiance_.push_back(constant(light.irradiance));
            finiteLight_.push_back(everyLane(isFinite(irradiance_.back())));
        }
    }

    bool empty() const { return toLight_.empty(); }

    static vec3 constant(const glm::dvec3& v) { return vec3(T(v.x), T(v.y), T(v.z)); }

    // The diffuse reflectance at surface coordinates u, v in metres.
    vec3 surfaceColour(const SurfaceMaterial& material, T u, T v) {
        const vec3 even = constant(material.diffuse), odd = constant(material.diffuse2);
        if (!material.checker) return even;
        const auto isOdd = kernels_.isOddSquare(u, v, T(1.0 / material.checkerSize_m));
        return vec3(K::select(isOdd, odd.x, even.x), K::select(isOdd, odd.y, even.y),
                    K::select(isOdd, odd.z, even.z));
    }

    // n: unit normal on the side that is seen; toEye: unit; surface: diffuse reflectance. Components that are
    // not asked for are 0. Flattened, so that constants stay in registers from light to light.
    [[gnu::flatten]] Reflected reflected(const SurfaceMaterial& material, vec3 n, vec3 toEye, vec3 surface,
                                         bool diffuse, bool specular) {
        const vec3 colour = constant(material.specular);
        const T exponent(material.exponent), scale((material.exponent + 8.0) / kEightPi);
        Reflected sum{constant(glm::dvec3(0)), constant(glm::dvec3(0))};
        // A light behind the surfaces of all lanes adds zeros, unless something here is not finite.
        const bool hasZeros = everyLane(isFinite(toEye) && isFinite(scale));
        for (size_t l = 0; l < toLight_.size(); l++) {
            const bool isBehind = everyLane(kernels_.dot3(n, toLight_[l]) <= T(0.0));
            if (isBehind && hasZeros && finiteLight_[l]) continue;
            if (diffuse)
                sum.diffuse =
                    kernels_.add3(sum.diffuse, kernels_.lambert(n, toLight_[l], irradiance_[l], surface));
            if (specular)
                sum.specular = kernels_.add3(
                    sum.specular,
                    kernels_.blinnPhong(n, toEye, toLight_[l], irradiance_[l], colour, exponent, scale));
        }
        return sum;
    }

  private:
    static constexpr double kEightPi = 25.132741228718345;

    using Condition = typename K::boolean;
    static bool everyLane(const Condition& c) { return !anyOf(!c); }
    static Condition isFinite(const T& a) { return a - a == T(0.0); }
    static Condition isFinite(const vec3& a) { return isFinite(a.x) && isFinite(a.y) && isFinite(a.z); }

    K kernels_;
    std::vector<vec3> toLight_, irradiance_;
    std::vector<bool> finiteLight_;  // whether the irradiance is, as a T
};

}  // namespace etalon
