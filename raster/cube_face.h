// Cube-map faces: raster rule 9. The texts are raster/kernels/cube_face.glsl.
//
// Faces in the order +X -X +Y -Y +Z -Z, with the face table of [VulkanSpec, "Cube Map Face Selection"]:
//   face  major  sc  tc
//   +X      x    -z  -y
//   -X      x     z  -y
//   +Y      y     x   z
//   -Y      y     x  -z
//   +Z      z     x  -y
//   -Z      z    -x  -y
// s = (sc / |major| + 1) / 2 to the right, t = (tc / |major| + 1) / 2 downwards; row 0 of a face is at t = 0.
// Ties of the largest magnitude go to Z, then Y, then X, as in [D3D11.3].
//
// Degenerate directions: comparisons with NaN are false and a quotient that is NaN counts as 0. So the zero
// direction is the centre of +Z, and every direction with NaN or infinite components has a face, and s and t
// in [0, 1]. The direction's length is arbitrary as long as its largest component is not subnormal.
//
// Bilinear sampling is seamless: a texel beyond a face's border is the adjoining texel of the neighbouring
// face; at a corner, where only three texels meet, the missing fourth counts as their mean, as the Vulkan
// specification recommends. Fractions, tap order and hull are those of raster/sampler.h; in `Sampling` only
// the width (the cube's size), the filter and its rules are used.
#pragma once

#include "numeric/kernel_types.h"
#include "raster/sampler.h"
#include "raster/texture.h"

namespace etalon {

// Faces of a cube map in storage order.
enum class CubeFace { plusX, minusX, plusY, minusY, plusZ, minusZ };
inline constexpr int kCubeFaces = 6;

// Largest error of s and t in float, directions exact; the face is always right (comparisons do not round).
inline constexpr double kCubeCoordinateFloatError = 0x1p-24;

// The texts over T: cubeCoordinates, cubeDirection, wrapCubeTexel, sampleCubeReal, sampleCubeRgb.
template <class T>
struct CubeFaceKernel {
#include "numeric/kernel_scope.inc"
#include "raster/texture_scope.inc"
#include "raster/kernels/sampler.glsl"
#include "raster/kernels/cube_face.glsl"
};

}  // namespace etalon
