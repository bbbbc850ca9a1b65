#include "app/command_line.h"
#include "app/verbs.h"

namespace etalon {

void addProbe(Verb& command) {
    Verb& probe = command.addVerb("probe", "Light probes: radiance over directions in image files");
    addProbeConvert(probe);
    addProbeInfo(probe);
    addProbeLights(probe);
    addProbeSh(probe);
}

}  // namespace etalon
