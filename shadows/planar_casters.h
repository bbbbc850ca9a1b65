// What casts a shadow on a plane: triangles in the plane's own coordinates, cut where they cast none.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "lighting/geometry.h"
#include "shadows/plane_projection.h"

namespace etalon {

// Triangles in a frame's coordinates (s, t, height), three indices each. Vertices that no triangle uses may
// be there.
struct PlanarCasters {
    std::vector<glm::dvec3> vertices;
    std::vector<uint32_t> indices;

    // Of the vertices that triangles use; 0 for none.
    double highest() const;
};

enum class KeepSide : uint8_t { above, below };

// The part of the triangles at `height` and on the side that is kept. A triangle that has no vertex inside
// that side (on the plane does not count) is dropped. Cuts are in double: from the vertex a that is kept to
// the vertex b that is not, t = d_a / (d_a - d_b) with the distances d from the plane, a + t (b - a) in s and
// t, and the height is exactly `height`; so triangles that share an edge have it cut at the same bits.
PlanarCasters clipAtHeight(const PlanarCasters& casters, double height_m, KeepSide keep);

// The triangles of the meshes above a plane. Heights of magnitude up to contact_m are on the plane: what is
// coplanar with it within contact_m casts nothing. Triangles with a coordinate that is not finite are
// dropped.
PlanarCasters castersAbove(const PlaneFrame& frame, std::span<const PlacedMesh* const> meshes,
                           double contact_m);

}  // namespace etalon
