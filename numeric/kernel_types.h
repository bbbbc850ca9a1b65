// What a kernel text may use, for every number type it is compiled for: float, double, Lanes<S, N>, Narrow<D>,
// Emulated<D>, Rounded<Format, D> and Truth. The class that includes a kernel text includes "numeric/kernel_scope.inc"
// first. The subset and a worked example stand in docs/kernels.md.
#pragma once

#include <cmath>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <type_traits>
#include <utility>

#include "numeric/lanes.h"

namespace etalon {

// Number of values that a T holds side by side, the integer type that goes with it, the scalar that it is stored
// as. Number types of other headers specialise this; host code uses Number<T> (numeric/number.h).
template <class T>
struct NumberTraits {
    static_assert(std::is_floating_point_v<T>);
    static constexpr int lanes = 1;
    using Integer = int32_t;
    using Stored = T;
};
template <class S, int N>
struct NumberTraits<Lanes<S, N>> {
    static constexpr int lanes = N;
    using Integer = Lanes<int32_t, N>;
    using Stored = S;
};

// The elementary functions for a number type: numeric/elementary.h.
template <class T>
struct ElementaryFunctions;

// Scalar instances of the lane-wise operations.
inline float select(bool c, float a, float b) { return c ? a : b; }
inline double select(bool c, double a, double b) { return c ? a : b; }
inline int32_t select(bool c, int32_t a, int32_t b) { return c ? a : b; }
inline float squareRoot(float a) { return __builtin_sqrtf(a); }
inline double squareRoot(double a) { return __builtin_sqrt(a); }
inline float floorOf(float a) { return __builtin_floorf(a); }
inline double floorOf(double a) { return __builtin_floor(a); }
inline bool anyOf(bool c) { return c; }

// Conversion between a number type and its integers. toInteger truncates; the value must be inside int32.
inline int32_t toInteger(float a) { return static_cast<int32_t>(a); }
inline int32_t toInteger(double a) { return static_cast<int32_t>(a); }
template <class S, int N>
Lanes<int32_t, N> toInteger(Lanes<S, N> a) {
    return convertLanes<int32_t>(a);
}
template <class T>
struct FromInteger {
    static T of(int32_t a) { return static_cast<T>(a); }
};
template <class S, int N>
struct FromInteger<Lanes<S, N>> {
    static Lanes<S, N> of(Lanes<int32_t, N> a) { return convertLanes<S>(a); }
};

// The operations looked up where they are instantiated: kernel classes call these, so that they find the
// operations of number types whose headers were included after them.
namespace lookup {
template <class C, class T>
T selectOf(const C& c, const T& a, const T& b) {
    return select(c, a, b);
}
template <class T>
T squareRootOf(const T& a) {
    return squareRoot(a);
}
template <class T>
T wholeOf(const T& a) {
    return floorOf(a);
}
template <class T>
auto integerOf(const T& a) {
    return toInteger(a);
}
}  // namespace lookup

}  // namespace etalon
