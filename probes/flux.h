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
#include "numeric/number_lanes.h"
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

// How numbers of the arithmetic T are kept between steps of a sum, exactly: one scalar per lane.
template <class T>
using StoredTerm = std::conditional_t<NumberTraits<T>::lanes == 1, T, TexelStorage<T>>;

// The numbers kept from `from` on, one per lane.
template <class T>
T loadTerms(const StoredTerm<T>* from) {
    if constexpr (NumberTraits<T>::lanes == 1)
        return *from;
    else if constexpr (requires { T::ofRepresentable(T::load(from)); })
        return T::load(from);
    else if constexpr (requires(T t) { T::ofRepresentable(t.v); })
        return T::ofRepresentable(decltype(T::v)::load(from));
    else
        return T::load(from);
}
// One number in each lane.
template <class T>
T broadcastTerm(const StoredTerm<T>& value) {
    if constexpr (NumberTraits<T>::lanes == 1)
        return value;
    else if constexpr (requires(T t) { T::ofRepresentable(t.v); })
        return T::ofRepresentable(decltype(T::v)(value));
    else
        return T(static_cast<double>(value));
}
template <class T>
void storeTerms(const T& value, StoredTerm<T>* to) {
    if constexpr (NumberTraits<T>::lanes == 1)
        *to = value;
    else
        TexelFetch<T>::store(value, to, NumberTraits<T>::lanes);
}
// Floats or doubles rounded once to T, one per lane; register by register where TexelFetch would go lane by
// lane.
template <class T, class Stored>
T loadRounded(const Stored* from) {
    constexpr int kWidth = NumberTraits<T>::lanes;
    if constexpr (kWidth == 1)
        return T(static_cast<double>(*from));
    else if constexpr (std::is_same_v<T, Lanes<Stored, kWidth>>)
        return T::load(from);
    else if constexpr (std::is_same_v<T, Lanes<float, kWidth>>)
        return joinLanes(convertLanes<float>(Lanes<double, kWidth / 2>::load(from)),
                         convertLanes<float>(Lanes<double, kWidth / 2>::load(from + kWidth / 2)));
    else if constexpr (std::is_same_v<T, Narrow<Lanes<Stored, kWidth>>>)
        return T(Lanes<Stored, kWidth>::load(from));
    else
        return T(convertLanes<double>(Lanes<Stored, kWidth>::load(from)));
}

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
