// Conversion of a probe from any mapping to any mapping.
//
// For each texel of the result: the direction of its centre, turned from the frame of the result to that of
// the source, the point where the source shows it, and the source's texels there. Directions of lat-long
// texels come from tables of sines and cosines made in double; everything else per texel is kernel text
// (probes/kernels/{mapping,probe_sampler}.glsl) in the chosen arithmetic. One sample gives the texel
//   nearest: the texel that holds the point.
//   bilinear: the four texels around the point, as raster/sampler.h. No mapping has a seam: columns of a
//     lat-long image repeat and beyond its poles lies the pole's row half a turn further, cube maps are
//     sampled as raster/cube_face.h says, the borders of an octahedral image fold onto themselves. On the
//     rim of a disc (and where the source is not valid) texels without a direction are left out: of two
//     neighbours the one that has radiance counts alone, first along x, then along y.
//   area: samplesPerAxis^2 bilinear samples at the centres of the equal parts of the texel, each weighted
//     with the solid angle of its part: exact for lat-long, cube, octahedral images and the orthographic
//     mirror ball; of angular maps and near balls it is the density at the part's centre, which differs by a
//     share that falls with the square of the part's size, as does the error of the sample itself. Parts
//     whose centre is beyond the rim weigh nothing. In order, row by row: weight = weight + w, mean = mean +
//     (sample - mean) w / weight. Samples without radiance are left out.
// So a constant probe keeps exactly its constant in every arithmetic, results stay in the hull of the texels
// but for the rounding of the mean, and a non-finite texel makes those results NaN or infinite that it has a
// weight in.
//
// Validity: a texel of the result is valid if it has a direction (probes/texel_grid.h) and a sample with
// radiance; else its radiance and distance are 0. Directions behind a mirror ball and texels with
// source.valid = 0 have none. Distances are never blended: each is that of the nearest texel at the texel's
// centre, and 0 where that one is not valid.
#pragma once

#include "numeric/parallel.h"
#include "probes/mapping.h"
#include "raster/profile.h"

namespace etalon {

enum class Resampling : uint8_t { nearest, bilinear, area };

struct ProbeConversion {
    ProbeShape shape;        // of the result
    glm::dmat3 rotation{1};  // of the result (Probe::rotation)
    Resampling resampling = Resampling::bilinear;
    int samplesPerAxis = 4;  // of area, 1 .. kMaxSamplesPerAxis
    int fractionBits = kExactFraction;
    FilterRule rule = {};
};

// The radiance (and distance and validity, where the source has them) of the source as a probe of another
// shape or orientation, at the same position. `valid` of the result is empty if every texel is valid. Neither
// threads nor lanes change a bit. Sizes of the source are whole numbers of the arithmetic (raster/sampler.h).
Probe convertProbe(const Probe& source, const ProbeConversion& conversion,
                   Arithmetic arithmetic = Arithmetic::fp32, int threads = 0);

// The same into a probe, whose images are written over where they have the right sizes: repeated conversions
// need no new memory. The result is not the source.
void convertProbe(Probe& result, const Probe& source, const ProbeConversion& conversion,
                  Arithmetic arithmetic = Arithmetic::fp32, int threads = 0);

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
