// The depth, stencil and id planes that triangles are drawn into, and the records of the triangles drawn.
//
// Not here: colour and attributes, which shading makes of the ids; several layers, levels of size, sample
// counts other than 1, 4 and 16, resolving of depth or stencil, and packed depth and stencil.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "raster/draw.h"
#include "raster/image.h"
#include "raster/uninitialized_vector.h"

namespace etalon {

enum class DepthFormat : uint8_t { d16, d24, d32f, d64f };
enum class DepthRounding : uint8_t { exact, driver, fixedFunction };  // rules 6 and 22
// What decides a depth test: the numbers that are stored, or the exact depths of the triangles (rule 6).
enum class DepthOrder : uint8_t { stored, exact };
enum class RasterReal : uint8_t { fp32, fp64 };  // arithmetic of depth interpolation (rule 5)

// Id of a sample that no triangle covers.
inline constexpr uint32_t kNoTriangle = 0xffffffffu;

// A vertex after rule 3.
struct ProjectedVertex {
    int32_t x_subpx, y_subpx;
    double z;            // the z_i of rule 5
    double reciprocalW;  // 1 / w
};

// A vertex that clipping made or kept, and its barycentric coordinates in the source triangle.
struct ClippedVertex {
    ProjectedVertex projected;
    std::array<double, 3> barycentric;
};

// A triangle (or piece of a clipped one) as it is kept: its vertices by number, orientation made positive.
struct StoredTriangle {
    std::array<uint32_t, 3> vertex;  // of RenderTarget::vertices, or of clippedVertices
    uint32_t draw, triangle;         // which triangle of which draw
    uint8_t groupSize;  // > 0: the first of the groupSize pieces of a polygon with mixed signs (rule 2)
    bool front : 1;     // facing
    bool reversed : 1;  // a piece whose sign is opposite to its polygon's (rule 2)
    bool clipped : 1;
    bool exchanged : 1;  // vertices 1 and 2 were exchanged
};

// The same with what depth, attributes and shading need.
struct TriangleRecord {
    std::array<int32_t, 3> x_subpx, y_subpx;  // snapped; orientation made positive
    int64_t area;                             // A > 0: twice the area in subpixels
    std::array<double, 3> z;                  // the z_i of rule 5
    std::array<double, 3> reciprocalW;        // 1 / w
    uint32_t draw, triangle;
    std::array<uint8_t, 3> corner;  // record vertex i is the source vertex corner[i], when not clipped
    bool front, reversed, clipped;
};

// The unit of the constant depth bias of UNORM formats of n bits: a step of the format, 1 / (2^n - 1) [D3D11.3,
// sec. 15.10], or the 2^-(n - 1) of measured drivers, twice that.
enum class BiasUnit : uint8_t { step, driver };

struct RenderTargetFormat {
    int samples = 1;       // 1, 4 or 16
    int subpixelBits = 8;  // 4 to 8
    DepthFormat depth = DepthFormat::d32f;
    DepthRounding depthRounding = DepthRounding::exact;
    RasterReal real = RasterReal::fp32;
    BiasUnit biasUnit = BiasUnit::step;
    DepthOrder depthOrder =
        DepthOrder::stored;  // exact: with d64f and fp64, and draws that write ids where depths
    DepthDirection depthDirection =
        DepthDirection::forward;  // of what is cleared; draws say what they compare
    int stencilBits = 8;          // 8, or 32: a stencil that counts and does nothing else

    friend bool operator==(const RenderTargetFormat&, const RenderTargetFormat&) = default;
};

// Memory that rasterize keeps from call to call; a copied target starts with none.
class RasterScratch;
class RasterScratchHolder {
  public:
    RasterScratchHolder();
    ~RasterScratchHolder();
    RasterScratchHolder(const RasterScratchHolder&);
    RasterScratchHolder& operator=(const RasterScratchHolder&);
    RasterScratchHolder(RasterScratchHolder&&) noexcept;
    RasterScratchHolder& operator=(RasterScratchHolder&&) noexcept;
    RasterScratch& get();

  private:
    std::unique_ptr<RasterScratch> scratch_;
};

// width x height pixels with `samples` planes each of depth (stored integers, rule 6), stencil and triangle
// id (which triangle(id) explains, or kNoTriangle). Cleared to the farthest depth, stencil 0 and kNoTriangle.
class RenderTarget {
  public:
    RenderTarget(int width, int height, const RenderTargetFormat& targetFormat);

    int width() const { return id.width(); }
    int height() const { return id.height(); }

    // Back to the state after construction; keeps the memory.
    void clear();
    // A stencil of so many bits, cleared.
    void setStencil(int bits);
    // What is drawn so far, besides depth, stencil and id.
    struct Drawn {
        uint32_t draws = 0;
        size_t triangles = 0, vertices = 0, clippedVertices = 0;
    };
    Drawn drawn() const { return {drawCount, triangles.size(), vertices.size(), clippedVertices.size()}; }
    // Keeps that much of it. Ids of what is forgotten stay in the plane.
    void forgetTriangles(const Drawn& kept);
    void forgetTriangles() { forgetTriangles(Drawn{}); }

    // Triangles and pieces that were drawn; their ids are 0 .. triangleCount() - 1.
    size_t triangleCount() const { return triangles.size(); }
    TriangleRecord triangle(uint32_t triangleId) const;
    // For a clipped triangle: the barycentric coordinates of its vertex 0, 1 or 2 in the source triangle.
    const std::array<double, 3>& barycentric(uint32_t triangleId, size_t corner) const {
        return clippedVertices[triangles[triangleId].vertex[corner]].barycentric;
    }
    const ProjectedVertex& vertex(const StoredTriangle& t, size_t i) const {
        return t.clipped ? clippedVertices[t.vertex[i]].projected : vertices[t.vertex[i]];
    }

    RenderTargetFormat format;
    Image<uint32_t> depth;        // of d64f the upper 32 bits
    Image<uint32_t> lowDepth;     // of d64f the lower 32 bits; else empty
    Image<uint8_t> stencil;       // of 8 bits; else empty
    Image<uint32_t> wideStencil;  // of 32 bits; else empty
    Image<uint32_t> id;
    uint32_t drawCount = 0;         // draws so far; StoredTriangle::draw counts over all calls of rasterize
    std::vector<DepthBias> biases;  // of each draw
    double largestDepth = 1;        // bounds |z_i| + |bias| of what was drawn in an exact order

    // What ids stand for; written by rasterize.
    UninitializedVector<StoredTriangle> triangles;
    UninitializedVector<ProjectedVertex> vertices;
    std::vector<ClippedVertex> clippedVertices;
    RasterScratchHolder scratch;
};

// The stored integer of depth 1; of d64f the upper 32 bits, the lower ones are 0.
uint32_t storedOne(DepthFormat format);

// The stored integers of the far plane (the clear value) and of the near one.
uint32_t farthestDepth(const RenderTargetFormat& format);
uint32_t nearestDepth(const RenderTargetFormat& format);

// A stored integer behind every depth that is drawn: where it stands every depth is nearer. It stands for 2, reversed for
// -1.
uint32_t depthBehindAll(const RenderTargetFormat& format);

// The number that a stored integer stands for, in [0, 1] but for depthBehindAll. low: the lower 32 bits of d64f.
double depthFromStored(DepthFormat format, uint32_t stored, uint32_t low = 0);

// Sample positions in sixteenths of a pixel from the pixel's corner (0..15), rule 4; `samples` of them.
std::span<const std::array<int, 2>> samplePositions(int samples);

}  // namespace etalon
