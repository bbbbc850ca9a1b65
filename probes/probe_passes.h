// The passes of probes/ that are compiled once per instruction set level (numeric/isa.h).
#pragma once

#include "probes/mapping_passes.h"

namespace etalon {

// All arithmetics but truth, which has no lanes.
struct ProbePasses {
    MappingPasses (*mapping)(FragmentArithmetic arithmetic);
};

// Those of the active level.
const ProbePasses& probePasses();

}  // namespace etalon
