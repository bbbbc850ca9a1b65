// Compiled once per level.
#include "numeric/lanes.h"
#include "raster/blur.h"
#include "raster/raster_passes.h"
#include "raster/vertex_stage.h"

namespace etalon::ETALON_LEVEL {

const RasterPasses& rasterPasses() {
    static const RasterPasses passes = {projectVertices, makeTileRasterizer, blurGaussian<Native<float>>};
    return passes;
}

}  // namespace etalon::ETALON_LEVEL
