#include "probes/light_passes.h"

#include "numeric/door.h"
#include "probes/energy_lanes.h"
#include "probes/light_irradiance.h"
#include "probes/summed_area.h"

namespace etalon {

template <class T>
constexpr LightPasses kPassesOver<LightPasses, T> = {roundedValues<T>, summedArea<T>, boxSums<T>,
                                                     texelEnergies<T>, regionSums<T>, irradianceOfLights<T>};
template const LightPasses& ETALON_LEVEL::passesOf<LightPasses>(NumberType);

}  // namespace etalon
