// Emulated<D>: arithmetic in a number format that is a value of the run (numeric/format.h), not of the program,
// over D = double or a register of lanes of double. One type serves every format, a user's own too. Each
// operation gives the exact result rounded once to the format, but for formats that divide or raise to powers in steps
// (numeric/format.h). Emulated of a format has the bits of Rounded of it, where there is one (numeric/rounded.h, which
// says why double is wide enough); Rounded stays as its oracle.
//
// The format is that of the calling thread (numeric/emulated_format.h). Numbers of two formats must not meet.
//
// Operations are functions, not inlined: a rounding is some twenty instructions, which in line make functions of
// hundreds of kilobytes and are not faster (measured: calls cost 0.95 to 1.15 of inlined code with g++ 12).
#pragma once

#include <concepts>
#include <cstdint>
#include <cstring>
#include <limits>

#include "numeric/elementary.h"
#include "numeric/emulated_format.h"
#include "numeric/kernel_types.h"
#include "numeric/lanes.h"
#include "numeric/random.h"
#include "numeric/rounded.h"

namespace etalon {

// Bit patterns as unsigned numbers, in the shape of D: what the draws of stochastic rounding are computed in.
template <class D>
struct DrawBits;
template <>
struct DrawBits<double> {
    using Unsigned = uint64_t;
    static Unsigned items() { return emulatedItems.keys[0]; }
};
template <int N>
struct DrawBits<Lanes<double, N>> {
    static_assert(N <= kEmulatedItems);
    typedef uint64_t Unsigned __attribute__((vector_size(N * sizeof(uint64_t))));
    static Unsigned items() {
        Unsigned keys;
        std::memcpy(&keys, emulatedItems.keys.data(), sizeof(keys));
        return keys;
    }
};

// The operations on one register, D = double or Lanes<double, N>.
template <class D>
struct EmulatedOperations {
    using Operation = EmulatedOperation;

    [[gnu::noinline, gnu::pure]] static D add(D a, D b) {
        return roundedInline(sumOf(a, b), Operation::sum, a, b);
    }
    [[gnu::noinline, gnu::pure]] static D subtract(D a, D b) {
        return roundedInline(sumOf(a, -b), Operation::sum, a, -b);
    }
    [[gnu::noinline, gnu::pure]] static D multiply(D a, D b) {
        return roundedInline(a * b, Operation::product, a, b);
    }
    [[gnu::noinline, gnu::pure]] static D divide(D a, D b) {
        if (!emulatedFormat.hasPlainDivision) [[unlikely]]
            return otherQuotient(a, b);
        return roundedInline(a / b, Operation::quotient, a, b);
    }
    [[gnu::noinline, gnu::pure]] static D squareRoot(D a) {
        if (!emulatedFormat.hasPlainDivision) [[unlikely]]
            return otherRoot(a);
        return roundedInline(etalon::squareRoot(a), Operation::root, a, D(0.0));
    }
    // x rounded once to the format: a conversion.
    [[gnu::noinline, gnu::pure]] static D rounded(D x) {
        return roundedInline(x, Operation::conversion, x, D(0.0));
    }
    // x, the value in double of an operation on numbers of the format, rounded once.
    [[gnu::noinline, gnu::pure]] static D rounded(D x, Operation operation, D a, D b) {
        return roundedInline(x, operation, a, b);
    }
    // x^y as the exponential of the product with the logarithm, each step rounded once.
    [[gnu::noinline, gnu::pure]] static D powerInSteps(D x, D y) {
        const D logarithm = rounded(log2InDouble(x), Operation::logarithm, x, D(0.0));
        const D exponent = multiply(y, logarithm);
        return rounded(exp2InDouble(exponent), Operation::exponential, exponent, D(0.0));
    }

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

    // The value whose double is `nearest`, and that is larger by something of the sign of `error`, rounded to odd:
    // where it is no double, the one next to it with an odd last bit. What rounds that again sees on which side of every
    // number of the format, of every middle between two and of every bound of a draw the exact value lies: those are
    // doubles with an even last bit. A NaN error is none.
    static D toOdd(D nearest, D error) {
        const D zero(0.0);
        const auto beyond = (nearest > zero && error < zero) || (nearest < zero && error > zero);
        const auto bits = B::of(nearest) + B::minusOneWhere(beyond);
        return select(error < zero || error > zero, B::from(bits | 1), nearest);
    }

