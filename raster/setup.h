// From projected vertices to triangles: assembly, cut and culling (rules 1 to 3), and the tiles that each can
// touch.
//
// Not here: attributes (lighting/tile_triangles.h sets them up for the triangles that are visible), and any
// removal of triangles that others hide; triangles are neither sorted nor merged.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "raster/clip.h"
#include "raster/tile_grid.h"

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

// A draw after the vertex stage.
struct DrawInput {
    const Draw* draw;
    std::span<const ProjectedVertex> projected;
    std::span<const uint8_t> outcodes;
    uint32_t number;       // StoredTriangle::draw
    uint32_t firstVertex;  // number of the first vertex in the target
};

// Turns triangles into stored ones, in order, and counts what became of them and how many each tile gets.
// Vertices that clipping makes are numbered from 0.
class TriangleSetup {
  public:
    // Starts anew; keeps the memory.
    void begin(const ViewportTransform& transform, const TileGrid& grid);
    // The triangles [first, last) of those that a draw draws.
    void process(const DrawInput& input, size_t first, size_t last);

    std::vector<StoredTriangle> triangles;
    std::vector<uint32_t>
        tiles;  // of the first triangle, of the second one ...; a group's at its first piece
    std::vector<size_t> endOfTiles;  // for each triangle: the number of tiles up to its last one
    std::vector<ClippedVertex> clippedVertices;
    std::vector<uint32_t> countOfTile;
    RasterStatistics statistics;

  private:
    bool isCulled(int64_t area, const DrawState& state);
    void addTriangle(const DrawInput& input, uint32_t index, const std::array<uint32_t, 3>& corners);
    bool missesAll(const TileGrid::PixelBox& box, const ProjectedVertex& a, const ProjectedVertex& b,
                   const ProjectedVertex& c) const;
    void addClipped(const DrawInput& input, uint32_t index, const std::array<uint32_t, 3>& corners,
                    int planes);
    void addTile(size_t tile);
    void addTiles(const TileBox& box);
    void addTilesInside(const TileBox& box, const ProjectedVertex& a, const ProjectedVertex& b,
                        const ProjectedVertex& c);
    void endTiles() { endOfTiles.push_back(tiles.size()); }

    const ViewportTransform* transform_ = nullptr;
    const TileGrid* grid_ = nullptr;
};

}  // namespace etalon
