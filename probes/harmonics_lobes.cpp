#include "probes/harmonics_lobes.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "numeric/check.h"
#include "numeric/elementary.h"
#include "numeric/vectors.h"
#include "probes/latlong.h"

namespace etalon {

namespace {

// The integrals of t^s P_l(t) over [0, 1].
std::vector<double> powerMoments(int degree, double s) {
    ETALON_CHECK(degree >= 0 && degree <= kMaxHarmonicDegree && s >= 0, "degree {}, exponent {}", degree, s);
    std::vector<double> moments = {1 / (s + 1), 1 / (s + 2)};
    for (int l = 2; l <= degree; l++)
        moments.push_back(moments[static_cast<size_t>(l - 2)] * ((s - l + 2) / (s + l + 1)));
    moments.resize(static_cast<size_t>(degree) + 1);
    return moments;
}

// Values of a function on directions, split by bands, so that windows cost little; and below the grid.
class Valley {
  public:
    explicit Valley(const SphericalHarmonics& f) : f_(f), grid_(kColumns, kRows) {
        const auto bands = static_cast<size_t>(f.degree) + 1;
        parts_.assign(static_cast<size_t>(kColumns * kRows) * bands, glm::dvec3(0));
        for (size_t i = 0; i < static_cast<size_t>(kColumns * kRows); i++) {
            kernel_.findHarmonics(directionOf(i), f.degree);
            for (int l = 0; l <= f.degree; l++)
                for (int m = -l; m <= l; m++)
                    for (int c = 0; c < 3; c++)
                        parts_[i * bands + static_cast<size_t>(l)][c] +=
                            kernel_.harmonicValue(harmonicIndex(l, m)) * f.at(l, m)[c];
        }
    }

    // The smallest value with these factors of bands.
    double smallest(const std::vector<double>& factors) {
        windowed_ = scaleBands(f_, factors);
        double lowest = std::numeric_limits<double>::infinity();
        for (int c = 0; c < 3; c++)
            for (const size_t start : lowestTexels(factors, c)) lowest = std::min(lowest, follow(start, c));
        return lowest;
    }

  private:
    static constexpr int kColumns = 96, kRows = 48, kSteps = 60;

    glm::dvec3 directionOf(size_t i) const {
        return grid_.direction(static_cast<int>(i) % kColumns, static_cast<int>(i) / kColumns);
    }

    std::array<size_t, 2> lowestTexels(const std::vector<double>& factors, int channel) const {
        std::array<size_t, 2> best = {0, 0};
        std::array<double, 2> values;
        values.fill(std::numeric_limits<double>::infinity());
        for (size_t i = 0; i < parts_.size() / factors.size(); i++) {
            double value = 0;
            for (size_t l = 0; l < factors.size(); l++)
                value += factors[l] * parts_[i * factors.size() + l][channel];
            if (value < values[0])
                values = {value, values[0]}, best = {i, best[0]};
            else if (value < values[1])
                values[1] = value, best[1] = i;
        }
        return best;
    }

    double valueAt(const glm::dvec3& d, int channel) {
        kernel_.findHarmonics(d, windowed_.degree);
        double value = 0;
        for (size_t i = 0; i < windowed_.coefficients.size(); i++)
            value += kernel_.harmonicValue(static_cast<int>(i)) * windowed_.coefficients[i][channel];
        return value;
    }

    double follow(size_t start, int channel) {
        glm::dvec3 d = directionOf(start);
        double lowest = valueAt(d, channel), step = 2 * kPi / kColumns;
        for (int i = 0; i < kSteps; i++) {
            // Two tangents; the first is never short.
            const glm::dvec3 first =
                std::abs(d.y) < 0.8 ? glm::dvec3(d.z, 0, -d.x) : glm::dvec3(0, d.z, -d.y);
            const glm::dvec3 second(d.y * first.z - d.z * first.y, d.z * first.x - d.x * first.z,
                                    d.x * first.y - d.y * first.x);
            glm::dvec3 next = d;
            for (const glm::dvec3& tangent : {first, -first, second, -second}) {
                const glm::dvec3 p(d.x + step * tangent.x, d.y + step * tangent.y, d.z + step * tangent.z);
                const double length = std::sqrt(p.x * p.x + (p.y * p.y + p.z * p.z));
                const glm::dvec3 neighbour(p.x / length, p.y / length, p.z / length);
                const double value = valueAt(neighbour, channel);
                if (value < lowest) lowest = value, next = neighbour;
            }
            if (next == d)
                step /= 2;
            else
                d = next;
        }
        return lowest;
    }

