// Draws triangles into a render target by the rules of docs/specification.md.
//
// It draws indexed triangle lists whose vertices are in clip space, and finds visibility. Not here:
//   - points, lines, strips, fans, restarting indices, instances, vertex or geometry programs, tessellation
//   - several viewports or scissors at once, a range of depth other than [0, 1], clip planes of the user
//   - colour, blending, discarded fragments, alpha to coverage: shading follows (lighting/shade.h)
//   - conservative coverage, sample masks, sample positions of the user, queries of samples
#pragma once

#include <cstdint>
#include <span>

#include "raster/draw.h"
#include "raster/render_target.h"

namespace etalon {

// Where clip space lands, in pixels; inside the render target, at least 1 x 1.
struct Viewport {
    int x = 0, y = 0, width = 0, height = 0;
};

// How the work is done. Threads and tiles change no bit.
struct RasterOptions {
    int threads = 0;    // 0: all hardware threads
    int tileSize = 64;  // 8 to 256, a multiple of 8
    // As RenderTarget::clear before, but tile by tile, which is faster. The viewport must be the whole
    // target.
    bool clear = false;
};

struct RasterStatistics {
    uint64_t triangles = 0;         // submitted
    uint64_t droppedNonFinite = 0;  // rule 1
    uint64_t rejected = 0;          // outside one plane of rule 2, or nothing left of it
    uint64_t clipped = 0;           // cut by at least one plane
    uint64_t zeroArea = 0;          // after snapping
    uint64_t culled = 0;            // by facing
    uint64_t missed = 0;            // small and whole, and known to cover no sample when set up
    uint64_t records = 0;           // triangles and pieces that were drawn

    friend bool operator==(const RasterStatistics&, const RasterStatistics&) = default;
};

// Draws the triangles of all draws in order into the part of the target inside the viewport. Ids are those of
// target.triangle(id), and go on from earlier calls. Throws PreconditionError for an index out of range, a
// viewport that leaves the target, or options out of range.
RasterStatistics rasterize(RenderTarget& target, const Viewport& viewport, std::span<const Draw> draws,
                           const RasterOptions& options = {});

}  // namespace etalon
