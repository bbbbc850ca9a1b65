#include "numeric/elementary.h"

#include "numeric/check.h"

namespace etalon {
namespace {

// ln 2 as a sum: 42 bits, whose product with an exponent is exact, and the rest.
constexpr double kLn2High = 0x1.62e42fefa38p-1;
constexpr double kLn2Low = 0x1.ef35793c7673p-45;
constexpr double kLog2E = 0x1.71547652b82fep+0;

}  // namespace

double sinOf(double angle_rad) {
    ETALON_CHECK(angle_rad <= kMaxAngle && angle_rad >= -kMaxAngle, "angle = {}", angle_rad);
    return ElementaryFunctions<double>::sinOf(angle_rad);
}

double cosOf(double angle_rad) {
    ETALON_CHECK(angle_rad <= kMaxAngle && angle_rad >= -kMaxAngle, "angle = {}", angle_rad);
    return ElementaryFunctions<double>::cosOf(angle_rad);
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
    return texts.joinNumber({texts.exponentialOfSum(z, zLow), n}, kLowestExponent);
}

}  // namespace etalon