    const SphericalHarmonics& f_;
    LatLongGrid grid_;
    std::vector<glm::dvec3> parts_;
    SphericalHarmonics windowed_;
    HarmonicsKernel<double> kernel_;
};

std::vector<double> smoothing(int degree, double strength) {
    std::vector<double> factors;
    for (int l = 0; l <= degree; l++) {
        const double bend = l * (l + 1.0);
        factors.push_back(1 / (1 + strength * (bend * bend)));
    }
    return factors;
}

}  // namespace

std::vector<double> cosineLobe(int degree) {
    std::vector<double> factors = powerMoments(degree, 1);
    for (double& f : factors) f *= 2 * kPi;
    return factors;
}

std::vector<double> phongLobe(int degree, double exponent) {
    std::vector<double> factors = powerMoments(degree, exponent);
    for (double& f : factors) f *= exponent + 2;
    return factors;
}

std::vector<double> mirrorLobe(int degree) {
    ETALON_CHECK(degree >= 0 && degree <= kMaxHarmonicDegree, "degree {}", degree);
    return std::vector<double>(static_cast<size_t>(degree) + 1, 1.0);
}

std::vector<double> zonalOfLobe(const std::vector<double>& factors) {
    std::vector<double> zonal = factors;
    for (size_t l = 0; l < zonal.size(); l++)
        zonal[l] *= std::sqrt((2 * static_cast<double>(l) + 1) / (4 * kPi));
    return zonal;
}

SphericalHarmonics scaleBands(const SphericalHarmonics& f, const std::vector<double>& factors) {
    ETALON_CHECK(factors.size() == static_cast<size_t>(f.degree) + 1, "{} factors, degree {}", factors.size(),
                 f.degree);
    SphericalHarmonics scaled = f;
    for (int l = 0; l <= f.degree; l++)
        for (int m = -l; m <= l; m++)
            for (int c = 0; c < 3; c++) scaled.at(l, m)[c] *= factors[static_cast<size_t>(l)];
    return scaled;
}

SphericalHarmonics irradianceOfHarmonics(const SphericalHarmonics& radiance) {
    return scaleBands(radiance, cosineLobe(radiance.degree));
}

std::vector<double> hanningWindow(int degree, double width) {
    ETALON_CHECK(width > 0, "width {}", width);
    std::vector<double> factors = mirrorLobe(degree);
    for (int l = 1; l <= degree; l++)
        factors[static_cast<size_t>(l)] = l < width ? 0.5 * (1 + cosOf(kPi * (l / width))) : 0;
    return factors;
}

std::vector<double> lanczosWindow(int degree, double width) {
    ETALON_CHECK(width > 0, "width {}", width);
    std::vector<double> factors = mirrorLobe(degree);
    for (int l = 1; l <= degree; l++) {
        const double angle_rad = kPi * (l / width);
        factors[static_cast<size_t>(l)] = l < width ? sinOf(angle_rad) / angle_rad : 0;
    }
    return factors;
}

double smallestValue(const SphericalHarmonics& f) { return Valley(f).smallest(mirrorLobe(f.degree)); }

MinimalWindow minimalWindow(const SphericalHarmonics& f) {
    Valley valley(f);
    const auto isEnough = [&](double strength) {
        return valley.smallest(smoothing(f.degree, strength)) >= 0;
    };
    if (isEnough(0)) return {0, smoothing(f.degree, 0)};
    constexpr int kFirstExponent = -30, kLastExponent = 60, kHalvings = 40;
    double high = powerOfTwo(kFirstExponent), low = 0;
    while (!isEnough(high)) {
        if (high >= powerOfTwo(kLastExponent)) {
            MinimalWindow mean{std::numeric_limits<double>::infinity(), {}};
            mean.factors.assign(static_cast<size_t>(f.degree) + 1, 0.0);
            mean.factors[0] = 1;
            return mean;
        }
        low = high, high *= 4;
    }
    for (int i = 0; i < kHalvings; i++) {
        const double middle = 0.5 * (low + high);
        (isEnough(middle) ? high : low) = middle;
    }
    return {high, smoothing(f.degree, high)};
}

}  // namespace etalon
