// Compiled once per level.
#include "raster/fragment_numbers.h"
#include "shadows/shadow_passes.h"

namespace etalon {

ETALON_DECLARE_ARITHMETICS(LookupPasses, lookupPasses)
ETALON_DECLARE_ARITHMETICS(PlanarPasses, planarPasses)

namespace ETALON_LEVEL {
namespace {

ETALON_PASSES_IN_LANES(LookupPasses, lookupPasses)
ETALON_PASSES_IN_LANES(PlanarPasses, planarPasses)

}  // namespace

const ShadowPasses& shadowPasses() {
    static const ShadowPasses passes = {lookupPasses_inLanes, planarPasses_inLanes};
    return passes;
}

}  // namespace ETALON_LEVEL
}  // namespace etalon
