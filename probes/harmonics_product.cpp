#include "probes/harmonics_product.h"

#include <array>
#include <cmath>
#include <cstdlib>

#include "numeric/check.h"
#include "numeric/elementary.h"
#include "numeric/vectors.h"

namespace etalon {

namespace {

// 16 points of Gauss and Legendre integrate polynomials up to degree 31, above three times the largest
// degree.
constexpr int kPoints = 16;
static_assert(2 * kPoints - 1 >= 3 * kMaxHarmonicDegree);

struct Quadrature {
    std::array<double, kPoints> z, weight;
};
Quadrature gaussLegendre() {
    Quadrature q;
    for (int i = 0; i < kPoints; i++) {
        // Newton's method on P_n from an estimate of its roots.
        double z = cosOf(kPi * (i + 0.75) / (kPoints + 0.5)), slope = 0;
        constexpr int kSteps = 8;
        for (int step = 0; step < kSteps; step++) {
            double before = 1, value = z;
            for (int n = 2; n <= kPoints; n++) {
                const double next = ((2 * n - 1) * z * value - (n - 1) * before) / n;
                before = value, value = next;
            }
            slope = kPoints * (z * value - before) / (z * z - 1);
            z = z - value / slope;
        }
        q.z[static_cast<size_t>(i)] = z;
        q.weight[static_cast<size_t>(i)] = 2 / ((1 - z * z) * (slope * slope));
    }
    return q;
}

// The integral of the product of three functions of azimuth, cos(m phi) for m >= 0 and sin(-m phi) for m < 0,
// over 2 pi, from their exponentials.
double azimuthIntegral(const std::array<int, 3>& m) {
    int sines = 0, sum = 0;
    for (const int k : m) sines += k < 0 ? 1 : 0;
    if (sines % 2 != 0) return 0;
    for (int signs = 0; signs < 8; signs++) {
        int total = 0, sign = 1;
        for (int k = 0; k < 3; k++) {
            const int s = (signs >> k & 1) != 0 ? -1 : 1;
            total += s * std::abs(m[static_cast<size_t>(k)]);
            if (m[static_cast<size_t>(k)] < 0) sign *= s;
        }
        if (total == 0) sum += sign;
    }
    return (sines == 2 ? -sum : sum) * (2 * kPi / 8);
}

struct Harmonic {
    int l, m;
};
std::vector<Harmonic> harmonicsUpTo(int degree) {
    std::vector<Harmonic> list;
    for (int l = 0; l <= degree; l++)
        for (int m = -l; m <= l; m++) list.push_back({l, m});
    return list;
}

}  // namespace

HarmonicProduct::HarmonicProduct(int degreeA, int degreeB, int degreeC)
    : degreeA_(degreeA), degreeB_(degreeB), degreeC_(degreeC) {
    for (const int degree : {degreeA, degreeB, degreeC})
        ETALON_CHECK(degree >= 0 && degree <= kMaxHarmonicDegree, "degree {}", degree);
    // The harmonics of m >= 0 at azimuth 0: their functions of z.
    const Quadrature q = gaussLegendre();
    const int largest = std::max(degreeA, std::max(degreeB, degreeC));
    std::vector<std::array<double, kPoints>> functions(static_cast<size_t>(harmonicCount(largest)));
    for (size_t i = 0; i < kPoints; i++) {
        const std::vector<double> values = harmonicsAt({std::sqrt(1 - q.z[i] * q.z[i]), 0, q.z[i]}, largest);
        for (size_t k = 0; k < values.size(); k++) functions[k][i] = values[k];
    }
    const auto functionOf = [&](const Harmonic& h) -> const std::array<double, kPoints>& {
        return functions[static_cast<size_t>(harmonicIndex(h.l, std::abs(h.m)))];
    };
    const auto indexOf = [](const Harmonic& h) { return static_cast<uint8_t>(harmonicIndex(h.l, h.m)); };

    for (const Harmonic& c : harmonicsUpTo(degreeC))
        for (const Harmonic& a : harmonicsUpTo(degreeA))
            for (const Harmonic& b : harmonicsUpTo(degreeB)) {
                if ((a.l + b.l + c.l) % 2 != 0 || c.l > a.l + b.l || c.l < std::abs(a.l - b.l)) continue;
                const double azimuth = azimuthIntegral({a.m, b.m, c.m});
                if (azimuth == 0) continue;
                const auto &fa = functionOf(a), &fb = functionOf(b), &fc = functionOf(c);
                double sum = 0;
                for (size_t i = 0; i < kPoints; i++) sum += q.weight[i] * (fa[i] * fb[i] * fc[i]);
                const double value = azimuth * sum;
                if (std::abs(value) > kProductTensorError)
                    terms_.push_back({indexOf(a), indexOf(b), indexOf(c), value});
            }
}

SphericalHarmonics HarmonicProduct::multiply(const SphericalHarmonics& f, const SphericalHarmonics& g) const {
    ETALON_CHECK(f.degree == degreeA_ && g.degree == degreeB_, "degrees {} and {}, not {} and {}", f.degree,
                 g.degree, degreeA_, degreeB_);
    SphericalHarmonics product(degreeC_);
    for (const Term& t : terms_)
        for (int channel = 0; channel < 3; channel++)
            product.coefficients[t.c][channel] +=
                t.value * (f.coefficients[t.a][channel] * g.coefficients[t.b][channel]);
    return product;
}

std::vector<double> HarmonicProduct::matrix(const SphericalHarmonics& f, int channel) const {
    ETALON_CHECK(f.degree == degreeA_ && channel >= 0 && channel < 3, "degree {}, not {}; channel {}",
                 f.degree, degreeA_, channel);
    const auto columns = static_cast<size_t>(harmonicCount(degreeB_));
    std::vector<double> elements(columns * static_cast<size_t>(harmonicCount(degreeC_)));
    for (const Term& t : terms_) elements[t.c * columns + t.b] += t.value * f.coefficients[t.a][channel];
    return elements;
}

}  // namespace etalon
