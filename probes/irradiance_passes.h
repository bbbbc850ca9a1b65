// Irradiance of a probe.
#pragma once

#include <span>

#include "probes/irradiance.h"

namespace etalon {

struct IrradiancePasses {
    // probes/irradiance.h
    std::vector<glm::dvec3> (*irradianceAt)(const Probe& probe, std::span<const glm::dvec3> normals,
                                            int threads);
    TexelLights (*texelLights)(const Probe& probe, int threads);
};

}  // namespace etalon
