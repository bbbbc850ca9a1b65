// The space behind a mesh as seen from a light: shadow volumes [Crow77] [Everitt2002], for any triangles.
//
// Each triangle that casts bounds a volume by itself: the triangle, turned to face the light (its light cap),
// the same infinitely far behind it (its dark cap), and a side for each edge, drawn away from the light to
// infinity. The volumes add up: a side appears as often as more triangles run along an edge one way than the
// other (Kim et al. [Kim2008] count so), which leaves the silhouette of a closed mesh and the borders of an
// open one, and is right for edges of any number of triangles in any orientation. What a point counts,
// volumes entered less volumes left on the way to it, is the number of casting triangles between it and the
// light.
//
// Which triangles cast:
//   - of a closed part of the mesh with the light outside it: those that face the light, and their silhouette
//     once;
//   - of other parts: all, each turned to the light. A closed part around the light shadows everything
//   beyond.
// Triangles whose plane holds the light cast nothing. Facing is decided exactly (shadows/exact_side.h).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "shadows/mesh_topology.h"
#include "shadows/visibility_oracle.h"

namespace etalon {

// What a mesh casts from one light. Vertex v < n is vertex v of the mesh; vertex n + v is the point
// infinitely far behind it: (position - light, 0), or the one vertex n, (-towards, 0), of a light at
// infinity.
struct ShadowVolume {
    // The triangles that cast, as they stand in the mesh: those that face the light, and those that face
    // away.
    std::vector<uint32_t> facing, away;
    // Sides: triangles, three vertex numbers each, counter-clockwise from outside the volume.
    std::vector<uint32_t> sides;
    uint32_t silhouetteEdges = 0;  // with sides
    uint32_t closedParts = 0;      // that cast the first of the two ways above

    bool empty() const { return facing.empty() && away.empty(); }
};

// The signed volume of a closed part is positive if its triangles are counter-clockwise from outside.
double signedVolume(std::span<const glm::dvec3> positions, std::span<const uint32_t> indices,
                    std::span<const uint32_t> triangles);

// Whether a point is inside the solid that a closed part bounds, or close to its surface: the solid angle of
// the surface around the point is not zero.
bool mayBeInside(std::span<const glm::dvec3> positions, std::span<const uint32_t> indices,
                 std::span<const uint32_t> triangles, const glm::dvec3& point);

// topology: that of the same mesh. Throws PreconditionError for a light with a coordinate outside the range
// of shadows/exact_side.h (NaN, infinity). Threads change no bit.
ShadowVolume shadowVolumeOf(std::span<const glm::dvec3> positions, std::span<const uint32_t> indices,
                            const MeshTopology& topology, const LightSource& light, int threads);

}  // namespace etalon
