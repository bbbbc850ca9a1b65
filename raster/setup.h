// From clip space to triangle records (rules 1 to 3).
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "raster/clip.h"
#include "raster/rasterizer.h"
#include "raster/render_target.h"

namespace etalon {

// Edge function i of a record as E(x, y) = stepX * x + stepY * y + constant over subpixel positions (rule 4).
struct EdgeFunction {
    int64_t stepX, stepY, constant;
    bool ownsZero;  // top or left edge: samples with E = 0 are inside

    int64_t at(int64_t x_subpx, int64_t y_subpx) const {
        return stepX * x_subpx + stepY * y_subpx + constant;
    }
    // True if a sample there is on the inner side of the edge, or on an edge that owns it.
    bool covers(int64_t x_subpx, int64_t y_subpx) const { return at(x_subpx, y_subpx) >= (ownsZero ? 0 : 1); }
};

std::array<EdgeFunction, 3> edgeFunctions(const TriangleRecord& record);

// Turns the triangles [first, last) of a draw into records, in order, and counts what became of them.
class TriangleSetup {
  public:
    TriangleSetup(const Viewport& viewport, int subpixelBits);

    void process(const Draw& draw, uint32_t drawIndex, size_t first, size_t last);

    std::vector<TriangleRecord> records;
    std::vector<ClippedCorners> clippedCorners;
    RasterStatistics statistics;

  private:
    struct SnappedVertex {
        int32_t x_subpx, y_subpx;
        double z, reciprocalW;
    };

    SnappedVertex snap(const ClipVertex& p) const;
    bool isCulled(int64_t area, const DrawState& state);
    TriangleRecord makeRecord(const std::array<SnappedVertex, 3>& v, int64_t area, bool front) const;
    void addTriangle(const std::array<ClipVertex, 3>& triangle, const DrawState& state, uint32_t draw,
                     uint32_t index);
    void addPolygon(const Polygon& polygon, const DrawState& state, uint32_t draw, uint32_t index);

    GuardBand guard_;
    double centreX_px_, centreY_px_, halfWidth_px_, halfHeight_px_;
    double subpixels_;
};

}  // namespace etalon
