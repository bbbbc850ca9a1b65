// Passes between probes and lights over a number type, for the sources that instantiate them.
#pragma once

#include "probes/light_irradiance.h"
#include "probes/light_passes.h"
#include "probes/summed_area.h"

namespace etalon {

template <class T>
LightPasses lightPassesOver() {
    return {roundedValues<T>, summedArea<T>, boxSums<T>, irradianceOfLights<T>};
}

}  // namespace etalon
