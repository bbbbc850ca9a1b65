#include "shadows/shadow_passes.h"

#include "numeric/levels.h"
#include "raster/fragment_numbers.h"

namespace etalon {

ETALON_PASSES_OF_ACTIVE_LEVEL(ShadowPasses, shadowPasses)
ETALON_DECLARE_ARITHMETICS(LookupPasses, lookupPasses)
ETALON_DECLARE_ARITHMETICS(PlanarPasses, planarPasses)

LookupPasses lookupPasses(FragmentArithmetic arithmetic) {
    return arithmetic == FragmentArithmetic::truth ? lookupPasses_truth() : shadowPasses().lookup(arithmetic);
}

PlanarPasses planarPasses(FragmentArithmetic arithmetic) {
    return arithmetic == FragmentArithmetic::truth ? planarPasses_truth() : shadowPasses().planar(arithmetic);
}

}  // namespace etalon
