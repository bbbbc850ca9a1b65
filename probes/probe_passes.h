// The passes of probes/ that are compiled once per instruction set level (numeric/isa.h).
#pragma once

#include "probes/energy_passes.h"
#include "probes/light_passes.h"
#include "probes/mapping_passes.h"

namespace etalon {

// All arithmetics but truth, which has no lanes.
struct ProbePasses {
    LightPasses (*light)(FragmentArithmetic arithmetic);
    MappingPasses (*mapping)(FragmentArithmetic arithmetic);
    EnergyPasses energy;  // in double
};

// Those of the active level.
const ProbePasses& probePasses();

}  // namespace etalon
