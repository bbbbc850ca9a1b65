// Triangle meshes in memory.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

namespace etalon {

// An indexed triangle list in object space, metres. normals[i] belongs to positions[i] and has unit length
// (to within 1e-7). indices: three per triangle, counter-clockwise seen from the front, each below
// positions.size(). All numbers are finite; -0 does not occur in positions.
struct Mesh {
    std::vector<glm::vec3> positions, normals;
    std::vector<uint32_t> indices;

    size_t triangleCount() const { return indices.size() / 3; }
};

}  // namespace etalon
