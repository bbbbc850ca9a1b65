#include "raster/raster_passes.h"

#include "numeric/check.h"
#include "numeric/levels.h"

namespace etalon {

#define ETALON_DECLARE(name)                \
    namespace level_##name {                \
        const RasterPasses& rasterPasses(); \
    }
ETALON_FOR_EACH_LEVEL(ETALON_DECLARE)

const RasterPasses& rasterPasses() {
    switch (activeIsa()) {
#define ETALON_CASE(name) \
    case IsaLevel::name:  \
        return level_##name::rasterPasses();
        ETALON_FOR_EACH_LEVEL(ETALON_CASE)
        default:
            break;
    }
    ETALON_CHECK(false, "level {} is not built", isaName(activeIsa()));
    __builtin_unreachable();
}

}  // namespace etalon