    // a + b rounded to odd. The exact error is that of Knuth's TwoSum; it is NaN for sums that are not finite.
    static D generalSumOf(D a, D b) {
        const D sum = a + b, zero(0.0);
        const D partOfB = sum - a;
        const D odd = toOdd(sum, (a - (sum - partOfB)) + (b - partOfB));
        // IEEE 754: an exact difference of equal numbers is -0 when rounding down.
        if (emulatedFormat.rounding == Rounding::down)
            return select(sum == zero, -select(isPlusZero(a) && isPlusZero(b), -zero, zero), odd);
        return odd;
    }
    static auto isPlusZero(D x) { return D(1.0) / x > D(std::numeric_limits<double>::max()); }

    // By reciprocals, or drawn. A quotient and a root in double are on the right side of all numbers of the format and of
    // all middles (numeric/rounded.h), but not of the bounds of draws, which have 25 bits more.
    [[gnu::noinline, gnu::pure]] static D otherQuotient(D a, D b) {
        if (emulatedFormat.division == Division::reciprocal) return multiply(a, reciprocal(b));
        return roundedInline(oddQuotientOf(a, b), Operation::quotient, a, b);
    }
    [[gnu::noinline, gnu::pure]] static D otherRoot(D a) {
        if (emulatedFormat.division == Division::reciprocal) return reciprocal(reciprocalRoot(a));
        const D root = etalon::squareRoot(a), square = root * root;
        const D odd = toOdd(root, (a - square) - WideTexts<D>{}.productError(root, root, square));
        return roundedInline(odd, Operation::root, a, D(0.0));
    }
    // The remainder a - b q is a double, and so exact.
    static D oddQuotientOf(D a, D b) {
        const D q = a / b, product = q * b;
        const D rest = (a - product) - WideTexts<D>{}.productError(q, b, product);
        return toOdd(q, select(b < D(0.0), -rest, rest));
    }

    // 1 / a rounded once.
    [[gnu::noinline, gnu::pure]] static D reciprocal(D a) {
        return roundedInline(oddQuotientOf(D(1.0), a), Operation::reciprocal, a, D(0.0));
    }
    // 1 / sqrt(a) rounded once. Two roundings in double could move it over a middle: one step of Newton's method makes
    // them one, and the sign of what is left says on which side of the double the value is.
    [[gnu::noinline, gnu::pure]] static D reciprocalRoot(D a) {
        const D start = D(1.0) / etalon::squareRoot(a);
        const D root = start + start * (D(0.5) * restOfReciprocalRoot(a, start));
        // Zero and infinity have no rest.
        const D nearest = select(root == root, root, start);
        return roundedInline(toOdd(nearest, restOfReciprocalRoot(a, nearest)), Operation::reciprocalRoot, a,
                             D(0.0));
    }
    // 1 - a r^2 for r near 1 / sqrt(a): the terms of the product that it rounds are below 2^-150.
    static D restOfReciprocalRoot(D a, D r) {
        WideTexts<D> texts;
        const D square = r * r, squareLow = texts.productError(r, r, square);
        const D product = a * square, productLow = texts.productError(a, square, product);
        const D low = a * squareLow, lowest = texts.productError(a, squareLow, low);
        return (((D(1.0) - product) - productLow) - low) - lowest;
    }

    [[gnu::always_inline]] static D roundedInline(D x, Operation operation, D a, D b) {
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
        return f.rounding == Rounding::stochastic ? generallyRounded(x, bound(operation, a, b))
                                                  : generallyRounded(x, D(0.0));
    }

