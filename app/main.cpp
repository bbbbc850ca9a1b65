#include "app/verbs.h"
#include "ar/render_scene.h"
#include "ar/scene_loader.h"
#include "raster/rules.h"

namespace {

// Golden cases are rendered as `etalon render` would.
etalon::Frame renderGolden(const etalon::GoldenManifest& manifest, const etalon::GoldenCase& golden) {
    etalon::RenderOptions options;
    options.request.outputs = golden.outputs;
    options.profile = golden.profile;
    return etalon::renderScene(etalon::loadScene(manifest.resolve(golden.scene)), options).frame;
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app;
    etalon::ExitCode exitCode = etalon::ExitCode::done;
    const etalon::GoldenSupport golden{renderGolden, std::to_string(etalon::kRulesVersion)};
    const std::vector<etalon::BitCase> cases = etalon::bitCases();
    etalon::configureCommand(app);
    etalon::addRender(app, exitCode);
    etalon::addPlan(app, exitCode);
    etalon::addProbe(app, exitCode);
    etalon::addCompare(app, exitCode);
    etalon::addCheck(app, exitCode, golden);
    etalon::addAccept(app, exitCode, golden);
    etalon::addBits(app, exitCode, cases);
    return static_cast<int>(etalon::runCommand(app, exitCode, argc, argv));
}
