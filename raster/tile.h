// Visibility of one tile: replays triangles in order (rules 4 to 7, 10 and 11).
//
// Not here: shading, depth bounds, depths that fragments make, and samples that are counted. What one call
// learns of a tile's depths is forgotten by the next one, which reads the planes.
#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "raster/draw.h"
#include "raster/render_target.h"
#include "raster/tile_grid.h"

namespace etalon {

// What the tiles of one call have in common.
struct TileWork {
    RenderTarget* target;
    std::span<const Draw> draws;  // they start at the target's draw number firstDraw
    uint32_t firstDraw;
    bool clear;                             // the tiles start cleared
    bool usesId, usesStencil, writesDepth;  // some draw does
};

// Draws tiles, one after the other; keeps a tile's planes.
class TileRasterizer {
  public:
    virtual ~TileRasterizer() = default;

    // Draws the triangles whose numbers are listed, in that order, with the state of their draw. A triangle
    // with a groupSize stands for its whole group.
    virtual void run(const TileWork& work, const TileGrid::Rectangle& rectangle,
                     std::span<const uint32_t> triangles) = 0;
};

struct TilePasses {
    std::unique_ptr<TileRasterizer> (*makeRasterizer)();
};

}  // namespace etalon
