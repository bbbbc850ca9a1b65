// Directions and solid angles of the texels of a probe, in double.
#pragma once

#include <glm/vec3.hpp>
#include <optional>

#include "probes/latlong.h"
#include "probes/probe.h"

namespace etalon {

// The solid angle of texel (x, y) of a cube face of size x size texels, in steradians: four corner terms
// atan2(s t, sqrt(s^2 + t^2 + 1)). The texels of six faces add up to 4 pi (relative 1e-14).
double cubeTexelSolidAngle_sr(int size, int x, int y);

class TexelGrid {
  public:
    // A shape with width and height >= 1.
    explicit TexelGrid(const ProbeShape& shape);

    const ProbeShape& shape() const { return shape_; }

    // The unit direction of the centre of a texel, in the probe's frame.
    glm::dvec3 direction(int layer, int x, int y) const;
    // 0 for texels that show no direction.
    double solidAngle_sr(int layer, int x, int y) const;

  private:
    ProbeShape shape_;
    std::optional<LatLongGrid> latLong_;
    std::vector<double> cubeSolidAngle_sr_;  // of the texels of a face
};

}  // namespace etalon
