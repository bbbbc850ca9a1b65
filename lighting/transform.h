// Transforms of many points, over lanes. Compiled once per level; callers go through
// lighting/lighting_passes.h.
#pragma once

#include "lighting/lighting_passes.h"

namespace etalon {

void transformPoints(RasterReal real, const TransformRows& rows, std::span<const glm::vec3> from,
                     std::span<glm::dvec3> to);
void projectPoints(RasterReal real, const TransformRows& rows, std::span<const glm::dvec3> from,
                   std::span<ClipVertex> to);

}  // namespace etalon
