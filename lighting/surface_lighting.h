// What the lights of a scene reflect from a point of a surface, over a number type T: per fragment and per
// vertex the same text.
#pragma once

#include <span>
#include <vector>

#include "lighting/environment_lighting.h"
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
    // What a point sees of its surroundings (lighting/occlusion.h).
    struct Surroundings {
        T open;
        vec3 bentNormal;
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

    // The lights as T; what lights outlives this. sampler: of maps.
    SurfaceLighting(const LightSources& from, const SamplerSettings& sampler)
        : environment_(*from.environment, sampler) {
        for (size_t l = 0; l < from.lights->size(); l++) {
            if (from.shows && !(*from.shows)[l]) continue;
            const SurfaceLight& light = (*from.lights)[l];
            const bool isFar = light.kind == LightKind::directional;
            const vec3 power = constant(isFar ? light.irradiance : light.intensity);
            lights_.push_back(
                {constant(isFar ? light.toLight : light.position_m), power, everyLane(isFinite(power))});
            sources_.push_back(&light);
            numbers_.push_back(l);
            hasPlaces_ = hasPlaces_ || !isFar;
        }
    }

    // Whether anything is reflected diffusely, and specularly.
    bool hasDiffuse() const { return !lights_.empty() || !environment_.empty(); }
    bool hasSpecular() const { return !lights_.empty(); }
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
    // light l of LightSources::lights is multiplied with shadows.visibility(l). Lights are added in their order, the environment
    // last: its irradiance in the normal or, with surroundings, in the bent normal times what is open.
    template <class Shadows = Unshadowed>
    Reflected reflected(const SurfaceMaterial& material, const Point& point, vec3 surface, bool diffuse,
                        bool specular, const Shadows& shadows = {},
                        const Surroundings* surroundings = nullptr) {
        const Request request{material, point, surface, diffuse, specular};
        Reflected sum{constant(glm::dvec3(0)), constant(glm::dvec3(0))};
        // Runs of lights that arrive as they are, and single ones that do not.
        size_t done = 0;
        for (size_t l = 0; l < lights_.size(); l++) {
            const bool isCast = shadows.casts(numbers_[l]);
            if (sources_[l]->kind == LightKind::directional && !isCast) continue;
            addLights(request, std::span(lights_).subspan(done, l - done), sum);
            Light arriving =
                sources_[l]->kind == LightKind::directional ? lights_[l] : arrivingFrom(l, point);
            if (isCast)
                arriving.irradiance = kernels_.scale3(arriving.irradiance, shadows.visibility(numbers_[l]));
            addLights(request, std::span(&arriving, 1), sum);
            done = l + 1;
        }
        addLights(request, std::span(lights_).subspan(done), sum);
        if (diffuse && !environment_.empty()) addEnvironment(request, surroundings, sum);
        return sum;
    }

  private:
    static constexpr double kEightPi = 25.132741228718345;

    // What arrives at a point; of a point or spot light its position and intensity instead.
    struct Light {
        vec3 toLight, irradiance;
        bool isFinite;  // whether the irradiance is, in every lane
    };
    struct Request {
        const SurfaceMaterial& material;
        const Point& point;
        const vec3& surface;
        bool diffuse, specular;
    };

    using Condition = typename K::boolean;
    static bool everyLane(const Condition& c) { return !anyOf(!c); }
    static Condition isFinite(const T& a) { return a - a == T(0.0); }
    static Condition isFinite(const vec3& a) { return isFinite(a.x) && isFinite(a.y) && isFinite(a.z); }

    [[gnu::noinline]] Light arrivingFrom(size_t l, const Point& point) {
        const SurfaceLight& source = *sources_[l];
        const auto arriving = kernels_.pointLight(lights_[l].toLight, point.position);
        T part = arriving.perIntensity;
        if (source.kind == LightKind::spot)
            part = part * kernels_.spotPart(arriving.toLight, constant(source.axis), T(source.cosInner),
                                            T(source.cosOuter));
        const vec3 irradiance = kernels_.scale3(lights_[l].irradiance, part);
        return {arriving.toLight, irradiance, everyLane(isFinite(irradiance))};
    }

    void addLights(const Request& request, std::span<const Light> lights, Reflected& total) {
        if constexpr (Number<T>::isNative)
            addLightsFlattened(request, lights, total);
        else
            addEachLight(request, lights, total);
    }
    // Constants stay in registers from light to light.
    [[gnu::flatten, gnu::noinline]] void addLightsFlattened(const Request& request,
                                                            std::span<const Light> lights, Reflected& total) {
        addEachLight(request, lights, total);
    }
    void addEachLight(const Request& request, std::span<const Light> lights, Reflected& total) {
        const vec3 n = request.point.normal, toEye = request.point.toEye, surface = request.surface;
        const vec3 colour = constant(request.material.specular);
        const T exponent(request.material.exponent), scale((request.material.exponent + 8.0) / kEightPi);
        Reflected sum = total;
        // A light behind the surfaces of all lanes adds zeros, unless something here is not finite.
        const bool hasZeros = everyLane(isFinite(toEye) && isFinite(scale));
        for (const Light& light : lights) {
            const bool isBehind = everyLane(kernels_.dot3(n, light.toLight) <= T(0.0));
            if (isBehind && hasZeros && light.isFinite) continue;
            if (request.diffuse)
                sum.diffuse =
                    kernels_.add3(sum.diffuse, kernels_.lambert(n, light.toLight, light.irradiance, surface));
            if (request.specular)
                sum.specular = kernels_.add3(
                    sum.specular,
                    kernels_.blinnPhong(n, toEye, light.toLight, light.irradiance, colour, exponent, scale));
        }
        total = sum;
    }

    [[gnu::noinline]] void addEnvironment(const Request& request, const Surroundings* surroundings,
                                          Reflected& sum) {
        vec3 irradiance =
            environment_.irradiance(surroundings ? surroundings->bentNormal : request.point.normal);
        if (surroundings) irradiance = kernels_.scale3(irradiance, surroundings->open);
        sum.diffuse = kernels_.add3(sum.diffuse, kernels_.lambertOfIrradiance(irradiance, request.surface));
    }

    K kernels_;
    EnvironmentLighting<T> environment_;
    std::vector<Light> lights_;
    std::vector<const SurfaceLight*> sources_;
    std::vector<size_t> numbers_;  // among LightSources::lights
    bool hasPlaces_ = false;
};

}  // namespace etalon
