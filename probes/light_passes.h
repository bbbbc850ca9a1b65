// Passes between probes and lights.
#pragma once

#include <span>
#include <vector>

#include "probes/energy_passes.h"
#include "probes/probe.h"
#include "probes/probe_light.h"

namespace etalon {

struct LightPasses {
    // probes/summed_area.h
    Image<double> (*roundedValues)(const Image<double>& values, int threads);
    Image<double> (*summedArea)(const Image<double>& values, int threads);
    Image<double> (*boxSums)(const Image<double>& table, int width, int height, int threads);
    // probes/energy_passes.h. Of one texel each, energyOf its counted radiance times the weight of its row.
    Image<double> (*texelEnergies)(const Image<float>& radiance, const double* rowWeights, int threads);
    RegionSums (*regionSums)(const Image<float>& radiance, const TexelRegion& region,
                             const double* rowWeights);
    // probes/light_irradiance.h
    std::vector<Image<double>> (*irradianceOfLights)(std::span<const ProbeLight> lights,
                                                     const ProbeShape& shape, int threads);
};

}  // namespace etalon
