#include "ar/plan.h"

#include <memory>

#include "app/command_line.h"
#include "app/options.h"
#include "app/output.h"
#include "app/verbs.h"
#include "scene/scene.h"

namespace etalon {
namespace {

struct PlanVerb {
    SceneOptions scene;
    bool json = false, dot = false, png = false;
};

ExitCode runPlan(const PlanVerb& verb) {
    RenderOptions options = verb.scene.renderOptions();
    options.request.png = verb.png;
    ProgressLine progress;
    RenderProgressText progressText;
    options.progress = [&](const RenderProgress& at) { progress.show(progressText.of(at)); };
    const Plan plan = planScene(loadScene(verb.scene.scene), options);
    progress.finish();
    printOut(verb.json ? planJson(plan) : verb.dot ? planDot(plan) : planText(plan));
    return ExitCode::done;
}

}  // namespace

void addPlan(Verb& command) {
    auto options = std::make_shared<PlanVerb>();
    Verb& verb = command.addVerb("plan", "Say which passes a scene needs, and why the others do not run");
    options->scene.addTo(verb);
    const Option json = verb.addFlag("--json", options->json, "As JSON");
    verb.addFlag("--dot", options->dot, "As a Graphviz graph").excludes(json);
    verb.addFlag("--png", options->png, "As if a PNG were written too");
    verb.onRun([options] { return runPlan(*options); });
}

}  // namespace etalon
