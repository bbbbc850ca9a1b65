// Products of functions in spherical harmonics.
#pragma once

#include <cstdint>
#include <vector>

#include "probes/spherical_harmonics.h"

namespace etalon {

// The triple product tensor: the integrals of y_a y_b y_c over the sphere (Gaunt coefficients of real
// harmonics) that are not 0, for degrees of a, b and c up to those given. By Gauss-Legendre quadrature that
// is exact for their degrees and, along the azimuth, in closed form; error at most kProductTensorError.
// Integrals that vanish by parity, the triangle inequality or the azimuth are not stored, nor those below
// kProductTensorError.
class HarmonicProduct {
  public:
    struct Term {
        uint8_t a, b, c;  // harmonicIndex
        double value;
    };

    // Degrees 0 .. kMaxHarmonicDegree, else PreconditionError.
    HarmonicProduct(int degreeA, int degreeB, int degreeC);

    // In the order of c, then a, then b.
    const std::vector<Term>& terms() const { return terms_; }

    // The coefficients of f g up to degreeC, channel by channel: exact if degreeC >= degreeA + degreeB, else
    // the projection of the product. f and g have degreeA and degreeB.
    SphericalHarmonics multiply(const SphericalHarmonics& f, const SphericalHarmonics& g) const;

    // The matrix that multiplies with a channel of f: element [c * harmonicCount(degreeB) + b]; its product
    // with the coefficients of g are those of f g. f has degreeA.
    std::vector<double> matrix(const SphericalHarmonics& f, int channel) const;

  private:
    int degreeA_, degreeB_, degreeC_;
    std::vector<Term> terms_;
};

inline constexpr double kProductTensorError = 1e-13;

}  // namespace etalon
