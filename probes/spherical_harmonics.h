// Real spherical harmonics of degree up to 10: radiance over directions as coefficients, and back. The texts
// are probes/kernels/harmonics.glsl.
//
// Basis. y_l^m with -l <= m <= l has the index l l + l + m and is orthonormal over the sphere:
//   y_l^0 = K_l^0 P_l(z), y_l^m = sqrt(2) K_l^m P_l^m(z) cos(m phi), y_l^-m = sqrt(2) K_l^m P_l^m(z) sin(m
//   phi)
// for m > 0, phi = atan2(y, x), with K_l^m = sqrt((2l + 1) (l - m)! / (4 pi (l + m)!)). The Legendre
// functions P_l^m carry the Condon-Shortley phase (-1)^m, as in [Nowrouzezahrai2011]: y_1^-1 = -0.4886 y,
// y_1^0 = 0.4886 z, y_1^1 = -0.4886 x.
//
// Axes. x, y and z are the components of the direction in the world as they are, +Y up: the polar axis of the
// formulas is the world's z, not its vertical. Tables of other systems:
// - without the phase [RamamoorthiHanrahan2001]: coefficients of odd m change their sign;
// - z up instead of y up, both right-handed: rotateHarmonics() with the rotation that takes their axes to
// ours,
//   (x, y, z) -> (x, z, -y) for z up with x kept.
//
// Evaluation. Constants of the recurrences in double, rounded once to the number type; no monomials. The
// direction has unit length; the degenerate direction (0, 0, 0) has y_l^m = 0 but for the even degrees of m =
// 0.
#pragma once

#include <array>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "numeric/kernel_types.h"
#include "probes/flux.h"
#include "probes/probe.h"
#include "raster/profile.h"

namespace etalon {

inline constexpr int kMaxHarmonicDegree = 10;
constexpr int harmonicCount(int degree) { return (degree + 1) * (degree + 1); }
constexpr int harmonicIndex(int l, int m) { return l * l + l + m; }
inline constexpr auto kMaxHarmonicCount = static_cast<size_t>(harmonicCount(kMaxHarmonicDegree));

// A function over directions with three channels (radiance, irradiance): coefficients[harmonicIndex(l, m)]
// for all l up to the degree.
struct SphericalHarmonics {
    SphericalHarmonics() : SphericalHarmonics(0) {}
    // All coefficients 0. 0 <= newDegree <= kMaxHarmonicDegree.
    explicit SphericalHarmonics(int newDegree);

    glm::dvec3& at(int l, int m) { return coefficients[static_cast<size_t>(harmonicIndex(l, m))]; }
    const glm::dvec3& at(int l, int m) const {
        return coefficients[static_cast<size_t>(harmonicIndex(l, m))];
    }

    int degree = 0;
    std::vector<glm::dvec3> coefficients;
};

// Largest error of a harmonic of degree <= 10 in double and float against exact arithmetic, unit direction
// exact.
inline constexpr double kHarmonicDoubleError = 0x1p-47, kHarmonicFloatError = 0x1p-19;

// Errors of an arithmetic, for radiance in the normal range of its format, in units of probeErrors().harmonic
// (probes/probe_errors.h): a projected coefficient of degree <= 4 is off by at most four times that, L00 by
// it once, relative to the mean radiance times 2 sqrt(pi); a sum of harmonics of degree <= 6 with
// coefficients up to 1 by eight times.

// The factors of the recurrences. With p_m^m = rise(m, m):
//   p_l^m = rise(l, m) z p_{l-1}^m - fall(l, m) p_{l-2}^m,  y_l^m = p_l^m Re (x + iy)^m, y_l^-m = p_l^m Im (x
//   + iy)^m
struct HarmonicConstants {
    std::array<double, kMaxHarmonicCount> rise, fall;  // by harmonicIndex(l, m), m >= 0
};
const HarmonicConstants& harmonicConstants();

// The texts over T: findHarmonics(d, degree), after which harmonicValue(i) is y_i(d),
// sumOfHarmonics(d, degree) of the coefficients that setCoefficients() took, and projectTexels(first, end, parts,
// degree) of the texels of `row` into projectedSums.
template <class T>
struct HarmonicsKernel {
#include "numeric/kernel_scope.inc"
#include "probes/flux_scope.inc"
#include "numeric/kernels/vector.glsl"
#include "probes/kernels/flux.glsl"

