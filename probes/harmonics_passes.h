// Spherical harmonics of a probe, once per arithmetic (raster/fragment_numbers.h).
#pragma once

#include <span>

#include "probes/spherical_harmonics.h"
#include "raster/profile.h"

namespace etalon {

struct HarmonicsPasses {
    // probes/spherical_harmonics.h
    SphericalHarmonics (*project)(const Probe& probe, int degree, int threads);
    std::vector<glm::dvec3> (*evaluate)(const SphericalHarmonics& harmonics,
                                        std::span<const glm::dvec3> directions, int threads);
};

// Those of an arithmetic.
HarmonicsPasses harmonicsPasses(FragmentArithmetic arithmetic);

}  // namespace etalon
