// Passes between the mappings of a probe.
#pragma once

#include "probes/conversion_job.h"
#include "probes/latlong.h"

namespace etalon {

struct MappingPasses {
    // probes/latlong.h
    CubeMap<float> (*cubeFromLatLong)(const Image<float>& latLong, int size, const CubeFromLatLong& options,
                                      int threads);
    // probes/convert.h; the images of the result have their sizes. Writes every texel.
    void (*convertImages)(const ConversionJob& job, Probe& result);
    void (*latLongFromCube)(const CubeMap<float>& cube, const LatLongFromCube& options, int threads,
                            Image<float>& latLong);
};

}  // namespace etalon
