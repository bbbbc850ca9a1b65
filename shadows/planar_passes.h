// Passes of planar shadows.
#pragma once

#include <span>

#include "lighting/light_visibility.h"
#include "shadows/planar_shadow.h"

namespace etalon {

struct PlanarPasses {
    // Multiplies visibility[i] with what the shadow lets pass, for the points i that are listed; the others are
    // left as they are. The shadow is not empty. sampler: how the shadow's texture is read; it is never wrapped.
    void (*visibility)(const PlanarShadow& shadow, const SamplerSettings& sampler, const LitPoints& points,
                       std::span<const uint32_t> listed, std::span<double> visibility);
};

}  // namespace etalon
