#include "app/verbs.h"

namespace etalon {

void addProbe(CLI::App& app, ExitCode& exitCode) {
    CLI::App* probe = app.add_subcommand("probe", "Light probes: radiance over directions in image files");
    probe->require_subcommand(1);
    addProbeConvert(*probe, exitCode);
    addProbeInfo(*probe, exitCode);
    addProbeLights(*probe, exitCode);
    addProbeSh(*probe, exitCode);
}

}  // namespace etalon