    // The fraction of a quantum beyond which stochastic rounding takes the larger magnitude
    // (numeric/emulated_format.h).
    [[gnu::noinline, gnu::pure]] static D bound(Operation operation, D a, D b) {
        using Bits = DrawBits<D>;
        using Unsigned = typename Bits::Unsigned;
        const uint64_t start = splitMix64(emulatedFormat.seed + static_cast<uint64_t>(operation));
        const Unsigned items = operation == Operation::conversion ? Unsigned{} : Bits::items();
        Unsigned hash = splitMix64(items ^ start);
        hash = splitMix64(hash ^ __builtin_bit_cast(Unsigned, a));
        hash = splitMix64(hash ^ __builtin_bit_cast(Unsigned, b));
        // A whole number below 2^52 stands in the low bits of 2^52 plus it.
        constexpr uint64_t kWholeNumberBits = 0x4330000000000000;
        const D whole = __builtin_bit_cast(D, (hash >> kUndrawnBits) | kWholeNumberBits) - D(0x1p52);
        return (whole + D(0.5)) * D(0x1p-24);
    }
    static constexpr int kUndrawnBits = 64 - 24;

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

    // `bound` is read where the rounding is stochastic.
    [[gnu::noinline, gnu::pure]] static D generallyRounded(D x, D bound) {
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
        } else if (f.rounding == Rounding::stochastic) {
            r = select(rest > bound * quantum, cut + quantum, cut);
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

template <class D>
inline constexpr bool kIsEmulated<Emulated<D>> = true;

// Per lane: c ? a : b.
inline Emulated<double> select(bool c, Emulated<double> a, Emulated<double> b) { return c ? a : b; }
template <int N>
Emulated<Lanes<double, N>> select(Mask<double, N> c, Emulated<Lanes<double, N>> a,
                                  Emulated<Lanes<double, N>> b) {
    return Emulated<Lanes<double, N>>::ofRepresentable(select(c, a.v, b.v));
}
// The square root rounded once, or by reciprocals (Division). -0 gives -0; a negative number gives NaN, and +0 where
// the format has no NaN.
template <class D>
Emulated<D> squareRoot(Emulated<D> a) {
    return Emulated<D>::ofRepresentable(EmulatedOperations<D>::squareRoot(a.v));
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
    using Stored = double;
};
template <int N>
struct NumberTraits<Emulated<Lanes<double, N>>> {
    static constexpr int lanes = N;
    using Integer = Lanes<int32_t, N>;
    using Stored = double;
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

// Computed in double with a relative error below 2^-43 and rounded once, or in float for a format that rounds as float
// (numeric/elementary.h), but for powers in steps (Power).
template <class D>
struct ElementaryFunctions<Emulated<D>> {
    using R = Emulated<D>;
    static R atan2Of(R y, R x) {
        return of(
            EmulatedOperation::angle, y, x,
            [](auto a, auto b) { return ElementaryFunctions<decltype(a)>::atan2Of(a, b); },
            [](D a, D b) { return atan2InDouble(a, b, emulatedFormat.lowestExponent, false); });
    }
    static R powOf(R x, R y) {
        if (emulatedFormat.power == Power::exp2log2)
            return R::ofRepresentable(EmulatedOperations<D>::powerInSteps(x.v, y.v));
        return of(
            EmulatedOperation::power, x, y,
            [](auto a, auto b) { return ElementaryFunctions<decltype(a)>::powOf(a, b); },
            [](D a, D b) { return powInDouble(a, b, emulatedFormat.lowestExponent, false); });
    }
    static R sinOf(R x) {
        return of(
            EmulatedOperation::sine, x, R(0.0),
            [](auto a, auto) { return ElementaryFunctions<decltype(a)>::sinOf(a); },
            [](D a, D) { return sinInDouble(a, emulatedFormat.lowestExponent); });
    }
    static R cosOf(R x) {
        return of(
            EmulatedOperation::cosine, x, R(0.0),
            [](auto a, auto) { return ElementaryFunctions<decltype(a)>::cosOf(a); },
            [](D a, D) { return cosInDouble(a, emulatedFormat.lowestExponent); });
    }

  private:
    template <class OfFloats, class OfDoubles>
    [[gnu::noinline]] static R of(EmulatedOperation operation, R a, R b, OfFloats&& ofFloats,
                                  OfDoubles&& ofDoubles) {
        const D value = emulatedFormat.path == EmulatedFormat::Path::binary32
                            ? inFloat(a.v, b.v, emulatedFormat.flushBelow == 0, ofFloats, ofDoubles)
                            : ofDoubles(a.v, b.v);
        return R::ofRepresentable(EmulatedOperations<D>::rounded(value, operation, a.v, b.v));
    }
};

}  // namespace etalon
