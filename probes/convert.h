// Conversion of a probe from any mapping to any mapping.
//
// What a texel of the result shows:
//   area: the mean of the source over the texel's solid angle, where each texel of the source is one radiance all over:
//     its texels, weighted with the solid angles that they have in common with the texel (probes/texel_overlaps.h,
//     made in double and relative to the largest of a texel), in the order of layers, rows and columns in runs of
//     32, by the text probes/kernels/texel_overlaps.glsl. Radiance times solid angle, summed over directions, is
//     that of the source within kAreaEnergyError, whatever the sizes, and every texel of the source counts as much
//     as its solid angle. Where the result's texels are the smaller ones, those inside one texel of the source show
//     its radiance: nothing is blended.
//   nearest, bilinear: point samples. The direction of the texel's centre, turned from the frame of the result to that
//     of the source, the point where the source shows it, and the source's texel there or the four around it. What lies
//     between the points is not seen: where texels of the result are larger than those of the source
//     (minificationOf) a small sun is lost or counted several times. Directions of lat-long texels come from tables of
//     sines and cosines made in double; everything else is kernel text (probes/kernels/{mapping,probe_sampler}.glsl)
//     in the chosen arithmetic. Bilinear is as raster/sampler.h. No mapping has a seam: columns of a lat-long image
//     repeat and beyond its poles lies the pole's row half a turn further, cube maps are sampled as
//     raster/cube_face.h says, the borders of an octahedral image fold onto themselves. On the rim of a disc (and
//     where the source is not valid) texels without a direction are left out: of two neighbours the one that has
//     radiance counts alone, first along x, then along y.
// The mean grows: weight = weight + w, mean = mean + (value - mean) w / weight. So a constant probe keeps exactly its
// constant in every arithmetic, results stay in the hull of the texels but for the rounding of the mean, and a
// non-finite texel makes those results NaN or infinite that it has a weight in. Texels without radiance are left out.
//
// Validity: a texel of the result is valid if it has a direction (probes/texel_grid.h) and a sample, or a texel of
// the source, with radiance; else its radiance and distance are 0. Directions behind a mirror ball and texels with
// source.valid = 0 have none. A texel that sees some of both shows the mean of what it sees, as if it were all of it.
// Distances are never blended: each is that of the nearest texel at the texel's centre, and 0 where that one is not
// valid.
#pragma once

#include "numeric/parallel.h"
#include "probes/mapping.h"
#include "raster/profile.h"

namespace etalon {

enum class Resampling : uint8_t { nearest, bilinear, area };

struct ProbeConversion {
    ProbeShape shape;        // of the result
    glm::dmat3 rotation{1};  // of the result (Probe::rotation)
    Resampling resampling = Resampling::area;
    int fractionBits = kExactFraction;  // of bilinear
    FilterRule rule = {};               // of bilinear and nearest
};

// Of the flux of any texel of the source that has radiance, the largest difference in the result by area, but for the
// rounding of the arithmetic: relative to its own flux, or, where a disc's rim cuts the texel, kRimEnergyError of
// that of a whole one as bright. Of near mirror balls it holds for the texels that are seen whole: beside what a ball
// does not show a texel of the result shows what it sees of the rim all over.
inline constexpr double kAreaEnergyError = 1e-5;
inline constexpr double kRimEnergyError = 1e-4;

// The radiance (and distance and validity, where the source has them) of the source as a probe of another
// shape or orientation, at the same position. `valid` of the result is empty if every texel is valid. Neither
// threads nor lanes change a bit. Sizes of a source that is point sampled, or has distances, are whole numbers of the
// arithmetic (raster/sampler.h).
Probe convertProbe(const Probe& source, const ProbeConversion& conversion,
                   Arithmetic arithmetic = Arithmetic::fp32, int threads = 0);

// The same into a probe, whose images are written over where they have the right sizes: repeated conversions
// need no new memory. The result is not the source.
void convertProbe(Probe& result, const Probe& source, const ProbeConversion& conversion,
                  Arithmetic arithmetic = Arithmetic::fp32, int threads = 0);

// The solid angle of a texel of the result relative to that of the source's texel at its centre, where it is largest;
// of the mappings' texels, whether they are valid or not. Above kMinified, point samples lose or gain light.
double minificationOf(const Probe& source, const ProbeConversion& conversion);
inline constexpr double kMinified = 2;

// A probe from six faces or one image, without distance; and the faces of a probe of the mapping cube.
Probe probeOf(const CubeMap<float>& cube);
Probe probeOf(const Image<float>& image, Mapping mapping);
CubeMap<float> cubeMapOf(Probe probe);

// How latLongFromCube looks the cube map up.
enum class CubeEdges : uint8_t {
    seamless,  // raster/cube_face.h
    perFace    // each face clamps at its own border, as the GPUs of [Pedersen2008] did
};
struct LatLongFromCube {
    Filter filter = Filter::bilinear;
    int fractionBits = kExactFraction;
    CubeEdges edges = CubeEdges::seamless;
    FilterRule rule = {};
};

// The papers' path: one lookup of a cube map of three channels per texel of a lat-long image, in the
// convention of [Pedersen2008, Listing 6.1] (Mapping::latLongPedersen; row 0 on top) with sines and cosines
// in the arithmetic, as a GPU computes them.
Image<float> latLongFromCube(const CubeMap<float>& cube, int width, int height,
                             const LatLongFromCube& options = {}, Arithmetic arithmetic = Arithmetic::fp32,
                             int threads = 0);

}  // namespace etalon
