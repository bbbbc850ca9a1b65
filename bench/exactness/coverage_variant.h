// Coverage by edge functions in three arithmetics: the cost of exact edges alone, without the rest of a
// rasterizer.
#pragma once

#include <cstddef>
#include <cstdint>

namespace etalon::bench {

// Corners in subpixels (1/256 pixel), counter-clockwise as seen with y downwards turned up: the area is
// positive.
struct SnappedTriangle {
    int32_t x[3], y[3];
};

enum class EdgeArithmetic {
    integer64,  // exact for every triangle
    integer32,  // exact where the triangle's box allows it, else 64 bits
    real32,     // float, relative to the box
};

}  // namespace etalon::bench

extern "C" {
// Counts the samples at pixel centres inside each triangle, all inside width x height; the counts of all
// triangles are written to `covered`.
void etalonCountCovered(const etalon::bench::SnappedTriangle* triangles, size_t count, int width, int height,
                        etalon::bench::EdgeArithmetic arithmetic, uint32_t* covered);
}
