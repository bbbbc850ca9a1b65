// Rounded<F, D>: arithmetic in the number format F, emulated over double (D = double) or over lanes of double
// (D = Lanes<double, N>). Each operation gives the exact result rounded once to F. Lane i of a result has the
// bits that the scalar instance gives.
//
// Why computing in double and rounding again is right, for p = F.significandBits <= 24 (double has 53 bits):
// - Range: isSupported(F) keeps exact sums, products and quotients of non-zero numbers of F away from the
//   overflow and the subnormals of double, so double errs only by its own rounding.
// - Products have 2p <= 48 bits and are exact in double.
// - A sum of numbers of F below F's smallest normal, or that cancels into it, is a multiple of F's smallest
//   subnormal of at most p bits, and exact in double.
// - Nearest-even: rounding to double first can only harm if it moves a value onto a midpoint m between two
//   numbers of F, and m has at most p + 1 bits, also where F is subnormal. A quotient a/b = m(1 + d) with d
//   != 0 has |a - mb| of at least one unit of a product of 2p + 1 bits, so |d| >= 2^-(2p+1) > 2^-53. The
//   square root is the same with a - m^2 and 2p + 2 bits. For sums 53 >= 2p + 2 suffices (Figueroa, "When is
//   double rounding innocuous?", 1995).
// - Toward zero: rounding to double first can only harm if it moves a value up onto a number m of F.
//   Quotients and square roots stay away from m by the same argument. Sums do not: 1 - 2^-100 becomes 1. So
//   sums are first truncated in double: TwoSum gives the exact error of the sum, and where the sum was
//   rounded away from zero it is moved back by one step. Truncation followed by truncation is truncation.
#pragma once

#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>

#include "numeric/format.h"
#include "numeric/kernel_types.h"
#include "numeric/lanes.h"

