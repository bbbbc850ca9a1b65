// Transforms of many points, over lanes.
#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <span>

#include "raster/draw.h"
#include "raster/render_target.h"

namespace etalon {

// The rows of a 4x4 matrix.
using TransformRows = std::array<glm::dvec4, 4>;

// to[i] = the rows applied to (from[i], 1), in the vertex arithmetic; from and to have the same size.
struct TransformPasses {
    void (*transformPoints)(RasterReal real, const TransformRows& rows, std::span<const glm::vec3> from,
                            std::span<glm::dvec3> to);
    void (*projectPoints)(RasterReal real, const TransformRows& rows, std::span<const glm::dvec3> from,
                          std::span<ClipVertex> to);
};

}  // namespace etalon
