// Descriptions of floating-point number formats, and the named ones that arithmetic profiles are made of.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <string_view>

namespace etalon {

// How an exact result between two neighbouring numbers of a format becomes one of them.
enum class Rounding {
    nearestEven,  // the nearer one; halfway, the one with the even significand
    towardZero,   // the one of smaller magnitude (truncation)
    nearestAway,  // the nearer one; halfway, the one of larger magnitude
    up,           // the one that is not smaller
    down,         // the one that is not larger; an exact difference of equal numbers is -0
    stochastic,  // drawn: the one of larger magnitude with the probability of the exact result's place between the
                 // two (numeric/emulated_format.h says how)
};

// What happens to results below the smallest normal number.
enum class Subnormals {
    keep,   // gradual underflow as in IEEE 754
    flush,  // rounded as with `keep`, then replaced by a zero of the same sign unless normal. Hardware that
            // flushes differs in the last step below the smallest normal: x86 decides after rounding with an
            // unbounded exponent, AArch64 before rounding. The choice here is a third one: the kept result,
            // flushed.
};

// What happens to results beyond the largest finite number.
enum class Overflow {
    infinity,  // as in IEEE 754: infinity where the rounding leads there (nearestEven, nearestAway; stochastic where
               // it draws so; up above zero, down below), else the largest finite number; operations on
               // infinities, division by zero and NaN as in IEEE 754
    saturate,  // the format has neither infinities nor NaN: every result that would be infinite is the
               // largest finite number with its sign, every result that would be NaN is +0
};

// How quotients and square roots are made.
enum class Division {
    exact,  // the exact quotient or root rounded once
    reciprocal,  // a / b is a times 1 / b, and the root of a is 1 / (1 / sqrt a), each of the two steps rounded once:
    // hardware with instructions for reciprocals only, as R300's fragment programs (root: [MesaR300])
};

// How powOf (numeric/elementary.h) is made.
enum class Power {
    exact,  // the power rounded once, or that of float (kFloatErrorUlp) where a format roundsAsFloat
    exp2log2,  // 2^(y log2 x), each of the three steps rounded once: hardware with instructions for log2 and exp2
    // only [MesaR300]. What the steps give stands: 0^0 is NaN where the format has it, else 1, and the
    // error grows with |y log2 x|
};

// A binary floating-point format with a sign bit: the numbers +-m * 2^e with 1 <= m < 2, m a multiple of
// 2^(1 - significandBits), minExponent <= e <= maxExponent; zeros of both signs; with Subnormals::keep also
// the multiples of 2^(minExponent - significandBits + 1) below 2^minExponent; with Overflow::infinity also
// both infinities and one NaN; and how its operations are made. Usable as a template argument.
struct Format {
    int significandBits;  // with the leading one
    int minExponent;      // of the smallest normal number
    int maxExponent;      // of the largest finite number
    Rounding rounding;
    Subnormals subnormals;
    Overflow overflow;
    Division division = Division::exact;
    Power power = Power::exact;
    uint64_t seed = 0;  // of Rounding::stochastic

