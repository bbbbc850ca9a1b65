// Visibility of one tile: replays triangles in order (rules 4 to 7, 10 and 11).
#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "raster/draw.h"
#include "raster/render_target.h"
#include "raster/tile_grid.h"

namespace etalon {

// Which planes the draws of one call read or write, besides depth.
struct UsedPlanes {
    bool id = false, stencil = false;
};

// Draws tiles, one after the other; keeps a tile's planes.
class TileRasterizer {
  public:
    virtual ~TileRasterizer() = default;

    // Draws the triangles whose numbers are listed, in that order, with the state of their draw (`draws`
    // start at the target's draw number firstDraw). A triangle with a groupSize stands for its whole group.
    virtual void run(RenderTarget& target, const TileGrid::Rectangle& rectangle, std::span<const Draw> draws,
                     uint32_t firstDraw, const UsedPlanes& used, std::span<const uint32_t> triangles) = 0;
};

// Compiled once per level; callers go through raster/raster_passes.h.
std::unique_ptr<TileRasterizer> makeTileRasterizer();

}  // namespace etalon
