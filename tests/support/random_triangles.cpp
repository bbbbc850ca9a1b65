#include "tests/support/random_triangles.h"

#include <cfloat>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <utility>

namespace etalon {
namespace {

double logUniform(Random& random, int lowExponent, int highExponent) {
    const double magnitude = std::ldexp(random.uniform(1, 2), random.integer(lowExponent, highExponent));
    return random.chance(0.5) ? magnitude : -magnitude;
}

double randomLimit(Random& random) {
    static constexpr double kInfinity = std::numeric_limits<double>::infinity();
    static const double kLimits[] = {0.0,
                                     -0.0,
                                     1,
                                     -1,
                                     FLT_MAX,
                                     -FLT_MAX,
                                     FLT_MIN,
                                     -FLT_MIN,
                                     0x1p-80,
                                     0x1p-81,
                                     DBL_MIN,
                                     -DBL_TRUE_MIN,
                                     0x1p499,
                                     -0x1p499,
                                     0x1p52,
                                     -0x1p52,
                                     131072,
                                     0x1.fffffffffffffp-1,
                                     0x1p-100,
                                     1e6,
                                     -1e6,
                                     0.5,
                                     2,
                                     3,
                                     std::nextafter(0x1p500, 0.0)};
    static const double kTooLarge[] = {0x1p500, -0x1p500, 1e300, DBL_MAX, kInfinity, -kInfinity};
    return random.chance(0.02) ? random.pick(kTooLarge) : random.pick(kLimits);
}

ClipVertex inside(Random& random, const Viewport& v) {
    return vertexAtPixel(v, v.x + random.uniform(-0.3, 1.3) * v.width,
                         v.y + random.uniform(-0.3, 1.3) * v.height,
                         std::ldexp(random.uniform(1, 2), random.integer(-3, 3)), random.uniform(0, 1));
}

std::array<ClipVertex, 3> sliver(Random& random, const Viewport& v) {
    const double x0 = v.x + random.uniform(-0.5, 1.5) * v.width,
                 y0 = v.y + random.uniform(-0.5, 1.5) * v.height;
    const double x1 = v.x + random.uniform(-0.5, 1.5) * v.width,
                 y1 = v.y + random.uniform(-0.5, 1.5) * v.height;
    const double t = random.uniform(-0.2, 1.2), off = logUniform(random, -10, 0);
    const double x2 = x0 + t * (x1 - x0) + off, y2 = y0 + t * (y1 - y0) + random.uniform(-1, 1) * off;
    return {vertexAtPixel(v, x0, y0, 1, 0.25), vertexAtPixel(v, x1, y1, random.uniform(0.1, 9), 0.5),
            vertexAtPixel(v, x2, y2, 2, 0.75)};
}

// A few units in the last place away, half of the time.
double nudged(Random& random, double value) {
    const int steps = random.chance(0.5) ? 0 : random.integer(-3, 3);
    for (int i = 0; i < std::abs(steps); i++) value = std::nextafter(value, steps < 0 ? -DBL_MAX : DBL_MAX);
    return value;
}

ClipVertex onPlanes(Random& random, const Viewport& v) {
    const double w = random.chance(0.2)   ? nudged(random, 0x1p-80)
                     : random.chance(0.2) ? random.uniform(-2, 0)
                                          : nudged(random, random.pick({0.5, 1.0, 2.0, 3.0}));
    ClipVertex c{nudged(random, random.pick({-1.0, 1.0, 0.0, 2.0, -2.0, 0.3}) * (131072.0 / v.width) * w),
                 nudged(random, random.pick({-1.0, 1.0, 0.0, 2.0, -2.0, 0.3}) * (131072.0 / v.height) * w),
                 nudged(random, random.pick({0.0, 1.0, 0.5, -1.0, 2.0}) * w), w};
    if (random.chance(0.1)) c.x = -c.x;
    return c;
}

}  // namespace

ClipVertex vertexAtPixel(const Viewport& viewport, double x_px, double y_px, double w, double depth) {
    const double halfWidth = viewport.width / 2.0, halfHeight = viewport.height / 2.0;
    return {(x_px - (viewport.x + halfWidth)) / halfWidth * w,
            (y_px - (viewport.y + halfHeight)) / -halfHeight * w, depth * w, w};
}

std::array<ClipVertex, 3> randomTriangle(Random& random, TriangleFamily family, const Viewport& v) {
    std::array<ClipVertex, 3> t = {inside(random, v), inside(random, v), inside(random, v)};
    const double x = v.x + random.uniform(-0.05, 1.05) * v.width,
                 y = v.y + random.uniform(-0.05, 1.05) * v.height;
    const int far = random.integer(8, random.chance(0.2) ? 40 : 21);
    switch (family) {
        case TriangleFamily::sliver:
            return sliver(random, v);
        case TriangleFamily::subPixel: {
            const double size = std::ldexp(2.0, -random.integer(0, 6));
            for (auto& c : t)
                c = vertexAtPixel(v, x + random.uniform(-size, size), y + random.uniform(-size, size),
                                  random.uniform(0.5, 2), random.uniform(0, 1));
            return t;
        }
        case TriangleFamily::guardBand:
            for (auto& c : t)
                if (random.chance(0.6))
                    c = vertexAtPixel(v, x + logUniform(random, 4, far), y + logUniform(random, 4, far),
                                      random.uniform(0.5, 2), random.uniform(0, 1));
            return t;
        case TriangleFamily::negativeW: {
            for (auto& c : t) {
                c = {random.uniform(-2, 2), random.uniform(-2, 2), 0, random.uniform(-1, 2)};
                if (random.chance(0.1)) c.w = 0;
                if (random.chance(0.1)) c.w = logUniform(random, -90, -60);
                c.z = random.chance(0.5) ? c.w * random.uniform(0, 1) : random.uniform(-0.5, 1.5);
            }
            return t;
        }
        case TriangleFamily::nearFar:
            for (auto& c : t) c.z = random.chance(0.05) ? c.w : random.uniform(-0.7, 1.7) * c.w;
            return t;
        case TriangleFamily::nonFinite: {
            static const double kBad[] = {std::numeric_limits<double>::quiet_NaN(),
                                          std::numeric_limits<double>::infinity(),
                                          -std::numeric_limits<double>::infinity(),
                                          0x1p500,
                                          1e300,
                                          -DBL_MAX};
            ClipVertex& c = t[static_cast<size_t>(random.integer(0, 2))];
            double* const coordinates[] = {&c.x, &c.y, &c.z, &c.w};
            *random.pick(coordinates) = random.pick(kBad);
            return t;
        }
        case TriangleFamily::limits:
            for (auto& c : t)
                for (double* value : {&c.x, &c.y, &c.z, &c.w})
                    if (random.chance(0.35)) *value = randomLimit(random);
            return t;
        case TriangleFamily::onSamples: {
            // 1/32 and 1/512 are ties of the snapping for 4 and 8 bits.
            const double step = random.pick({0.5, 0.0625, 1.0 / 32, 1.0 / 512});
            const int reach = static_cast<int>(random.uniform(1, 1.2 * v.width) / step);
            for (auto& c : t)
                c = vertexAtPixel(v, std::floor(x) + step * random.integer(-reach, reach),
                                  std::floor(y) + step * random.integer(-reach, reach),
                                  random.chance(0.5) ? 1 : 4, 0.5);
            if (random.chance(0.5)) t[1].y = t[0].y / t[0].w * t[1].w;
            if (random.chance(0.5)) t[2].x = t[0].x / t[0].w * t[2].w;
            return t;
        }
        case TriangleFamily::lattice:
            for (auto& c : t) {
                c = vertexAtPixel(v, std::floor(x) + 0.25 * random.integer(-8, 8),
                                  std::floor(y) + 0.25 * random.integer(-8, 8), 1, 0);
                for (double* value : {&c.x, &c.y, &c.z})
                    if (random.chance(0.15)) *value = -0.0;
            }
            return t;
        case TriangleFamily::everything: {
            const double size = std::ldexp(random.uniform(1, 2), random.integer(1, 18));
            t = {vertexAtPixel(v, v.x - size * v.width, v.y - random.uniform(0, 1) * size * v.height, 1, 0.5),
                 vertexAtPixel(v, v.x + 1.1 * size * v.width, v.y - size * v.height, 3, 0.5),
                 vertexAtPixel(v, v.x + random.uniform(0, 1) * v.width, v.y + 5 * size * v.height, 2, 0.5)};
            if (random.chance(0.5)) std::swap(t[1], t[2]);
            return t;
        }
        case TriangleFamily::onPlanes:
            for (auto& c : t) c = onPlanes(random, v);
            return t;
        default:
            return t;
    }
}

}  // namespace etalon
