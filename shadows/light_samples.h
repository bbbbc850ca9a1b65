// Points that stand for an area light: a jittered, stratified grid on a patch [Karlsson2005, sec. 3.2.2;
// Heckbert1997].
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <vector>

namespace etalon {

// The most samples of a light.
inline constexpr int kMaxLightSamples = 65536;

// `count` points of [0, 1)^2, one in each of as many cells of equal area: rows of cells, about as many as
// cells in a row; a count that is no product of two such numbers has rows of k and of k + 1 cells, and the
// rows' heights are as their numbers of cells. In a cell the point is at random, x before y, from
// Random(seed) in the order of the cells. One sample is the centre, without jitter. 1 <= count <=
// kMaxLightSamples.
std::vector<glm::dvec2> stratifiedSamples(int count, uint64_t seed);

// The parallelogram centre +- halfU +- halfV. Each sample is (x, y, z, 1). With both halves zero every sample
// is the centre to the bit.
struct RectangularPatch {
    glm::dvec3 centre_m{0};
    glm::dvec3 halfU_m{0}, halfV_m{0};
};
std::vector<glm::dvec4> lightSamples(const RectangularPatch& patch, int count, uint64_t seed);

// A disc around a homogeneous centre: centre + radius r (cos(a) u + sin(a) v) with u and v perpendicular to
// the axis, in cells of equal area: x of the cell gives the angle, the root of y the distance from the
// centre. Of a place (w = 1) lengths are in metres; of a direction (w = 0, unit) the radius is the tangent of
// half the angle that the light subtends. A radius of 0, and one sample: the centre to the bit. axis: not
// zero; radius >= 0.
struct DiscPatch {
    glm::dvec4 centre{0, 0, 0, 1};
    glm::dvec3 axis{0, 1, 0};
    double radius = 0;
};
std::vector<glm::dvec4> lightSamples(const DiscPatch& patch, int count, uint64_t seed);

// A patch of a sphere around the objects, in spherical coordinates about its middle: longitudes up to
// halfLongitude_rad to each side of `direction`, latitudes up to halfLatitude_rad, cells of equal area.
// radius_m infinite: samples are directions, (x, y, z, 0); else places, (x, y, z, 1). direction: towards the
// middle of the patch, not zero. Angles in [0, pi] and [0, pi / 2]; both zero: every sample is the middle to
// the bit.
struct SphericalPatch {
    glm::dvec3 centre_m{0};
    double radius_m = 0;
    glm::dvec3 direction{0, 1, 0};
    double halfLongitude_rad = 0, halfLatitude_rad = 0;
};
std::vector<glm::dvec4> lightSamples(const SphericalPatch& patch, int count, uint64_t seed);

}  // namespace etalon
