#include "ar/plan.h"

#include <memory>

#include "app/report.h"
#include "app/scene_options.h"
#include "app/verbs.h"

namespace etalon {
namespace {

struct PlanVerb {
    SceneOptions scene;
    bool json = false, dot = false, png = false;
};

ExitCode runPlan(const PlanVerb& verb) {
    RenderOptions options = verb.scene.renderOptions();
    options.request.png = verb.png;
    const Plan plan = planScene(loadScene(verb.scene.scene), options);
    printOut(verb.json ? planJson(plan) : verb.dot ? planDot(plan) : planText(plan));
    return ExitCode::done;
}

}  // namespace

void addPlan(CLI::App& app, ExitCode& exitCode) {
    auto verb = std::make_shared<PlanVerb>();
    CLI::App* command =
        app.add_subcommand("plan", "Say which passes a scene needs, and why the others do not run");
    verb->scene.addTo(*command);
    CLI::Option* json = command->add_flag("--json", verb->json, "As JSON");
    command->add_flag("--dot", verb->dot, "As a Graphviz graph")->excludes(json);
    command->add_flag("--png", verb->png, "As if a PNG were written too");
    command->callback([verb, &exitCode] { exitCode = runPlan(*verb); });
}

}  // namespace etalon
