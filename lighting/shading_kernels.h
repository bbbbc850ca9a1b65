// The kernel texts of the shading passes, for every number type.
#pragma once

#include "numeric/elementary.h"
#include "numeric/kernel_types.h"
#include "numeric/number.h"
#include "raster/sampler.h"
#include "raster/texture.h"

namespace etalon {

template <class T>
struct ShadingKernels {
#include "numeric/kernel_scope.inc"
#include "raster/texture_scope.inc"
#include "raster/sample_scope.inc"
#include "lighting/light_scope.inc"
#include "numeric/kernels/vector.glsl"
#include "raster/kernels/interpolate.glsl"
#include "raster/kernels/resolve.glsl"
#include "raster/kernels/sampler.glsl"
#include "raster/kernels/view_ray.glsl"
#include "raster/kernels/cube_face.glsl"
#include "lighting/kernels/blinn_phong.glsl"
#include "lighting/kernels/checker.glsl"
#include "lighting/kernels/lambert.glsl"
#include "probes/kernels/latlong.glsl"
#include "lighting/kernels/mirror.glsl"
#include "lighting/kernels/positional_light.glsl"
#include "lighting/kernels/rotate_y.glsl"
#include "lighting/kernels/environment_view.glsl"
#include "lighting/kernels/surface_point.glsl"
#include "lighting/kernels/reflectances.glsl"
#include "lighting/kernels/surface_light.glsl"
#include "lighting/kernels/view_depth.glsl"
};

}  // namespace etalon
