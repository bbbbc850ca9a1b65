#include "raster/fragments.h"

#include <algorithm>
#include <cmath>

#include "raster/setup.h"

namespace etalon {
namespace {

bool isInside(const TriangleRecord& record, int32_t x_subpx, int32_t y_subpx) {
    for (const EdgeFunction& edge : edgeFunctions(record))
        if (!edge.covers(x_subpx, y_subpx)) return false;
    return true;
}

}  // namespace

void TileFragments::collect(const RenderTarget& target, const PixelRectangle& rectangle) {
    const int samples = target.format.samples;
    const int n = target.format.subpixelBits;
    const auto positions = samplePositions(samples);
    fragments.clear();
    fragmentOf.clear();
    for (int y = rectangle.y0; y < rectangle.y1; y++) {
        for (int x = rectangle.x0; x < rectangle.x1; x++) {
            const size_t firstOfPixel = fragments.size();
            for (int s = 0; s < samples; s++) {
                const uint32_t id = target.id.at(x, y, s);
                size_t f = firstOfPixel;
                while (f < fragments.size() && fragments[f].id != id) f++;
                fragmentOf.push_back(static_cast<uint32_t>(f));
                if (f < fragments.size()) continue;
                Fragment fragment{x, y, id, (x << n) + (1 << (n - 1)), (y << n) + (1 << (n - 1))};
                if (samples > 1 && id != kNoTriangle &&
                    !isInside(target.triangle(id), fragment.x_subpx, fragment.y_subpx)) {
                    const auto& position = positions[static_cast<size_t>(s)];
                    fragment.x_subpx = (x << n) + ((position[0] << n) >> 4);
                    fragment.y_subpx = (y << n) + ((position[1] << n) >> 4);
                }
                fragments.push_back(fragment);
            }
        }
    }
}

WeightScale weightScale(const TriangleRecord& record) {
    constexpr double kSmallestWeight = 0x1p-64;
    const double largest = std::max({record.reciprocalW[0], record.reciprocalW[1], record.reciprocalW[2]});
    const double toOne = std::ldexp(1.0, -std::ilogb(largest));
    WeightScale scale;
    for (size_t i = 0; i < 3; i++) scale.q[i] = std::max(record.reciprocalW[i] * toOne, kSmallestWeight);
    scale.areaScale = std::ldexp(1.0, -std::ilogb(static_cast<double>(record.area)));
    return scale;
}

}  // namespace etalon
