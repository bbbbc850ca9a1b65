#include "shadows/light_samples.h"

#include <cmath>

#include "numeric/check.h"
#include "numeric/elementary.h"
#include "numeric/random.h"
#include "numeric/vectors.h"

namespace etalon {
namespace {

// A direction and two more, right-handed: side x axis = middle.
struct Axes {
    glm::dvec3 middle, side, axis;
};

Axes axesAround(const glm::dvec3& direction) {
    const double square = direction.x * direction.x + (direction.y * direction.y + direction.z * direction.z);
    ETALON_CHECK(square > 0 && std::isfinite(square), "direction ({}, {}, {})", direction.x, direction.y,
                 direction.z);
    Axes axes;
    axes.middle = unitOf(direction);
    const bool upright = axes.middle.y * axes.middle.y > 0.8;
    axes.side = unitOf(crossOf(upright ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0), axes.middle));
    axes.axis = crossOf(axes.middle, axes.side);
    return axes;
}

}  // namespace

std::vector<glm::dvec2> stratifiedSamples(int count, uint64_t seed) {
    ETALON_CHECK(count >= 1 && count <= kMaxLightSamples, "{} samples", count);
    if (count == 1) return {glm::dvec2(0.5, 0.5)};
    int rows = 1;
    while (rows * (rows + 1) < count) rows++;
    Random random(seed);
    std::vector<glm::dvec2> samples;
    for (int row = 0; row < rows; row++) {
        const int first = row * count / rows, last = (row + 1) * count / rows;
        for (int cell = first; cell < last; cell++) {
            const double x = random.uniform(0, 1);
            const double y = random.uniform(0, 1);
            samples.emplace_back((cell - first + x) / (last - first), (first + y * (last - first)) / count);
        }
    }
    return samples;
}

std::vector<glm::dvec4> lightSamples(const RectangularPatch& patch, int count, uint64_t seed) {
    std::vector<glm::dvec4> lights;
    for (const glm::dvec2& sample : stratifiedSamples(count, seed)) {
        const double a = 2.0 * sample.x - 1.0, b = 2.0 * sample.y - 1.0;
        glm::dvec4 light(0, 0, 0, 1);
        for (int c = 0; c < 3; c++)
            light[c] = patch.centre_m[c] + (a * patch.halfU_m[c] + b * patch.halfV_m[c]);
        lights.push_back(light);
    }
    return lights;
}

std::vector<glm::dvec4> lightSamples(const DiscPatch& patch, int count, uint64_t seed) {
    ETALON_CHECK(patch.radius >= 0, "radius {}", patch.radius);
    const Axes axes = axesAround(patch.axis);
    if (count == 1) return {patch.centre};
    std::vector<glm::dvec4> lights;
    for (const glm::dvec2& sample : stratifiedSamples(count, seed)) {
        const double angle_rad = 2.0 * kPi * sample.x, distance = patch.radius * std::sqrt(sample.y);
        const double a = distance * cosOf(angle_rad), b = distance * sinOf(angle_rad);
        glm::dvec4 light = patch.centre;
        for (int c = 0; c < 3; c++) light[c] += a * axes.side[c] + b * axes.axis[c];
        lights.push_back(light);
    }
    return lights;
}

std::vector<glm::dvec4> lightSamples(const SphericalPatch& patch, int count, uint64_t seed) {
    const Axes axes = axesAround(patch.direction);
    ETALON_CHECK(patch.radius_m > 0, "radius {}", patch.radius_m);
    ETALON_CHECK(patch.halfLongitude_rad >= 0 && patch.halfLongitude_rad <= kPi &&
                     patch.halfLatitude_rad >= 0 && patch.halfLatitude_rad <= kPi / 2,
                 "half angles {} and {}", patch.halfLongitude_rad, patch.halfLatitude_rad);
    const double sinHighest = sinOf(patch.halfLatitude_rad);
    const bool isFar = std::isinf(patch.radius_m);

    std::vector<glm::dvec4> lights;
    for (const glm::dvec2& sample : stratifiedSamples(count, seed)) {
        const double longitude_rad = (2.0 * sample.x - 1.0) * patch.halfLongitude_rad;
        const double sinLatitude = (2.0 * sample.y - 1.0) * sinHighest;
        const double cosLatitude = std::sqrt(1.0 - sinLatitude * sinLatitude);
        const double along = cosLatitude * cosOf(longitude_rad), across = cosLatitude * sinOf(longitude_rad);
        glm::dvec4 light(0, 0, 0, isFar ? 0 : 1);
        for (int c = 0; c < 3; c++) {
            const double direction =
                along * axes.middle[c] + (across * axes.side[c] + sinLatitude * axes.axis[c]);
            light[c] = isFar ? direction : patch.centre_m[c] + direction * patch.radius_m;
        }
        lights.push_back(light);
    }
    return lights;
}

}  // namespace etalon
