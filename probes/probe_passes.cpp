#include "probes/probe_passes.h"

#include "numeric/levels.h"
#include "raster/fragment_numbers.h"

namespace etalon {

ETALON_PASSES_OF_ACTIVE_LEVEL(ProbePasses, probePasses)
ETALON_DECLARE_ARITHMETICS(LightPasses, lightPasses)
ETALON_DECLARE_ARITHMETICS(MappingPasses, mappingPasses)
ETALON_DECLARE_ARITHMETICS(HarmonicsPasses, harmonicsPasses)
ETALON_DECLARE_ARITHMETICS(IrradiancePasses, irradiancePasses)

LightPasses lightPasses(FragmentArithmetic arithmetic) {
    return arithmetic == FragmentArithmetic::truth ? lightPasses_truth() : probePasses().light(arithmetic);
}

MappingPasses mappingPasses(FragmentArithmetic arithmetic) {
    return arithmetic == FragmentArithmetic::truth ? mappingPasses_truth()
                                                   : probePasses().mapping(arithmetic);
}

HarmonicsPasses harmonicsPasses(FragmentArithmetic arithmetic) {
    return arithmetic == FragmentArithmetic::truth ? harmonicsPasses_truth()
                                                   : probePasses().harmonics(arithmetic);
}

IrradiancePasses irradiancePasses(FragmentArithmetic arithmetic) {
    return arithmetic == FragmentArithmetic::truth ? irradiancePasses_truth()
                                                   : probePasses().irradiance(arithmetic);
}

}  // namespace etalon
