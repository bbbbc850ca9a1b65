// Passes between probes and lights.
#pragma once

#include <span>
#include <vector>

#include "probes/probe.h"
#include "probes/probe_light.h"

namespace etalon {

struct LightPasses {
    // probes/summed_area.h
    Image<double> (*roundedValues)(const Image<double>& values, int threads);
    Image<double> (*summedArea)(const Image<double>& values, int threads);
    Image<double> (*boxSums)(const Image<double>& table, int width, int height, int threads);
    // probes/light_irradiance.h
    std::vector<Image<double>> (*irradianceOfLights)(std::span<const ProbeLight> lights,
                                                     const ProbeShape& shape, int threads);
};

}  // namespace etalon
