// Elementary functions from + - * /, comparisons and the bits of numbers: the same bits on every machine, compiler and
// number of lanes. Code that computes calls these and never those of <cmath>.
#pragma once

#include <algorithm>
#include <concepts>
#include <cstdint>
#include <cstring>

#include "numeric/format.h"
#include "numeric/kernel_types.h"
#include "numeric/lanes.h"
#include "numeric/rounded.h"

namespace etalon {

// atan2Of(y, x): the angle of the vector (x, y) in radians, in [-pi, pi].
//   Zeros have no sign: atan2Of(0, x) is 0 for x >= 0, also for x = 0, and pi for x < 0, whichever zero it
//   is. Infinities as in C: pi/2 for (inf, finite), +-pi for (finite, -inf), pi/4 for (inf, inf), and so on.
//   NaN if an argument is NaN.
// powOf(x, y): x to the power y, for x >= 0; -0 is taken as 0.
//   powOf(x, 0) = 1 for every x >= 0; powOf(0, y) is 0 for y > 0 and infinity for y < 0; powOf(inf, y) is
//   infinity for y > 0 and 0 for y < 0; powOf(x, +-inf) is the limit, and 1 for x = 1. Overflow gives
//   infinity. NaN if x < 0 or an argument is NaN.
// Both for float, double, Emulated, Rounded<F, D>, Lanes of float and double, and, with numeric/truth_elementary.h,
// Truth.
//
// Small numbers: arguments and results below the smallest normal number of the type in magnitude (float
// 2^-126, double 2^-1022) are taken as 0, so that no mode of flushing subnormals changes a bit. Rounded<F, D>
// has the smallest positive number of F in that place. In double, atan2Of is also 0 where the exponent of y
// is more than 900 below that of x > 0.
//
// Errors: in double kAtan2ErrorUlp and kPowErrorUlp. In float kFloatErrorUlp: it is computed over sums of two floats, so
// that processors without double have it. In other formats the result of a computation in double with a relative error
// below 2^-43 is rounded once: kOtherErrorUlp with nearest-even. A format that roundsAsFloat has the bits of float.
template <class N>
N atan2Of(N y, N x) {
    return ElementaryFunctions<N>::atan2Of(y, x);
}
template <class N>
N powOf(N x, N y) {
    return ElementaryFunctions<N>::powOf(x, y);
}

// Sine and cosine of an angle in radians, |angle_rad| <= kMaxAngle (PreconditionError otherwise, also for
// NaN). sinOf(-x) is -sinOf(x), cosOf(-x) is cosOf(x). Errors: kSinErrorUlp, kCosErrorUlp. Kernel texts have
// them for every number type: NaN beyond kMaxAngle there; in float and Rounded<F, D> the result in double is
// rounded once.
double sinOf(double angle_rad);
double cosOf(double angle_rad);

// e^x. Infinity for x > 709.79; 0 where the result is below 2^-1022 (x < -708.39); NaN for NaN. Error:
// kExpErrorUlp.
double expOf(double x);

inline constexpr double kMaxAngle = 0x1p20;

// Largest errors, in units in the last place of the type at the true result. The tests check them against
// MPFR.
inline constexpr double kAtan2ErrorUlp = 0.70;
inline constexpr double kPowErrorUlp = 0.70;
inline constexpr double kFloatErrorUlp = 0.51;
inline constexpr double kOtherErrorUlp = 0.500001;
inline constexpr double kSinErrorUlp = 0.85;
inline constexpr double kCosErrorUlp = 0.85;
inline constexpr double kExpErrorUlp = 0.65;

// The kernel texts written over `wide`, for D = double or Lanes<double, N>.
template <class D>
struct WideTexts {
    using T = D;
#include "numeric/kernel_scope.inc"
    using wide = D;
    using Bits = DoubleBits<D>;

