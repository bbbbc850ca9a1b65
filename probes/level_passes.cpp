// Compiled once per level.
#include "probes/energy_lanes.h"
#include "probes/latlong_moments_over.h"
#include "probes/probe_passes.h"
#include "raster/fragment_numbers.h"

namespace etalon {

ETALON_DECLARE_ARITHMETICS(LightPasses, lightPasses)
ETALON_DECLARE_ARITHMETICS(MappingPasses, mappingPasses)
ETALON_DECLARE_ARITHMETICS(HarmonicsPasses, harmonicsPasses)
ETALON_DECLARE_ARITHMETICS(IrradiancePasses, irradiancePasses)

namespace ETALON_LEVEL {
namespace {

ETALON_PASSES_IN_LANES(LightPasses, lightPasses)
ETALON_PASSES_IN_LANES(MappingPasses, mappingPasses)
ETALON_PASSES_IN_LANES(HarmonicsPasses, harmonicsPasses)
ETALON_PASSES_IN_LANES(IrradiancePasses, irradiancePasses)

}  // namespace

const ProbePasses& probePasses() {
    static const ProbePasses passes = {lightPasses_inLanes,
                                       mappingPasses_inLanes,
                                       harmonicsPasses_inLanes,
                                       irradiancePasses_inLanes,
                                       {bandOfTable<kNativeLanes<double>>, regionSums<kNativeLanes<double>>},
                                       projectLatLongOver<Native<double>>};
    return passes;
}

}  // namespace ETALON_LEVEL
}  // namespace etalon
