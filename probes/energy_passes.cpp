#include "probes/energy_passes.h"

#include "numeric/door.h"
#include "probes/energy_lanes.h"

namespace etalon {

template <>
constexpr EnergyPasses kPassesOver<EnergyPasses, void> = {bandOfTable<kNativeLanes<double>>};
template const EnergyPasses& ETALON_LEVEL::passesOf<EnergyPasses>();

}  // namespace etalon
