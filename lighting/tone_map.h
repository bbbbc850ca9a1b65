// From linear radiance to 8-bit sRGB. The texts are lighting/kernels/tone_map.glsl.
#pragma once

#include <cstdint>
#include <vector>

#include "numeric/elementary.h"
#include "numeric/kernel_types.h"
#include "numeric/parallel.h"
#include "raster/image.h"
#include "raster/texture.h"

namespace etalon {

// Operators, per channel, on exposed radiance x >= 0; the result is limited to 1.
enum class ToneMap {
    linear = 0,    // x
    reinhard = 1,  // x / (1 + x) [Reinhard2002, Eq. 3], on each channel instead of on luminance
    filmic = 2,    // x (2.51 x + 0.03) / (x (2.43 x + 0.59) + 0.14) [Narkowicz2015], without his factor 0.6
};

// Largest relative error of reinhard and filmic in float, for x that float holds.
inline constexpr double kOperatorFloatError = 0x1p-21;

// The texts over T: encodeSrgb, decodeSrgb, reinhard, filmic, displayLinear, displayByte.
// encodeSrgb and decodeSrgb take [0, 1]; largest errors in float: kSrgbFloatError.
template <class T>
struct ToneMapKernel {
#include "numeric/kernel_scope.inc"
#include "lighting/kernels/tone_map.glsl"
};

// Largest absolute error of encodeSrgb and decodeSrgb in float on [0, 1] against exact arithmetic.
inline constexpr double kSrgbFloatError = 0x1.4p-22;
// encodeSrgb never falls but at the joint of its two pieces, where the standard's own curve falls by 2.9e-8:
// in float by at most this. Bytes never fall.
inline constexpr double kSrgbJointFall = 0x1p-24;

// Exposure is limited to this many stops up or down.
inline constexpr double kMaxExposureStops = 64.0;

// 2^stops, exact for whole stops. |stops| <= kMaxExposureStops.
double exposureScale(double stops);

// See toneMap.
inline constexpr double kToneMapFloatErrorLsb = 0x1p-12;

// Each channel of linear Rec.709 radiance times 2^exposureStops, mapped, encoded as sRGB and quantised:
// floor(255 v + 1/2), each operation rounded in T. NaN and negative values give 0, positive infinity 255.
// In float a byte differs from that of exact arithmetic only where 255 v + 1/2 is within
// kToneMapFloatErrorLsb of a whole number, then by one.
template <class T>
Image<uint8_t> toneMap(const Image<float>& radiance, ToneMap operation, double exposureStops,
                       int threads = 0) {
    constexpr int kWidth = Number<T>::lanes;
    const T exposure(exposureScale(exposureStops));
    Image<uint8_t> bytes(radiance.width(), radiance.height(), radiance.channels());
    const auto rows = static_cast<size_t>(radiance.height()) * static_cast<size_t>(radiance.channels());
    const auto width = static_cast<size_t>(radiance.width());
    parallelFor(rows, threads, [&](size_t r) {
        // Padded to whole groups of lanes.
        std::vector<float> row(radiance.values().begin() + static_cast<std::ptrdiff_t>(r * width),
                               radiance.values().begin() + static_cast<std::ptrdiff_t>((r + 1) * width));
        row.resize((width + kWidth - 1) / kWidth * kWidth);
        uint8_t* to = bytes.values().data() + r * width;
        ToneMapKernel<T> kernel;
        forEachLaneGroup<kWidth>(width, [&](size_t first, int active) {
            const T value = Number<T>::load(row.data() + first);
            const auto byte = kernel.displayByte(value, exposure, static_cast<int>(operation));
            for (int i = 0; i < active; i++) {
                if constexpr (kWidth == 1)
                    to[first] = static_cast<uint8_t>(byte);
                else
                    to[first + static_cast<size_t>(i)] = static_cast<uint8_t>(byte[i]);
            }
        });
    });
    return bytes;
}
struct ToneMapPasses {
    // toneMap
    Image<uint8_t> (*toneMap)(const Image<float>& radiance, ToneMap operation, double exposureStops,
                              int threads);
};

// The same in the default profile: float arithmetic in lanes.
Image<uint8_t> toneMap(const Image<float>& radiance, ToneMap operation, double exposureStops,
                       int threads = 0);

}  // namespace etalon
