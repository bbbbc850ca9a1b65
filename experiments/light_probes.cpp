#include "experiments/light_probes.h"

#include <algorithm>

#include "files/image_io.h"
#include "numeric/text.h"

namespace etalon::experiments {

Probe latLongProbe(Image<float> radiance) {
    Probe probe;
    probe.shape = {Mapping::latLong, radiance.width(), radiance.height()};
    for (float& v : radiance.values()) v = std::max(v, 0.0f);
    probe.radiance.push_back(std::move(radiance));
    return probe;
}

std::vector<NamedProbe> fetchedProbes() {
    std::vector<NamedProbe> probes;
    for (const char* name :
         {"city", "courtyard", "forest", "interior", "night", "studio", "sunrise", "sunset"})
        probes.push_back({name, latLongProbe(readRgb(formatText("scenes/probes/{}.exr", name)))});
    return probes;
}

}  // namespace etalon::experiments
