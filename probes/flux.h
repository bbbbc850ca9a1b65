// What a texel of a probe adds to sums over directions, in every arithmetic. The text is
// probes/kernels/flux.glsl.
//
// The flux of a texel is its radiance times its weight, the solid angle times kFluxScale. The scale is a
// power of two and is taken out again, exactly, where a sum leaves its pass: with it neither the irradiance
// nor a coefficient of spherical harmonics overflows, whatever its partial sums, while no radiance is beyond
// the largest finite number of the arithmetic. Radiance beyond that number, infinities included, counts as
// that number; NaN stays. Texels without a solid angle and those that are not valid count as black.
//
// In fp32 fluxes, cosines, components of directions and values of harmonics below kSmallestFloatTerm in
// magnitude count as 0, so that no intermediate is subnormal. Other arithmetics need no such floor: the
// formats below fp32's range flush or keep subnormals by a rule of their own (numeric/format.h).
#pragma once

#include <array>
#include <glm/mat3x3.hpp>
#include <limits>
#include <type_traits>
#include <vector>

#include "numeric/format.h"
#include "numeric/kernel_types.h"
#include "numeric/number.h"
#include "numeric/rounded.h"
#include "probes/texel_grid.h"
#include "raster/texture.h"

namespace etalon {

inline constexpr double kSmallestFloatTerm = 0x1p-50;
inline constexpr double kFluxScale = 0x1p-3;

// The limits of flux.glsl for a number type; only float has a floor.
template <class T>
struct TermLimits {
    static constexpr double smallest = 0;
    static double largest() { return std::numeric_limits<double>::max(); }
};
template <>
struct TermLimits<float> {
    static constexpr double smallest = kSmallestFloatTerm;
    static double largest() { return std::numeric_limits<float>::max(); }
};
template <int N>
struct TermLimits<Lanes<float, N>> : TermLimits<float> {};
template <Format F, class D>
struct TermLimits<Rounded<F, D>> {
    static constexpr double smallest = 0;
    static double largest() { return largestFinite(F); }
};
template <class D>
struct TermLimits<Emulated<D>> {
    static constexpr double smallest = 0;
    static double largest() { return emulatedFormat.largest; }
};
template <class D>
struct TermLimits<Narrow<D>> : TermLimits<Emulated<double>> {};

// One row of texels of a probe: directions in the world, weights, radiance. All are `padded` long, a multiple
// of kTexelGroup; what lies behind the width is black and weighs nothing.
inline constexpr int kTexelGroup = 16;
struct TexelRow {
    int width = 0, padded = 0;
    std::array<std::vector<double>, 3> direction;
    std::vector<double> weight;  // the solid angle times kFluxScale
    std::array<std::vector<float>, 3> radiance;
};

// The radiance of a row of a checked probe; blind texels are black. Directions and weights stay empty.
TexelRow readRadiance(const Probe& probe, int layer, int y);
// Directions in the probe's frame, as TexelGrid has them.
void readDirections(const TexelGrid& grid, int layer, int y, TexelRow& row);
// Turns them into the world.
void turnDirections(const glm::dmat3& rotation, TexelRow& row);
// Weights, and black where a texel shows no direction.
void readWeights(const TexelGrid& grid, int layer, int y, TexelRow& row);

}  // namespace etalon
