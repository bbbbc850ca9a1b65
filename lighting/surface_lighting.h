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

    // A point of a surface: where it is, its unit normal on the side that is seen, the unit vector to the
    // eye.
    struct Point {
        vec3 position, normal, toEye;
    };
    // What the lights of a point add up to.
    struct Reflected {
        vec3 diffuse, specular;
    };
    // Nothing stands between the lights and the point.
    struct Unshadowed {
        static constexpr bool casts(size_t) { return false; }
        static T visibility(size_t) { return T(1.0); }
    };

    // The lights as T; the scene outlives this.
    explicit SurfaceLighting(const SurfaceScene& scene) {
        for (const SurfaceLight& light : scene.lights) {
            const bool isFar = light.kind == LightKind::directional;
            lights_.push_back({&light, constant(isFar ? light.toLight : light.position_m),
                               constant(isFar ? light.irradiance : light.intensity), constant(light.axis),
                               T(light.cosInner), T(light.cosOuter), false});
            lights_.back().isFinite = everyLane(isFinite(lights_.back().power));
            hasPlaces_ = hasPlaces_ || !isFar;
        }
    }

    bool empty() const { return lights_.empty(); }
    // Whether a light needs the point's position.
    bool hasPlaces() const { return hasPlaces_; }

    static vec3 constant(const glm::dvec3& v) { return vec3(T(v.x), T(v.y), T(v.z)); }

    // The diffuse reflectance at surface coordinates u, v in metres.
    vec3 surfaceColour(const SurfaceMaterial& material, T u, T v) {
        const vec3 even = constant(material.diffuse), odd = constant(material.diffuse2);
        if (!material.checker) return even;
        const auto isOdd = kernels_.isOddSquare(u, v, T(1.0 / material.checkerSize_m));
        return vec3(K::select(isOdd, odd.x, even.x), K::select(isOdd, odd.y, even.y),
                    K::select(isOdd, odd.z, even.z));
    }

    // surface: diffuse reflectance. Components that are not asked for are 0. shadows.casts(l) says whether
    // light l is multiplied with shadows.visibility(l). Flattened, so that constants stay in registers from
    // light to light.
    template <class Shadows = Unshadowed>
    [[gnu::flatten]] Reflected reflected(const SurfaceMaterial& material, const Point& point, vec3 surface,
                                         bool diffuse, bool specular, const Shadows& shadows = {}) {
        const vec3 n = point.normal, toEye = point.toEye;
        const vec3 colour = constant(material.specular);
        const T exponent(material.exponent), scale((material.exponent + 8.0) / kEightPi);
        Reflected sum{constant(glm::dvec3(0)), constant(glm::dvec3(0))};
        // A light behind the surfaces of all lanes adds zeros, unless something here is not finite.
        const bool hasZeros = everyLane(isFinite(toEye) && isFinite(scale));
        for (size_t l = 0; l < lights_.size(); l++) {
            const Light& light = lights_[l];
            vec3 toLight = light.place, irradiance = light.power;
            if (light.source->kind != LightKind::directional) {
                const auto arriving = kernels_.pointLight(light.place, point.position);
                toLight = arriving.toLight;
                T part = arriving.perIntensity;
                if (light.source->kind == LightKind::spot)
                    part = part * kernels_.spotPart(toLight, light.axis, light.cosInner, light.cosOuter);
                irradiance = kernels_.scale3(irradiance, part);
            }
            const bool isBehind = everyLane(kernels_.dot3(n, toLight) <= T(0.0));
            if (isBehind && hasZeros && light.isFinite) continue;
            if (shadows.casts(l)) irradiance = kernels_.scale3(irradiance, shadows.visibility(l));
            if (diffuse)
                sum.diffuse = kernels_.add3(sum.diffuse, kernels_.lambert(n, toLight, irradiance, surface));
            if (specular)
                sum.specular = kernels_.add3(sum.specular, kernels_.blinnPhong(n, toEye, toLight, irradiance,
                                                                               colour, exponent, scale));
        }
        return sum;
    }

  private:
    static constexpr double kEightPi = 25.132741228718345;

    struct Light {
        const SurfaceLight* source;
        vec3 place;  // the direction towards it, or its position
        vec3 power;  // irradiance or intensity
        vec3 axis;
        T cosInner, cosOuter;
        bool isFinite;  // whether power is, as a T
    };

    using Condition = typename K::boolean;
    static bool everyLane(const Condition& c) { return !anyOf(!c); }
    static Condition isFinite(const T& a) { return a - a == T(0.0); }
    static Condition isFinite(const vec3& a) { return isFinite(a.x) && isFinite(a.y) && isFinite(a.z); }

    K kernels_;
    std::vector<Light> lights_;
    bool hasPlaces_ = false;
};

}  // namespace etalon
