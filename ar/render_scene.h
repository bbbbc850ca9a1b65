// From a scene to a frame: loads what the plan needs, runs its passes.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "ar/frame.h"
#include "ar/plan.h"
#include "ar/scene.h"
#include "raster/profile.h"
#include "raster/rasterizer.h"

namespace etalon {

struct RenderOptions {
    PlanRequest request;
    std::optional<Profile> profile;  // none: the scene's
    RasterOptions raster;            // threads and tile size; change no bit
    bool strict = false;             // questionable input (negative or NaN radiance) is an error
    std::function<void(const std::string& pass)> progress;
    std::function<void(uint64_t bytes)> announceMemory;  // called before memory of that size is taken
};

struct RenderResult {
    Frame frame;                        // the outputs as channels, with metadata
    Image<float> beauty;                // three channels, when the plan has a beauty
    Plan plan;                          // as it ran
    std::vector<std::string> warnings;  // one line each
    RasterStatistics raster;            // of the camera's view
    ShadeStatistics shading;
};

// Renders the scene. Throws InputError "file:line: reason" for files that cannot be used and for images that
// need more memory than the machine has.
RenderResult renderScene(const Scene& scene, const RenderOptions& options);

// The plan as renderScene would run it: loads the geometry and finds what is visible.
Plan planScene(const Scene& scene, const RenderOptions& options);

}  // namespace etalon
