// The number types that fragments and texels are computed in, and how passes over them are reached. A family
// of passes is a struct of functions, `XPasses`, with
//   template <class T> XPasses xPassesOver();       in <library>/x_passes_over.h
// which the sources that etalon_arithmetic_sources() makes instantiate, once per arithmetic (and level).
#pragma once

#include "numeric/check.h"
#include "numeric/lanes.h"
#include "numeric/rounded.h"
#include "raster/profile.h"

namespace etalon {

// The number type of an arithmetic in the lanes of the level that is compiled; truth:
// raster/fragment_truth.h.
template <FragmentArithmetic A>
struct FragmentNumber;
template <>
struct FragmentNumber<FragmentArithmetic::fp64> {
    using Type = Native<double>;
};
template <>
struct FragmentNumber<FragmentArithmetic::fp32> {
    using Type = Native<float>;
};
template <>
struct FragmentNumber<FragmentArithmetic::fp32Flush> {
    using Type = Rounded<kFp32Flush, Native<double>>;
};
template <>
struct FragmentNumber<FragmentArithmetic::fp32Nv40> {
    using Type = Rounded<kFp32Nv40, Native<double>>;
};
template <>
struct FragmentNumber<FragmentArithmetic::fp16> {
    using Type = Rounded<kFp16, Native<double>>;
};
template <>
struct FragmentNumber<FragmentArithmetic::fp16Nv40> {
    using Type = Rounded<kFp16Nv40, Native<double>>;
};
template <>
struct FragmentNumber<FragmentArithmetic::bf16> {
    using Type = Rounded<kBf16, Native<double>>;
};
template <>
struct FragmentNumber<FragmentArithmetic::fp24R300> {
    using Type = Rounded<kFp24R300, Native<double>>;
};

}  // namespace etalon

// Expands X(arithmetic, ...) for each arithmetic with lanes that has a number type of its own: truth has no
// lanes, and what is assumed of NV40 has the types of fp32Flush and fp16.
#define ETALON_FOR_EACH_LANE_ARITHMETIC(X, ...) \
    X(fp64, __VA_ARGS__)                        \
    X(fp32, __VA_ARGS__)                        \
    X(fp32Flush, __VA_ARGS__) X(fp16, __VA_ARGS__) X(bf16, __VA_ARGS__) X(fp24R300, __VA_ARGS__)

// Declares what the made sources define. Stands in namespace etalon.
#define ETALON_DECLARE_ARITHMETICS(Passes, function) \
    ETALON_FOR_EACH_LANE_ARITHMETIC(ETALON_DECLARE_ARITHMETIC, Passes, function) Passes function##_truth();
#define ETALON_DECLARE_ARITHMETIC(name, Passes, function) Passes function##_##name();

// Defines `Passes function_inLanes(FragmentArithmetic)`: those of a level, for its table of passes.
#define ETALON_PASSES_IN_LANES(Passes, function)                                            \
    Passes function##_inLanes(FragmentArithmetic arithmetic) {                              \
        static_assert(std::is_same_v<FragmentNumber<FragmentArithmetic::fp32Nv40>::Type,    \
                                     FragmentNumber<FragmentArithmetic::fp32Flush>::Type>); \
        static_assert(std::is_same_v<FragmentNumber<FragmentArithmetic::fp16Nv40>::Type,    \
                                     FragmentNumber<FragmentArithmetic::fp16>::Type>);      \
        switch (arithmetic) {                                                               \
            ETALON_FOR_EACH_LANE_ARITHMETIC(ETALON_ARITHMETIC_CASE, function)               \
            case FragmentArithmetic::fp32Nv40:                                              \
                return function##_fp32Flush();                                              \
            case FragmentArithmetic::fp16Nv40:                                              \
                return function##_fp16();                                                   \
            case FragmentArithmetic::truth:                                                 \
                break;                                                                      \
        }                                                                                   \
        ETALON_CHECK(false, "arithmetic {}", static_cast<int>(arithmetic));                 \
        __builtin_unreachable();                                                            \
    }
#define ETALON_ARITHMETIC_CASE(name, function) \
    case FragmentArithmetic::name:             \
        return function##_##name();
