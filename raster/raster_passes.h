// The passes of the rasterizer that are compiled once per instruction set level (numeric/isa.h).
#pragma once

#include <memory>
#include <span>

#include "raster/image.h"
#include "raster/projection.h"
#include "raster/tile.h"

namespace etalon {

struct RasterPasses {
    // raster/vertex_stage.h
    void (*projectVertices)(const ViewportTransform& transform, std::span<const ClipVertex> vertices,
                            std::span<ProjectedVertex> projected, std::span<uint8_t> outcodes);
    // raster/tile.h
    std::unique_ptr<TileRasterizer> (*makeTileRasterizer)();
    // raster/blur.h
    Image<float> (*blurGaussian)(const Image<float>& image, int radius, double sigma, int threads);
};

// Those of the active level.
const RasterPasses& rasterPasses();

}  // namespace etalon
