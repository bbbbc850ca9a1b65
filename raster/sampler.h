// Sampling of single images: raster rule 8. The texts are raster/kernels/sampler.glsl.
//
// A texture coordinate u spans the image: 0 is the left border of texel 0, 1 the right border of the last
// one, texel centres are at (i + 0.5) / width. v is 0 at the upper border. Steps, each one operation of T:
//  1. u is folded into [0, 1]: clamp; repeat u - floor(u); mirror min(p, 2 - p) with p = u - 2 floor(u / 2).
//     NaN becomes 0. An infinite u becomes its border with clamp, else 0.
//  2. nearest: texel floor(u * width), at most width - 1.
//     bilinear: the position is u * width - 0.5, its floor the texel, the rest the fraction f (exact for
//     positions >= 0).
//  3. With n fraction bits f is rounded half up to a multiple of 2^-n, exactly: floor(f 2^n), plus one if
//     f 2^n - floor(f 2^n) >= 1/2. A fraction of 1 is the next texel with fraction 0.
//  4. The neighbours -1 and width are wrapped: clamp and mirror repeat the border texel, repeat takes the
//     opposite one.
//  5. a + (b - a) f along x on the upper row, then on the lower row, then along y; a itself where f is 0.
//
// So a constant image gives exactly its constant, results never leave the hull of the four texels, texels of
// weight 0 have no influence, and a non-finite texel of another weight gives NaN or infinity. Texels may go
// up to half the largest number of T.
//
// Error in float against exact arithmetic, u in [0, 1], exact fractions; W and D the size and the largest
// difference of neighbouring texels on an axis, V the largest texel magnitude (bilinearFloatErrorBound):
//   |error| <= 2^-23 (W_x D_x + W_y D_y + 5 V)
//
// Not here: levels of size and what chooses them, anisotropic and cubic filters, borders of a colour,
// volumes, sRGB and integer texels, gathers, comparisons (shadows/shadow_map.h has its own).
#pragma once

#include "numeric/check.h"
#include "numeric/kernel_types.h"
#include "raster/texture.h"

namespace etalon {

enum class Filter { nearest = 0, bilinear = 1 };
enum class Wrap { clamp = 0, repeat = 1, mirror = 2 };

// Fractions as exact as the number type.
inline constexpr int kExactFraction = -1;
// The most fraction bits that can be asked for.
inline constexpr int kMaxFractionBits = 16;

struct SamplerSettings {
    Filter filter = Filter::bilinear;
    Wrap wrapX = Wrap::clamp, wrapY = Wrap::clamp;
    int fractionBits = kExactFraction;  // or 0 .. kMaxFractionBits
};

// True if T holds the whole number exactly.
template <class T>
bool holdsInteger(int value) {
    if constexpr (Number<T>::lanes == 1)
        return toInteger(T(static_cast<double>(value))) == value;
    else
        return toInteger(T(static_cast<double>(value)))[0] == value;
}

// The settings as a kernel class that includes sampler.glsl wants them. Width and height are exact in the
// kernel's number type (fp16 holds no 2049).
template <class Kernel>
typename Kernel::Sampling samplingOf(const SamplerSettings& s, int width, int height) {
    using T = typename Kernel::real;
    ETALON_CHECK(width > 0 && height > 0 && holdsInteger<T>(width) && holdsInteger<T>(height), "{}x{}", width,
                 height);
    ETALON_CHECK(s.fractionBits >= kExactFraction && s.fractionBits <= kMaxFractionBits, "{} fraction bits",
                 s.fractionBits);
    return {width,
            height,
            static_cast<int>(s.filter),
            static_cast<int>(s.wrapX),
            static_cast<int>(s.wrapY),
            s.fractionBits};
}

// See above: sizes, largest differences of neighbours along x and y, largest magnitude.
inline double bilinearFloatErrorBound(int width, int height, double stepX, double stepY, double magnitude) {
    return 0x1p-23 * (width * stepX + height * stepY + 5.0 * magnitude);
}

// The texts over T: sampleReal and sampleRgb (texture, layer, u, v, sampling).
template <class T>
struct SamplerKernel {
#include "numeric/kernel_scope.inc"
#include "raster/texture_scope.inc"
#include "raster/kernels/sampler.glsl"
};

}  // namespace etalon
