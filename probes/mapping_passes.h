// Passes between the mappings of a probe, once per arithmetic (raster/fragment_numbers.h).
#pragma once

#include "probes/latlong.h"
#include "raster/profile.h"

namespace etalon {

struct MappingPasses {
    // probes/latlong.h
    CubeMap<float> (*cubeFromLatLong)(const Image<float>& latLong, int size, const CubeFromLatLong& options,
                                      int threads);
};

// Those of an arithmetic.
MappingPasses mappingPasses(FragmentArithmetic arithmetic);

}  // namespace etalon