    static wide wideFromBits(uint32_t high, uint32_t low) {
        return wide(std::bit_cast<double>(static_cast<uint64_t>(high) << 32 | low));
    }
    // The exponent e of a = m 2^e, 1 <= m < 2, as a whole number: for normal a > 0. For zero and subnormals
    // it is -1023, for infinity 1024.
    static wide exponentOf(wide a) {
        return Bits::from((Bits::of(a) >> kFractionBits) | kWholeNumberBits) - wide(kWholeNumberOffset);
    }
    // The significand m of the same.
    static wide significandOf(wide a) { return Bits::from((Bits::of(a) & kFractionMask) | kOneBits); }
    // 2^k exactly, for a whole number k in [-1022, 1023].
    static wide powerOfTwo(wide k) {
        return Bits::from(Bits::of(k + wide(kWholeNumberOffset)) << kFractionBits);
    }

#include "numeric/kernels/wide.glsl"
// The texts that need it.
#include "numeric/kernels/atan2.glsl"
#include "numeric/kernels/pow.glsl"
#include "numeric/kernels/sine.glsl"

  private:
    static constexpr int kFractionBits = 52;
    static constexpr int64_t kFractionMask = (int64_t{1} << kFractionBits) - 1;
    static constexpr int64_t kOneBits = 0x3FF0000000000000;
    // A whole number k in [0, 2^52) stands in the low bits of 2^52 + k. The exponent field of a double holds
    // e + 1023.
    static constexpr int64_t kWholeNumberBits = 0x4330000000000000;
    static constexpr double kWholeNumberOffset = 0x1p52 + 1023.0;
};

// The kernel texts over pairs of floats, for T = float or Lanes<float, N>.
template <class T>
struct FloatTexts {
#include "numeric/kernel_scope.inc"

