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
// FilterRule replaces steps by what hardware does: 1 to 3 by its fixed-point position, step 5 by its weights of 8 bits,
//   (w00 v00 + w10 v10) + (w01 v01 + w11 v11), inside the hull of the texels that have a weight,
// or by those and its sum (raster/texture_unit.h). They keep what the next paragraph promises, but that the hull of a sum
// of the texture unit may be left by half a unit in the last place of its format.
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

#include <algorithm>
#include <cstdint>
#include <string_view>

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

// What a filter does by the rules of hardware (rule 22).
enum class FilterPosition : uint8_t { rounded, fixedPoint };
enum class FilterWeights : uint8_t { product, bits8 };
enum class FilterSum : uint8_t { arithmetic, fixedFunction };
// What textures hold: numbers as they are, or those of a format, written by rule 22.
enum class TexelFormat : uint8_t { float32, float16, unorm16, unorm8 };
struct FilterRule {
    FilterPosition position = FilterPosition::rounded;
    FilterWeights weights = FilterWeights::product;
    FilterSum sum = FilterSum::arithmetic;
    TexelFormat texels = TexelFormat::float32;

    friend constexpr bool operator==(const FilterRule&, const FilterRule&) = default;
};

struct SamplerSettings {
    Filter filter = Filter::bilinear;
    Wrap wrapX = Wrap::clamp, wrapY = Wrap::clamp;
    int fractionBits = kExactFraction;  // or 0 .. kMaxFractionBits
    FilterRule rule = {};
};

// What a filter's rule lacks; empty: nothing. The hardware's weights are products of fractions of at most 8 bits, its
// position has 8, its sum its weights; what it computes with has 24 significand bits at least.
struct FilterFault {
    std::string_view field, reason;  // of a profile file
};
constexpr FilterFault filterFault(const FilterRule& rule, int fractionBits, int significandBits) {
    constexpr int kBits = 8, kFloatBits = 24;
    if (rule.weights == FilterWeights::bits8 && (fractionBits < 0 || fractionBits > kBits))
        return {"filter_weights", "8-bit needs texture_fraction_bits of at most 8"};
    if (rule.position == FilterPosition::fixedPoint && fractionBits != kBits)
        return {"filter_position", "fixed-point needs texture_fraction_bits = 8"};
    if (rule.sum == FilterSum::fixedFunction && rule.weights != FilterWeights::bits8)
        return {"filter_sum", "fixed-function needs filter_weights = \"8-bit\""};
    if (significandBits >= kFloatBits) return {};
    if (rule.position == FilterPosition::fixedPoint)
        return {"filter_position", "fixed-point needs a fragment arithmetic of at least 24 significand bits"};
    if (rule.sum == FilterSum::fixedFunction)
        return {"filter_sum", "fixed-function needs a fragment arithmetic of at least 24 significand bits"};
    return {};
}

// True if T holds the whole number exactly.
template <class T>
bool holdsInteger(int value) {
    if constexpr (Number<T>::lanes == 1)
        return toInteger(T(static_cast<double>(value))) == value;
    else
        return toInteger(T(static_cast<double>(value)))[0] == value;
}

// The settings as a kernel class that includes sampler.glsl wants them.
template <class Kernel>
typename Kernel::Sampling samplingOfAnySize(const SamplerSettings& s, int width, int height) {
    ETALON_CHECK(s.fractionBits >= kExactFraction && s.fractionBits <= kMaxFractionBits, "{} fraction bits",
                 s.fractionBits);
    ETALON_CHECK(s.rule.weights == FilterWeights::product || (s.fractionBits >= 0 && s.fractionBits <= 8),
                 "{} fraction bits for weights of 8", s.fractionBits);
    ETALON_CHECK(s.rule.position == FilterPosition::rounded ||
                     (s.fractionBits == 8 && std::max(width, height) <= kMaxFixedPointSize),
                 "{}x{} with {} fraction bits in fixed point", width, height, s.fractionBits);
    return {width,
            height,
            static_cast<int>(s.filter),
            static_cast<int>(s.wrapX),
            static_cast<int>(s.wrapY),
            s.fractionBits,
            static_cast<int>(s.rule.position),
            static_cast<int>(s.rule.weights),
            static_cast<int>(s.rule.sum),
            static_cast<int>(s.rule.texels)};
}
// Width and height are exact in the kernel's number type (fp16 holds no 2049).
template <class Kernel>
typename Kernel::Sampling samplingOf(const SamplerSettings& s, int width, int height) {
    using T = typename Kernel::real;
    ETALON_CHECK(width > 0 && height > 0 && holdsInteger<T>(width) && holdsInteger<T>(height), "{}x{}", width,
                 height);
    return samplingOfAnySize<Kernel>(s, width, height);
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
