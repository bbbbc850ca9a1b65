// What a texel of a probe adds to sums over directions, in every arithmetic. The text is
// probes/kernels/flux.glsl.
//
// The flux of a texel is its radiance times its solid angle. Sums are made of scaled flux: all of it together is as
// large as leaves room for sums (FluxScale). The scale is a power of two and is taken out again, exactly, where a sum
// leaves its pass. So neither the irradiance nor a coefficient of spherical harmonics overflows, whatever its partial
// sums, a probe that is 2^n times as bright gives 2^n times the light to the bit, and nothing is too dark to count.
// Radiance beyond the largest finite number of the arithmetic, infinities included, counts as that number; NaN stays.
// Texels without a solid angle and those that are not valid count as black.
//
// In fp32 scaled fluxes, cosines, components of directions and values of harmonics below kSmallestFloatTerm in
// magnitude count as 0, so that no intermediate is subnormal: of flux that is 2^-170 of all. Other arithmetics need no
// such floor: the formats below fp32's range flush or keep subnormals by a rule of their own (numeric/format.h).
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
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

// The limits of flux.glsl for a number type; only float has a floor. minExponent: of the smallest normal number.
template <class T>
struct TermLimits {
    static constexpr double smallest = 0;
    static double largest() { return std::numeric_limits<double>::max(); }
    static int minExponent() { return std::numeric_limits<double>::min_exponent - 1; }
};
template <>
struct TermLimits<float> {
    static constexpr double smallest = kSmallestFloatTerm;
    static double largest() { return std::numeric_limits<float>::max(); }
    static int minExponent() { return std::numeric_limits<float>::min_exponent - 1; }
};
template <int N>
struct TermLimits<Lanes<float, N>> : TermLimits<float> {};
template <Format F, class D>
struct TermLimits<Rounded<F, D>> {
    static constexpr double smallest = 0;
    static double largest() { return largestFinite(F); }
    static int minExponent() { return F.minExponent; }
};
template <class D>
struct TermLimits<Emulated<D>> {
    static constexpr double smallest = 0;
    static double largest() { return emulatedFormat.largest; }
    static int minExponent() { return std::ilogb(emulatedFormat.leastNormal); }
};
template <class D>
struct TermLimits<Narrow<D>> : TermLimits<Emulated<double>> {};

// The power of two that a sum of terms is multiplied with, so that it is as large as T holds with room for its terms: the
// exponent for terms whose magnitudes add up to `total`; 0 if that is 0 or not finite. The factor is undone by two
// multiplications with the halves of its inverse, each of them a normal number of T.
template <class T>
int sumExponent(double total) {
    constexpr int kRoom = 4;  // for factors below 2 and 1.5, and roundings
    if (!(total > 0) || !std::isfinite(total)) return 0;
    const int top = std::ilogb(TermLimits<T>::largest()),
              halves = 2 * std::min(top, -TermLimits<T>::minExponent());
    return std::clamp(top - kRoom - std::ilogb(total), -halves, halves);
}
// The same for vectors, by the sum of their largest components.
template <class T>
int sumExponent(const std::vector<glm::dvec3>& terms) {
    double total = 0;
    for (const glm::dvec3& a : terms)
        total += std::max(std::abs(a.x), std::max(std::abs(a.y), std::abs(a.z)));
    return sumExponent<T>(total);
}
template <class T>
struct PowerOfTwoHalves {
    T first, second;
    explicit PowerOfTwoHalves(int exponent)
        : first(std::ldexp(1.0, exponent / 2)), second(std::ldexp(1.0, exponent - exponent / 2)) {}
};

// The solid angles of a checked probe's texels, in the order of layers, rows and columns, and what exponents follow from.
struct TexelWeights {
    std::vector<double> solidAngle_sr;  // 0 where a texel shows no direction
    double largestRadiance = 0;         // magnitude, of texels that count
    double flux = 0;  // sum of the magnitudes of their largest channels, times kFluxHeadroom
    static constexpr double kFluxHeadroom = 0x1p-8;  // infinite radiance counts as the largest number
};
// Radiance beyond `largest` counts as that.
TexelWeights texelWeightsOf(const Probe& probe, const TexelGrid& grid, double largest, int threads);

// The exponents of the powers of two that radiance and solid angles are multiplied with.
struct FluxScale {
    int radiance = 0, weight = 0;
    // A sum of scaled flux without the scale.
    double takenOut(double sum) const { return std::ldexp(sum, -(radiance + weight)); }
};
// So that flux is as sumExponent() has it. The weights take all of it, unless they would overflow, or small ones lose
// digits: then radiance takes the rest.
template <class T>
FluxScale fluxScaleOf(const TexelWeights& weights) {
    constexpr double kSphere_sr = 12.566370614359172;
    constexpr int kSmallTexels = 4;  // 2^-4 of the mean
    if (!(weights.flux > 0)) return {};
    const int top = std::ilogb(TermLimits<T>::largest());
    const int whole = sumExponent<T>(weights.flux) + std::ilogb(TexelWeights::kFluxHeadroom);
    const double mean_sr = kSphere_sr / static_cast<double>(weights.solidAngle_sr.size());
    const int least = TermLimits<T>::minExponent() - std::ilogb(mean_sr) + kSmallTexels;
    FluxScale scale;
    scale.weight = std::min(std::max(whole, least), sumExponent<T>(kSphere_sr));
    scale.radiance = std::clamp(whole - scale.weight, TermLimits<T>::minExponent(),
                                std::min(top - 1 - std::ilogb(weights.largestRadiance), top));
    return scale;
}

// One row of texels of a probe: directions in the world, weights, radiance. All are `padded` long, a multiple
// of kTexelGroup; what lies behind the width is black and weighs nothing.
inline constexpr int kTexelGroup = 16;
struct TexelRow {
    int width = 0, padded = 0;
    std::array<std::vector<double>, 3> direction;
    std::vector<double> weight;  // the scaled solid angle
    std::array<std::vector<float>, 3> radiance;
};

// The radiance of a row of a checked probe; blind texels are black. Directions and weights stay empty.
TexelRow readRadiance(const Probe& probe, int layer, int y);
// Directions in the probe's frame, as TexelGrid has them.
void readDirections(const TexelGrid& grid, int layer, int y, TexelRow& row);
// Turns them into the world.
void turnDirections(const glm::dmat3& rotation, TexelRow& row);
// Of the texels from the given one on: solid angles times 2^exponent, and black where a texel shows no direction.
void readWeights(const TexelWeights& weights, size_t first, int exponent, TexelRow& row);

}  // namespace etalon
