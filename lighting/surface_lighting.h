// What points of surfaces show, over a number type T: the text lighting/kernels/surface_shading.glsl with the lights
// that it reads, per fragment and per vertex.
#pragma once

#include <vector>

#include "lighting/environment_lighting.h"
#include "lighting/shading_kernels.h"
#include "lighting/surface_scene.h"

namespace etalon {

template <class T>
class SurfaceLighting {
  public:
    using K = ShadingKernels<T>;
    // What the text takes and hands on is not copied.
    using Reflectances = const typename K::Reflectances&;
    using SurfacePoint = const typename K::SurfacePoint&;
    using Reflected = typename K::Reflected;
    using LightBuffer = typename K::LightBuffer;
    using VisibilityBuffer = typename K::VisibilityBuffer;
#include "numeric/kernel_scope.inc"
#include "numeric/kernels/vector.glsl"
#include "lighting/kernels/lambert.glsl"

    // The lights as T; what lights outlives this. sampler: of maps. casts: for each light of LightSources::lights
    // whether its visibility is asked for, which then is in the row of the light's number; empty: of none.
    SurfaceLighting(const LightSources& from, const SamplerSettings& sampler,
                    const std::vector<bool>& casts = {})
        : environment_(*from.environment, sampler) {
        for (size_t l = 0; l < from.lights->size(); l++) {
            if (from.shows && !(*from.shows)[l]) continue;
            const bool isCast = !casts.empty() && casts[l];
            lights_.push_back(recordOf((*from.lights)[l], isCast ? static_cast<int>(l) : -1));
            hasPlaces_ = hasPlaces_ || lights_.back().light.kind != 0;
        }
    }

    // Whether anything is reflected diffusely, and specularly.
    bool hasDiffuse() const { return !lights_.empty() || environmentKind() != 0; }
    bool hasSpecular() const { return !lights_.empty(); }
    // Whether a light needs the point's position.
    bool hasPlaces() const { return hasPlaces_; }
    LightBuffer lights() const { return {lights_.data(), static_cast<int>(lights_.size())}; }

    static vec3 constant(const glm::dvec3& v) { return vec3(T(v.x), T(v.y), T(v.z)); }
    static typename K::Reflectances reflectancesOf(const SurfaceMaterial& material) {
        typename K::Reflectances r;
        r.diffuse = constant(material.diffuse), r.diffuse2 = constant(material.diffuse2);
        r.perSquare = T(1.0 / material.checkerSize_m);
        r.hasChecker = material.checker ? 1 : 0;
        r.specular = constant(material.specular);
        r.exponent = T(material.exponent), r.lobeScale = T((material.exponent + 8.0) / kEightPi);
        r.mirror = constant(material.reflectance);
        return r;
    }

    // What the text calls beside vectors: functions of texts of their own.
    Reflected reflectedOfLights(bool diffuse, bool specular, SurfacePoint p, Reflectances r,
                                const vec3& albedo, const LightBuffer& lights,
                                const VisibilityBuffer& shadows) {
        if constexpr (Number<T>::isNative)
            return reflectedFlattened(diffuse, specular, p, r, albedo, lights, shadows);
        else
            return kernels_.reflectedOfLights(diffuse, specular, p, r, albedo, lights, shadows);
    }
    int environmentKind() const { return environment_.environmentKind(); }
    [[gnu::noinline]] vec3 environmentIrradiance(const vec3& n) {
        return environment_.environmentIrradiance(n);
    }

#include "lighting/kernels/surface_shading.glsl"

  private:
    static constexpr double kEightPi = 25.132741228718345;

    // Constants stay in registers from light to light.
    [[gnu::flatten, gnu::noinline]] Reflected reflectedFlattened(bool diffuse, bool specular, SurfacePoint p,
                                                                 Reflectances r, const vec3& albedo,
                                                                 const LightBuffer& lights,
                                                                 const VisibilityBuffer& shadows) {
        return kernels_.reflectedOfLights(diffuse, specular, p, r, albedo, lights, shadows);
    }

    typename K::LightRecord recordOf(const SurfaceLight& light, int shadowRow) {
        const bool isFar = light.kind == LightKind::directional;
        const vec3 power = constant(isFar ? light.irradiance : light.intensity);
        return {{constant(isFar ? light.toLight : light.position_m), static_cast<int>(light.kind), power,
                 shadowRow, kernels_.isEverywhere(kernels_.isFinite3(power)) ? 1 : 0},
                {constant(light.axis), T(light.cosInner), T(light.cosOuter)}};
    }

    K kernels_;
    EnvironmentLighting<T> environment_;
    std::vector<typename K::LightRecord> lights_;
    bool hasPlaces_ = false;
};

}  // namespace etalon
