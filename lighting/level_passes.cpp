// Compiled once per level.
#include "lighting/lighting_passes.h"
#include "lighting/transform.h"
#include "lighting/vertex_lighting.h"
#include "numeric/lanes.h"
#include "raster/fragment_numbers.h"

namespace etalon {

ETALON_DECLARE_ARITHMETICS(ShadingPasses, shadingPasses)

namespace ETALON_LEVEL {
namespace {

ETALON_PASSES_IN_LANES(ShadingPasses, shadingPasses)

}  // namespace

const LightingPasses& lightingPasses() {
    static const LightingPasses passes = {shadingPasses_inLanes, toneMap<Native<float>>, transformPoints,
                                          projectPoints, lightVertices};
    return passes;
}

}  // namespace ETALON_LEVEL
}  // namespace etalon