    friend constexpr bool operator==(const Format&, const Format&) = default;
};

// 2^exponent, for exponents in [-1022, 1023].
constexpr double powerOfTwo(int exponent) {
    constexpr int kDoubleBias = 1023, kDoubleFractionBits = 52;  // IEEE 754 binary64
    return std::bit_cast<double>(static_cast<int64_t>(exponent + kDoubleBias) << kDoubleFractionBits);
}

constexpr double largestFinite(Format f) {
    return (2.0 - powerOfTwo(1 - f.significandBits)) * powerOfTwo(f.maxExponent);
}
constexpr double smallestNormal(Format f) { return powerOfTwo(f.minExponent); }
// The smallest number above zero: subnormal where the format keeps those.
constexpr double smallestPositive(Format f) {
    return f.subnormals == Subnormals::keep ? powerOfTwo(f.minExponent - f.significandBits + 1)
                                            : smallestNormal(f);
}
// The distance from 1 to the next larger number. A result in the normal range is off by at most half of it
// (nearestEven, nearestAway), or by less than all of it (the others), relative to the exact result.
constexpr double epsilonOf(Format f) { return powerOfTwo(1 - f.significandBits); }

// Largest significand and exponents for which arithmetic through double is exact; rounded.h derives the first. The
// second keeps every exact product, quotient and rounding constant well inside the range of double.
inline constexpr int kMaxSignificandBits = 24;
inline constexpr int kMaxFormatExponent = 400;

// True if operations that round to the format are those of the processor's float, subnormals apart.
constexpr bool roundsAsFloat(Format f) {
    return f.significandBits == 24 && f.minExponent == -126 && f.maxExponent == 127 &&
           f.rounding == Rounding::nearestEven && f.overflow == Overflow::infinity;
}

// True if the format can be emulated (numeric/emulated.h): 2 to 24 significand bits, exponents within +-400, 1 inside the
// normal range, and every number below the first whole-number binade rounds down to a finite number (floorOf
// is exact).
constexpr bool isSupported(Format f) {
    return f.significandBits >= 2 && f.significandBits <= kMaxSignificandBits &&
           f.minExponent >= -kMaxFormatExponent && f.minExponent <= 0 &&
           f.maxExponent <= kMaxFormatExponent && f.maxExponent >= f.significandBits - 1;
}

// The NaN that every operation in a format returns, so that its bits do not depend on the machine (0/0 has a
// sign on x86 and none on AArch64).
inline constexpr double kCanonicalNan = std::bit_cast<double>(int64_t{0x7ff8000000000000});

// IEEE 754 binary32: `float` of every CPU that this project builds for. All of it is documented.
inline constexpr Format kFp32{24, -126, 127, Rounding::nearestEven, Subnormals::keep, Overflow::infinity};

// binary32 as Direct3D 11 asks for it. Documented (D3D11.3 functional specification, floating-point rules):
// add, subtract and multiply within 0.5 ULP, subnormals flushed to a zero that keeps its sign, infinities and
// NaN. Assumed: ties to even, and correctly rounded division and square root where the specification allows
// more error.
inline constexpr Format kFp32Flush{
    24, -126, 127, Rounding::nearestEven, Subnormals::flush, Overflow::infinity};

// binary32 that truncates: IEEE 754 roundTowardZero. No profile uses it as documented hardware; it shows what
// the rounding direction alone does to an image.
inline constexpr Format kFp32TowardZero{
    24, -126, 127, Rounding::towardZero, Subnormals::keep, Overflow::infinity};

// The fp32 of NV40 fragment programs. Documented: 1 sign, 8 exponent and 23 fraction bits. Assumed, because
// no source states them: rounding to nearest even, subnormals flushed, IEEE infinities and NaN.
inline constexpr Format kFp32Nv40{
    24, -126, 127, Rounding::nearestEven, Subnormals::flush, Overflow::infinity};

// IEEE 754 binary16. All of it is documented.
inline constexpr Format kFp16{11, -14, 15, Rounding::nearestEven, Subnormals::keep, Overflow::infinity};

// binary16 that truncates, the result of a Direct3D 11 narrowing conversion. Documented: toward zero when a
// float is narrowed (D3D11.3 functional specification). Assumed: finite values beyond 65504 become 65504, as
// IEEE 754 roundTowardZero has it.
inline constexpr Format kFp16TowardZero{
    11, -14, 15, Rounding::towardZero, Subnormals::keep, Overflow::infinity};

// The fp16 ("half") of NV40 fragment programs. Documented: 1 sign, 5 exponent and 10 fraction bits. The
// rounding direction is not documented: nearest even is assumed, compare with kFp16TowardZero. Also assumed:
// subnormals kept, IEEE infinities and NaN.
inline constexpr Format kFp16Nv40{11, -14, 15, Rounding::nearestEven, Subnormals::keep, Overflow::infinity};

// bfloat16: binary32 with 8 significand bits. Documented: the layout. Assumed: an arithmetic that rounds each
// result to nearest even and keeps subnormals; real units accumulate in binary32 and often flush.
inline constexpr Format kBf16{8, -126, 127, Rounding::nearestEven, Subnormals::keep, Overflow::infinity};

// The 24-bit float of R300 to R400 fragment programs: 1 sign, 7 exponent and 16 fraction bits. Documented:
// the layout. From a single source: truncation, no NaN, no infinities, no subnormals; so all 127 non-zero
// exponent codes are numbers, exponents -62 to 64. Assumed: a zero keeps its sign; 0/0 is +0. The hardware
// divides as reciprocal times multiply and makes powers of log2 and exp2 [MesaR300]; here both are exact and rounded
// once. A profile of a user's own takes division = "reciprocal" and power = "exp2log2" (docs/profiles.md).
inline constexpr Format kFp24R300{17, -62, 64, Rounding::towardZero, Subnormals::flush, Overflow::saturate};

struct NamedFormat {
    std::string_view name;
    Format format;
};

// Every format above under the name that options and reports use.
inline constexpr std::array kNamedFormats{
    NamedFormat{"fp32", kFp32},
    NamedFormat{"fp32-flush", kFp32Flush},
    NamedFormat{"fp32-toward-zero", kFp32TowardZero},
    NamedFormat{"fp32-nv40", kFp32Nv40},
    NamedFormat{"fp16", kFp16},
    NamedFormat{"fp16-toward-zero", kFp16TowardZero},
    NamedFormat{"fp16-nv40", kFp16Nv40},
    NamedFormat{"bf16", kBf16},
    NamedFormat{"fp24-r300", kFp24R300},
};
constexpr const auto& namedFormats() { return kNamedFormats; }

}  // namespace etalon
