// The points that shading asks about, to look their visibility up elsewhere.
#pragma once

#include <cstddef>
#include <functional>

#include "lighting/light_visibility.h"
#include "lighting/shade.h"

namespace etalon {

// One point for each fragment of the job's surfaces, in the order of one thread; keep(points, i), where
// given, decides whether point i is among them. The scene has a light. The job's request, visibility and
// threads do not matter.
LitPoints litPointsOf(const ShadeJob& job, const std::function<bool(const LitPoints&, size_t)>& keep = {});

}  // namespace etalon
