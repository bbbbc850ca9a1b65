// Per-vertex (Gouraud) lighting: what the lights reflect from each vertex, in the profile's vertex
// arithmetic, for fragments to interpolate.
#pragma once

#include <array>
#include <vector>

#include "lighting/geometry.h"
#include "lighting/occlusion.h"
#include "lighting/surface_scene.h"
#include "raster/profile.h"

namespace etalon {

// Of each vertex of a placed mesh, on its front side [0] and, with the normal turned round, on its back [1].
// The doubles hold values of the vertex arithmetic.
struct VertexRadiance {
    struct Side {
        std::vector<glm::dvec3> diffuse, specular;
        std::vector<double> open;  // Occlusion::open, for the ambient light; empty: 1
    };
    std::array<Side, 2> sides;
};

struct VertexLightingPasses {
    // In the vertex arithmetic of the profile: lights vertices begin .. begin + count - 1 as seen from `eye`;
    // the sides have the size of the mesh. occlusion: of its vertices; null: all are open.
    void (*light)(const Profile& profile, const LightSources& sources, const SurfaceMaterial& material,
                  const PlacedMesh& placed, const glm::dvec3& eye, size_t begin, size_t count,
                  const VertexOcclusion* occlusion, VertexRadiance& radiance);
};

}  // namespace etalon
