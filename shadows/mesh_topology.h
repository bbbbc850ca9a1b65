// Which triangles of a mesh share edges.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace etalon {

// A triangle at an edge: `direction` is 1 if it runs along the edge from -> to, -1 if it runs back.
struct EdgeUse {
    uint32_t triangle;
    int32_t direction;
};

// uses[firstUse], ..., in the order of the triangles.
struct MeshEdge {
    uint32_t from, to;  // vertices of the mesh, from < to
    uint32_t firstUse, useCount;
};

// Vertices at the same place (the same coordinates to the bit, -0 as 0) count as one; of several the first
// stands for all. Triangles of which two corners are one vertex have no edges, triangles with a coordinate
// outside the range of shadows/exact_side.h (NaN, infinity) are left out: they appear in no edge.
struct MeshTopology {
    std::vector<MeshEdge> edges;
    std::vector<EdgeUse> uses;
    std::vector<uint8_t> isUsed;  // for each triangle: not left out

    uint32_t leftOut = 0;          // triangles with coordinates out of range
    uint32_t degenerate = 0;       // triangles with two corners in one place
    uint32_t openEdges = 0;        // of one triangle
    uint32_t crowdedEdges = 0;     // of more than two: not a manifold
    uint32_t discordantEdges = 0;  // of two triangles that run along it in the same direction

    // Parts: triangles that share edges, directly or through others. Those of part p are
    // trianglesOfParts[firstOfPart[p]], ... up to firstOfPart[p + 1]; triangles without edges are in none.
    std::vector<uint32_t> trianglesOfParts, firstOfPart;
    // Whether the directions along each of its edges add up to zero, so that the part bounds a solid.
    std::vector<uint8_t> isClosed;

    size_t partCount() const { return isClosed.size(); }
    std::span<const uint32_t> trianglesOf(size_t part) const {
        return std::span(trianglesOfParts)
            .subspan(firstOfPart[part], firstOfPart[part + 1] - firstOfPart[part]);
    }
};

// indices: three per triangle, each below positions.size().
MeshTopology topologyOf(std::span<const glm::dvec3> positions, std::span<const uint32_t> indices);

}  // namespace etalon
