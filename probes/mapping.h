// The mappings of a probe as formulas. The texts are probes/kernels/mapping.glsl.
//
// u runs to the right and v downwards over the image of a layer, 0 to 1; texel centres are at (i + 1/2) /
// size.
//   latLong: u = 1/2 - atan2(x, z) / (2 pi), v = 1/2 - atan2(y, sqrt(x^2 + z^2)) / pi (probes/latlong.h)
//   latLongPedersen: [Pedersen2008, Listing 6.1] x = sin(pi v) cos(2 pi u), y = cos(pi v), z = -sin(pi v)
//     sin(2 pi u): +X at the left border, -Z a quarter from it. Seen from inside it is a mirror image of
//     latLong. The listing's texture coordinate grows upwards (v there is 1 - v here), as OpenGL's rows do.
//   cube: the face table (raster/cube_face.h)
// The others fill a square, X = 2 u - 1 to the right, Y = 1 - 2 v upwards, +Z in the middle, +X on its right,
// +Y above. That is what a mirror ball shows to an eye on its +Z side; seen from inside it is a mirror image.
//   angular: the disc X^2 + Y^2 <= 1, whose radius is the polar angle from +Z divided by pi. This is the
//     formula of [Debevec98], (x, y) r with r = acos(z) / (pi sqrt(x^2 + y^2)); its words put the middle at
//     -Z. Also [Nowrouzezahrai2011, Eq. 6].
//   mirrorBall: the disc is the silhouette of the ball, seen in the direction -Z from ballDistance_radii, on
//     an image plane across that direction. At infinity the polar angle is 2 asin(radius). At a distance D
//     the directions within asin(1 / D) of -Z are behind the ball and not shown.
//   octahedral: [Clarberg2008, Sec. 3] with +Z in the middle and -Z in the corners; every texel has the same
//     solid angle.
//
// Degenerate directions: the zero direction counts as +Z; what has no azimuth (-Z on a disc) lies at X > 0, Y
// = 0. NaN gives numbers in [0, 1]. Squares of components neither overflow nor vanish in the number type.
#pragma once

#include "numeric/elementary.h"
#include "probes/latlong.h"
#include "probes/probe.h"

namespace etalon {

// Largest error of u and v in float against exact arithmetic, direction exact, where the mapping is
// continuous: for mirror balls seen from kLeastBallDistance_radii or farther. Times the image's size it is an
// error in texels.
inline constexpr double kMappingFloatError = 0x1p-22;
// A ball cannot be seen from nearer.
inline constexpr double kLeastBallDistance_radii = 1.01;

// The texts over T: mappingPoint(direction, settings), mappingDirection(layer, u, v, settings).
template <class T>
struct MappingKernel {
#include "numeric/kernel_scope.inc"
#include "raster/texture_scope.inc"
#include "raster/kernels/sampler.glsl"
#include "raster/kernels/cube_face.glsl"
#include "probes/kernels/latlong.glsl"
#include "probes/kernels/mapping.glsl"
};

// Steps of Newton's method for a mirror ball at 1 / k radii, after which the angle is off by less than 2^-50.
inline int ballNewtonSteps(double k) {
    if (k == 0.0) return 0;
    return k <= 0.1 ? 2 : k <= 0.5 ? 4 : k <= 0.9 ? 6 : 8;
}

// Width and height as the mapping wants them, at least 1; the ball's distance at least
// kLeastBallDistance_radii (PreconditionError otherwise).
void checkShape(const ProbeShape& shape);

// The settings of a shape for a kernel class that includes mapping.glsl.
template <class Kernel>
typename Kernel::MappingSettings mappingSettingsOf(const ProbeShape& shape) {
    using T = typename Kernel::real;
    const double k = shape.mapping == Mapping::mirrorBall ? 1.0 / shape.ballDistance_radii : 0.0;
    return {static_cast<int>(shape.mapping), ballNewtonSteps(k), T(k), T(squareRoot((1.0 - k) * (1.0 + k)))};
}

}  // namespace etalon
