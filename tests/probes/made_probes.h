// Probes that tests make.
#pragma once

#include <array>
#include <cmath>

#include "numeric/truth.h"
#include "probes/probe.h"
#include "probes/texel_grid.h"
#include "raster/profile.h"
#include "tests/support/random_numbers.h"

namespace etalon {

inline constexpr Arithmetic kAllArithmetics[] = {
    Arithmetic::truth, Arithmetic::fp64,     Arithmetic::fp32, Arithmetic::fp32Flush, Arithmetic::fp32Nv40,
    Arithmetic::fp16,  Arithmetic::fp16Nv40, Arithmetic::bf16, Arithmetic::fp24R300};

// Every texel shows value(layer, x, y, channel).
template <class F>
Probe madeProbe(const ProbeShape& shape, F&& value) {
    Probe probe;
    probe.shape = shape;
    for (int layer = 0; layer < shape.layers(); layer++) {
        Image<float>& image = probe.radiance.emplace_back(shape.width, shape.height, 3);
        for (int c = 0; c < 3; c++)
            for (int y = 0; y < shape.height; y++)
                for (int x = 0; x < shape.width; x++)
                    image.at(x, y, c) = static_cast<float>(value(layer, x, y, c));
    }
    return probe;
}

inline Probe constantProbe(const ProbeShape& shape, double radiance) {
    return madeProbe(shape, [&](int, int, int, int) { return radiance; });
}

inline Probe randomProbe(const ProbeShape& shape, uint64_t seed) {
    RandomNumbers random(seed);
    return madeProbe(shape, [&](int, int, int, int) { return random.uniform(0, 1); });
}

inline glm::dvec3 randomUnitVector(RandomNumbers& random) {
    for (;;) {
        const glm::dvec3 d{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
        const double square = d.x * d.x + d.y * d.y + d.z * d.z;
        if (square > 1e-2 && square < 1) return d / std::sqrt(square);
    }
}

// A rotation by an angle about an axis.
inline glm::dmat3 rotationAbout(const glm::dvec3& a, double angle_rad) {
    const double c = std::cos(angle_rad), s = std::sin(angle_rad), k = 1 - c;
    return {{c + k * a.x * a.x, k * a.x * a.y + s * a.z, k * a.x * a.z - s * a.y},
            {k * a.x * a.y - s * a.z, c + k * a.y * a.y, k * a.y * a.z + s * a.x},
            {k * a.x * a.z + s * a.y, k * a.y * a.z - s * a.x, c + k * a.z * a.z}};
}
inline glm::dmat3 randomRotation(RandomNumbers& random) {
    const glm::dvec3 axis = randomUnitVector(random);
    return rotationAbout(axis, random.uniform(-3, 3));
}

// Directions and weights that integrate harmonics exactly: `points` heights of Gauss and Legendre (degrees up
// to 2 points - 1) times `columns` longitudes (orders up to columns - 1).
struct WeightedDirection {
    glm::dvec3 direction;
    double weight;
};
inline std::vector<WeightedDirection> exactQuadrature(int points, int columns) {
    constexpr double kPi = 0x1.921fb54442d18p+1;
    std::vector<WeightedDirection> list;
    for (int i = 0; i < points; i++) {
        long double z = std::cos(kPi * (i + 0.75) / (points + 0.5)), slope = 0;
        for (int step = 0; step < 10; step++) {
            long double before = 1, value = z;
            for (int n = 2; n <= points; n++) {
                const long double next = ((2 * n - 1) * z * value - (n - 1) * before) / n;
                before = value, value = next;
            }
            slope = points * (z * value - before) / (z * z - 1);
            z -= value / slope;
        }
        const auto sine = static_cast<double>(std::sqrt(1 - z * z));
        for (int k = 0; k < columns; k++) {
            const double phi = 2 * kPi * k / columns;
            list.push_back({{sine * std::cos(phi), sine * std::sin(phi), static_cast<double>(z)},
                            static_cast<double>(2 / ((1 - z * z) * slope * slope)) * 2 * kPi / columns});
        }
    }
    return list;
}

// Every mapping; of the ball both views.
inline constexpr ProbeShape kSmallShapes[] = {
    {Mapping::latLong, 37, 19},         {Mapping::latLong, 16, 8},
    {Mapping::latLongPedersen, 22, 11}, {Mapping::cube, 9, 9},
    {Mapping::angular, 17, 17},         {Mapping::mirrorBall, 16, 16},
    {Mapping::mirrorBall, 15, 15, 3},   {Mapping::octahedral, 13, 13}};

// Shapes for unit radiance, with the largest relative error of the irradiance over normals that the midpoint
// rule makes.
struct Furnace {
    ProbeShape shape;
    double quadrature;

    // Of the half angle of the cone that a near ball hides.
    double sineOfHidden() const {
        return shape.mapping == Mapping::mirrorBall ? 1 / shape.ballDistance_radii : 0;
    }
    double shown_sr() const {
        return 2 * M_PI * (1 + std::sqrt((1 - sineOfHidden()) * (1 + sineOfHidden())));
    }
};
inline constexpr Furnace kFurnaces[] = {
    {{Mapping::latLong, 64, 32}, 1.5e-3},         {{Mapping::latLong, 37, 19}, 4e-3},
    {{Mapping::latLongPedersen, 64, 32}, 1.5e-3}, {{Mapping::cube, 16, 16}, 1.5e-3},
    {{Mapping::angular, 48, 48}, 1.5e-3},         {{Mapping::mirrorBall, 48, 48}, 3e-3},
    {{Mapping::mirrorBall, 48, 48, 20}, 3e-3},    {{Mapping::mirrorBall, 48, 48, 2}, 3e-3},
    {{Mapping::octahedral, 32, 32}, 4e-3}};

}  // namespace etalon
