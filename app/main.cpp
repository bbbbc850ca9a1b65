#include "app/command_line.h"
#include "app/verbs.h"
#include "ar/render_scene.h"
#include "bitcheck/bit_case.h"
#include "golden/golden.h"
#include "raster/rules.h"
#include "scene/profile_file.h"
#include "scene/scene.h"

namespace {

// Golden cases are rendered as `etalon render` would.
etalon::Frame renderGolden(const etalon::GoldenManifest& manifest, const etalon::GoldenCase& golden) {
    etalon::RenderOptions options;
    options.request.outputs = golden.outputs;
    options.profile = etalon::isProfileFile(golden.profile)
                          ? etalon::readProfileFile(manifest.resolve(golden.profile))
                          : etalon::loadProfile(golden.profile);
    return etalon::renderScene(etalon::loadScene(manifest.resolve(golden.scene)), options).frame;
}

}  // namespace

int main(int argc, char** argv) {
    const etalon::GoldenSupport golden{renderGolden, std::to_string(etalon::kRulesVersion)};
    const std::vector<etalon::BitCase> cases = etalon::bitCases();
    etalon::Command command;
    etalon::addRender(command);
    etalon::addPlan(command);
    etalon::addProfiles(command);
    etalon::addOutputs(command);
    etalon::addSchema(command);
    etalon::addProbe(command);
    etalon::addCompare(command);
    etalon::addCheck(command, golden);
    etalon::addAccept(command, golden);
    etalon::addBits(command, cases);
    return static_cast<int>(command.run(argc, argv));
}
