// Irradiance from the lights of a probe, for every direction of a surface. The text is
// probes/kernels/irradiance.glsl.
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
    using Kernel = IrradianceKernel<T>;
    using vec3 = typename Kernel::vec3;
    constexpr int kWidth = Number<T>::lanes;
    struct Light {
        vec3 direction, energy;
    };
    std::vector<Light> rounded;
    for (const ProbeLight& l : lights)
        rounded.push_back({vec3(T(l.direction.x), T(l.direction.y), T(l.direction.z)),
                           vec3(T(l.energy.x), T(l.energy.y), T(l.energy.z))});
    const TexelGrid grid(shape);
    std::vector<Image<double>> irradiance(static_cast<size_t>(shape.layers()),
                                          Image<double>(shape.width, shape.height, 3));
    const auto height = static_cast<size_t>(shape.height);
    parallelFor(irradiance.size() * height, threads, [&](size_t item) {
        const int layer = static_cast<int>(item / height), y = static_cast<int>(item % height);
        Image<double>& image = irradiance[static_cast<size_t>(layer)];
        Kernel kernel;
        forEachLaneGroup<kWidth>(static_cast<size_t>(shape.width), [&](size_t first, int active) {
            std::array<glm::dvec3, kWidth> directions;
            for (int i = 0; i < kWidth; i++)
                directions[static_cast<size_t>(i)] =
                    grid.direction(layer, static_cast<int>(first) + std::min(i, active - 1), y);
            const auto component = [&](int c) {
                return Number<T>::generate([&](int i) { return directions[static_cast<size_t>(i)][c]; });
            };
            const vec3 normal(component(0), component(1), component(2));
            vec3 sum(T(0.0), T(0.0), T(0.0));
            for (const Light& light : rounded)
                sum = kernel.addIrradiance(sum, normal, light.direction, light.energy);
            for (int c = 0; c < 3; c++)
                for (int i = 0; i < active; i++)
                    image.at(static_cast<int>(first) + i, y, c) = numberLane(sum[c], i);
        });
    });
    return irradiance;
}

}  // namespace etalon
