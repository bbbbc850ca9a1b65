// Spherical harmonics of a probe.
#pragma once

#include <span>

#include "probes/spherical_harmonics.h"

namespace etalon {

struct HarmonicsPasses {
    // probes/spherical_harmonics.h
    SphericalHarmonics (*project)(const Probe& probe, int degree, int threads);
    std::vector<glm::dvec3> (*evaluate)(const SphericalHarmonics& harmonics,
                                        std::span<const glm::dvec3> directions, int threads);
};

// Of a lat-long probe, in double and about the image's axis (probes/latlong_moments.cpp).
struct LatLongHarmonicsPasses {
    SphericalHarmonics (*project)(const Probe& probe, int degree, int threads);
};

}  // namespace etalon
