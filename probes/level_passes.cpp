// Compiled once per level.
#include "probes/energy_lanes.h"
#include "probes/probe_passes.h"
#include "raster/fragment_numbers.h"

namespace etalon {

ETALON_DECLARE_ARITHMETICS(LightPasses, lightPasses)
ETALON_DECLARE_ARITHMETICS(MappingPasses, mappingPasses)

namespace ETALON_LEVEL {
namespace {

ETALON_PASSES_IN_LANES(LightPasses, lightPasses)
ETALON_PASSES_IN_LANES(MappingPasses, mappingPasses)

}  // namespace

const ProbePasses& probePasses() {
    static const ProbePasses passes = {lightPasses_inLanes,
                                       mappingPasses_inLanes,
                                       {bandOfTable<kNativeLanes<double>>, regionSums<kNativeLanes<double>>}};
    return passes;
}

}  // namespace ETALON_LEVEL
}  // namespace etalon
