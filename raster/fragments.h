// The visible fragments of a tile: one for each different triangle (or none) among a pixel's samples.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "raster/render_target.h"

namespace etalon {

// The pixels x0 <= x < x1, y0 <= y < y1.
struct PixelRectangle {
    int x0, y0, x1, y1;
    int width() const { return x1 - x0; }
    int height() const { return y1 - y0; }
};

// Arrays with one element per fragment. A fragment is shaded at the pixel's centre, or at its sample of
// lowest index when the centre is not inside the triangle (rule 5).
struct TileFragments {
    std::vector<int32_t> x_subpx, y_subpx;  // where it is shaded: a position inside its triangle
    std::vector<uint32_t> triangle;         // index into `triangles`

    // Ids of triangle records and kNoTriangle, in no order. A triangle that neighbours do not connect can
    // stand there more than once.
    std::vector<uint32_t> triangles;

    // The fragment of pixel p (row-major in the rectangle) and sample s, of `samples`.
    size_t fragmentOf(size_t p, size_t s, size_t samples) const {
        return samples == 1 ? p : ofSample_[p * samples + s];
    }
    size_t size() const { return triangle.size(); }

    // Lists the fragments of the rectangle, replacing what was there.
    void collect(const RenderTarget& target, const PixelRectangle& rectangle);

  private:
    void collectPixels(const RenderTarget& target, const PixelRectangle& rectangle);
    void collectSamples(const RenderTarget& target, const PixelRectangle& rectangle);
    uint32_t triangleOf(uint32_t id, size_t first, size_t last) const;

    std::vector<uint32_t> ofSample_;  // of each pixel's samples; unused with one sample
};

// The factors of a triangle's interpolation weights (rule 5) that do not depend on the pixel.
struct WeightScale {
    std::array<double, 3> q;  // reciprocals of w, scaled
    double areaScale;         // 2^m
};
WeightScale weightScale(const TriangleRecord& record);

}  // namespace etalon
