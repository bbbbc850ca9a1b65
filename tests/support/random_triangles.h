// Random numbers that are the same everywhere, and families of triangles that are hard to rasterize.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "raster/draw.h"
#include "raster/rasterizer.h"

namespace etalon {

// splitmix64 [Steele2014]: the same sequence on every machine, unlike the standard distributions.
class Random {
  public:
    explicit Random(uint64_t seed) : state_(seed) {}

    uint64_t next() {
        uint64_t z = state_ += 0x9e3779b97f4a7c15u;
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
        return z ^ (z >> 31);
    }
    // In [low, high).
    double uniform(double low, double high) {
        return low + static_cast<double>(next() >> 11) * 0x1p-53 * (high - low);
    }
    // In low ... high, both included.
    int integer(int low, int high) {
        return low + static_cast<int>(next() % (static_cast<uint64_t>(high - low) + 1));
    }
    bool chance(double probability) { return uniform(0, 1) < probability; }
    template <class T, size_t N>
    T pick(const T (&values)[N]) {
        return values[next() % N];
    }

  private:
    uint64_t state_;
};

enum class TriangleFamily : uint8_t {
    normal,
    sliver,      // the third vertex almost on the line of the others
    subPixel,    // smaller than two pixels
    guardBand,   // far outside of the viewport, up to and beyond the guard band
    negativeW,   // w of either sign, and 0
    nearFar,     // z on both sides of 0 and of w
    nonFinite,   // NaN, infinities, 2^500 and more
    limits,      // each coordinate from a list of limits
    onSamples,   // vertices on sample positions, so edges go through samples
    lattice,     // quarter-pixel lattice with many zero areas and many -0
    everything,  // covers the viewport
    onPlanes,    // vertices on and next to the planes of rule 2
    count
};

// A clip-space vertex that rule 3 brings close to (x_px, y_px), with the given w and z = depth * w.
ClipVertex vertexAtPixel(const Viewport& viewport, double x_px, double y_px, double w, double depth);

std::array<ClipVertex, 3> randomTriangle(Random& random, TriangleFamily family, const Viewport& viewport);

}  // namespace etalon
