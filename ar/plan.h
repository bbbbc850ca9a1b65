// The plan: which passes a scene and the requested outputs need, and why each other one does not run.
//
// A plan is the passes themselves. It is made before anything is known but the scene file, and assumes that whatever
// may be visible is. Three passes refine it when they have run: "geometry" (what lights can reach, what can occlude
// and cast), "visibility" (what a pixel shows) and "environment light" (which of its lights cast shadows). They
// prune the passes behind them, and put in others; what they may still change says so in Pass::dependsOn. So far as
// a decision is made it stays: more knowledge only ends passes, or puts those of the environment's lights in.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "ar/pass.h"
#include "ar/plan_facts.h"
#include "ar/scene_passes.h"
#include "files/json.h"
#include "raster/rasterizer.h"
#include "scene/scene.h"

namespace etalon {

struct Plan;

// What is asked for beyond the scene's own outputs.
struct PlanRequest {
    std::vector<std::string> outputs;  // of outputNames(); empty: those of the scene
    bool png = false;                  // a tone mapped image is written
};

// How far a render is: before each pass (step 0), and while one runs. pass: its number among `passes` of the plan as it
// is now; step, part: of it (numeric/progress.h).
struct RenderProgress {
    const Plan* plan = nullptr;
    size_t pass = 0;
    int step = 0;
    double part = 0;
};

struct RenderOptions {
    PlanRequest request;
    std::optional<Profile> profile;  // none: the scene's
    RasterOptions raster;            // threads and tile size; change no bit
    bool strict = false;             // questionable input (negative or NaN radiance) is an error
    // Every pass runs, and shading evaluates also what is black; no bit of an output changes, as far as no number
    // overflows.
    bool everything = false;
    std::function<void(const RenderProgress&)> progress;  // may come from any thread, one call at a time
    std::function<void(uint64_t bytes)> announceMemory;   // called before memory of that size is taken
};

// What the passes yield that is not read by others. Those of a refined plan replace those of the plan before.
struct PlanResults {
    std::optional<Result<Geometry>> geometry;
    std::optional<Result<VisibleView>> visibility;
    std::optional<Result<EnvironmentImage>> environmentImage;
    std::optional<Result<EnvironmentIllumination>> illumination;  // where the environment lights surfaces
    std::optional<Result<Shading>> shading;
    std::optional<Result<Frame>> frame;
    std::optional<Result<std::vector<OutputFile>>> cubeFiles, mapFiles;
    std::vector<std::string> notMade;  // of these files: warnings
    std::optional<Result<Image<uint8_t>>> toned;
};

struct Plan : PassList {
    std::shared_ptr<PlanResults> results;
};

// The scene outlives the plan. facts: what is known already, for plans that are not run from their beginning.
Plan makePlan(const Scene& scene, const RenderOptions& options, PlanFacts facts = {});

// The passes whose results a pass reads: of one that runs those that run, of one that does not all that it names.
std::vector<std::string> namesOfNeeds(const Plan& plan, const Pass& pass);

// One line for each pass, then the memory.
std::string planText(const Plan& plan);
// Per pass: name, runs, reason, depends_on (or null), needs, arithmetic (null: it does not compute), memory_bytes (at
// most, of the images that it makes and works in), and of one that has run (else null) result_bytes, all that its result
// held, and the seconds that it took.
Json planPassesJson(const Plan& plan);
std::string planJson(const Plan& plan);
// Graphviz: an arrow from a pass to each pass that reads its result; passes that do not run are dashed.
std::string planDot(const Plan& plan);

}  // namespace etalon
