// The kernel text that makes shadow textures of planes from counts, and one picture of several; and what it
// reads.
#pragma once

#include <vector>

#include "numeric/kernel_types.h"

namespace etalon {

template <class T>
struct CompositionKernel {
#include "numeric/kernel_scope.inc"
    // The GLSL counterpart is shadows/kernels/composition_scope.glsl; the two say the same.
    real lightShare(int light) const { return T(shares[static_cast<size_t>(light)]); }
    real lightVisibility(int light) const {
        return T(visibility[static_cast<size_t>(light) * texels + texel]);
    }
#include "shadows/kernels/planar_composition.glsl"

    std::vector<double> shares;      // of the lights in the irradiance
    std::vector<double> visibility;  // of the lights at each texel of a row, row after row
    size_t texels = 0, texel = 0;
};

}  // namespace etalon
