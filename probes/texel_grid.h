// Directions and solid angles of the texels of a probe, in double.
//
// Texels of a disc (angular, mirrorBall) that its rim cuts: their solid angle is that of the part on the
// disc, and a texel whose centre is beyond the rim has the direction of the nearest point of the rim. Texels
// without a part on the disc show no direction. All texels of a probe add up to 4 pi (relative 1e-14), those
// of a mirror ball at a finite distance to 4 pi less the cone of half angle asin(1 / distance) behind it, 2
// pi (1 - sqrt(1 - 1 / distance^2)).
#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "probes/mapping.h"
#include "probes/probe.h"

namespace etalon {

// The solid angle of texel (x, y) of a cube face of size x size texels, in steradians: four corner terms
// atan2(s t, sqrt(s^2 + t^2 + 1)). The texels of six faces add up to 4 pi (relative 1e-14).
double cubeTexelSolidAngle_sr(int size, int x, int y);

// True if directions lie on a disc, so that texels in the corners show none.
inline bool isDisc(Mapping mapping) { return mapping == Mapping::angular || mapping == Mapping::mirrorBall; }

// True if a part of the texel shows directions.
bool showsDirection(const ProbeShape& shape, int x, int y);

// Layers, sizes and channels are as the shape says; PreconditionError with what is wrong otherwise.
void checkProbe(const Probe& probe);

class TexelGrid {
  public:
    // A shape that checkShape (probes/mapping.h) accepts.
    explicit TexelGrid(const ProbeShape& shape);

    const ProbeShape& shape() const { return shape_; }

    // The unit direction of the centre of a texel, in the probe's frame; each component within 2^-48.
    glm::dvec3 direction(int layer, int x, int y) const;
    // 0 for texels that show no direction. Of discs: within kDiscSolidAngleError of a texel's mean solid
    // angle.
    double solidAngle_sr(int layer, int x, int y) const;

  private:
    ProbeShape shape_;
    MappingKernel<double>::MappingSettings settings_;
    std::optional<LatLongGrid> latLong_;
    // Of the texels of a face, or of the upper left quarter of a disc.
    std::vector<double> solidAngle_sr_;
};

// Up to 1024 texels across; it grows with the size, as do the roundings of a texel's borders against its
// area.
inline constexpr double kDiscSolidAngleError = 1e-12;

// The weights that papers print in place of solid angles, in steradians.
// [Pedersen2008, Eq. 5.11] with its missing differences: 2 pi / width * pi / height * sin(theta), where theta
// is that of the row's centre, or of its upper border, where the first row weighs nothing.
enum class RowAngle : uint8_t { centre, upperBorder };
double latLongMidpointSolidAngle_sr(int width, int height, int y, RowAngle angle);
// [Nowrouzezahrai2011, Eq. 7]: 4 / size^2 (1 + s^2 + t^2)^(-3/2) at the texel's centre.
double cubeMidpointSolidAngle_sr(int size, int x, int y);
// [Nowrouzezahrai2011, Eq. 6]: (2 pi / size)^2 sin(theta) / theta, theta the polar angle of the texel's
// centre; 0 for centres beyond the disc.
double angularMidpointSolidAngle_sr(int size, int x, int y);

}  // namespace etalon
