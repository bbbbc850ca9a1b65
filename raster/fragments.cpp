#include "raster/fragments.h"

#include <algorithm>
#include <bit>
#include <limits>

#include "raster/setup.h"

namespace etalon {
namespace {

constexpr uint32_t kNotListed = std::numeric_limits<uint32_t>::max();

using Edges = std::array<EdgeFunction, 3>;

bool isInside(const Edges& edges, int32_t x_subpx, int32_t y_subpx) {
    for (const EdgeFunction& edge : edges)
        if (!edge.covers(x_subpx, y_subpx)) return false;
    return true;
}

// 2^-e for the exponent e of a positive normal number 2^e m, 1 <= m < 2; e in [-1022, 1022].
double reciprocalOfBinade(double x) {
    constexpr int kFractionBits = 52;
    constexpr uint64_t kTwiceBias = 2 * 1023;
    return std::bit_cast<double>((kTwiceBias - (std::bit_cast<uint64_t>(x) >> kFractionBits))
                                 << kFractionBits);
}

}  // namespace

void TileFragments::collect(const RenderTarget& target, const PixelRectangle& rectangle) {
    triangles.clear();
    if (target.format.samples == 1)
        collectPixels(target, rectangle);
    else
        collectSamples(target, rectangle);
}

// One sample per pixel: fragments are pixels. A triangle is looked for to the left and above.
void TileFragments::collectPixels(const RenderTarget& target, const PixelRectangle& rectangle) {
    const int n = target.format.subpixelBits;
    const int32_t toCentre_subpx = 1 << (n - 1);
    const auto width = static_cast<size_t>(rectangle.width());
    const size_t count = width * static_cast<size_t>(rectangle.height());
    x_subpx.resize(count);
    y_subpx.resize(count);
    triangle.resize(count);
    const uint32_t* above = nullptr;
    size_t first = 0;
    for (int y = rectangle.y0; y < rectangle.y1; y++, first += width) {
        const uint32_t* ids = &target.id.row(y)[static_cast<size_t>(rectangle.x0)];
        uint32_t number = 0;
        for (size_t i = 0; i < width; i++) {
            if (i == 0 || ids[i] != ids[i - 1]) {
                if (above != nullptr && above[i] == ids[i]) {
                    number = triangle[first + i - width];
                } else if (above != nullptr && i + 1 < width && above[i + 1] == ids[i]) {
                    number = triangle[first + i + 1 - width];
                } else {
                    number = static_cast<uint32_t>(triangles.size());
                    triangles.push_back(ids[i]);
                }
            }
            triangle[first + i] = number;
        }
        for (size_t i = 0; i < width; i++)
            x_subpx[first + i] = ((rectangle.x0 + static_cast<int32_t>(i)) << n) + toCentre_subpx;
        std::fill_n(&y_subpx[first], width, (y << n) + toCentre_subpx);
        above = ids;
    }
}

// The number of a triangle among those of the fragments [first, last), or kNotListed.
uint32_t TileFragments::triangleOf(uint32_t id, size_t first, size_t last) const {
    for (size_t f = first; f < last; f++)
        if (triangles[triangle[f]] == id) return triangle[f];
    return kNotListed;
}

void TileFragments::collectSamples(const RenderTarget& target, const PixelRectangle& rectangle) {
    const int samples = target.format.samples;
    const int n = target.format.subpixelBits;
    const auto positions = samplePositions(samples);
    const auto width = static_cast<size_t>(rectangle.width());
    x_subpx.clear();
    y_subpx.clear();
    triangle.clear();
    ofSample_.clear();
    std::vector<Edges> edges;                                         // of `triangles`
    std::vector<size_t> firstAbove(width + 1), firstHere(width + 1);  // fragments of a row's pixels
    for (int y = rectangle.y0; y < rectangle.y1; y++) {
        for (int x = rectangle.x0; x < rectangle.x1; x++) {
            const auto column = static_cast<size_t>(x - rectangle.x0);
            const size_t firstOfPixel = triangle.size();
            const size_t firstOfLeft = column > 0 ? firstHere[column - 1] : firstOfPixel;
            firstHere[column] = firstOfPixel;
            for (int s = 0; s < samples; s++) {
                const uint32_t id = target.id.at(x, y, s);
                size_t f = firstOfPixel;
                while (f < triangle.size() && triangles[triangle[f]] != id) f++;
                ofSample_.push_back(static_cast<uint32_t>(f));
                if (f < triangle.size()) continue;

                uint32_t number = triangleOf(id, firstOfLeft, firstOfPixel);
                if (number == kNotListed) number = triangleOf(id, firstAbove[column], firstAbove[column + 1]);
                if (number == kNotListed) {
                    number = static_cast<uint32_t>(triangles.size());
                    triangles.push_back(id);
                    edges.push_back(id == kNoTriangle ? Edges{} : edgeFunctions(target.triangle(id)));
                }
                int32_t px = (x << n) + (1 << (n - 1)), py = (y << n) + (1 << (n - 1));
                if (id != kNoTriangle && !isInside(edges[number], px, py)) {
                    const auto& position = positions[static_cast<size_t>(s)];
                    px = (x << n) + ((position[0] << n) >> 4);
                    py = (y << n) + ((position[1] << n) >> 4);
                }
                triangle.push_back(number);
                x_subpx.push_back(px);
                y_subpx.push_back(py);
            }
        }
        firstHere[width] = triangle.size();
        std::swap(firstAbove, firstHere);
    }
}

WeightScale weightScale(const TriangleRecord& record) {
    constexpr double kSmallestWeight = 0x1p-64;
    const double largest = std::max({record.reciprocalW[0], record.reciprocalW[1], record.reciprocalW[2]});
    const double toOne = reciprocalOfBinade(largest);
    WeightScale scale;
    for (size_t i = 0; i < 3; i++) scale.q[i] = std::max(record.reciprocalW[i] * toOne, kSmallestWeight);
    scale.areaScale = reciprocalOfBinade(static_cast<double>(record.area));
    return scale;
}

}  // namespace etalon
