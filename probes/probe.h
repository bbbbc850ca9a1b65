// A light probe: radiance over directions, on the texels of a mapping.
#pragma once

#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <limits>
#include <vector>

#include "raster/image.h"

namespace etalon {

// How directions lie on images; probes/mapping.h has the formulas.
//   latLong: one image, any width and height (probes/latlong.h)
//   cube: six square images, the faces +X -X +Y -Y +Z -Z (raster/cube_face.h)
//   angular: one square image, the polar angle grows linearly with the radius [Debevec98]
//   mirrorBall: one square image, a mirror ball that fills it, seen from ballDistance_radii
//   octahedral: one square image, of equal areas [Clarberg2008]
//   latLongPedersen: as latLong, with the axes of [Pedersen2008, Listing 6.1]
// The numbers are those of probes/kernels/mapping.glsl.
enum class Mapping : uint8_t {
    latLong = 0,
    cube = 1,
    angular = 2,
    mirrorBall = 3,
    octahedral = 4,
    latLongPedersen = 5
};

// True if rows are latitudes and columns longitudes.
inline bool isLatLong(Mapping mapping) {
    return mapping == Mapping::latLong || mapping == Mapping::latLongPedersen;
}

// A mapping with its texels.
struct ProbeShape {
    Mapping mapping = Mapping::latLong;
    int width = 0, height = 0;  // of each image; height is width for all but lat-long
    // Of mirrorBall: from the eye to the middle of the ball in radii of the ball, above 1; infinity is the
    // orthographic view.
    double ballDistance_radii = std::numeric_limits<double>::infinity();

    int layers() const { return mapping == Mapping::cube ? 6 : 1; }

    friend bool operator==(const ProbeShape&, const ProbeShape&) = default;
};

// rotation takes directions of the probe's own frame to the world, its determinant is 1; position_m is where
// the probe was taken, in the world.
struct Probe {
    ProbeShape shape;
    std::vector<Image<float>> radiance;    // for each layer three channels, W/(m^2 sr)
    std::vector<Image<float>> distance_m;  // empty, or for each layer the distance along the direction
    std::vector<Image<uint8_t>> valid;     // empty: every texel shows radiance; else 1 or 0 for each texel
    glm::dmat3 rotation{1};
    glm::dvec3 position_m{0};
};

}  // namespace etalon
