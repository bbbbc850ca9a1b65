// The largest errors of sums over directions, by arithmetic.
#pragma once

#include "numeric/arithmetic.h"

namespace etalon {

// Relative. To what, and for which radiance, stands with the sums:
//   irradiance: irradianceAt() (probes/irradiance.h); three times what was measured
//   harmonic: projectHarmonics(), evaluateHarmonics() (probes/spherical_harmonics.h)
//   meanOfLights: irradianceOfLights() (probes/light_irradiance.h)
struct ProbeErrors {
    double irradiance, harmonic, meanOfLights;
};

// By arithmetic; fp24 of R300 truncates and is always too dark. Formats that no test measures get a generous
// multiple of bf16's errors, in proportion to the distance of their numbers.
constexpr ProbeErrors probeErrors(const Arithmetic& arithmetic) {
    constexpr ProbeErrors kOfFp32 = {5e-7, 1e-6, 1e-7}, kOfBf16 = {4e-2, 3e-2, 5e-3};
    switch (arithmetic.type()) {
        case NumberType::truth:
        case NumberType::fp64:
            return {1e-14, 1e-14, 1e-15};
        case NumberType::fp32:
            return kOfFp32;
        case NumberType::narrow:
        case NumberType::emulated:
            break;
    }
    const Format& format = *arithmetic.format;
    if (format == kFp24R300) return {6e-4, 4e-4, 2e-4};
    if (format.rounding == Rounding::nearestEven && format.significandBits == kFp32.significandBits)
        return kOfFp32;
    if (format.rounding == Rounding::nearestEven && format.significandBits == kFp16.significandBits)
        return {8e-3, 4e-3, 1e-3};
    if (format == kBf16) return kOfBf16;
    const double scale = 8 * epsilonOf(format) / epsilonOf(kBf16);
    return {scale * kOfBf16.irradiance, scale * kOfBf16.harmonic, scale * kOfBf16.meanOfLights};
}

}  // namespace etalon
