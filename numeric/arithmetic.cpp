#include "numeric/arithmetic.h"

#include "numeric/text.h"

namespace etalon {
namespace {

const char* roundingName(Rounding rounding) {
    switch (rounding) {
        case Rounding::nearestEven:
            return "nearest-even";
        case Rounding::towardZero:
            return "toward-zero";
        case Rounding::nearestAway:
            return "nearest-away";
        case Rounding::up:
            return "up";
        case Rounding::down:
            return "down";
        case Rounding::stochastic:
            return "stochastic";
    }
    return "?";
}

}  // namespace

std::string arithmeticName(const Arithmetic& arithmetic) {
    switch (arithmetic.type()) {
        case NumberType::fp32:
            return "fp32";
        case NumberType::fp64:
            return "fp64";
        case NumberType::truth:
            return "truth";
        case NumberType::narrow:
        case NumberType::emulated:
            break;
    }
    const Format& f = *arithmetic.format;
    for (const NamedFormat& named : namedFormats())
        if (named.format == f) return std::string(named.name);
    std::string name = formatText("{} bits, exponents {} to {}, {}, subnormals {}, {}", f.significandBits,
                                  f.minExponent, f.maxExponent, roundingName(f.rounding),
                                  f.subnormals == Subnormals::keep ? "kept" : "flushed",
                                  f.overflow == Overflow::infinity ? "infinity" : "saturates");
    if (f.division == Division::reciprocal) name += ", division by reciprocal";
    if (f.power == Power::exp2log2) name += ", power by exp2 and log2";
    if (f.rounding == Rounding::stochastic) name += formatText(", seed {}", f.seed);
    return name;
}

}  // namespace etalon
