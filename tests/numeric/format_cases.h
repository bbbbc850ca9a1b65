// Test input for number formats: random numbers of a format, and pairs that sit where arithmetic goes wrong.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string_view>
#include <utility>

#include "numeric/format.h"
#include "numeric/random.h"

#if defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define ETALON_TEST_SANITIZED
#endif
#endif
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define ETALON_TEST_SANITIZED
#endif

namespace etalon::test {

// Cases per operation and format: 4 Mi in an optimised build, 1/32 of that where a sanitizer or -O0 slows
// each case down by an order of magnitude.
#if defined(__OPTIMIZE__) && !defined(ETALON_TEST_SANITIZED)
inline constexpr size_t kCases = size_t{1} << 22;
#else
inline constexpr size_t kCases = size_t{1} << 17;
#endif

// Makes cases for one format. All values are built exactly from integers, never by the code under test.
class FormatCases {
  public:
    FormatCases(Format format, uint64_t seed) : f_(format), random_(seed) {}

    // A pair of numbers of the format, from a mix of kinds: any exponents, close exponents, subnormal or
    // nearly so, near overflow, exact ties, cancellation, products and quotients at the limits, squares,
    // special values.
    std::pair<double, double> pair() {
        const int p = f_.significandBits, lo = f_.minExponent, hi = f_.maxExponent;
        const int ea = random_.integer(lo - p, hi);
        switch (random_.integer(0, 9)) {
            case 0:
                return {number(ea), number(random_.integer(lo - p, hi))};
            case 1:
                return {number(ea), number(ea + random_.integer(-p - 2, p + 2))};
            case 2:
                return {number(lo + random_.integer(-p, 2)), number(lo + random_.integer(-p, 2))};
            case 3:
                return {number(hi - random_.integer(0, 2)), number(hi - random_.integer(0, p + 2))};
            case 4: {  // the sum is a tie, or next to one
                const double a = number(ea);
                return {a, neighbour(sign() * powerOfTwo(clamp(ea - p)), random_.integer(-1, 1))};
            }
            case 5: {  // the difference cancels but for the last bits
                const double a = number(ea);
                return {a, sign() * neighbour(a, random_.integer(-3, 3))};
            }
            case 6:
                return {number(ea), number(lo - ea + random_.integer(-p - 1, 2))};  // tiny products
            case 7:
                return {number(ea), number(random_.integer(0, 1) ? hi - ea + random_.integer(-2, 1)
                                                                 : ea - lo + random_.integer(-2, p + 1))};
            case 8: {  // short significands: products and quotients are exact or ties; squares for the root
                const int bits = random_.integer(1, (p + 2) / 2);
                const double root = static_cast<double>(random_.next() >> (64 - bits) | 1);
                const int even = 2 * random_.integer(lo / 2, std::max(lo / 2, hi / 2 - p));
                const double b = representable(root * powerOfTwo(random_.integer(-p, 2)));
                return {neighbour(representable(root * root * powerOfTwo(even)), random_.integer(-1, 1)), b};
            }
            default:
                return {special(), random_.integer(0, 1) ? special() : number(ea)};
        }
    }

    // A double that need not be a number of the format: on, next to, or halfway between two of them, or any.
    double anyDouble() {
        if (random_.integer(0, 15) == 0) return std::bit_cast<double>(random_.next());
        const int e = random_.integer(f_.minExponent - f_.significandBits - 2, f_.maxExponent + 1);
        const double a = number(e);
        const double quantum = powerOfTwo(quantumExponent(e));
        const double halves = a + quantum * 0.5 * random_.integer(-2, 2);
        switch (random_.integer(0, 3)) {
            case 0:
                return halves;
            case 1:
                return std::nextafter(halves, std::numeric_limits<double>::infinity());
            case 2:
                return std::nextafter(halves, -std::numeric_limits<double>::infinity());
            default:
                return a + quantum * (static_cast<double>(random_.next() >> 11) * powerOfTwo(-53));
        }
    }

  private:
    double sign() { return random_.integer(0, 1) ? 1.0 : -1.0; }
    int clamp(int e) const {
        const int lowest =
            f_.subnormals == Subnormals::keep ? f_.minExponent - f_.significandBits + 1 : f_.minExponent;
        return e < lowest ? lowest : e > f_.maxExponent ? f_.maxExponent : e;
    }
    int quantumExponent(int e) const {
        return (e < f_.minExponent ? f_.minExponent : e) - f_.significandBits + 1;
    }
    // A random number of the format in the binade of 2^e, e clamped to the format.
    double number(int e) {
        e = clamp(e);
        const int quantum = quantumExponent(e);
        const int fractionBits = e - quantum;
        const uint64_t fraction = fractionBits == 0 ? 0 : random_.next() >> (64 - fractionBits);
        return sign() * (static_cast<double>((uint64_t{1} << fractionBits) | fraction) * powerOfTwo(quantum));
    }
    // x, if it is a number of the format, else a number near it: digits that do not fit are cut off.
    double representable(double x) const {
        if (x == 0.0 || !std::isfinite(x)) return x;
        const int e = std::ilogb(x);
        if (e > f_.maxExponent) return std::copysign(largestFinite(f_), x);
        if (std::abs(x) < smallestPositive(f_)) return std::copysign(0.0, x);
        const double quantum = powerOfTwo(quantumExponent(e));
        return std::trunc(x / quantum) * quantum;
    }
    // The number of the format `steps` quanta from x.
    double neighbour(double x, int steps) const {
        if (x == 0.0 || !std::isfinite(x)) return x;
        return representable(x + steps * powerOfTwo(quantumExponent(std::ilogb(x))));
    }
    double special() {
        const double values[] = {0.0,
                                 smallestPositive(f_),
                                 smallestNormal(f_),
                                 neighbour(smallestNormal(f_), -1),
                                 1.0,
                                 1.0 + epsilonOf(f_),
                                 1.0 - 0.5 * epsilonOf(f_),
                                 largestFinite(f_),
                                 std::numeric_limits<double>::infinity(),
                                 std::numeric_limits<double>::quiet_NaN()};
        const int count = f_.overflow == Overflow::infinity ? 10 : 8;
        return sign() * values[random_.integer(0, count - 1)];
    }

    Format f_;
    Random random_;
};

// True if an earlier name in the list stands for the same format.
constexpr bool hasEarlierName(size_t index) {
    for (size_t i = 0; i < index; i++)
        if (kNamedFormats[i].format == kNamedFormats[index].format) return true;
    return false;
}

// Calls body.template operator()<F>(name) for every named format; a format with two names once.
template <class Body>
void forEachNamedFormat(Body&& body) {
    const auto one = [&]<size_t I>() {
        if constexpr (!hasEarlierName(I))
            body.template operator()<kNamedFormats[I].format>(kNamedFormats[I].name);
    };
    [&]<size_t... I>(std::index_sequence<I...>) { (one.template operator()<I>(), ...); }
    (std::make_index_sequence<kNamedFormats.size()>());
}

}  // namespace etalon::test
