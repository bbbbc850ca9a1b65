// How much of their surroundings points of surfaces see, for what lights from everywhere: ambient occlusion
// and bent normals [Landis2002]. Found in shadows/.
#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <vector>

namespace etalon {

struct OcclusionPoint {
    glm::dvec3 position_m{0};
    glm::dvec3 normal{0};  // unit; zero: no surface
};

struct Occlusion {
    double open = 1;           // 0 to 1; 1 for points without a surface
    glm::dvec3 bentNormal{0};  // unit: the mean of the open directions, weighted by the cosine; the normal
                               // where nothing is open
};

// Of the vertices of a placed mesh: on its front side [0] and, with the normal turned round, on its back [1].
using VertexOcclusion = std::array<std::vector<Occlusion>, 2>;

// Of the fragments of each tile of a view, in the order of fragmentPoints() (lighting/shade.h).
using TileOcclusion = std::vector<std::vector<Occlusion>>;

}  // namespace etalon
