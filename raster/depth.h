// Depth formats and bias (rules 6 and 7).
//
// Not here: ranges of depth other than [0, 1] and float depths outside of it, clearing to another depth than the
// farthest, and compression.
#pragma once

#include <cstdint>

#include "numeric/lanes.h"
#include "raster/draw.h"
#include "raster/raster_kernels.h"
#include "raster/render_target.h"
#include "raster/texture_unit.h"

namespace etalon {

// 2^n - 1 of a UNORM format; 0 for the float formats.
inline double depthLevels(DepthFormat format) {
    switch (format) {
        case DepthFormat::d16:
            return 65535.0;
        case DepthFormat::d24:
            return 16777215.0;
        case DepthFormat::d32f:
        case DepthFormat::d64f:
            return 0.0;
    }
    return 0.0;
}

// What a depth is cut to before it is written to D16 by rule 22.
inline constexpr double kDepth16Steps = 0x1p20;

// The integers that are stored for depths z (any finite values; clamped to [0, 1] first), but those of d64f.
template <class S, int N>
[[gnu::always_inline]] inline Lanes<int32_t, N> storedFloatDepth(Lanes<S, N> z) {
    z = RasterKernels<Lanes<S, N>>::clampOf(z, Lanes<S, N>(0.0), Lanes<S, N>(1.0));
    const Lanes<float, N> narrow = convertLanes<float>(z);
    return Lanes<int32_t, N>(reinterpret_cast<typename Lanes<int32_t, N>::Vector>(narrow.v));
}
// UNORM, by rule 22; z in [0, 1]. Not inlined into what is drawn by other rules.
template <int N>
[[gnu::noinline]] void writeUnormDepth(DepthFormat format, const Lanes<float, N>& z,
                                       Lanes<int32_t, N>& stored) {
    using Wide = Lanes<double, N>;
    TextureUnitTexts<Wide> texts;
    const Wide wide = convertLanes<double>(z);
    stored = convertLanes<int32_t>(format == DepthFormat::d16
                                       ? texts.unormCode(wide, Wide(depthLevels(format)), Wide(kDepth16Steps))
                                       : texts.depth24Code(wide));
}
template <class S, int N>
[[gnu::always_inline]] inline Lanes<int32_t, N> storedDepth(DepthFormat format, DepthRounding rounding,
                                                            Lanes<S, N> z) {
    if (format == DepthFormat::d32f) return storedFloatDepth(z);
    z = RasterKernels<Lanes<S, N>>::clampOf(z, Lanes<S, N>(0.0), Lanes<S, N>(1.0));
    const double levels = depthLevels(format);
    if (rounding == DepthRounding::fixedFunction) {
        Lanes<int32_t, N> stored;
        writeUnormDepth(format, convertLanes<float>(z), stored);
        return stored;
    }
    if (rounding == DepthRounding::driver) {
        const Lanes<float, N> product = convertLanes<float>(z) * Lanes<float, N>(levels);
        // Adding and subtracting 1.5 * 2^52 rounds to a whole number, ties to even.
        const Lanes<double, N> toWhole(6755399441055744.0);
        return convertLanes<int32_t>((convertLanes<double>(product) + toWhole) - toWhole);
    }
    RasterKernels<Lanes<S, N>> kernels;
    return convertLanes<int32_t>(kernels.unormDepth(z, Lanes<S, N>(levels)));
}

// The two halves of what d64f stores, for depths z (any finite values; clamped to [0, 1] first).
template <int N>
struct DoubleDepth {
    Lanes<int32_t, N> high, low;
};
template <class S, int N>
DoubleDepth<N> storedDoubleDepth(Lanes<S, N> z) {
    if constexpr (N > kNativeLanes<double>) {
        const auto lower = storedDoubleDepth(lowerLanes(z)), upper = storedDoubleDepth(upperLanes(z));
        return {joinLanes(lower.high, upper.high), joinLanes(lower.low, upper.low)};
    } else {
        using Wide = Lanes<double, N>;
        using Halves = typename Lanes<int32_t, N>::Vector;
        typedef int64_t Bits __attribute__((vector_size(N * sizeof(int64_t))));
        const Wide depth = RasterKernels<Wide>::clampOf(convertLanes<double>(z), Wide(0.0), Wide(1.0));
        const Bits bits = __builtin_bit_cast(Bits, depth.v);
        return {Lanes<int32_t, N>(__builtin_convertvector(bits >> 32, Halves)),
                Lanes<int32_t, N>(__builtin_convertvector(bits, Halves))};
    }
}

// The bias of rule 7 for a triangle, in depth units; 0 for the default DepthBias.
double depthBias(const DepthBias& bias, const RenderTargetFormat& format, const TriangleRecord& record);

}  // namespace etalon
