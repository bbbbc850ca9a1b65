// What cannot reach what, seen from the geometry alone: lights behind surfaces, and surroundings in which nothing
// occludes. Both answer for every view, and for every arithmetic that rounds to so many significand bits.
#pragma once

#include <span>
#include <vector>

#include "lighting/geometry.h"
#include "lighting/surface_scene.h"
#include "numeric/arithmetic.h"

namespace etalon {

// The bits that numbers of the arithmetic are rounded to; of truth no more than those of a double.
int significandBitsOf(const Arithmetic& arithmetic);

// False only if the light adds exactly nothing to any point of the mesh, on the side that is seen: the mesh is seen
// from its front alone, and in all of each triangle the interpolated normal turns away from the light, by more than
// the rounding of the arithmetic (64 units of its last place). A mesh that is seen from both sides is reached.
bool lightReaches(const PlacedMesh& placed, bool twoSided, const SurfaceLight& light, int significandBits);

// True only if directionalOcclusion() (shadows/ambient_occlusion.h) with maps of mapSize texels finds that all points
// of the marked instances are open: each of these is flat (shadows/flat_mesh.h), its normals are that of its plane to
// 1/64 of a texel over the scene, and no vertex of the scene lies in front of it, or, where it is seen from both sides,
// off its plane. Where the arithmetic, or that of vertices, rounds points and normals by as much as that, false.
bool isAllOpen(std::span<const PlacedMesh> placed, std::span<const SurfaceInstance> instances,
               const std::vector<bool>& marked, int mapSize, int significandBits);

}  // namespace etalon
