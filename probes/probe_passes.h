// The passes of probes/ that are compiled once per instruction set level (numeric/isa.h).
#pragma once

#include "probes/energy_passes.h"
#include "probes/light_passes.h"
#include "probes/harmonics_passes.h"
#include "probes/irradiance_passes.h"
#include "probes/mapping_passes.h"

namespace etalon {

// All arithmetics but truth, which has no lanes.
struct ProbePasses {
    LightPasses (*light)(FragmentArithmetic arithmetic);
    MappingPasses (*mapping)(FragmentArithmetic arithmetic);
    HarmonicsPasses (*harmonics)(FragmentArithmetic arithmetic);
    IrradiancePasses (*irradiance)(FragmentArithmetic arithmetic);
    EnergyPasses energy;  // in double
    // Of a lat-long probe, in double and about the image's axis (probes/latlong_moments_over.h).
    SphericalHarmonics (*projectLatLong)(const Probe& probe, int degree, int threads);
};

// Those of the active level.
const ProbePasses& probePasses();

}  // namespace etalon
