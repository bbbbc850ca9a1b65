// Separable Gaussian blur. The text is raster/kernels/blur.glsl.
//
// Not here: boxes, recursive filters or levels of size in place of the kernel; widths that change over the
// image, masks, and edges that are kept; borders other than the repeated pixel. Channels do not mix: alpha
// weighs nothing.
#pragma once

#include <algorithm>
#include <vector>

#include "numeric/kernel_types.h"
#include "numeric/parallel.h"
#include "raster/image.h"
#include "raster/texture.h"

namespace etalon {

// The largest radius of a blur, in pixels.
inline constexpr int kMaxBlurRadius = 65536;

// Weights 0 .. radius of a Gaussian of standard deviation sigma (pixels, > 0), in double, with
// w[0] + 2 (w[1] + ... + w[radius]) = 1 to within (radius + 4) 2^-53. Weights below 2^-100 are 0, so that no
// weight is denormal in float. 0 <= radius <= kMaxBlurRadius.
// Relative error of a weight against the true normalised Gaussian: kGaussianWeightRelativeError.
std::vector<double> gaussianWeights(int radius, double sigma);

// The rounding of the exponent of e, up to 70, dominates.
inline constexpr double kGaussianWeightRelativeError = 0x1p-45;

// What blur.glsl reads, and the text, over T: the weights and one contiguous row of texels per tap.
template <class T, class Stored>
struct BlurKernel {
#include "numeric/kernel_scope.inc"
    const std::vector<T>* weights;
    // rows[centre + k]: the row of tap k, shifted so that index x belongs to pixel x.
    const Stored* const* rows;
    int centre;
    size_t x = 0;

    T blurWeight(int k) const { return (*weights)[static_cast<size_t>(k)]; }
    T blurTap(int k) const { return Number<T>::load(rows[centre + k] + x); }
#include "raster/kernels/blur.glsl"
};

// See blurGaussian.
inline constexpr double kBlurRelativeErrorPerTap = 0x1p-23;

// Blurs every channel with gaussianWeights(radius, sigma), first along rows, then along columns; beyond the
// image the border pixel repeats. T is the number type of the arithmetic (float, double, lanes of them, a
// rounded format, truth); results between the passes are stored as float where T computes in float, else as
// double.
//
// Per pixel and pass the sum runs from the outermost pair of taps, w_k (before + after), to the centre, so
// that neither threads, lanes nor mirroring the image change a bit. Radius 0 returns the image unchanged, bit
// for bit; the radius may exceed the image. A NaN or infinite pixel makes every pixel within the radius in x
// and y NaN or infinite (weights of 0 included). Pixels may go up to half the largest number of T.
//
// Error in float against exact arithmetic on non-negative images: relative (radius + 3)
// kBlurRelativeErrorPerTap; on others the same times the blur of the absolute values. An image of one
// constant is reproduced to that bound.
template <class T>
Image<float> blurGaussian(const Image<float>& image, int radius, double sigma, int threads = 0) {
    using Stored = typename Number<T>::Stored;
    constexpr int kWidth = Number<T>::lanes;
    const std::vector<double> exactWeights = gaussianWeights(radius, sigma);
    if (radius == 0 || image.empty()) return image;
    std::vector<T> weights;
    for (double w : exactWeights) weights.push_back(T(w));

    // Rows are padded to whole groups of lanes, so that the last group may read past the image's width.
    const int width = image.width(), height = image.height();
    const size_t stride = (static_cast<size_t>(width) + kWidth - 1) / kWidth * kWidth;
    const size_t rowCount = static_cast<size_t>(height) * static_cast<size_t>(image.channels());
    std::vector<Stored> between(stride * rowCount);
    const int taps = 2 * radius + 1;

    // One row of one channel: taps are shifted views of the row with its ends repeated.
    parallelFor(rowCount, threads, [&](size_t r) {
        const float* from = image.values().data() + r * static_cast<size_t>(width);
        std::vector<Stored> padded(stride + static_cast<size_t>(taps));
        for (size_t i = 0; i < padded.size(); i++) {
            const long x = static_cast<long>(i) - radius;
            padded[i] = static_cast<Stored>(from[std::clamp(x, 0L, static_cast<long>(width) - 1)]);
        }
        std::vector<const Stored*> rows(static_cast<size_t>(taps));
        for (size_t k = 0; k < rows.size(); k++) rows[k] = padded.data() + k;
        BlurKernel<T, Stored> kernel{&weights, rows.data(), radius};
        forEachLaneGroup<kWidth>(static_cast<size_t>(width), [&](size_t first, int active) {
            kernel.x = first;
            Number<T>::store(kernel.blurPixelAlong(radius), between.data() + r * stride + first, active);
        });
    });

    // One row of the result: taps are the rows above and below.
    Image<float> result(width, height, image.channels());
    parallelFor(rowCount, threads, [&](size_t r) {
        const size_t channelTop = r / static_cast<size_t>(height) * static_cast<size_t>(height);
        const int y = static_cast<int>(r - channelTop);
        std::vector<const Stored*> rows(static_cast<size_t>(taps));
        for (int k = 0; k < taps; k++) {
            const size_t row = channelTop + static_cast<size_t>(std::clamp(y + k - radius, 0, height - 1));
            rows[static_cast<size_t>(k)] = between.data() + row * stride;
        }
        BlurKernel<T, Stored> kernel{&weights, rows.data(), radius};
        forEachLaneGroup<kWidth>(static_cast<size_t>(width), [&](size_t first, int active) {
            kernel.x = first;
            Number<T>::store(kernel.blurPixelAlong(radius),
                             result.values().data() + r * static_cast<size_t>(width) + first, active);
        });
    });
    return result;
}

struct BlurPasses {
    // blurGaussian
    Image<float> (*blur)(const Image<float>& image, int radius, double sigma, int threads);
};

// The same in the default profile: float arithmetic in lanes.
Image<float> blurGaussian(const Image<float>& image, int radius, double sigma, int threads = 0);

}  // namespace etalon
