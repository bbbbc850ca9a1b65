// The kernel texts of the rasterizer, for every number type.
#pragma once

#include "numeric/kernel_types.h"

namespace etalon {

template <class T>
struct RasterKernels {
#include "numeric/kernel_scope.inc"
#include "raster/kernels/depth_unorm.glsl"
#include "raster/kernels/interpolate.glsl"
};

}  // namespace etalon
