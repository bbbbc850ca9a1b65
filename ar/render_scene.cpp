#include "ar/render_scene.h"

#include <unistd.h>

#include <algorithm>

#include "numeric/text.h"

namespace etalon {
namespace {

constexpr double kGiB = 1024.0 * 1024.0 * 1024.0;

uint64_t machineMemory_bytes() {
    return static_cast<uint64_t>(sysconf(_SC_PHYS_PAGES)) * static_cast<uint64_t>(sysconf(_SC_PAGESIZE));
}

void requireMemory(const Scene& scene, const RenderOptions& options, const Plan& plan) {
    const uint64_t needed = plan.memory_bytes(), present = machineMemory_bytes();
    if (needed <= present) {
        if (options.announceMemory) options.announceMemory(needed);
        return;
    }
    const bool hasMaps = std::ranges::any_of(plan.passes, [](const Pass& pass) {
        return pass.runs && pass.text.isLookedUp && pass.memory_bytes() > 0;
    });
    throw InputError(
        formatText("{}: {}x{} pixels with {} samples{} need {:.1f} GiB, this machine has {:.1f} GiB",
                   where(scene, scene.camera.line), scene.camera.width, scene.camera.height,
                   scene.render.samples, hasMaps ? ", and the maps that they look up," : "",
                   static_cast<double>(needed) / kGiB, static_cast<double>(present) / kGiB));
}

// Runs the plan from its beginning up to the pass of this number, which may have grown by then.
void runPasses(Plan& plan, const RenderOptions& options, size_t end) {
    for (size_t i = 0; i < std::min(end, plan.passes.size()); i++) {
        ProgressScope::Report progress;
        if (options.progress)
            progress = [&, i](int step, double part) { options.progress({&plan, i, step, part}); };
        if (progress && plan.passes[i].runs) progress(0, 0);
        plan.run(i, progress);
    }
}

template <class T>
void append(std::vector<T>& to, const std::vector<T>& from) {
    to.insert(to.end(), from.begin(), from.end());
}

}  // namespace

RenderResult renderScene(const Scene& scene, const RenderOptions& options) {
    RenderResult result;
    Plan& plan = result.plan;
    plan = makePlan(scene, options);
    requireMemory(scene, options, plan);
    runPasses(plan, options, SIZE_MAX);

    const PlanResults& of = *plan.results;
    append(result.warnings, plan.value(*of.geometry).warnings);
    append(result.warnings, plan.value(*of.environmentImage).warnings);
    if (of.illumination)
        for (const std::string& warning : plan.value(*of.illumination).warnings)
            result.warnings.push_back(formatText("{}: {}", where(scene, scene.environment.line), warning));
    append(result.warnings, of.notMade);
    result.frame = plan.value(*of.frame);
    append(result.files, plan.value(*of.cubeFiles));
    append(result.files, plan.value(*of.mapFiles));
    const std::vector<std::string>& asked =
        options.request.outputs.empty() ? scene.output.images : options.request.outputs;
    const auto isShadow = [](const Channel& channel) { return channel.name.starts_with("shadow."); };
    if (std::ranges::count(asked, "shadow") > 0 && std::ranges::none_of(result.frame.channels, isShadow))
        result.warnings.push_back(formatText("{}: the output 'shadow' has no channel: no light casts shadows",
                                             where(scene, scene.output.line)));
    result.toned = plan.value(*of.toned);
    result.raster = plan.value(*of.visibility).scene->statistics;
    result.shading = plan.value(*of.shading).statistics;
    plan.forgetResults();
    plan.results = nullptr;
    return result;
}

Plan planScene(const Scene& scene, const RenderOptions& options) {
    Plan plan = makePlan(scene, options);
    requireMemory(scene, options, plan);
    runPasses(plan, options, plan.results->geometry->pass() + 1);
    return plan;
}

}  // namespace etalon
