// Compiled once per level.
#include "probes/probe_passes.h"
#include "raster/fragment_numbers.h"

namespace etalon {

ETALON_DECLARE_ARITHMETICS(MappingPasses, mappingPasses)

namespace ETALON_LEVEL {
namespace {

ETALON_PASSES_IN_LANES(MappingPasses, mappingPasses)

}  // namespace

const ProbePasses& probePasses() {
    static const ProbePasses passes = {mappingPasses_inLanes};
    return passes;
}

}  // namespace ETALON_LEVEL
}  // namespace etalon
