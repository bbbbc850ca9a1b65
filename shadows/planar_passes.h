// Passes of planar shadows.
#pragma once

#include <span>

#include "lighting/light_visibility.h"
#include "shadows/planar_shadow.h"

namespace etalon {

// How a shadow texture is read.
struct PlanarSampling {
    Filter filter = Filter::bilinear;
    int fractionBits = kExactFraction;
};

struct PlanarPasses {
    // Multiplies visibility[i] with what the shadow lets pass, for the points i that are listed; the others are
    // left as they are. The shadow is not empty.
    void (*visibility)(const PlanarShadow& shadow, const PlanarSampling& sampling, const LitPoints& points,
                       std::span<const uint32_t> listed, std::span<double> visibility);
};

}  // namespace etalon
