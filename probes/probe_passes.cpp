#include "probes/probe_passes.h"

#include "numeric/levels.h"
#include "raster/fragment_numbers.h"

namespace etalon {

ETALON_PASSES_OF_ACTIVE_LEVEL(ProbePasses, probePasses)
ETALON_DECLARE_ARITHMETICS(LightPasses, lightPasses)
ETALON_DECLARE_ARITHMETICS(MappingPasses, mappingPasses)

LightPasses lightPasses(FragmentArithmetic arithmetic) {
    return arithmetic == FragmentArithmetic::truth ? lightPasses_truth() : probePasses().light(arithmetic);
}

MappingPasses mappingPasses(FragmentArithmetic arithmetic) {
    return arithmetic == FragmentArithmetic::truth ? mappingPasses_truth()
                                                   : probePasses().mapping(arithmetic);
}

}  // namespace etalon
