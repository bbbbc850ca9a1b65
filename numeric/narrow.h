// Narrow<D>: arithmetic in fp16 and in bf16 over D = float or lanes of float: half the instructions and twice the
// lanes of numeric/emulated.h, and the same bits. Which of the two formats is that of the calling thread
// (numeric/emulated_format.h).
//
// Why a float operation, rounded once more, is right, for p = significandBits (11 or 8), nearest even:
// - 24 >= 2p + 2: rounding to float first does not move a sum, product, quotient or square root of numbers of the
//   format onto the middle between two of them, unless it lies there (numeric/rounded.h has the argument).
// - fp16: its range, subnormals included, lies inside the normal range of float.
// - bf16 has the range of float. Overflow to infinity: what float rounds to infinity is beyond bf16 as well. Below
//   2^-126 float has multiples of 2^-149 and bf16 those of 2^-133, middles at multiples of 2^-134: sums are exact;
//   products have 16 bits, so that those of at least 2^-134 are multiples of 2^-149 and exact, and smaller ones
//   become 0 in both ways (2^-134 itself is a tie that goes to 0); a quotient that is no middle is at least 2^-142
//   away from each.
#pragma once

#include <bit>
#include <concepts>
#include <cstdint>

#include "numeric/elementary.h"
#include "numeric/emulated.h"
#include "numeric/kernel_types.h"
#include "numeric/lanes.h"

namespace etalon {

// The bits of a float, or of each lane, as unsigned integers.
template <class D>
struct FloatBits;
template <>
struct FloatBits<float> {
    using Bits = uint32_t;
    static Bits of(float x) { return std::bit_cast<uint32_t>(x); }
    static float from(Bits b) { return std::bit_cast<float>(b); }
};
template <int N>
struct FloatBits<Lanes<float, N>> {
    typedef uint32_t Bits __attribute__((vector_size(N * sizeof(uint32_t))));
    static Bits of(Lanes<float, N> x) { return __builtin_bit_cast(Bits, x.v); }
    static Lanes<float, N> from(Bits b) {
        return Lanes<float, N>(__builtin_bit_cast(typename Lanes<float, N>::Vector, b));
    }
};

// A number of the format, or one per lane. Trivial like D: a default-constructed value is not initialised.
// -0 and comparisons as in IEEE 754.
template <class D = float>
struct Narrow {
    D v;  // always a number of the format

    Narrow() = default;
    // The value rounded once to the format; the same in each lane.
    [[gnu::always_inline]] explicit Narrow(double value) {
        // Literals of texts are rounded when compiling.
        if (__builtin_constant_p(value))
            v = D(static_cast<float>(emulatedFormat.isBinary16 ? roundTo<kFp16>(value)
                                                               : roundTo<kBf16>(value)));
        else
            v = D(roundedOnce(value));
    }
    // Each lane rounded once to the format.
    explicit Narrow(D value) requires(!std::same_as<D, float>) : v(rounded(value)) {}
    template <int N>
    requires std::same_as<D, Lanes<float, N>>
    explicit Narrow(Lanes<double, N> value) : v(rounded(convertInParts(value))) {}

    // Takes a value that is a number of the format already (in each lane); not checked.
    static Narrow ofRepresentable(D value) {
        Narrow r;
        r.v = value;
        return r;
    }

    // Doubles, or a register of them, cut to 16 bits of significand, and the last one made 1 where that loses something
    // (rounding to odd). 16 >= p + 2: what is cut lies on the same side of every number of the format and of every
    // middle between two as the double does. From 2^-134 on it is a float, or beyond all of them; below, both formats
    // have 0, and so they do for what float makes of it.
    template <class Double>
    [[gnu::always_inline]] static Double cutToOdd(Double x) {
        using Pattern = DoubleBits<Double>;
        constexpr int64_t kCutBits = (int64_t{1} << (52 - 15)) - 1;
        const auto bits = Pattern::of(x);
        // The carry into the last bit that is kept.
        return Pattern::from((bits | ((bits & kCutBits) + kCutBits)) & ~kCutBits);
    }

    // Each lane rounded once to the format.
    [[gnu::always_inline]] static D rounded(D x) {
        const D r = emulatedFormat.isBinary16 ? toBinary16(x) : toBfloat16(x);
        // The one NaN of all formats (kCanonicalNan).
        return select(x == x, r, D(std::bit_cast<float>(uint32_t{0x7fc00000})));
    }

    [[gnu::always_inline]] friend Narrow operator+(Narrow a, Narrow b) {
        return ofRepresentable(rounded(a.v + b.v));
    }
    [[gnu::always_inline]] friend Narrow operator-(Narrow a, Narrow b) {
        return ofRepresentable(rounded(a.v - b.v));
    }
    [[gnu::always_inline]] friend Narrow operator*(Narrow a, Narrow b) {
        return ofRepresentable(rounded(a.v * b.v));
    }
    friend Narrow operator/(Narrow a, Narrow b) { return ofRepresentable(rounded(a.v / b.v)); }
    friend Narrow operator-(Narrow a) { return ofRepresentable(-a.v); }

