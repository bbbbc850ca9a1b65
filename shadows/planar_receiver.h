// What a planar shadow falls on: a plane, bounded by a polygon.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <optional>
#include <vector>

#include "lighting/geometry.h"
#include "shadows/plane_projection.h"

namespace etalon {

// The polygon as triangles in the frame's coordinates (s, t), three indices each: any shape, with holes, in
// parts.
struct PlanarReceiver {
    PlaneFrame frame;
    std::vector<glm::dvec2> corners_m;
    std::vector<uint32_t> indices;

    // The rectangle around the polygon; 0 for none.
    glm::dvec2 lowest_m() const;
    glm::dvec2 highest_m() const;
    // The same polygon, lit and seen from its other side.
    PlanarReceiver reversed() const;
};

// The receiver that a placed mesh is, if its vertices are in one plane to kFlatness (shadows/flat_mesh.h): that of its
// triangle of largest area, whose vertices in their order give the front (counter-clockwise, as the mesh is
// placed). None for a mesh without area.
std::optional<PlanarReceiver> planarReceiverOf(const PlacedMesh& mesh);

}  // namespace etalon
