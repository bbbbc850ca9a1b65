// Irradiance: what a plane receives from a probe, W/m^2, over the plane's normal. The texts are
// probes/kernels/{irradiance,irradiance_sums}.glsl.
#pragma once

#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "probes/flux.h"
#include "probes/probe.h"
#include "probes/spherical_harmonics.h"
#include "raster/profile.h"

namespace etalon {

template <class T>
struct IrradianceKernel {
#include "numeric/kernel_scope.inc"
#include "probes/flux_scope.inc"
#include "numeric/kernels/vector.glsl"
#include "probes/kernels/flux.glsl"
#include "probes/kernels/irradiance.glsl"
#include "probes/irradiance_scope.inc"
#include "probes/kernels/irradiance_sums.glsl"
};

// The irradiance of planes with these unit normals (world): the sum over all texels of radiance, solid angle
// and max(0, cosine) between normal and the direction of the texel's centre, every step in an arithmetic
// (probes/flux.h). Blind texels are black.
// Order: texels in the order of layers, rows and columns are cut into runs of kIrradianceRun; a run adds its
// texels in order, starting from 0; the sums of the runs are added in pairs of neighbours, again and again,
// an odd last one kept as it is. The midpoint rule of the texels remains: its error falls with the square of
// their size.
std::vector<glm::dvec3> irradianceAt(const Probe& probe, std::span<const glm::dvec3> normals,
                                     Arithmetic arithmetic, int threads = 0);
inline constexpr int kIrradianceRun = 32;

// Of each texel in order the unit vector to it, in the world, and what it gives to a plane that faces it, as the sum above
// adds them: rounded to the arithmetic, flux without the scale of probes/flux.h.
struct TexelLights {
    std::vector<glm::dvec3> directions, flux;
};
TexelLights texelLights(const Probe& probe, Arithmetic arithmetic, int threads = 0);

// Its largest relative error (arithmetic of the sum, of directions and of solid angles, not the midpoint
// rule) against the same sum in double, for non-negative radiance inside the normal range of the format that
// does not come from a few texels at right angles, and up to 2^20 texels, is probeErrors().irradiance
// (probes/probe_errors.h).
// The midpoint rule's own error in a white furnace, against pi: 1.2e-3 for lat-long 64 x 32, 1.3e-3 for cubes of 16; it
// falls with the square of the size of the texels.

// A probe of the given shape, not turned, at the position of `like`, whose texels show these values in the
// order of layers, rows and columns; and its texels' directions.
std::vector<glm::dvec3> texelDirections(const ProbeShape& shape);
Probe probeOfValues(const ProbeShape& shape, std::span<const glm::dvec3> values, const Probe& like);

// Irradiance over normals as a probe, exact as irradianceAt() and from the radiance's spherical harmonics
// (degree 2: within 1 % of the mean for most radiance [RamamoorthiHanrahan2001]). Values are stored as float.
Probe irradianceProbe(const Probe& probe, const ProbeShape& shape, Arithmetic arithmetic, int threads = 0);
Probe irradianceProbe(const SphericalHarmonics& radiance, const ProbeShape& shape, const Probe& like,
                      Arithmetic arithmetic, int threads = 0);

// The diffuse map of [Karlsson2005, Sec. 3.1.5]: the reflective cube map with each face blurred on its own
// (raster/blur.h). It stands for irradiance / pi, but is none: each face sees only itself. The probe is a
// cube.
Probe blurredDiffuseMap(const Probe& cube, int radius, double sigma_px, Arithmetic arithmetic,
                        int threads = 0);

}  // namespace etalon
