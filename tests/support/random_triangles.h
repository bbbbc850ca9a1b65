// Families of triangles that are hard to rasterize.
#pragma once

#include <array>
#include <cstdint>

#include "numeric/random.h"
#include "raster/draw.h"
#include "raster/rasterizer.h"

namespace etalon {

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
