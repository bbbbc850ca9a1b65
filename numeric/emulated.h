// Emulated<D>: arithmetic in a number format that is a value of the run (numeric/format.h), not of the program,
// over D = double or a register of lanes of double. One type serves every format, a user's own too. Each
// operation gives the exact result rounded once to the format; Emulated of a format has the bits of Rounded of
// it (numeric/rounded.h, which says why double is wide enough), which stays as its oracle.
//
// The format is that of the calling thread (numeric/emulated_format.h). Numbers of two formats must not meet.
//
// Operations are functions, not inlined: a rounding is some twenty instructions, which in line make functions of
// hundreds of kilobytes and are not faster (measured: calls cost 0.95 to 1.15 of inlined code with g++ 12).
#pragma once

#include <concepts>
#include <cstdint>
#include <limits>

#include "numeric/elementary.h"
#include "numeric/emulated_format.h"
#include "numeric/kernel_types.h"
#include "numeric/lanes.h"
#include "numeric/rounded.h"

namespace etalon {

// The operations on one register, D = double or Lanes<double, N>.
template <class D>
struct EmulatedOperations {
    // x rounded once to the format. A sum has the bits of the exact one where the format does not round to
    // nearest even: sumOf.
    [[gnu::noinline, gnu::pure]] static D rounded(D x) { return roundedInline(x); }
    [[gnu::noinline, gnu::pure]] static D add(D a, D b) { return roundedInline(sumOf(a, b)); }
    [[gnu::noinline, gnu::pure]] static D subtract(D a, D b) { return roundedInline(sumOf(a, -b)); }
    [[gnu::noinline, gnu::pure]] static D multiply(D a, D b) { return roundedInline(a * b); }
    [[gnu::noinline, gnu::pure]] static D divide(D a, D b) { return roundedInline(a / b); }

  private:
    using B = DoubleBits<D>;
    static constexpr int64_t kMagnitudeBits = std::numeric_limits<int64_t>::max();
    static constexpr int64_t kExponentBits = int64_t{0x7ff0000000000000};

    static D smaller(D a, D b) { return select(a < b, a, b); }  // b if one is NaN
    static D larger(D a, D b) { return select(a > b, a, b); }   // b if one is NaN

    [[gnu::always_inline]] static D sumOf(D a, D b) {
        switch (emulatedFormat.path) {
            case EmulatedFormat::Path::binary32:
            case EmulatedFormat::Path::nearestEven:
                return a + b;
            case EmulatedFormat::Path::truncated:
                return addTowardZeroInDouble(a, b);
            case EmulatedFormat::Path::general:
                break;
        }
        return generalSumOf(a, b);
    }

    // a + b rounded to odd: where the sum is not exact, the double next to the exact sum with an odd last bit.
    // What rounds it again sees on which side of every number of the format, and of every middle between two,
    // the exact sum lies. The exact error is that of Knuth's TwoSum; it is NaN for sums that are not finite.
    static D generalSumOf(D a, D b) {
        const D sum = a + b, zero(0.0);
        const D partOfB = sum - a;
        const D error = (a - (sum - partOfB)) + (b - partOfB);
        const auto beyond = (sum > zero && error < zero) || (sum < zero && error > zero);
        const auto bits = B::of(sum) + B::minusOneWhere(beyond);
        const auto isInexact = error < zero || error > zero;
        D odd = select(isInexact, B::from(bits | 1), sum);
        // IEEE 754: an exact difference of equal numbers is -0 when rounding down.
        if (emulatedFormat.rounding == Rounding::down)
            odd = select(sum == zero, -select(isPlusZero(a) && isPlusZero(b), -zero, zero), odd);
        return odd;
    }
    static auto isPlusZero(D x) { return D(1.0) / x > D(std::numeric_limits<double>::max()); }

    [[gnu::always_inline]] static D roundedInline(D x) {
        const EmulatedFormat& f = emulatedFormat;
        switch (f.path) {
            case EmulatedFormat::Path::binary32:
                return throughFloat(x);
            case EmulatedFormat::Path::nearestEven:
                return toNearestEven(x);
            case EmulatedFormat::Path::truncated:
                return truncated(x);
            case EmulatedFormat::Path::general:
                break;
        }
        return generallyRounded(x);
    }

