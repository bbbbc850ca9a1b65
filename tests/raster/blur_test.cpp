#include "raster/blur.h"

#include <doctest/doctest.h>
#include <mpfr.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "numeric/format.h"
#include "numeric/rounded.h"
#include "numeric/truth.h"
#include "tests/support/random_numbers.h"

namespace etalon {
namespace {

Image<float> randomImage(int width, int height, int channels, uint64_t seed, double lo = 0.0) {
    RandomNumbers random(seed);
    Image<float> image(width, height, channels);
    for (float& v : image.values()) v = static_cast<float>(random.uniform(lo, 100.0));
    return image;
}

// The Gaussian's weights -radius .. radius, normalised, with MPFR's exponential.
std::vector<Truth> trueWeights(int radius, double sigma) {
    std::vector<Truth> weights;
    Truth sum(0.0);
    for (int k = -radius; k <= radius; k++) {
        const Truth ratio = Truth(k) / Truth(sigma);
        const Truth exponent = Truth(-0.5) * (ratio * ratio);
        Truth w;
        mpfr_exp(w.get(), exponent.get(), MPFR_RNDN);
        weights.push_back(w);
        sum = sum + w;
    }
    for (Truth& w : weights) w = w / sum;
    return weights;
}

// The two-dimensional convolution at one pixel, with edges clamped.
double convolved(const Image<float>& image, int x, int y, int channel, const std::vector<Truth>& weights) {
    const int radius = static_cast<int>(weights.size() / 2);
    Truth sum(0.0);
    for (int j = -radius; j <= radius; j++)
        for (int i = -radius; i <= radius; i++) {
            const float pixel = image.at(std::clamp(x + i, 0, image.width() - 1),
                                         std::clamp(y + j, 0, image.height() - 1), channel);
            sum = sum + weights[static_cast<size_t>(i + radius)] * weights[static_cast<size_t>(j + radius)] *
                            Truth(pixel);
        }
    return sum.toDouble();
}

struct BlurCase {
    int width, height, radius;
    double sigma;
};
// One pixel, lines, tails of every length, radius beyond the image, flat and narrow kernels.
constexpr BlurCase kCases[] = {{1, 1, 3, 1.0},  {17, 1, 4, 2.0}, {1, 9, 5, 0.7},   {13, 11, 1, 0.5},
                               {19, 6, 7, 3.0}, {5, 4, 12, 6.0}, {33, 2, 3, 50.0}, {8, 8, 6, 0.05}};

template <class T>
double worstRelativeError(const BlurCase& c) {
    const Image<float> image = randomImage(c.width, c.height, 2, 1);
    const Image<float> blurred = blurGaussian<T>(image, c.radius, c.sigma, 1);
    const std::vector<Truth> weights = trueWeights(c.radius, c.sigma);
    double worst = 0.0;
    for (int channel = 0; channel < 2; channel++)
        for (int y = 0; y < c.height; y++)
            for (int x = 0; x < c.width; x++) {
                const double truth = convolved(image, x, y, channel, weights);
                worst = std::max(worst, std::abs(blurred.at(x, y, channel) - truth) / truth);
            }
    return worst;
}

}  // namespace

TEST_CASE("GaussianWeightsAreNormalisedAndTrue") {
    for (const BlurCase& c : kCases) {
        const std::vector<double> weights = gaussianWeights(c.radius, c.sigma);
        const std::vector<Truth> truth = trueWeights(c.radius, c.sigma);
        REQUIRE(weights.size() == static_cast<size_t>(c.radius) + 1);
        Truth sum(weights[0]);
        for (size_t k = 1; k < weights.size(); k++) sum = sum + Truth(2.0) * Truth(weights[k]);
        CHECK(std::abs((sum - Truth(1.0)).toDouble()) <= (c.radius + 4) * 0x1p-53);
        for (size_t k = 0; k < weights.size(); k++) {
            const double exact = truth[k + static_cast<size_t>(c.radius)].toDouble();
            if (weights[k] == 0.0)
                CHECK(exact < 0x1p-100);
            else
                CHECK(std::abs(weights[k] - exact) <= kGaussianWeightRelativeError * exact);
        }
    }
}

TEST_CASE("BlurMatchesTheDirectConvolutionInTruth") {
    double worst = 0.0;
    for (const BlurCase& c : kCases) {
        const double bound = kBlurRelativeErrorPerTap * (c.radius + 3);
        worst = std::max(worst, worstRelativeError<float>(c) / bound);
        // Computed in double, only the weights and the rounding of the result to float remain.
        CHECK(worstRelativeError<double>(c) <= 0x1.00001p-24);
        CHECK(worstRelativeError<Truth>(c) <= 0x1.00001p-24);
    }
    CHECK(worst <= 1.0);
    CHECK(worst >= 0.02);
}

TEST_CASE("BlurKeepsAConstantImageToItsBound") {
    for (int radius : {1, 5, 40, 300})
        for (double sigma : {0.3, 2.0, 25.0, 1e6}) {
            Image<float> image(37, 5);
            image.fill(0.7f);
            const Image<float> blurred = blurGaussian(image, radius, sigma);
            for (float v : blurred.values())
                REQUIRE(std::abs(v - 0.7f) <= 0.7f * kBlurRelativeErrorPerTap * (radius + 3));
        }
}

TEST_CASE("BlurDependsNeitherOnThreadsNorOnLanes") {
    for (const BlurCase& c : kCases) {
        const Image<float> image = randomImage(c.width, c.height, 3, 2, -100.0);
        const Image<float> scalar = blurGaussian<float>(image, c.radius, c.sigma, 1);
        CHECK(blurGaussian(image, c.radius, c.sigma, 1) == scalar);
        CHECK(blurGaussian(image, c.radius, c.sigma, 3) == scalar);
        CHECK(blurGaussian<Lanes<float, 2>>(image, c.radius, c.sigma, 2) == scalar);
        CHECK(blurGaussian<Lanes<float, 32>>(image, c.radius, c.sigma, 2) == scalar);
        CHECK(blurGaussian<Lanes<double, 8>>(image, c.radius, c.sigma, 2) ==
              blurGaussian<double>(image, c.radius, c.sigma, 1));
        // Emulated float keeps the bits of float.
        CHECK(blurGaussian<Rounded<kFp32, double>>(image, c.radius, c.sigma, 1) == scalar);
        CHECK(blurGaussian<Rounded<kFp32, Lanes<double, 4>>>(image, c.radius, c.sigma, 2) == scalar);
    }
}

TEST_CASE("BlurOfAMirroredImageIsTheMirroredBlur") {
    const Image<float> image = randomImage(21, 10, 1, 3);
    Image<float> mirrored(21, 10);
    for (int y = 0; y < 10; y++)
        for (int x = 0; x < 21; x++) mirrored.at(20 - x, 9 - y) = image.at(x, y);
    const Image<float> a = blurGaussian(image, 6, 2.5), b = blurGaussian(mirrored, 6, 2.5);
    for (int y = 0; y < 10; y++)
        for (int x = 0; x < 21; x++) REQUIRE(a.at(x, y) == b.at(20 - x, 9 - y));
}

TEST_CASE("RadiusZeroCopiesEveryBit") {
    Image<float> image = randomImage(9, 4, 2, 4);
    image.at(3, 2) = -0.0f;
    image.at(4, 2) = 1e-45f;
    const Image<float> copy = blurGaussian(image, 0, 1.0);
    CHECK(copy == image);
    CHECK(std::signbit(copy.at(3, 2)));
    CHECK(blurGaussian(Image<float>(0, 0), 3, 1.0).empty());
}

TEST_CASE("NonFinitePixelsSpreadExactlyOverTheKernel") {
    for (float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
        Image<float> image = randomImage(30, 20, 1, 5);
        image.at(14, 9) = bad;
        const Image<float> blurred = blurGaussian(image, 4, 0.1);  // outer weights are 0
        for (int y = 0; y < 20; y++)
            for (int x = 0; x < 30; x++) {
                const bool isReached = std::abs(x - 14) <= 4 && std::abs(y - 9) <= 4;
                REQUIRE(std::isfinite(blurred.at(x, y)) == !isReached);
            }
    }
}

TEST_CASE("BadBlurParametersAreRejected") {
    const Image<float> image(4, 4);
    CHECK_THROWS_AS(blurGaussian(image, -1, 1.0), PreconditionError);
    CHECK_THROWS_AS(blurGaussian(image, kMaxBlurRadius + 1, 1.0), PreconditionError);
    for (double sigma : {0.0, -1.0, static_cast<double>(NAN), static_cast<double>(INFINITY)})
        CHECK_THROWS_AS(blurGaussian(image, 1, sigma), PreconditionError);
}

}  // namespace etalon
