// The passes of the rasterizer that are compiled once per instruction set level (numeric/isa.h).
#pragma once

#include "raster/image.h"

namespace etalon {

struct RasterPasses {
    Image<float> (*blurGaussian)(const Image<float>& image, int radius, double sigma, int threads);
};

// Those of the active level.
const RasterPasses& rasterPasses();

}  // namespace etalon