    [[gnu::always_inline]] static D throughFloat(D x) {
        const EmulatedFormat& f = emulatedFormat;
        const D r = roundedToFloat(x);
        const auto magnitude = B::of(r) & kMagnitudeBits;
        const D kept = select(B::from(magnitude) < D(f.flushBelow), B::from(B::of(r) & ~kMagnitudeBits), r);
        return select(x == x, kept, D(f.whenNan));
    }
    static double roundedToFloat(double x) { return static_cast<double>(static_cast<float>(x)); }
    template <int N>
    static Lanes<double, N> roundedToFloat(Lanes<double, N> x) {
        return convertLanes<double>(convertLanes<float>(x));
    }

    // As roundRegisterTo (numeric/rounded.h), which explains the steps.
    [[gnu::always_inline]] static D toNearestEven(D x) {
        const EmulatedFormat& f = emulatedFormat;
        const auto sign = B::of(x) & ~kMagnitudeBits;
        const D exact = B::from(B::of(x) & kMagnitudeBits);
        const D magnitude = smaller(D(f.beyond), exact);
        const D shift = larger(D(f.leastNormal), B::from(B::of(magnitude) & kExponentBits)) * D(f.perBinade);
        D r = (magnitude + shift) - shift;
        r = select(r < D(f.flushBelow), D(0.0), r);
        r = select(r > D(f.largest), D(f.whenInfinite), r);
        return select(x == x, B::from(B::of(r) | sign), D(f.whenNan));
    }

    [[gnu::always_inline]] static D truncated(D x) {
        const EmulatedFormat& f = emulatedFormat;
        const auto sign = B::of(x) & ~kMagnitudeBits;
        const D exact = B::from(B::of(x) & kMagnitudeBits);
        D r = B::from(B::of(exact) & f.keptBits);
        r = select(r < D(f.leastNormal), D(0.0), r);
        r = select(r > D(f.largest), D(f.largest), r);
        r = select(exact == D(std::numeric_limits<double>::infinity()), D(f.whenInfinite), r);
        return select(x == x, B::from(B::of(r) | sign), D(f.whenNan));
    }

    static D generallyRounded(D x) {
        const EmulatedFormat& f = emulatedFormat;
        const D zero(0.0);
        const auto sign = B::of(x) & ~kMagnitudeBits;
        const D exact = B::from(B::of(x) & kMagnitudeBits);
        const D magnitude = smaller(D(f.beyond), exact);
        const D binade = larger(D(f.leastNormal), B::from(B::of(magnitude) & kExponentBits));
        const D quantum = binade * D(f.step), shift = binade * D(f.perBinade);
        const D nearest = (magnitude + shift) - shift;
        const D cut = select(nearest > magnitude, nearest - quantum, nearest);
        const D rest = magnitude - cut;  // exact
        D r = cut;
        if (f.rounding == Rounding::nearestAway) {
            r = select(rest + rest >= quantum, cut + quantum, cut);
        } else if (f.rounding != Rounding::towardZero) {
            // Away from zero above zero (up) or below (down).
            const auto isAway = f.rounding == Rounding::up ? x > zero : x < zero;
            r = select(isAway && rest > zero, cut + quantum, cut);
        }
        r = select(r < D(f.flushBelow), zero, r);
        r = select(r > D(f.largest), select(x > zero, D(f.overflow[0]), D(f.overflow[1])), r);
        r = select(exact == D(std::numeric_limits<double>::infinity()), D(f.whenInfinite), r);
        return select(x == x, B::from(B::of(r) | sign), D(f.whenNan));
    }
};

// A number of the format, or one per lane. Trivial like D: a default-constructed value is not initialised.
// -0 and comparisons as in IEEE 754. Needs the default floating-point control word (fp_environment.h).
template <class D = double>
struct Emulated {
    using Operations = EmulatedOperations<D>;

    D v;  // always a number of the format

