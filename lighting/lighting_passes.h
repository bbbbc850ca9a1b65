// The passes of lighting/ that are compiled once per instruction set level (numeric/isa.h).
#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <span>

#include "lighting/shading_passes.h"
#include "lighting/tone_map.h"
#include "raster/draw.h"
#include "raster/render_target.h"

namespace etalon {

// The rows of a 4x4 matrix.
using TransformRows = std::array<glm::dvec4, 4>;

struct LightingPasses {
    // All but truth, which has no lanes.
    ShadingPasses (*shading)(FragmentArithmetic arithmetic);
    Image<uint8_t> (*toneMap)(const Image<float>& radiance, ToneMap operation, double exposureStops,
                              int threads);
    // to[i] = the rows applied to (from[i], 1), in the vertex arithmetic; from and to have the same size.
    void (*transformPoints)(RasterReal real, const TransformRows& rows, std::span<const glm::vec3> from,
                            std::span<glm::dvec3> to);
    void (*projectPoints)(RasterReal real, const TransformRows& rows, std::span<const glm::dvec3> from,
                          std::span<ClipVertex> to);
    // lighting/vertex_lighting.h
    void (*lightVertices)(const Profile& profile, const SurfaceScene& scene, const SurfaceMaterial& material,
                          const PlacedMesh& placed, const glm::dvec3& eye, size_t begin, size_t count,
                          const VertexOcclusion* occlusion, VertexRadiance& radiance);
};

// Those of the active level.
const LightingPasses& lightingPasses();

}  // namespace etalon
