// The verbs check and accept with a renderer whose scenes are files that hold one number: the value of R.
#include <fstream>

#include "app/verbs.h"

namespace {

etalon::Frame renderNumber(const etalon::GoldenManifest& manifest, const etalon::GoldenCase& c) {
    const std::filesystem::path path = manifest.resolve(c.scene);
    std::ifstream file(path);
    float value = 0;
    if (!(file >> value)) throw etalon::InputError(path.string() + ":1: not a number");
    etalon::Image<float> image(3, 2);
    image.fill(value);
    return {3, 2, {{"R", image}, {"G", image}, {"B", image}, {"Z", etalon::Image<float>(3, 2)}}, {}};
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app;
    etalon::ExitCode exitCode = etalon::ExitCode::done;
    const etalon::GoldenSupport support{renderNumber, "1"};
    etalon::configureCommand(app);
    etalon::addCompare(app, exitCode);
    etalon::addCheck(app, exitCode, support);
    etalon::addAccept(app, exitCode, support);
    return static_cast<int>(etalon::runCommand(app, exitCode, argc, argv));
}