    Emulated() = default;
    // The value rounded once to the format; the same in each lane. 0 and +-1 are numbers of every format.
    [[gnu::always_inline]] explicit Emulated(double value) {
        if (__builtin_constant_p(value) && (value == 0 || value == 1 || value == -1))
            v = D(value);
        else
            v = D(EmulatedOperations<double>::rounded(value));
    }
    // Each lane rounded once to the format.
    explicit Emulated(D value) requires(!std::same_as<D, double>)
        : v(perRegister([](auto part) { return EmulatedOperations<decltype(part)>::rounded(part); }, value)) {
    }

    // Takes a value that is a number of the format already (in each lane); not checked.
    static Emulated ofRepresentable(D value) {
        Emulated r;
        r.v = value;
        return r;
    }

    friend Emulated operator+(Emulated a, Emulated b) { return ofRepresentable(Operations::add(a.v, b.v)); }
    friend Emulated operator-(Emulated a, Emulated b) {
        return ofRepresentable(Operations::subtract(a.v, b.v));
    }
    friend Emulated operator*(Emulated a, Emulated b) {
        return ofRepresentable(Operations::multiply(a.v, b.v));
    }
    friend Emulated operator/(Emulated a, Emulated b) {
        return ofRepresentable(Operations::divide(a.v, b.v));
    }
    friend Emulated operator-(Emulated a) { return ofRepresentable(-a.v); }

    friend auto operator<(Emulated a, Emulated b) { return a.v < b.v; }
    friend auto operator<=(Emulated a, Emulated b) { return a.v <= b.v; }
    friend auto operator>(Emulated a, Emulated b) { return a.v > b.v; }
    friend auto operator>=(Emulated a, Emulated b) { return a.v >= b.v; }
    friend auto operator==(Emulated a, Emulated b) { return a.v == b.v; }
    friend auto operator!=(Emulated a, Emulated b) { return a.v != b.v; }
};

// Per lane: c ? a : b.
inline Emulated<double> select(bool c, Emulated<double> a, Emulated<double> b) { return c ? a : b; }
template <int N>
Emulated<Lanes<double, N>> select(Mask<double, N> c, Emulated<Lanes<double, N>> a,
                                  Emulated<Lanes<double, N>> b) {
    return Emulated<Lanes<double, N>>::ofRepresentable(select(c, a.v, b.v));
}
// The square root rounded once. -0 gives -0; a negative number gives NaN, and +0 where the format has no NaN.
template <class D>
Emulated<D> squareRoot(Emulated<D> a) {
    return Emulated<D>::ofRepresentable(EmulatedOperations<D>::rounded(squareRoot(a.v)));
}
// Largest whole number that is not greater; always a number of the format. -0 stays -0, infinities and NaN stay.
template <class D>
Emulated<D> floorOf(Emulated<D> a) {
    return Emulated<D>::ofRepresentable(floorOf(a.v));
}

template <>
struct NumberTraits<Emulated<double>> {
    static constexpr int lanes = 1;
    using Integer = int32_t;
};
template <int N>
struct NumberTraits<Emulated<Lanes<double, N>>> {
    static constexpr int lanes = N;
    using Integer = Lanes<int32_t, N>;
};

// Truncates; the value must be inside int32.
template <class D>
auto toInteger(Emulated<D> a) {
    return toInteger(a.v);
}
// The integer rounded once to the format.
template <class D>
struct FromInteger<Emulated<D>> {
    static Emulated<D> of(typename NumberTraits<Emulated<D>>::Integer a) {
        return Emulated<D>(FromInteger<D>::of(a));
    }
};

template <class D>
struct KeptFormat<Emulated<D>> {
    EmulatedFormat format = emulatedFormat;
    EmulatedScope enter() const { return EmulatedScope(format); }
};

// Computed in double with a relative error below 2^-43 and rounded once (numeric/elementary.h).
template <class D>
struct ElementaryFunctions<Emulated<D>> {
    using R = Emulated<D>;
    static R atan2Of(R y, R x) { return R(atan2InDouble(y.v, x.v, emulatedFormat.lowestExponent, false)); }
    static R powOf(R x, R y) { return R(powInDouble(x.v, y.v, emulatedFormat.lowestExponent, false)); }
    static R sinOf(R x) { return R(sinInDouble(x.v, emulatedFormat.lowestExponent)); }
    static R cosOf(R x) { return R(cosInDouble(x.v, emulatedFormat.lowestExponent)); }
};

}  // namespace etalon
