// The points that a view shades, as one list.
#pragma once

#include <cstddef>
#include <functional>

#include "lighting/light_visibility.h"
#include "lighting/shade.h"

namespace etalon {

// fragmentPoints(job) of all tiles behind each other; keep(points, i), where given, decides whether point i
// is among them.
LitPoints litPointsOf(const ShadeJob& job, const std::function<bool(const LitPoints&, size_t)>& keep = {});

}  // namespace etalon
