// Coefficients of spherical harmonics as lists of numbers, in the layouts of AR frameworks.
#pragma once

#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "probes/spherical_harmonics.h"

namespace etalon {

// interleaved: r, g, b of coefficient 0, then of coefficient 1, and so on. ARCore's 27 ambient coefficients
// [ARCore, LightEstimate], of WebXR and OpenXR too. Its sample multiplies them with y_l^m of this project
// times the cosine lobe over pi (0.282095, -0.325735, 0.325735, -0.325735, 0.273137, ...), so they are
// coefficients of radiance with Condon-Shortley phase, in world axes with +Y up: no number changes. planar:
// all coefficients of red, then of green, then of blue. ARKit's 27 [ARKit, ARDirectionalLightEstimate]. Its
// documentation states the planes, but neither phase nor scale nor axes: the numbers are those of this
// project.
enum class CoefficientLayout { interleaved, planar };

// 3 (degree + 1)^2 numbers.
std::vector<double> layOut(const SphericalHarmonics& harmonics, CoefficientLayout layout);
// The degree that so many numbers belong to, if any.
std::optional<int> degreeOfLayout(size_t numbers);
// The inverse of layOut; PreconditionError if the count belongs to no degree.
SphericalHarmonics fromLayout(std::span<const double> numbers, CoefficientLayout layout);

}  // namespace etalon
