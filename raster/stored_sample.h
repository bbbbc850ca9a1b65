// Samples of image files, as they are stored, as the floats of images.
#pragma once

#include <bit>
#include <cstdint>

namespace etalon {

// The number of an IEEE half; exact, and NaN keeps its payload.
inline float floatOfHalf(uint16_t half) {
    const uint32_t sign = uint32_t{half & 0x8000u} << 16, exponent = (half >> 10) & 31u,
                   fraction = half & 0x3ffu;
    if (exponent == 31) return std::bit_cast<float>(sign | 0x7f800000u | fraction << 13);
    if (exponent != 0) return std::bit_cast<float>(sign | (exponent + 112) << 23 | fraction << 13);
    const float magnitude = static_cast<float>(fraction) * 0x1p-24f;  // subnormal or zero; exact
    return sign != 0 ? -magnitude : magnitude;
}

// The part of the largest code, rounded once: 0 to 1.
inline float floatOfCode(uint8_t code) { return static_cast<float>(code) / 255.0f; }
inline float floatOfCode(uint16_t code) { return static_cast<float>(code) / 65535.0f; }

}  // namespace etalon