    friend auto operator<(Narrow a, Narrow b) { return a.v < b.v; }
    friend auto operator<=(Narrow a, Narrow b) { return a.v <= b.v; }
    friend auto operator>(Narrow a, Narrow b) { return a.v > b.v; }
    friend auto operator>=(Narrow a, Narrow b) { return a.v >= b.v; }
    friend auto operator==(Narrow a, Narrow b) { return a.v == b.v; }
    friend auto operator!=(Narrow a, Narrow b) { return a.v != b.v; }

  private:
    using B = FloatBits<D>;
    static constexpr int kLaneCount = sizeof(D) / sizeof(float);

    // NaN stays NaN.
    [[gnu::always_inline]] static D toBinary16(D x) {
        if constexpr (requires { registers::throughBinary16(x.v); }) {
            return D(registers::throughBinary16(x.v));
        } else {
            // As EmulatedOperations::toNearestEven.
            constexpr uint32_t kMagnitudeBits = 0x7fffffff, kExponentBits = 0x7f800000;
            constexpr float kBeyond = 0x1p16f, kLeastNormal = 0x1p-14f, kPerBinade = 0x1p13f,
                            kLargest = 65504.0f;
            const auto sign = B::of(x) & ~kMagnitudeBits;
            const D exact = B::from(B::of(x) & kMagnitudeBits), beyond(kBeyond), least(kLeastNormal);
            const D magnitude = select(exact > beyond, beyond, exact);
            const D ownBinade = B::from(B::of(magnitude) & kExponentBits);
            const D shift = select(ownBinade < least, least, ownBinade) * D(kPerBinade);
            D r = (magnitude + shift) - shift;
            r = select(r > D(kLargest), D(std::numeric_limits<float>::infinity()), r);
            return B::from(B::of(r) | sign);
        }
    }
    // Bit patterns order magnitudes: half of what is cut off is added, a little less where the last bit kept is
    // even; the carry runs into the exponent and up to infinity.
    [[gnu::always_inline]] static D toBfloat16(D x) {
        const auto bits = B::of(x);
        return B::from((bits + 0x7fffu + ((bits >> 16) & 1u)) & 0xffff0000u);
    }
    // The value rounded once to the format.
    [[gnu::noinline]] static float roundedOnce(double x) {
        return Narrow<float>::rounded(static_cast<float>(cutToOdd(x)));
    }
    template <int N>
    [[gnu::always_inline]] static Lanes<float, N> convertInParts(Lanes<double, N> a) {
        if constexpr (N <= kNativeLanes<double>)
            return convertLanes<float>(cutToOdd(a));
        else
            return joinLanes(convertInParts(lowerLanes(a)), convertInParts(upperLanes(a)));
    }
};

// Per lane: c ? a : b.
inline Narrow<float> select(bool c, Narrow<float> a, Narrow<float> b) { return c ? a : b; }
template <int N>
Narrow<Lanes<float, N>> select(Mask<float, N> c, Narrow<Lanes<float, N>> a, Narrow<Lanes<float, N>> b) {
    return Narrow<Lanes<float, N>>::ofRepresentable(select(c, a.v, b.v));
}
// The square root rounded once. -0 gives -0; a negative number gives NaN.
template <class D>
Narrow<D> squareRoot(Narrow<D> a) {
    return Narrow<D>::ofRepresentable(Narrow<D>::rounded(squareRoot(a.v)));
}
// Largest whole number that is not greater; always a number of the format. -0 stays -0, infinities and NaN stay.
template <class D>
Narrow<D> floorOf(Narrow<D> a) {
    return Narrow<D>::ofRepresentable(floorOf(a.v));
}

template <>
struct NumberTraits<Narrow<float>> {
    static constexpr int lanes = 1;
    using Integer = int32_t;
    using Stored = float;
};
template <int N>
struct NumberTraits<Narrow<Lanes<float, N>>> {
    static constexpr int lanes = N;
    using Integer = Lanes<int32_t, N>;
    using Stored = float;
};

// Truncates; the value must be inside int32.
template <class D>
auto toInteger(Narrow<D> a) {
    return toInteger(a.v);
}
// The integer rounded once to the format.
template <class D>
struct FromInteger<Narrow<D>> {
    static Narrow<D> of(typename NumberTraits<Narrow<D>>::Integer a) {
        if constexpr (NumberTraits<Narrow<D>>::lanes == 1)
            return Narrow<D>(static_cast<double>(a));
        else
            return Narrow<D>(convertLanes<double>(a));
    }
};

template <class D>
struct KeptFormat<Narrow<D>> {
    EmulatedFormat format = emulatedFormat;
    EmulatedScope enter() const { return EmulatedScope(format); }
};

// Computed in double with a relative error below 2^-43 and rounded once (numeric/elementary.h).
template <class D>
struct ElementaryFunctions<Narrow<D>> {
    using R = Narrow<D>;
    static R atan2Of(R y, R x) {
        return inDouble(
            y, x, [](auto a, auto b) { return atan2InDouble(a, b, emulatedFormat.lowestExponent, false); });
    }
    static R powOf(R x, R y) {
        if constexpr (!std::same_as<D, float>) {
            R power;
            if (isFractionPower(x.v, y.v, power.v)) return power;
        }
        return inDouble(
            x, y, [](auto a, auto b) { return powInDouble(a, b, emulatedFormat.lowestExponent, false); });
    }
    static R sinOf(R x) {
        return inDouble(x, x, [](auto a, auto) { return sinInDouble(a, emulatedFormat.lowestExponent); });
    }
    static R cosOf(R x) {
        return inDouble(x, x, [](auto a, auto) { return cosInDouble(a, emulatedFormat.lowestExponent); });
    }

