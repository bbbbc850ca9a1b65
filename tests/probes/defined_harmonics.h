// Real spherical harmonics from their definition, for tests.
#pragma once

#include <cstdlib>
#include <vector>

#include "numeric/truth_elementary.h"

namespace etalon {

inline Truth truthPi() {
    Truth pi;
    mpfr_const_pi(pi.get(), MPFR_RNDN);
    return pi;
}

// y_l^m as a polynomial: Rodrigues' formula as a sum of monomials in z with their factorials, times the real
// (m >= 0) or imaginary part of (x + iy)^|m|. The coefficients are Truth, rounded once to Real.
template <class Real>
class DefinedHarmonic {
  public:
    DefinedHarmonic(int l, int m) : order_(std::abs(m)), isImaginary_(m < 0) {
        const int k = order_;
        const Truth square =
            Truth(2.0 * l + 1) * factorial(l - k) / (Truth(4.0) * truthPi() * factorial(l + k));
        const Truth norm = squareRoot(square * Truth(m == 0 ? 1.0 : 2.0));
        byPower_.assign(static_cast<size_t>(l - k + 1), Real(0.0));
        for (int j = 0; 2 * j <= l - k; j++) {
            // (-1)^j (2l - 2j)! / (2^l j! (l - j)! (l - 2j)!) times the k-th derivative of z^(l - 2j)
            Truth c = norm * factorial(2 * l - 2 * j) /
                      (factorial(j) * factorial(l - j) * factorial(l - 2 * j - k));
            for (int i = 0; i < l; i++) c = c / Truth(2.0);
            byPower_[static_cast<size_t>(l - 2 * j - k)] = rounded((j + k) % 2 == 0 ? c : -c);
        }
    }

    Real at(const Real& x, const Real& y, const Real& z) const {
        Real real(1.0), imaginary(0.0), legendre(0.0);
        for (int i = 0; i < order_; i++) {
            const Real next = real * x - imaginary * y;
            imaginary = real * y + imaginary * x;
            real = next;
        }
        for (size_t power = byPower_.size(); power-- > 0;) legendre = legendre * z + byPower_[power];
        return legendre * (isImaginary_ ? imaginary : real);
    }

  private:
    static Truth factorial(int n) {
        Truth f(1.0);
        for (int i = 2; i <= n; i++) f = f * Truth(static_cast<double>(i));
        return f;
    }
    static Real rounded(const Truth& a) {
        if constexpr (std::is_same_v<Real, Truth>)
            return a;
        else
            return mpfr_get_ld(a.get(), MPFR_RNDN);
    }

    int order_;
    bool isImaginary_;
    std::vector<Real> byPower_;
};

// All of them up to a degree, by harmonicIndex(l, m).
template <class Real>
std::vector<DefinedHarmonic<Real>> definedHarmonics(int degree) {
    std::vector<DefinedHarmonic<Real>> all;
    for (int l = 0; l <= degree; l++)
        for (int m = -l; m <= l; m++) all.emplace_back(l, m);
    return all;
}

}  // namespace etalon
