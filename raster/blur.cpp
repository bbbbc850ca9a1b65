#include "raster/blur.h"

#include <cmath>

#include "numeric/check.h"
#include "numeric/door.h"
#include "numeric/elementary.h"

namespace etalon {

namespace {

// Weights below are 0, see gaussianWeights.
constexpr double kSmallestWeight = 0x1p-100;

}  // namespace

std::vector<double> gaussianWeights(int radius, double sigma) {
    ETALON_CHECK(radius >= 0 && radius <= kMaxBlurRadius, "blur radius {}", radius);
    ETALON_CHECK(sigma > 0.0 && std::isfinite(sigma), "sigma {}", sigma);
    std::vector<double> weights;
    for (int k = 0; k <= radius; k++) {
        const double ratio = static_cast<double>(k) / sigma;
        const double w = expOf(-0.5 * (ratio * ratio));
        weights.push_back(w < kSmallestWeight ? 0.0 : w);
    }
    // The smallest first.
    double sum = 0.0;
    for (size_t k = weights.size() - 1; k > 0; k--) sum = sum + 2.0 * weights[k];
    sum = sum + weights[0];
    for (double& w : weights) w = w / sum;
    return weights;
}

Image<float> blurGaussian(const Image<float>& image, int radius, double sigma, int threads) {
    return passesIn<BlurPasses>(Arithmetic::fp32)->blur(image, radius, sigma, threads);
}

}  // namespace etalon
