// Meshes that lie in a plane: by their own shape in double, wherever they are placed and in whatever arithmetic.
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/vec3.hpp>

#include "lighting/geometry.h"
#include "numeric/transform.h"
#include "numeric/vectors.h"

namespace etalon {

// A vertex this much of the diagonal of its mesh's box away from a plane lies in it: the error of the floats of mesh files.
inline constexpr double kFlatness = 0x1p-20;

inline double largestOf(const glm::dvec3& a) {
    return std::max({std::fabs(a.x), std::fabs(a.y), std::fabs(a.z)});
}

// A vertex in the world, in double.
inline glm::dvec3 exactPosition(const PlacedMesh& mesh, size_t vertex) {
    return transformPoint(mesh.toWorld, glm::dvec3(mesh.mesh->positions[vertex]));
}

// dotOf(normal, p) = offset, with a unit normal on either side; none where the mesh is not flat.
struct MeshPlane {
    bool exists = false;
    glm::dvec3 normal{0};
    double offset = 0;
    double tolerance_m = 0;  // of the mesh's vertices, whether it is flat or not
    double above(const glm::dvec3& p) const { return dotOf(normal, p) - offset; }
};

// The plane in which all vertices of the mesh lie; none where one is not finite, or where all lie on a line.
MeshPlane planeOf(const PlacedMesh& mesh);

}  // namespace etalon
