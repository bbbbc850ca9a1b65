#include "probes/mapping_passes.h"

#include "numeric/door.h"
#include "probes/convert_over.h"

namespace etalon {

template <class T>
constexpr MappingPasses kPassesOver<MappingPasses, T> = {cubeFromLatLong<T>, convertImages<T>,
                                                         latLongFromCubeImage<T>};
template const MappingPasses& ETALON_LEVEL::passesOf<MappingPasses>(NumberType);

}  // namespace etalon
