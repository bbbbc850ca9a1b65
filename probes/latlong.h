// Latitude-longitude images of the environment. The texts are probes/kernels/latlong.glsl.
//
// Orientation as in OpenEXR's envmap convention [OpenEXR, ImfEnvmap.h], with +Y up:
//   longitude = atan2(x, z), latitude = atan2(y, sqrt(x^2 + z^2)),
//   u = 1/2 - longitude / (2 pi), v = 1/2 - latitude / pi:
// the middle of the image is +Z, +X is a quarter from its left border, -X a quarter from its right one, the
// upper border is +Y. Texel centres are at ((i + 1/2) / width, (j + 1/2) / height). OpenEXR's own pixel
// positions put the centres of the first and the last pixel on the borders instead (u = i / (width - 1)), so
// that both columns show the same direction and each pole has a row of its own; that is not followed.
//
// Degenerate directions: straight up and down have longitude 0, the zero direction is +Z; NaN counts as u = 0
// or v = 0. The squares of x and z neither overflow nor vanish in the number type.
//
// Sampling: as raster/sampler.h (nearest or bilinear, fraction bits, tap order, hull). Columns repeat. Beyond
// a pole lies the pole's own row half a turn further (width / 2 columns, rounded down), so that bilinear
// sampling is continuous along every great circle through a pole if the width is even. Of `Sampling` the wrap
// modes are not used.
#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "numeric/elementary.h"
#include "numeric/kernel_types.h"
#include "probes/laned_columns.h"
#include "raster/cube_face.h"
#include "raster/image.h"
#include "raster/sampler.h"
#include "raster/texture.h"

namespace etalon {

// Largest error of u and v in float against exact arithmetic, direction exact; u at its border counts
// modulo 1.
inline constexpr double kLatLongFloatError = 0x1p-23;

// The texts over T: latLongCoordinates, sampleLatLong(texture, direction, sampling).
template <class T>
struct LatLongKernel {
#include "numeric/kernel_scope.inc"
#include "raster/texture_scope.inc"
#include "raster/kernels/sampler.glsl"
#include "probes/kernels/latlong.glsl"
#include "raster/kernels/cube_face.glsl"
};

// What cube_of_latlong.glsl reads, and the text, over T: the parts of the texels of a row from a column on.
template <class T>
struct CubeOfLatLongKernel {
#include "numeric/kernel_scope.inc"
#include "numeric/kernels/vector.glsl"
#include "raster/texture_scope.inc"
#include "raster/kernels/sampler.glsl"
#include "raster/kernels/cube_face.glsl"
#include "probes/kernels/latlong.glsl"
    struct Texels {
        const LanedColumns<T>* columns;
        int rows, partsPerAxis;
        size_t column = 0;
        int row = 0;
    };
    Texels texels;

    real partU(int i) const { return texels.columns->at(texels.column, i); }
    real partV(int j) const { return T(coordinateOf(texels.row, j, texels.rows, texels.partsPerAxis)); }
#include "probes/kernels/cube_of_latlong.glsl"
};

// Directions and solid angles of the texels of a lat-long image, from tables per row and column in double.
class LatLongGrid {
  public:
    // width, height >= 1.
    LatLongGrid(int width, int height);

    int width() const { return static_cast<int>(sinLongitude_.size()); }
    int height() const { return static_cast<int>(sinLatitude_.size()); }

    // The unit direction of the centre of texel (x, y); each component within 2^-50.
    glm::dvec3 direction(int x, int y) const {
        const auto i = static_cast<size_t>(x), j = static_cast<size_t>(y);
        return {sinLongitude_[i] * cosLatitude_[j], sinLatitude_[j], cosLongitude_[i] * cosLatitude_[j]};
    }
    // Of column x and of row y.
    double sinLongitude(int x) const { return sinLongitude_[static_cast<size_t>(x)]; }
    double cosLongitude(int x) const { return cosLongitude_[static_cast<size_t>(x)]; }
    double sinLatitude(int y) const { return sinLatitude_[static_cast<size_t>(y)]; }
    double cosLatitude(int y) const { return cosLatitude_[static_cast<size_t>(y)]; }
    // Solid angle of each texel of row y, in steradians; over the image they add up to 4 pi (relative 2^-48).
    double solidAngle_sr(int y) const { return solidAngle_sr_[static_cast<size_t>(y)]; }

  private:
    std::vector<double> sinLongitude_, cosLongitude_, sinLatitude_, cosLatitude_, solidAngle_sr_;
};

// How cubeFromLatLong samples.
struct CubeFromLatLong {
    Filter filter = Filter::bilinear;
    int fractionBits = kExactFraction;
    int samplesPerAxis = 1;  // per cube texel, on a regular grid; 1 .. kMaxSamplesPerAxis
    FilterRule rule = {};
};
inline constexpr int kMaxSamplesPerAxis = 64;

// The cube map of size x size texels per face that shows the lat-long image (3 channels): each texel is the
// mean, summed in rows, of samplesPerAxis^2 samples at the centres of its equal parts in the face's plane. T
// is the number type of the arithmetic; neither threads nor lanes change a bit.
template <class T>
CubeMap<float> cubeFromLatLong(const Image<float>& latLong, int size, const CubeFromLatLong& options = {},
                               int threads = 0) {
    ETALON_CHECK(latLong.channels() == 3 && size > 0, "{} channels, size {}", latLong.channels(), size);
    const int parts = options.samplesPerAxis;
    ETALON_CHECK(parts >= 1 && parts <= kMaxSamplesPerAxis, "{} samples per axis", parts);
    using Kernel = CubeOfLatLongKernel<T>;
    constexpr int kWidth = Number<T>::lanes;
    const TextureView texture(latLong);
    const auto sampling =
        samplingOf<Kernel>({options.filter, Wrap::repeat, Wrap::clamp, options.fractionBits, options.rule},
                           latLong.width(), latLong.height());
    const LanedColumns<T> columns(size, parts,
                                  [&](int x, int part) { return coordinateOf(x, part, size, parts); });
    const T share(1.0 / (parts * parts));

    CubeMap<float> cube(size, 3);
    parallelForRowBlocks(size, threads, [&](int y0, int y1) {
        Kernel kernel{{&columns, size, parts}};
        for (int face = 0; face < kCubeFaces; face++) {
            Image<float>& image = cube.faces[static_cast<size_t>(face)];
            forEachLaneGroup<kWidth>(static_cast<size_t>(size), [&](size_t first, int active) {
                kernel.texels.column = first;
                for (int y = y0; y < y1; y++) {
                    kernel.texels.row = y;
                    const auto rgb = kernel.cubeTexelOfLatLong(texture, face, parts, share, sampling);
                    for (int c = 0; c < 3; c++)
                        Number<T>::store(rgb[c], image.row(y, c).data() + first, active);
                }
            });
        }
    });
    return cube;
}

// The same in the default profile: float arithmetic in lanes.
CubeMap<float> cubeFromLatLong(const Image<float>& latLong, int size, const CubeFromLatLong& options = {},
                               int threads = 0);

}  // namespace etalon
