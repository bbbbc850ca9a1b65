// Irradiance of a probe, once per arithmetic (raster/fragment_numbers.h).
#pragma once

#include <span>

#include "probes/irradiance.h"
#include "raster/profile.h"

namespace etalon {

struct IrradiancePasses {
    // probes/irradiance.h
    std::vector<glm::dvec3> (*irradianceAt)(const Probe& probe, std::span<const glm::dvec3> normals,
                                            int threads);
    // raster/blur.h
    Image<float> (*blur)(const Image<float>& image, int radius, double sigma_px, int threads);
};

// Those of an arithmetic.
IrradiancePasses irradiancePasses(FragmentArithmetic arithmetic);

}  // namespace etalon
