// Ambient occlusion of what a view shows, for shading it (lighting/shade.h).
#pragma once

#include <vector>

#include "lighting/shade.h"
#include "shadows/ambient_occlusion.h"

namespace etalon {

// Of every fragment, at the point and with the normal that it is shaded with (ShadeJob::occlusion).
TileOcclusion fragmentOcclusion(const ShadeJob& job, const DirectionalOptions& options);

// Of the vertices of the instances that the job's target shows, on both sides (lightVerticesOf); the others
// stay empty.
std::vector<VertexOcclusion> vertexOcclusion(const ShadeJob& job, const DirectionalOptions& options);

}  // namespace etalon
