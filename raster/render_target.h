// The depth, stencil and id planes that triangles are drawn into, and the records of the triangles drawn.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "raster/draw.h"
#include "raster/image.h"

namespace etalon {

enum class DepthFormat : uint8_t { d16, d24, d32f };
enum class DepthRounding : uint8_t { exact, driver };  // rule 6
enum class RasterReal : uint8_t { fp32, fp64 };        // arithmetic of depth interpolation (rule 5)

// Id of a sample that no triangle covers.
inline constexpr uint32_t kNoTriangle = 0xffffffffu;

// A triangle (or piece of a clipped one) after rule 3: what depth, attributes and shading need.
struct TriangleRecord {
    std::array<int32_t, 3> x_subpx, y_subpx;  // snapped; orientation made positive
    int64_t area;                             // A > 0: twice the area in subpixels
    std::array<double, 3> z;                  // z / w
    std::array<double, 3> reciprocalW;        // 1 / w
    uint32_t draw, triangle;                  // which triangle of which draw
    std::array<uint8_t, 3> corner;  // record vertex i is the source vertex corner[i], when not clipped
    bool front;                     // facing
    bool reversed;                  // a piece whose sign is opposite to its polygon's (rule 2)
    uint8_t groupSize;              // > 0: the first of the groupSize pieces of a polygon with mixed signs
    int32_t clipped;                // -1, or the index of its entry in RenderTarget::clippedCorners
};

// For the three vertices of a clipped piece: their barycentric coordinates in the source triangle.
using ClippedCorners = std::array<std::array<double, 3>, 3>;

struct RenderTargetFormat {
    int samples = 1;       // 1, 4 or 16
    int subpixelBits = 8;  // 4 to 8
    DepthFormat depth = DepthFormat::d32f;
    DepthRounding depthRounding = DepthRounding::exact;
    RasterReal real = RasterReal::fp32;
};

// width x height pixels with `samples` planes each of depth (stored integers, rule 6), stencil and triangle
// id (an index into `triangles`, or kNoTriangle). Cleared to the farthest depth, stencil 0 and kNoTriangle.
struct RenderTarget {
    RenderTarget(int width, int height, const RenderTargetFormat& targetFormat);

    int width() const { return id.width(); }
    int height() const { return id.height(); }

    RenderTargetFormat format;
    Image<uint32_t> depth;
    Image<uint8_t> stencil;
    Image<uint32_t> id;
    std::vector<TriangleRecord> triangles;
    std::vector<ClippedCorners> clippedCorners;
    uint32_t drawCount = 0;  // draws so far; TriangleRecord::draw counts over all calls of rasterize
};

// The stored integer of depth 1 (the clear value).
uint32_t farthestDepth(DepthFormat format);

// The depth in [0, 1] that a stored integer stands for.
double depthFromStored(DepthFormat format, uint32_t stored);

// Sample positions in sixteenths of a pixel from the pixel's corner (0..15), rule 4; `samples` of them.
std::span<const std::array<int, 2>> samplePositions(int samples);

}  // namespace etalon
