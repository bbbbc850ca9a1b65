// The probes that experiments measure.
#pragma once

#include <string>
#include <vector>

#include "probes/probe.h"

namespace etalon::experiments {

struct NamedProbe {
    std::string name;
    Probe probe;
};

// A lat-long image as a probe. Negative values, of which lossy files have a few, become 0.
Probe latLongProbe(Image<float> radiance);

// The eight CC0 probes that scripts/fetch_probes fetches into scenes/probes/.
std::vector<NamedProbe> fetchedProbes();

}  // namespace etalon::experiments
