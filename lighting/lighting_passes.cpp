#include "lighting/lighting_passes.h"

#include "numeric/levels.h"
#include "raster/fragment_numbers.h"

namespace etalon {

ETALON_PASSES_OF_ACTIVE_LEVEL(LightingPasses, lightingPasses)
ETALON_DECLARE_ARITHMETICS(ShadingPasses, shadingPasses)

ShadingPasses shadingPasses(FragmentArithmetic arithmetic) {
    return arithmetic == FragmentArithmetic::truth ? shadingPasses_truth()
                                                   : lightingPasses().shading(arithmetic);
}

}  // namespace etalon
