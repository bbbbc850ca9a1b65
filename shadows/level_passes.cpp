// Compiled once per level.
#include "raster/fragment_numbers.h"
#include "shadows/shadow_passes.h"

namespace etalon {

ETALON_DECLARE_ARITHMETICS(PlanarPasses, planarPasses)

namespace ETALON_LEVEL {
namespace {

ETALON_PASSES_IN_LANES(PlanarPasses, planarPasses)

}  // namespace

const ShadowPasses& shadowPasses() {
    static const ShadowPasses passes = {planarPasses_inLanes};
    return passes;
}

}  // namespace ETALON_LEVEL
}  // namespace etalon
