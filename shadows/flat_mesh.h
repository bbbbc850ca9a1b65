// Meshes that lie in a plane.
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/vec3.hpp>

#include "lighting/geometry.h"
#include "numeric/vectors.h"

namespace etalon {

// A vertex this much of the largest coordinate away from a plane lies in it: the error of fp32 vertices.
inline constexpr double kFlatness = 0x1p-20;

inline double largestOf(const glm::dvec3& a) {
    return std::max({std::fabs(a.x), std::fabs(a.y), std::fabs(a.z)});
}

// dotOf(normal, p) = offset, with a unit normal on either side; none where the mesh is not flat.
struct MeshPlane {
    bool exists = false;
    glm::dvec3 normal{0};
    double offset = 0;
    double tolerance_m = 0;  // of the mesh's own vertices
    double above(const glm::dvec3& p) const { return dotOf(normal, p) - offset; }
    // How far a vertex of any mesh may be from the plane and count as in it.
    double toleranceAt_m(const glm::dvec3& p) const {
        return std::max(tolerance_m, kFlatness * largestOf(p));
    }
};

// The plane in which all vertices of the mesh lie to kFlatness; none where one is not finite, or where all lie on a
// line.
MeshPlane planeOf(const PlacedMesh& mesh);

}  // namespace etalon
