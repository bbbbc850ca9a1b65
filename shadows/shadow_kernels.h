// The kernel texts of shadow maps, for every number type, and what they read.
#pragma once

#include <glm/vec2.hpp>
#include <vector>

#include "raster/texture.h"
#include "shadows/shadow_pattern.h"
#include "shadows/shadow_texels.h"

namespace etalon {

template <class T>
struct ShadowBuffers {
    ShadowTexels<T> texels;
    std::vector<glm::dvec2> pattern;  // disc, soft
    PatternTurns turns;
};

template <class T>
struct ShadowKernels {
#include "numeric/kernel_scope.inc"
#include "raster/texture_scope.inc"
#include "shadows/shadow_scope.inc"
#include "numeric/kernels/vector.glsl"
#include "raster/kernels/sampler.glsl"
#include "raster/kernels/cube_face.glsl"
#include "shadows/kernels/pattern_turn.glsl"
#include "shadows/kernels/shadow_point.glsl"
#include "shadows/kernels/shadow_filter.glsl"
#include "shadows/kernels/shadow_disc.glsl"
#include "shadows/kernels/shadow_visibility.glsl"

    const ShadowBuffers<T>& buffers;
};

}  // namespace etalon
