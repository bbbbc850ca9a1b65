// Rule 22: what the fixed-function units of an NVIDIA H100 compute where it is not what the exact rules say, as measured on
// one with driver 580.159.04. The texts are raster/kernels/texture_unit.glsl; each is a rule in whole numbers:
//
//   position  u is cut to b = max(21, ceil(log2 W) + 8) fraction bits, t = floor(u 2^b), as it comes; then it is clamped
//             or its index of texels wrapped. linear: p = floor((256 t W + 2^(b - 1)) / 2^b) - 128 in 1/256 of a texel,
//             texels floor(p / 256) and the next one, fraction p mod 256. nearest: texel floor(t W / 2^b).
//   weights   of fractions x and y in 1/256: w11 = floor((x y + 128) / 256), w10 = x - w11, w01 = y - w11,
//             w00 = 256 - x - y + w11 (raster/kernels/tap_weights.glsl).
//   sum       float texels of p = 24 or 11 significand bits: cut toward zero to p + 4 bits below the largest exponent that
//             has a weight, the exact sum over 256 rounded to p bits, ties away from zero. 16-bit codes c (257 c of 8-bit
//             ones): floor((sum w c + 128) / 256) / 65535.
//   writes    UNORM of n bits and D16: x cut to n + 4 bits, times 2^n - 1 exactly, to nearest, ties down (SNORM: of
//             magnitudes, n - 1 bits). D24: times 2^24 - 1 exactly, to nearest, ties to even, but up where 2^24 x is a
//             whole number and a half and x < 1/16. fp16: toward zero, finite numbers never to infinity.
//
// Not here, and not followed by a profile that asks for these rules: the unit's own cube coordinates, in which positions
// differ from those of rule 9 by up to 1/256 of a texel, and its weights at the corners of cubes (a third of the missing
// texel's weight each, against the mean of rule 9); sRGB; levels of size; what the unit makes of texels that are not
// finite.
#pragma once

#include <array>
#include <glm/vec3.hpp>

#include "numeric/elementary.h"
#include "numeric/number.h"

namespace etalon {

// Widths and heights up to which positions are exact.
inline constexpr int kMaxFixedPointSize = 32768;

// The texts over D = double or a register of doubles.
template <class D>
struct TextureUnitTexts {
    using T = D;
#include "numeric/kernel_scope.inc"
    using wide = D;
    static wide exponentOf(wide a) { return WideTexts<D>::exponentOf(a); }
    static wide powerOfTwo(wide k) { return WideTexts<D>::powerOfTwo(k); }
#include "raster/kernels/texture_unit.glsl"
};

// The weights, over T.
template <class T>
struct TapWeightTexts {
#include "numeric/kernel_scope.inc"
#include "raster/kernels/tap_weights.glsl"
};

// The texts for numbers of any type T: arguments become doubles (those of 192 bits are rounded once), results are rounded
// once to T. Not inlined: the rules that most profiles have stay as short as they are.
template <class T>
class TextureUnit {
  public:
    using Integer = typename NumberTraits<T>::Integer;

    // Of one axis, by the text unitLinear: the texel, and the fraction.
    [[gnu::noinline]] static Integer linear(const T& u, int size, int wrap, T& fraction) {
        std::array<double, kCount> first, part;
        const Doubles from = doublesOf(u);
        for (int i = 0; i < kCount; i += kPart) {
            const auto texel = Texts{}.unitLinear(load(from, i), size, wrap);
            store(texel.first, first, i), store(texel.fraction, part, i);
        }
        fraction = Number<T>::load(part.data());
        return integersOf(first);
    }
    [[gnu::noinline]] static Integer nearest(const T& u, int size, int wrap) {
        Doubles texel;
        const Doubles from = doublesOf(u);
        for (int i = 0; i < kCount; i += kPart)
            store(Texts{}.unitNearest(load(from, i), size, wrap), texel, i);
        return integersOf(texel);
    }
    using vec3 = glm::vec<3, T>;
    // Texels v00, v10, v01, v11 with the weights of the fractions; sum: 0 in T, 1 by the unit.
    [[gnu::noinline]] static T filtered(const std::array<T, 4>& v, const T& fractionX, const T& fractionY,
                                        int sum, int format) {
        TapWeightTexts<T> texts;
        const auto w = texts.tapWeights(fractionX, fractionY);
        if (sum == 0) return texts.weightedSum(v[0], v[1], v[2], v[3], w);
        return weighted(v, {w.w00, w.w10, w.w01, w.w11}, format);
    }
    [[gnu::noinline]] static vec3 filteredRgb(const std::array<vec3, 4>& v, const T& fractionX,
                                              const T& fractionY, int sum, int format) {
        const auto channel = [&](int c) {
            return filtered({v[0][c], v[1][c], v[2][c], v[3][c]}, fractionX, fractionY, sum, format);
        };
        return vec3(channel(0), channel(1), channel(2));
    }
    // By the unit, with weights that are multiples of 1/256.
    [[gnu::noinline]] static T weighted(const std::array<T, 4>& texels, const std::array<T, 4>& weights,
                                        int format) {
        std::array<Doubles, 4> v, w;
        for (size_t k = 0; k < 4; k++) v[k] = doublesOf(texels[k]), w[k] = doublesOf(weights[k]);
        Doubles result;
        for (int i = 0; i < kCount; i += kPart) {
            const auto weight = [&](size_t k) { return load(w[k], i) * Part(256.0); };
            store(Texts{}.unitSum({load(v[0], i), load(v[1], i), load(v[2], i), load(v[3], i), weight(0),
                                   weight(1), weight(2), weight(3)},
                                  format),
                  result, i);
        }
        return Number<T>::load(result.data());
    }
    [[gnu::noinline]] static T written(const T& value, int format) {
        Doubles result;
        const Doubles from = doublesOf(value);
        for (int i = 0; i < kCount; i += kPart) store(Texts{}.writtenTexel(load(from, i), format), result, i);
        return Number<T>::load(result.data());
    }
    [[gnu::noinline]] static std::array<T, 4> writtenTexels(std::array<T, 4> texels, int format) {
        for (T& texel : texels) texel = written(texel, format);
        return texels;
    }
    [[gnu::noinline]] static std::array<vec3, 4> writtenRgbTexels(std::array<vec3, 4> texels, int format) {
        for (vec3& texel : texels)
            for (int c = 0; c < 3; c++) texel[c] = written(texel[c], format);
        return texels;
    }

  private:
    static constexpr int kCount = NumberTraits<T>::lanes;
    static constexpr int kPart = std::min(kCount, kNativeLanes<double>);
    using Part = std::conditional_t<kPart == 1, double, Lanes<double, kPart>>;
    using Texts = TextureUnitTexts<Part>;
    using Doubles = std::array<double, kCount>;

    static Doubles doublesOf(const T& value) {
        Doubles doubles;
        Number<T>::store(value, doubles.data());
        return doubles;
    }
    static Part load(const Doubles& from, int i) { return Number<Part>::load(&from[static_cast<size_t>(i)]); }
    static void store(const Part& value, Doubles& to, int i) {
        Number<Part>::store(value, &to[static_cast<size_t>(i)]);
    }
    static Integer integersOf(const Doubles& from) {
        if constexpr (kCount == 1)
            return static_cast<Integer>(from[0]);
        else
            return Integer::generate(
                [&](int i) { return static_cast<int32_t>(from[static_cast<size_t>(i)]); });
    }
};

}  // namespace etalon
