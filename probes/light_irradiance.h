// Irradiance from the lights of a probe, for every direction of a surface. The text is
// probes/kernels/irradiance_sums.glsl.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "numeric/parallel.h"
#include "probes/irradiance.h"
#include "probes/probe_light.h"
#include "probes/texel_grid.h"

namespace etalon {

// Of the mean irradiance for up to 64 lights, relative; see irradianceOfLights. That of the arithmetic is
// probeErrors().meanOfLights (probes/probe_errors.h).
inline constexpr double kMeanOfTexelsError = 0.75;

// What irradiance_sums.glsl reads, and the texts, over T: one plane at a time, the sources as they lie in lanes.
template <class T>
struct LightIrradianceKernel {
#include "numeric/kernel_scope.inc"
#include "probes/flux_scope.inc"
#include "numeric/kernels/vector.glsl"
#include "probes/kernels/flux.glsl"
#include "probes/kernels/irradiance.glsl"
    struct Source {
        vec3 direction, flux;
    };
    const Source* sources;
    vec3 onlyNormal, onlySum;

    const vec3& sourceDirection(int i) const { return sources[i].direction; }
    const vec3& sourceFlux(int i) const { return sources[i].flux; }
    const vec3& planeNormal(int) const { return onlyNormal; }
    void setPlaneNormal(const vec3& normal) { onlyNormal = normal; }
    const vec3& pendingSum(int, int) const { return onlySum; }
    void setPendingSum(int, int, const vec3& sum) { onlySum = sum; }
#include "probes/kernels/irradiance_sums.glsl"

    // The sum stays in registers: as calls, its steps pass it through memory.
    [[gnu::flatten]] vec3 flattenedIrradiance(const vec3& n, int count) {
        return irradianceOfSources(n, 0, count);
    }
};

// For the direction n of each texel (of the world) the sum over the lights of energy max(0, n . direction),
// three channels in W/m^2, added in the lights' order from 0; directions and energies are rounded once to T.
// Neither threads nor lanes change a bit.
//
// Whatever the directions of the lights, the mean over all directions n is exactly a quarter of the lights'
// total energy: pi, if the radiance is 1 everywhere. The mean over the texels of an image of W x W/2,
// weighted with their solid angles, differs from it by the error of the midpoint rule, at most
// kMeanOfTexelsError / W^2 of it, and by that of the arithmetic.
template <class T>
std::vector<Image<double>> irradianceOfLights(std::span<const ProbeLight> lights, const ProbeShape& shape,
                                              int threads = 0) {
    using Kernel = LightIrradianceKernel<T>;
    using vec3 = typename Kernel::vec3;
    constexpr int kWidth = Number<T>::lanes;
    std::vector<typename Kernel::Source> sources;
    for (const ProbeLight& l : lights)
        sources.push_back({vec3(T(l.direction.x), T(l.direction.y), T(l.direction.z)),
                           vec3(T(l.energy.x), T(l.energy.y), T(l.energy.z))});
    const TexelGrid grid(shape);
    std::vector<Image<double>> irradiance(static_cast<size_t>(shape.layers()),
                                          Image<double>(shape.width, shape.height, 3));
    const auto height = static_cast<size_t>(shape.height);
    parallelFor(irradiance.size() * height, threads, [&](size_t item) {
        const int layer = static_cast<int>(item / height), y = static_cast<int>(item % height);
        Image<double>& image = irradiance[static_cast<size_t>(layer)];
        Kernel kernel{sources.data(), {}, {}};
        forEachLaneGroup<kWidth>(static_cast<size_t>(shape.width), [&](size_t first, int active) {
            std::array<glm::dvec3, kWidth> directions;
            for (int i = 0; i < kWidth; i++)
                directions[static_cast<size_t>(i)] =
                    grid.direction(layer, static_cast<int>(first) + std::min(i, active - 1), y);
            const auto component = [&](int c) {
                return Number<T>::generate([&](int i) { return directions[static_cast<size_t>(i)][c]; });
            };
            const vec3 normal(component(0), component(1), component(2));
            const auto count = static_cast<int>(lights.size());
            vec3 sum;
            if constexpr (Number<T>::isNative)
                sum = kernel.flattenedIrradiance(normal, count);
            else
                sum = kernel.irradianceOfSources(normal, 0, count);
            for (int c = 0; c < 3; c++)
                for (int i = 0; i < active; i++)
                    image.at(static_cast<int>(first) + i, y, c) = numberLane(sum[c], i);
        });
    });
    return irradiance;
}

}  // namespace etalon
