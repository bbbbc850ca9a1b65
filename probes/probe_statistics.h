// What a probe holds, in numbers.
#pragma once

#include <cstddef>
#include <glm/vec3.hpp>

#include "probes/probe.h"

namespace etalon {

// Texels that show no direction or are not valid count nowhere.
struct ProbeStatistics {
    // Of the finite values of all channels; 0 if there is none.
    double smallest = 0, largest = 0;
    // log2 of the largest over the smallest value above 0; 0 if there is none.
    double dynamicRange_stops = 0;
    // The mean of the radiance over directions, weighted with the exact solid angles, in fixed sums; NaN and
    // infinities go into it. 0 if no texel counts.
    glm::dvec3 mean{0};
    double solidAngle_sr = 0;                           // of the texels that count
    size_t negative = 0, infinite = 0, notANumber = 0;  // values
};
ProbeStatistics statisticsOf(const Probe& probe, int threads = 0);

}  // namespace etalon
