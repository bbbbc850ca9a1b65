// The passes of shadows/ that are compiled once per instruction set level (numeric/isa.h).
#pragma once

#include "shadows/lookup_passes.h"
#include "shadows/planar_passes.h"

namespace etalon {

// All arithmetics but truth, which has no lanes.
struct ShadowPasses {
    LookupPasses (*lookup)(FragmentArithmetic arithmetic);
    PlanarPasses (*planar)(FragmentArithmetic arithmetic);
};

// Those of the active level.
const ShadowPasses& shadowPasses();

}  // namespace etalon
