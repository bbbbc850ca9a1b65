// From a scene to a frame: makes the plan and runs its passes.
#pragma once

#include <string>
#include <vector>

#include "ar/plan.h"
#include "files/frame.h"
#include "scene/scene.h"

namespace etalon {

struct RenderResult {
    Frame frame;                        // the outputs as channels, with metadata
    std::vector<OutputFile> files;      // outputs that are files of their own
    Image<uint8_t> toned;               // the tone mapped beauty, where a PNG was asked for
    Plan plan;                          // as it ran: passes with their times, without their results
    std::vector<std::string> warnings;  // one line each
    RasterStatistics raster;            // of the camera's view
    ShadeStatistics shading;
};

// Renders the scene. Throws InputError "file:line: reason" for files that cannot be used and for images that
// need more memory than the machine has.
RenderResult renderScene(const Scene& scene, const RenderOptions& options);

// The plan as renderScene begins with it: places the geometry, and draws nothing.
Plan planScene(const Scene& scene, const RenderOptions& options);

}  // namespace etalon