    HarmonicsKernel() {
        for (size_t i = 0; i < kMaxHarmonicCount; i++) {
            rise_[i] = T(harmonicConstants().rise[i]);
            fall_[i] = T(harmonicConstants().fall[i]);
        }
    }
    void setCoefficients(const SphericalHarmonics& harmonics) {
        const int exponent = sumExponent<T>(harmonics.coefficients);
        unscale_ = PowerOfTwoHalves<T>(-exponent);
        for (size_t i = 0; i < harmonics.coefficients.size(); i++) {
            const auto scaled = [&](int c) { return T(std::ldexp(harmonics.coefficients[i][c], exponent)); };
            coefficients_[i] = flooredTerm3(vec3(scaled(0), scaled(1), scaled(2)));
        }
    }
    real coefficientUnscale(int part) const { return part == 0 ? unscale_.first : unscale_.second; }
    real harmonicRise(int i) const { return rise_[static_cast<size_t>(i)]; }
    real harmonicFall(int i) const { return fall_[static_cast<size_t>(i)]; }
    vec3 harmonicCoefficient(int i) const { return coefficients_[static_cast<size_t>(i)]; }
    real harmonicValue(int i) const { return values_[static_cast<size_t>(i)]; }
    void setHarmonicValue(int i, real value) { values_[static_cast<size_t>(i)] = value; }

    const TexelRow* row = nullptr;
    real scaleOfRadiance{1.0};  // two to FluxScale::radiance
    vec3* projectedSums = nullptr;
    real radianceScale() const { return scaleOfRadiance; }
    // Of texel x and the ones behind it in lanes.
    vec3 texelDirection(int x) const { return texelVector(row->direction, x); }
    vec3 texelRadiance(int x) const { return texelVector(row->radiance, x); }
    real texelWeight(int x) const { return Number<T>::load(row->weight.data() + x); }
    vec3 projectedSum(int i) const { return projectedSums[i]; }
    void setProjectedSum(int i, const vec3& sum) { projectedSums[i] = sum; }

#include "probes/kernels/harmonics.glsl"

  private:
    template <class S>
    static vec3 texelVector(const std::array<std::vector<S>, 3>& of, int x) {
        return {Number<T>::load(of[0].data() + x), Number<T>::load(of[1].data() + x),
                Number<T>::load(of[2].data() + x)};
    }

    std::array<T, kMaxHarmonicCount> rise_, fall_, values_;
    std::array<vec3, kMaxHarmonicCount> coefficients_;
    PowerOfTwoHalves<T> unscale_{0};
};

// The harmonics at a unit direction, in double; kHarmonicDoubleError.
std::vector<double> harmonicsAt(const glm::dvec3& direction, int degree);
// The function at a unit direction, in double.
glm::dvec3 evaluate(const SphericalHarmonics& harmonics, const glm::dvec3& direction);

// The coefficients of a probe's radiance: the sum over texels of radiance, solid angle and the harmonic at
// the direction of the texel's centre in the world (that rule is the quadrature; its error falls with the
// square of the size of the texels). Blind texels are black. 0 <= degree <= kMaxHarmonicDegree. In double:
// kProjectionDoubleError. Lat-long probes are summed by rows: the azimuthal moments of each row times
// Legendre functions, about the image's own axis, then turned (rotateHarmonics).
SphericalHarmonics projectHarmonics(const Probe& probe, int degree, int threads = 0);

// The same with every step per texel and the sums in an arithmetic (probes/flux.h). Per coefficient and row
// of texels, partial sum j adds the texels j, j + 16, j + 32, ... in order, starting from 0; then j + 8 is
// added to j, and so on down to one. The sums of the rows, of all layers in order, are added in pairs of
// neighbours, again and again, an odd last one kept as it is.
SphericalHarmonics projectHarmonics(const Probe& probe, int degree, Arithmetic arithmetic, int threads = 0);

// Largest error of a coefficient against the same sum in exact arithmetic, relative to the largest magnitude
// of the probe's radiance.
inline constexpr double kProjectionDoubleError = 1e-13;

// The function at unit directions, in an arithmetic.
std::vector<glm::dvec3> evaluateHarmonics(const SphericalHarmonics& harmonics,
                                          std::span<const glm::dvec3> directions, Arithmetic arithmetic,
                                          int threads = 0);

}  // namespace etalon