  private:
    // x^y in float, where x is in [0, 1] and the float decides every lane: whatever lies as near to it as the power does
    // becomes the same number of the format, so that the double would, too. Else false.
    //   x = 2^e m with m in [sqrt(1/2), sqrt(2)],  log2 m = 2/ln(2) atanh(s),  s = (m - 1) / (m + 1),
    //   p = e y + y log2 m,  x^y = 2^whole e^z,  z = ln(2) (p - whole).
    // With u = 2^-24: m - 1, m + 1, e y and e y - whole are exact, y log2 m is within 5.1 u and the series of e^z within
    // 2.3 u of themselves; what the series leave out is below u / 10. Together 3.5 |p| u + 4.5 u.
    template <int N>
    [[gnu::noinline]] static bool isFractionPower(Lanes<float, N> x, Lanes<float, N> y,
                                                  Lanes<float, N>& power) {
        using L = Lanes<float, N>;
        using B = FloatBits<L>;
        using Whole = Lanes<int32_t, N>;
        constexpr float kPerExponent = 0x1p-22f, kAtLeast = 0x1.8p-22f;
        constexpr double kLeastScale = -100;  // binades of float that results may lie in
        const L zero(0.0), one(1.0), lowest(emulatedFormat.lowestExponent), least = lowest - L(2.0);
        const auto isZero = x == zero;
        // No subnormals of float.
        const auto isFraction = isZero || (x >= L(0x1p-126) && x <= one);
        if (anyOf(!(isFraction && y >= L(0x1p-100) && y <= L(0x1p70)))) return false;

        constexpr int32_t kRootOfHalf = 0x3f3504f3, kFractionMask = 0x7fffff, kFractionBits = 23, kBias = 127;
        const auto fromRoot = (typename Whole::Vector)B::of(select(isZero, one, x)) - kRootOfHalf;
        const L e = convertLanes<float>(Whole(fromRoot >> kFractionBits));
        const L m = B::from((typename B::Bits)((fromRoot & kFractionMask) + kRootOfHalf));
        const L s = (m - one) / (m + one), s2 = s * s;
        L sum(1.0 / 9.0);
        for (const double term : {1.0 / 7.0, 1.0 / 5.0, 1.0 / 3.0}) sum = L(term) + s2 * sum;
        const L log2m = (s + (s * s2) * sum) * L(2.8853900817779268);  // 2 / ln 2

        // Below 2^lowest the power is 0.
        const L high = e * y, low = y * log2m, p = high + low;
        const auto isNothing = isZero || p <= least;
        const L whole = floorOf(select(isNothing, zero, p) + L(0.5));
        const L z = select(isNothing, zero, (high - whole) + low) * L(0.69314718055994531);  // ln 2
        L series(1.0 / 5040.0);
        for (const double term : {1.0 / 720.0, 1.0 / 120.0, 1.0 / 24.0, 1.0 / 6.0, 1.0 / 2.0, 1.0})
            series = L(term) + z * series;
        const auto isTooSmall = whole < L(kLeastScale);
        const auto exponent = toInteger(select(isTooSmall, zero, whole)).v + kBias;
        const L value = (one + z * series) * B::from((typename B::Bits)(exponent << kFractionBits));
        const L error = value * (select(isNothing, zero, -p) * L(kPerExponent) + L(kAtLeast));

        const L lowestNumber(powerOfTwo(static_cast<int>(emulatedFormat.lowestExponent)));
        const auto numberOf = [&](const L& v) { return select(v < lowestNumber, zero, R::rounded(v)); };
        const L number = numberOf(value - error);
        if (anyOf(!(isNothing || (number == numberOf(value + error) && !isTooSmall)))) return false;
        power = select(isNothing, zero, number);
        return true;
    }

    template <class F>
    static R inDouble(R a, R b, F&& f) {
        const auto cut = [&](auto x, auto y) { return R::cutToOdd(f(x, y)); };
        if constexpr (std::same_as<D, float>)
            return R::ofRepresentable(
                R::rounded(static_cast<float>(cut(static_cast<double>(a.v), static_cast<double>(b.v)))));
        else
            return R::ofRepresentable(R::rounded(byRegisters(a.v, b.v, cut)));
    }
};

}  // namespace etalon
