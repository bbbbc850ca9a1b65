#include "raster/raster_passes.h"

#include "numeric/levels.h"

namespace etalon {

ETALON_PASSES_OF_ACTIVE_LEVEL(RasterPasses, rasterPasses)

}  // namespace etalon
