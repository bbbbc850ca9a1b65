// Which triangles the faces of a cube map can show: found once for all six.
#pragma once

#include <array>
#include <vector>

#include "lighting/geometry.h"
#include "raster/cube_face.h"

namespace etalon {

// For each face (in the order of CubeFace) the numbers of the mesh's triangles that can cover a sample of it,
// ascending. A triangle is left out only if it lies on the outer side of one of the four planes through the
// centre that bound the face, moved out by 1/64 of the distance along the face's axis and by 2^-20 of the
// largest coordinate: more than snapping (rule 3) and the vertex arithmetic can move it in, at any size of
// the face. Vertices that are not finite leave their triangles in every list. centre: world space.
std::array<std::vector<uint32_t>, kCubeFaces> trianglesOfFaces(const PlacedMesh& mesh,
                                                               const glm::dvec3& centre, int threads);

// The near and far planes of the faces of a cube map that shows the meshes, all but `excluded`, from `centre`.
//   near: half of the depth that the nearest point of a triangle has at least, its distance / sqrt(3); not below
//         kCubeNearRatio of far, so that what is still nearer, as of a mesh that the centre lies in, is cut off
//   far: a little behind the farthest vertex
// From positions that are finite; 1 and 2 where there are none.
struct CubeDepths {
    double near_m = 1, far_m = 2;
};
inline constexpr double kCubeNearRatio = 0x1p-16;
CubeDepths cubeDepthsOf(const std::vector<PlacedMesh>& placed, const glm::dvec3& centre, uint32_t excluded,
                        int threads);

}  // namespace etalon
