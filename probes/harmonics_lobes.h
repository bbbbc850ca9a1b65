// Lobes and windows: functions of the angle from an axis that scale the bands of spherical harmonics.
#pragma once

#include <vector>

#include "probes/spherical_harmonics.h"

namespace etalon {

// A lobe is a factor for each band. Radiance convolved with the lobe, d -> integral of L(w) k(d . w) dw, has
// the coefficients factor[l] L_l^m; the factors are 2 pi times the integral of k(t) P_l(t) over [-1, 1].
// Exact to a few units in the last place.

// max(0, t): what makes irradiance of radiance [RamamoorthiHanrahan2001]: pi, 2 pi / 3, pi / 4, 0, -pi / 24,
// ... The Lambert row of [Nowrouzezahrai2011, Table 1] is this divided by pi.
std::vector<double> cosineLobe(int degree);
// (s + 2) / (2 pi) max(0, t)^s, exponent s >= 0: of [Nowrouzezahrai2011, Table 1]. With the cosine of a plate
// that faces the axis it adds up to 1; alone to (s + 2) / (s + 1).
std::vector<double> phongLobe(int degree, double exponent);
// The direction itself: 1, 1, 1, ...
std::vector<double> mirrorLobe(int degree);

// The zonal coefficients of the lobe about the z axis: factor[l] sqrt((2l + 1) / (4 pi)).
std::vector<double> zonalOfLobe(const std::vector<double>& factors);

// Each coefficient times the factor of its band. As many factors as bands, else PreconditionError.
SphericalHarmonics scaleBands(const SphericalHarmonics& f, const std::vector<double>& factors);

// The irradiance over normals of a radiance.
SphericalHarmonics irradianceOfHarmonics(const SphericalHarmonics& radiance);

// Windows against ringing, factors for bands 0 .. degree, 0 from band `width` on; width > 0,
// PreconditionError otherwise. hanning: (1 + cos(pi l / width)) / 2. lanczos: sin(pi l / width) / (pi l /
// width). The usual width is degree + 1.
std::vector<double> hanningWindow(int degree, double width);
std::vector<double> lanczosWindow(int degree, double width);

// The smallest value of any channel over the sphere: the lowest of 96 x 48 lat-long texel centres are
// followed downwards, two for each channel, in 60 steps along a great circle to the lowest of four
// neighbours, else half as far. Off by at most 1e-9 times the sum of the magnitudes of the coefficients
// wherever the grid finds the valley.
double smallestValue(const SphericalHarmonics& f);

// The window 1 / (1 + strength l^2 (l + 1)^2) [Sloan2008] that only just removes what is negative: `strength`
// is the smallest one for which smallestValue() is not negative, for all channels together; found by steps of
// 4 from 2^-30 and 40 halvings, so from above and to a relative 2^-38. 0 (factors of exactly 1) where nothing
// is negative. Where the mean of a channel is not positive and the channel is not constant no strength is
// enough: it is infinite, and the mean alone remains.
struct MinimalWindow {
    double strength = 0;
    std::vector<double> factors;
};
MinimalWindow minimalWindow(const SphericalHarmonics& f);

}  // namespace etalon
