// The visible fragments of a tile: one for each different triangle (or none) among a pixel's samples.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "raster/render_target.h"

namespace etalon {

// A fragment is shaded at the pixel's centre, or at its sample of lowest index when the centre is not inside
// the triangle (rule 5).
struct Fragment {
    int32_t x, y;
    uint32_t id;               // index of the triangle record, or kNoTriangle
    int32_t x_subpx, y_subpx;  // where it is shaded
};

// The pixels x0 <= x < x1, y0 <= y < y1.
struct PixelRectangle {
    int x0, y0, x1, y1;
    int width() const { return x1 - x0; }
    int height() const { return y1 - y0; }
};

struct TileFragments {
    std::vector<Fragment> fragments;
    // For pixel p (row-major in the rectangle) and sample s: fragmentOf[p * samples + s].
    std::vector<uint32_t> fragmentOf;

    // Lists the fragments of the rectangle, replacing what was there.
    void collect(const RenderTarget& target, const PixelRectangle& rectangle);
};

// The factors of a triangle's interpolation weights (rule 5) that do not depend on the pixel.
struct WeightScale {
    std::array<double, 3> q;  // reciprocals of w, scaled
    double areaScale;         // 2^m
};
WeightScale weightScale(const TriangleRecord& record);

}  // namespace etalon