namespace etalon {

// The bits of a double, or of each lane, as signed integers that allow & | + with each other and with
// int64_t.
template <class D>
struct DoubleBits;
template <>
struct DoubleBits<double> {
    using Bits = int64_t;
    static Bits of(double x) { return std::bit_cast<int64_t>(x); }
    static double from(Bits b) { return std::bit_cast<double>(b); }
    // -1 where the condition holds, else 0.
    static Bits minusOneWhere(bool c) { return -static_cast<int64_t>(c); }
};
template <int N>
struct DoubleBits<Lanes<double, N>> {
    using Bits = typename Mask<double, N>::Vector;
    static Bits of(Lanes<double, N> x) { return __builtin_bit_cast(Bits, x.v); }
    static Lanes<double, N> from(Bits b) {
        return Lanes<double, N>(__builtin_bit_cast(typename Lanes<double, N>::Vector, b));
    }
    static Bits minusOneWhere(Mask<double, N> c) { return c.m; }
};

// f(x...) for x of one type D, double or Lanes<double, N>. Lanes that fill several vector registers are
// handed to f one register at a time: g++ 12 turns selections over wider vectors into code per lane, 3 times
// slower.
template <class Function, class D, class... Others>
D perRegister(Function&& f, D a, Others... others) {
    constexpr int kPart = kNativeLanes<double>;
    if constexpr (NumberTraits<D>::lanes <= kPart) {
        return f(a, others...);
    } else {
        using Part = Lanes<double, kPart>;
        const auto part = [](const D& whole, size_t offset) {
            Part p;
            std::memcpy(&p.v, reinterpret_cast<const char*>(&whole.v) + offset, sizeof(p.v));
            return p;
        };
        D result;
        for (size_t offset = 0; offset < sizeof(a.v); offset += sizeof(typename Part::Vector)) {
            const Part r = f(part(a, offset), part(others, offset)...);
            std::memcpy(reinterpret_cast<char*>(&result.v) + offset, &r.v, sizeof(r.v));
        }
        return result;
    }
}

// True if Rounded has the format.
constexpr bool hasRounded(Format f) {
    return isSupported(f) && (f.rounding == Rounding::nearestEven || f.rounding == Rounding::towardZero) &&
           f.division == Division::exact && f.power == Power::exact;
}

// roundTo for D = double or at most one register of lanes.
template <Format F, class D>
D roundRegisterTo(D x) {
    static_assert(hasRounded(F));
    using B = DoubleBits<D>;
    constexpr bool kTowardZero = F.rounding == Rounding::towardZero;
    constexpr bool kSaturates = F.overflow == Overflow::saturate;
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    constexpr int64_t kMagnitudeBits = std::numeric_limits<int64_t>::max();
    constexpr int64_t kExponentBits = int64_t{0x7ff0000000000000};
    constexpr int kDoubleFractionBits = 52;

    const auto sign = B::of(x) & ~kMagnitudeBits;
    const D exact = B::from(B::of(x) & kMagnitudeBits);

    // Everything from here on rounds as the first power of two beyond F does. NaN stays NaN.
    const D beyond(powerOfTwo(F.maxExponent + 1));
    const D magnitude = select(exact > beyond, beyond, exact);

    // The quantum is the distance of neighbouring numbers of F at this magnitude. Adding 2^52 quanta leaves
    // a sum whose last bit is one quantum: the addition rounds to it, ties to even; the subtraction is exact.
    const D leastNormal(smallestNormal(F));
    const D ownBinade = B::from(B::of(magnitude) & kExponentBits);
    const D binade = select(ownBinade < leastNormal, leastNormal, ownBinade);
    const D shift = binade * D(powerOfTwo(kDoubleFractionBits + 1 - F.significandBits));
    D r = (magnitude + shift) - shift;
    if constexpr (kTowardZero) r = select(r > magnitude, r - binade * D(epsilonOf(F)), r);

    if constexpr (F.subnormals == Subnormals::flush) r = select(r < leastNormal, D(0.0), r);
    const D largest(largestFinite(F));
    r = select(r > largest, kTowardZero || kSaturates ? largest : D(kInfinity), r);
    if constexpr (kTowardZero && !kSaturates) r = select(exact == D(kInfinity), exact, r);

    const D signedResult = B::from(B::of(r) | sign);
    return select(x == x, signedResult, D(kSaturates ? 0.0 : kCanonicalNan));
}

// x rounded once to the format F, per lane and without branches. Any double is allowed. Signs of zeros are
// kept. NaN becomes kCanonicalNan, and +0 where F has no NaN; beyond the largest finite number see Overflow;
// below the smallest normal one see Subnormals. Infinities stay where F has them, also with
// Rounding::towardZero.
template <Format F, class D>
D roundTo(D x) {
    return perRegister([](auto part) { return roundRegisterTo<F>(part); }, x);
}

// a + b truncated to double, for sums whose exact error is a double (no overflow): Knuth's TwoSum, then one
// step toward zero where the rounded sum is beyond the exact one. NaN and infinite sums are returned
// unchanged.
template <class D>
D addTowardZeroInDouble(D a, D b) {
    using B = DoubleBits<D>;
    const D sum = a + b;
    const D partOfB = sum - a;
    const D error = (a - (sum - partOfB)) + (b - partOfB);
    const D zero(0.0);
    const auto beyond = (sum > zero && error < zero) || (sum < zero && error > zero);
    // The bit pattern of a double orders magnitudes: one less is the next number toward zero, for both signs.
    return B::from(B::of(sum) + B::minusOneWhere(beyond));
}

// A number of the format F, or one per lane. Trivial like D: a default-constructed value is not initialised.
// -0 and comparisons as in IEEE 754: a comparison with NaN is false, but for != which is true.
// Needs the default floating-point control word (fp_environment.h) and no contraction into FMA.
template <Format F, class D = double>
struct Rounded {
    static_assert(hasRounded(F));
    static constexpr Format kFormat = F;

    D v;  // always a number of F