    static integer bitsOf(real a) { return __builtin_bit_cast(integer, a); }
    static real realFromBits(integer bits) { return __builtin_bit_cast(real, bits); }
// The entry of a list of 16 or 32 numbers at each lane's index.
#define table16(index, ...)                                  \
    [](integer at) {                                         \
        static constexpr float kEntries[16] = {__VA_ARGS__}; \
        return entriesOf(kEntries, at);                      \
    }(index)
#define table32(index, ...)                                  \
    [](integer at) {                                         \
        static constexpr float kEntries[32] = {__VA_ARGS__}; \
        return entriesOf(kEntries, at);                      \
    }(index)
#include "numeric/kernels/pair.glsl"
// The texts that need it.
#include "numeric/kernels/pair_atan2.glsl"
#include "numeric/kernels/pair_pow.glsl"
#include "numeric/kernels/pair_sine.glsl"
#undef table16
#undef table32
};

// f(a, b) per lane, through one register of doubles at a time; f takes Lanes<double, M> and returns them.
template <class S, int N, class F>
[[gnu::always_inline]] inline Lanes<S, N> byRegisters(Lanes<S, N> a, Lanes<S, N> b, F&& f) {
    if constexpr (N <= kNativeLanes<double>)
        return convertLanes<S>(f(convertLanes<double>(a), convertLanes<double>(b)));
    else
        return joinLanes(byRegisters(lowerLanes(a), lowerLanes(b), f),
                         byRegisters(upperLanes(a), upperLanes(b), f));
}

// atan2Of and powOf in double for a result format with the given smallest exponent; `extended` as in the
// texts.
inline double atan2InDouble(double y, double x, double lowest, bool extended) {
    return WideTexts<double>{}.atan2Wide(y, x, lowest, extended);
}
inline double powInDouble(double x, double y, double lowest, bool extended) {
    return WideTexts<double>{}.powWide(x, y, lowest, extended);
}
template <class S, int N>
Lanes<S, N> atan2InDouble(Lanes<S, N> y, Lanes<S, N> x, double lowest, bool extended) {
    return byRegisters(y, x, [=](auto a, auto b) {
        return WideTexts<decltype(a)>{}.atan2Wide(a, b, decltype(a)(lowest), extended);
    });
}
// For lanes of which one is special. Rarely called: kept out of the code of loops.
template <class S, int N>
[[gnu::noinline]] Lanes<S, N> anyPowInDouble(Lanes<S, N> x, Lanes<S, N> y, double lowest, bool extended) {
    return byRegisters(x, y, [=](auto a, auto b) {
        return WideTexts<decltype(a)>{}.powWide(a, b, decltype(a)(lowest), extended);
    });
}
// True if powOfFraction (numeric/kernels/pow.glsl) may replace powWide in every lane.
template <class S, int N>
bool areFractionPowers(Lanes<S, N> x, Lanes<S, N> y, double lowest) {
    using L = Lanes<S, N>;
    const double least = std::max(WideTexts<double>::powerOfTwo(lowest), 0x1p-100);
    return !anyOf(!(x >= L(0.0) && x <= L(1.0) && y >= L(least) && y <= L(0x1p70)));
}
template <class S, int N>
Lanes<S, N> powInDouble(Lanes<S, N> x, Lanes<S, N> y, double lowest, bool extended) {
    if (!areFractionPowers(x, y, lowest)) return anyPowInDouble(x, y, lowest, extended);
    return byRegisters(x, y, [=](auto a, auto b) {
        return WideTexts<decltype(a)>{}.powOfFraction(a, b, decltype(a)(lowest), extended);
    });
}

// log2 and 2^p in double for results that are rounded to a format of at most kMaxSignificandBits bits with exponents
// inside +-1000 (numeric/kernels/pow.glsl: domains and bounds); relative errors at most kLog2InDoubleError and
// kExp2InDoubleError.
inline constexpr double kLog2InDoubleError = 0x1p-47;
inline constexpr double kExp2InDoubleError = 0x1p-45;
template <class D>
D log2InDouble(D x) {
    if constexpr (std::is_same_v<D, double>)
        return WideTexts<double>{}.log2Wide(x);
    else
        return byRegisters(x, x, [](auto a, auto) { return WideTexts<decltype(a)>{}.log2Wide(a); });
}
template <class D>
D exp2InDouble(D p) {
    if constexpr (std::is_same_v<D, double>)
        return WideTexts<double>{}.exp2Wide(p);
    else
        return byRegisters(p, p, [](auto a, auto) { return WideTexts<decltype(a)>{}.exp2Wide(a); });
}

template <class D>
D sinInDouble(D angle_rad, double lowest) {
    if constexpr (std::is_same_v<D, double>)
        return WideTexts<double>{}.sinWide(angle_rad, lowest);
    else
        return byRegisters(angle_rad, angle_rad, [=](auto a, auto) {
            return WideTexts<decltype(a)>{}.sinWide(a, decltype(a)(lowest));
        });
}
template <class D>
D cosInDouble(D angle_rad, double lowest) {
    if constexpr (std::is_same_v<D, double>)
        return WideTexts<double>{}.cosWide(angle_rad, lowest);
    else
        return byRegisters(angle_rad, angle_rad, [=](auto a, auto) {
            return WideTexts<decltype(a)>{}.cosWide(a, decltype(a)(lowest));
        });
}

// Exponent of the smallest normal double.
inline constexpr double kLowestExponent = -1022.0;

// For lanes of which one is special. Rarely called: kept out of the code of loops.
template <int N>
[[gnu::noinline]] Lanes<float, N> anyPower(Lanes<float, N> x, Lanes<float, N> y) {
    return FloatTexts<Lanes<float, N>>{}.pairPower(x, y);
}

// What the elementary functions are for one number type. A class template, so that class templates that
// include numeric/kernel_scope.inc find it for number types that are declared after them.
template <>
struct ElementaryFunctions<double> {
    static double atan2Of(double y, double x) { return atan2InDouble(y, x, kLowestExponent, true); }
    static double powOf(double x, double y) { return powInDouble(x, y, kLowestExponent, true); }
    static double sinOf(double x) { return sinInDouble(x, kLowestExponent); }
    static double cosOf(double x) { return cosInDouble(x, kLowestExponent); }
};
template <int N>
struct ElementaryFunctions<Lanes<double, N>> {
    using L = Lanes<double, N>;
    static L atan2Of(L y, L x) { return atan2InDouble(y, x, kLowestExponent, true); }
    static L powOf(L x, L y) { return powInDouble(x, y, kLowestExponent, true); }
    static L sinOf(L x) { return sinInDouble(x, kLowestExponent); }
    static L cosOf(L x) { return cosInDouble(x, kLowestExponent); }
};
template <>
struct ElementaryFunctions<float> {
    using Texts = FloatTexts<float>;
    static float atan2Of(float y, float x) { return Texts{}.pairAtan2(y, x); }
    static float powOf(float x, float y) { return Texts{}.pairPower(x, y); }
    static float sinOf(float x) { return Texts{}.pairSine(x); }
    static float cosOf(float x) { return Texts{}.pairCosine(x); }
};
template <int N>
struct ElementaryFunctions<Lanes<float, N>> {
    using L = Lanes<float, N>;
    using Texts = FloatTexts<L>;
    static L atan2Of(L y, L x) { return Texts{}.pairAtan2(y, x); }
    static L powOf(L x, L y) {
        const auto isFraction = x >= L(0.0) && x <= L(1.0) && y >= L(0x1p-126) && y <= L(0x1p70);
        if (anyOf(!isFraction)) return anyPower(x, y);
        return Texts{}.pairPowerOfFraction(x, y);
    }
    static L sinOf(L x) { return Texts{}.pairSine(x); }
    static L cosOf(L x) { return Texts{}.pairCosine(x); }
};
// A function of the numbers a and b of a format that roundsAsFloat, over D = double or lanes of it: that of float,
// ofFloats, but ofDoubles where a subnormal number that the format keeps is an argument or the result, which are 0 in float.
template <class D, class OfFloats, class OfDoubles>
D inFloat(D a, D b, bool keepsSubnormals, OfFloats&& ofFloats, OfDoubles&& ofDoubles) {
    const auto wasFloat = [](D x) {
        if constexpr (std::same_as<D, double>)
            return static_cast<float>(x);
        else
            return convertLanes<float>(x);
    };
    const auto widened = [](auto x) {
        if constexpr (std::same_as<D, double>)
            return static_cast<double>(x);
        else
            return convertLanes<double>(x);
    };
    const D value = widened(ofFloats(wasFloat(a), wasFloat(b)));
    if (!keepsSubnormals) return value;
    const D zero(0.0), smallest(0x1p-126);
    const auto isSubnormal = [&](D x) { return x < smallest && x > -smallest && x != zero; };
    const auto counts = isSubnormal(a) || isSubnormal(b) || (value < smallest && value > -smallest);
    return anyOf(counts) ? select(counts, ofDoubles(a, b), value) : value;
}

template <Format F, class D>
struct ElementaryFunctions<Rounded<F, D>> {
    using R = Rounded<F, D>;
    static constexpr bool kKeeps = F.subnormals == Subnormals::keep;
    static constexpr double kLowest = F.minExponent - (kKeeps ? F.significandBits - 1 : 0);
    static R atan2Of(R y, R x) {
        return of(
            y, x, [](auto a, auto b) { return ElementaryFunctions<decltype(a)>::atan2Of(a, b); },
            [](D a, D b) { return atan2InDouble(a, b, kLowest, false); });
    }
    static R powOf(R x, R y) {
        return of(
            x, y, [](auto a, auto b) { return ElementaryFunctions<decltype(a)>::powOf(a, b); },
            [](D a, D b) { return powInDouble(a, b, kLowest, false); });
    }
    static R sinOf(R x) {
        return of(
            x, x, [](auto a, auto) { return ElementaryFunctions<decltype(a)>::sinOf(a); },
            [](D a, D) { return sinInDouble(a, kLowest); });
    }
    static R cosOf(R x) {
        return of(
            x, x, [](auto a, auto) { return ElementaryFunctions<decltype(a)>::cosOf(a); },
            [](D a, D) { return cosInDouble(a, kLowest); });
    }

  private:
    template <class OfFloats, class OfDoubles>
    static R of(R a, R b, OfFloats&& ofFloats, OfDoubles&& ofDoubles) {
        if constexpr (roundsAsFloat(F))
            return R(inFloat(a.v, b.v, kKeeps, ofFloats, ofDoubles));
        else
            return R(ofDoubles(a.v, b.v));
    }
};

}  // namespace etalon
