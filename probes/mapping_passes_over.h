// Passes between mappings over a number type, for the sources that instantiate them.
#pragma once

#include "probes/convert_over.h"
#include "probes/mapping_passes.h"

namespace etalon {

template <class T>
MappingPasses mappingPassesOver() {
    return {cubeFromLatLong<T>, convertImages<T>, latLongFromCubeImage<T>};
}

}  // namespace etalon
