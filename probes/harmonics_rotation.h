// Rotation of spherical harmonics.
#pragma once

#include <glm/mat3x3.hpp>
#include <vector>

#include "probes/spherical_harmonics.h"

namespace etalon {

// Largest error of an element of a rotation matrix of degree <= 10 against exact arithmetic, for rotations
// that are orthogonal to the last bits.
inline constexpr double kHarmonicRotationError = 1e-13;

// The matrices that rotate bands 0 .. degree: block l has (2l + 1)^2 elements, [(m + l) (2l + 1) + (n + l)]
// is what coefficient n of the function contributes to coefficient m of the rotated one. By recurrence over
// the degree [Ivanic1996]. The rotation is one (orthogonal, determinant 1) to within 1e-6, else
// PreconditionError.
class HarmonicRotation {
  public:
    HarmonicRotation(const glm::dmat3& rotation, int degree);

    int degree() const { return static_cast<int>(blocks_.size()) - 1; }
    double at(int l, int m, int n) const { return blocks_[static_cast<size_t>(l)][index(l, m, n)]; }

  private:
    static size_t index(int l, int m, int n) { return static_cast<size_t>((m + l) * (2 * l + 1) + (n + l)); }

    std::vector<std::vector<double>> blocks_;
};

// The coefficients of the function d -> f(rotation^-1 d): what f shows in direction d the result shows in
// direction rotation d. The identity returns f unchanged, bit for bit.
SphericalHarmonics rotateHarmonics(const SphericalHarmonics& f, const glm::dmat3& rotation);

// The coefficients of the function with zonal coefficients z[l] about the z axis, turned to the unit
// direction axis: sqrt(4 pi / (2l + 1)) z[l] y_l^m(axis) [Nowrouzezahrai2011, Eq. 3].
std::vector<double> rotateZonal(const std::vector<double>& zonal, const glm::dvec3& axis);

}  // namespace etalon
