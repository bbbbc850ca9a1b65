// The vertices of a draw on the screen (rule 3), over lanes.
#pragma once

#include <span>

#include "raster/draw.h"
#include "raster/projection.h"

namespace etalon {

struct VertexPasses {
    // Projects each vertex and finds its outcode (raster/projection.h). A vertex outside the w plane or the
    // guard band, or that rule 1 drops, gets the middle of the viewport: what is drawn of its triangles comes
    // from the cut polygon. The spans have one size.
    void (*project)(const ViewportTransform& transform, std::span<const ClipVertex> vertices,
                    std::span<ProjectedVertex> projected, std::span<uint8_t> outcodes);
};

}  // namespace etalon
