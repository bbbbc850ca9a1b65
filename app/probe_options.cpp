#include "app/probe_options.h"

#include <limits>

#include "app/command_line.h"
#include "probes/mapping.h"

namespace etalon {

void ProbeInput::addTo(Verb& verb) {
    verb.add("FILE", file, "Image file of a probe (.exr, .hdr, .tif, .pfm)").required();
    verb.add("--mapping", mapping, "How the file lays out directions; default: told by the file")
        .oneOf(kNames<Mapping>);
    verb.add("--layout", layout, "How the file lays out cube faces; default: told by its shape")
        .oneOf(kNames<CubeLayout>);
    verb.add("--ball-distance", ballDistance_radii,
             "Of a mirror ball, from the eye to its middle in radii; default: the file's, or infinity")
        .range(kLeastBallDistance_radii, std::numeric_limits<double>::infinity());
}

Probe ProbeInput::load() const {
    ProbeFileOptions options;
    if (!mapping.empty()) options.mapping = *memberOf<Mapping>(mapping);
    if (!layout.empty()) options.layout = *memberOf<CubeLayout>(layout);
    if (ballDistance_radii > 0) options.ballDistance_radii = ballDistance_radii;
    return loadProbe(file, options);
}

}  // namespace etalon
