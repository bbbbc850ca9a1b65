// The largest errors of sums over directions, by arithmetic.
#pragma once

#include "raster/profile.h"

namespace etalon {

// Relative. To what, and for which radiance, stands with the sums:
//   irradiance: irradianceAt() (probes/irradiance.h); three times what was measured
//   harmonic: projectHarmonics(), evaluateHarmonics() (probes/spherical_harmonics.h)
//   meanOfLights: irradianceOfLights() (probes/light_irradiance.h)
struct ProbeErrors {
    double irradiance, harmonic, meanOfLights;
};

constexpr ProbeErrors probeErrors(FragmentArithmetic arithmetic) {
    switch (arithmetic) {
        case FragmentArithmetic::truth:
        case FragmentArithmetic::fp64:
            return {1e-14, 1e-14, 1e-15};
        case FragmentArithmetic::fp32:
        case FragmentArithmetic::fp32Flush:
        case FragmentArithmetic::fp32Nv40:
            return {5e-7, 1e-6, 1e-7};
        case FragmentArithmetic::fp24R300:
            return {6e-4, 4e-4, 2e-4};  // truncation: always too dark
        case FragmentArithmetic::fp16:
        case FragmentArithmetic::fp16Nv40:
            return {8e-3, 4e-3, 1e-3};
        case FragmentArithmetic::bf16:
            return {4e-2, 3e-2, 5e-3};
    }
    return {};
}

}  // namespace etalon
