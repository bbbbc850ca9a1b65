#include "numeric/elementary.h"

#include "numeric/check.h"

namespace etalon {
namespace {

// pi/2 as a sum: three parts of 33 bits, whose products with a whole number below 2^20 are exact, and the
// rest.
constexpr double kHalfPi1 = 0x1.921fb544p+0;
constexpr double kHalfPi2 = 0x1.0b4611a6p-34;
constexpr double kHalfPi3 = 0x1.3198a2ep-69;
constexpr double kHalfPi4 = 0x1.b839a252049c1p-104;
constexpr double kTwoOverPi = 0x1.45f306dc9c883p-1;

// ln 2 as a sum: 42 bits, whose product with an exponent is exact, and the rest.
constexpr double kLn2High = 0x1.62e42fefa38p-1;
constexpr double kLn2Low = 0x1.ef35793c7673p-45;
constexpr double kLog2E = 0x1.71547652b82fep+0;

// An exact or nearly exact value as a sum of two numbers.
struct Pair {
    double high, low;
};

// a - b and its rounding error, exactly. [Knuth1998, sec. 4.2.2, Theorem B]
Pair twoDifference(double a, double b) {
    const double d = a - b;
    const double minusB = d - a;
    return {d, (a - (d - minusB)) + (-b - minusB)};
}

// |angle| = quadrant pi/2 + remainder, |remainder| <= pi/4 and a little. [Cody1980, sec. 8.2]
// No double is nearer to a multiple of pi/2 than 2^-62 but 0 [Muller2016, ch. 11]; the parts of pi/2 leave
// out less than 2^-157, times 2^20. Where the first differences cancel they are exact.
struct ReducedAngle {
    int quadrant;  // modulo 4
    Pair remainder;
};

ReducedAngle reduceAngle(double angle_rad) {
    ETALON_CHECK(angle_rad <= kMaxAngle && angle_rad >= -kMaxAngle, "angle = {}", angle_rad);
    const double magnitude = angle_rad < 0.0 ? -angle_rad : angle_rad;
    const double n = floorOf(magnitude * kTwoOverPi + 0.5);
    const Pair first = twoDifference(magnitude - n * kHalfPi1, n * kHalfPi2);
    const Pair second = twoDifference(first.high, n * kHalfPi3);
    const double small = (first.low + second.low) - n * kHalfPi4;
    const double high = second.high + small;
    const double low = (second.high - high) + small;
    return {static_cast<int>(n - 4.0 * floorOf(n * 0.25)), {high, low}};
}

// Taylor series of the sine of a sum, |sum| <= pi/4 and a little: the first term left out is below 2^-63.
double sineOfSum(Pair x) {
    const double x2 = x.high * x.high;
    double s = 1.0 / 355687428096000.0;  // 1 / 17!
    s = 1.0 / 1307674368000.0 - x2 * s;  // 1 / 15!
    s = 1.0 / 6227020800.0 - x2 * s;     // 1 / 13!
    s = 1.0 / 39916800.0 - x2 * s;       // 1 / 11!
    s = 1.0 / 362880.0 - x2 * s;         // 1 / 9!
    s = 1.0 / 5040.0 - x2 * s;           // 1 / 7!
    s = 1.0 / 120.0 - x2 * s;            // 1 / 5!
    s = 1.0 / 6.0 - x2 * s;              // 1 / 3!
    return x.high + (x.low * (1.0 - 0.5 * x2) - (x.high * x2) * s);
}

// The same for the cosine: the first term left out is below 2^-67.
double cosineOfSum(Pair x) {
    const double x2 = x.high * x.high;
    const double x2Low = WideTexts<double>{}.productError(x.high, x.high, x2);
    double s = 1.0 / 6402373705728000.0;  // 1 / 18!
    s = 1.0 / 20922789888000.0 - x2 * s;  // 1 / 16!
    s = 1.0 / 87178291200.0 - x2 * s;     // 1 / 14!
    s = 1.0 / 479001600.0 - x2 * s;       // 1 / 12!
    s = 1.0 / 3628800.0 - x2 * s;         // 1 / 10!
    s = 1.0 / 40320.0 - x2 * s;           // 1 / 8!
    s = 1.0 / 720.0 - x2 * s;             // 1 / 6!
    s = 1.0 / 24.0 - x2 * s;              // 1 / 4!
    const double high = 1.0 - 0.5 * x2;
    const double low = (1.0 - high) - 0.5 * x2;
    return high + (low + ((x2 * x2) * s - (0.5 * x2Low + x.high * x.low)));
}

}  // namespace

double sinOf(double angle_rad) {
    const ReducedAngle a = reduceAngle(angle_rad);
    const double s = a.quadrant % 2 == 0 ? sineOfSum(a.remainder) : cosineOfSum(a.remainder);
    return (a.quadrant < 2) == (angle_rad >= 0.0) ? s : -s;
}

double cosOf(double angle_rad) {
    const ReducedAngle a = reduceAngle(angle_rad);
    const double c = a.quadrant % 2 == 0 ? cosineOfSum(a.remainder) : sineOfSum(a.remainder);
    return a.quadrant == 0 || a.quadrant == 3 ? c : -c;
}

double expOf(double x) {
    constexpr double kBeyond = 800.0;  // of either sign: the result is infinity or 0
    if (x != x) return kCanonicalNan;
    const double bounded = x > kBeyond ? kBeyond : x < -kBeyond ? -kBeyond : x;
    const double n = floorOf(bounded * kLog2E + 0.5);
    const double high = bounded - n * kLn2High;
    const double z = high - n * kLn2Low;
    const double zLow = (high - z) - n * kLn2Low;
    WideTexts<double> texts;
    return texts.joinNumber({texts.exponentialOfSum(z, zLow), n}, kLowestExponent<double>);
}

}  // namespace etalon
