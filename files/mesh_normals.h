// Vertex normals from the shape of a mesh.
#pragma once

#include <cstddef>
#include <vector>

#include "files/mesh.h"

namespace etalon {

// Fills the normals of the vertices for which missing[i] != 0 (missing.size() == positions.size()); the
// others stay. A normal is the sum of the cross products (twice the area times the normal) of all triangles
// that touch a vertex at exactly the same position, added in double in the order of the triangles, made a
// unit vector. A position that only zero-area triangles touch, or none, gets +Y. Returns how many of the
// filled normals are such +Y. Positions must be finite, indices valid.
size_t fillSmoothNormals(Mesh& mesh, const std::vector<uint8_t>& missing);

// Triangles whose area is exactly zero: two corners at one place, or three on a line. Computed in double.
size_t countZeroAreaTriangles(const Mesh& mesh);

}  // namespace etalon
