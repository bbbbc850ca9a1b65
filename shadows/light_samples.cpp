#include "shadows/light_samples.h"

#include <cmath>

#include "numeric/check.h"
#include "numeric/elementary.h"
#include "numeric/random.h"

namespace etalon {

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

std::vector<glm::dvec4> lightSamples(const SphericalPatch& patch, int count, uint64_t seed) {
    const glm::dvec3 d = patch.direction;
    const double square = d.x * d.x + (d.y * d.y + d.z * d.z);
    ETALON_CHECK(square > 0 && std::isfinite(square), "direction ({}, {}, {})", d.x, d.y, d.z);
    ETALON_CHECK(patch.radius_m > 0, "radius {}", patch.radius_m);
    constexpr double kPi = 0x1.921fb54442d18p+1;
    ETALON_CHECK(patch.halfLongitude_rad >= 0 && patch.halfLongitude_rad <= kPi &&
                     patch.halfLatitude_rad >= 0 && patch.halfLatitude_rad <= kPi / 2,
                 "half angles {} and {}", patch.halfLongitude_rad, patch.halfLatitude_rad);
    // Towards the middle, to the side, and along the axis of the patch's longitudes.
    const double length = std::sqrt(square);
    const glm::dvec3 middle(d.x / length, d.y / length, d.z / length);
    const bool upright = middle.y * middle.y > 0.8;
    const glm::dvec3 other = upright ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
    glm::dvec3 side(other.y * middle.z - other.z * middle.y, other.z * middle.x - other.x * middle.z,
                    other.x * middle.y - other.y * middle.x);
    const double sideLength = std::sqrt(side.x * side.x + (side.y * side.y + side.z * side.z));
    side = {side.x / sideLength, side.y / sideLength, side.z / sideLength};
    const glm::dvec3 axis(middle.y * side.z - middle.z * side.y, middle.z * side.x - middle.x * side.z,
                          middle.x * side.y - middle.y * side.x);
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
            const double direction = along * middle[c] + (across * side[c] + sinLatitude * axis[c]);
            light[c] = isFar ? direction : patch.centre_m[c] + direction * patch.radius_m;
        }
        lights.push_back(light);
    }
    return lights;
}

}  // namespace etalon