    Rounded() = default;
    // The value rounded once to F; the same in each lane.
    explicit Rounded(double value) : v(roundTo<F>(D(value))) {}
    // Each lane rounded once to F.
    explicit Rounded(D value) requires(!std::same_as<D, double>) : v(roundTo<F>(value)) {}

    // Takes a value that is a number of F already (in each lane); not checked.
    static Rounded ofRepresentable(D value) {
        Rounded r;
        r.v = value;
        return r;
    }

    friend Rounded operator+(Rounded a, Rounded b) {
        return rounded(a, b, [](auto x, auto y) {
            if constexpr (F.rounding == Rounding::towardZero)
                return addTowardZeroInDouble(x, y);
            else
                return x + y;
        });
    }
    friend Rounded operator-(Rounded a, Rounded b) { return a + -b; }
    friend Rounded operator*(Rounded a, Rounded b) {
        return rounded(a, b, [](auto x, auto y) { return x * y; });
    }
    friend Rounded operator/(Rounded a, Rounded b) {
        return rounded(a, b, [](auto x, auto y) { return x / y; });
    }
    friend Rounded operator-(Rounded a) { return ofRepresentable(-a.v); }

    friend auto operator<(Rounded a, Rounded b) { return a.v < b.v; }
    friend auto operator<=(Rounded a, Rounded b) { return a.v <= b.v; }
    friend auto operator>(Rounded a, Rounded b) { return a.v > b.v; }
    friend auto operator>=(Rounded a, Rounded b) { return a.v >= b.v; }
    friend auto operator==(Rounded a, Rounded b) { return a.v == b.v; }
    friend auto operator!=(Rounded a, Rounded b) { return a.v != b.v; }

  private:
    template <class Operation>
    static Rounded rounded(Rounded a, Rounded b, Operation operation) {
        const auto once = [operation](auto x, auto y) { return roundRegisterTo<F>(operation(x, y)); };
        return ofRepresentable(perRegister(once, a.v, b.v));
    }
};

// Per lane: c ? a : b.
template <Format F>
Rounded<F, double> select(bool c, Rounded<F, double> a, Rounded<F, double> b) {
    return c ? a : b;
}
template <Format F, int N>
Rounded<F, Lanes<double, N>> select(Mask<double, N> c, Rounded<F, Lanes<double, N>> a,
                                    Rounded<F, Lanes<double, N>> b) {
    return Rounded<F, Lanes<double, N>>::ofRepresentable(select(c, a.v, b.v));
}

// The square root rounded once. -0 gives -0; a negative number gives NaN, and +0 where F has no NaN.
template <Format F, class D>
Rounded<F, D> squareRoot(Rounded<F, D> a) {
    return Rounded<F, D>::ofRepresentable(roundTo<F>(squareRoot(a.v)));
}

// Largest whole number that is not greater; always a number of F. -0 stays -0, infinities and NaN stay.
template <Format F, class D>
Rounded<F, D> floorOf(Rounded<F, D> a) {
    return Rounded<F, D>::ofRepresentable(floorOf(a.v));
}

template <Format F>
struct NumberTraits<Rounded<F, double>> {
    static constexpr int lanes = 1;
    using Integer = int32_t;
    using Stored = double;
};
template <Format F, int N>
struct NumberTraits<Rounded<F, Lanes<double, N>>> {
    static constexpr int lanes = N;
    using Integer = Lanes<int32_t, N>;
    using Stored = double;
};

// Truncates; the value must be inside int32.
template <Format F, class D>
auto toInteger(Rounded<F, D> a) {
    return toInteger(a.v);
}
// The integer rounded once to F.
template <Format F, class D>
struct FromInteger<Rounded<F, D>> {
    static Rounded<F, D> of(typename NumberTraits<Rounded<F, D>>::Integer a) {
        return Rounded<F, D>(FromInteger<D>::of(a));
    }
};

}  // namespace etalon
