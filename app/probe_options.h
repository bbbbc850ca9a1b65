// The options that every verb about a probe in a file shares.
#pragma once

#include <CLI/CLI.hpp>
#include <limits>
#include <string>
#include <vector>

#include "ar/probe_file.h"
#include "probes/mapping.h"

namespace etalon {

inline const std::vector<std::string> kLayoutNames = {"openexr", "strip", "horizontal_cross",
                                                      "vertical_cross"};

// The member of an enumeration whose names are in its order.
template <class Enum, class Names>
Enum memberOfName(const Names& names, const std::string& name) {
    return static_cast<Enum>(std::find(std::begin(names), std::end(names), name) - std::begin(names));
}

inline std::vector<std::string> mappingNames() {
    return {std::begin(kMappingNames), std::end(kMappingNames)};
}

struct ProbeInput {
    std::string file, mapping, layout;
    double ballDistance_radii = 0;  // not above 0: the file's

    void addTo(CLI::App& verb) {
        verb.add_option("FILE", file, "Image file of a probe (.exr, .hdr, .tif, .pfm)")->required();
        verb.add_option("--mapping", mapping, "How the file lays out directions; default: told by the file")
            ->check(CLI::IsMember(mappingNames()));
        verb.add_option("--layout", layout, "How the file lays out cube faces; default: told by its shape")
            ->check(CLI::IsMember(kLayoutNames));
        verb.add_option(
                "--ball-distance", ballDistance_radii,
                "Of a mirror ball, from the eye to its middle in radii; default: the file's, or infinity")
            ->check(CLI::Range(kLeastBallDistance_radii, std::numeric_limits<double>::infinity()));
    }

    Probe load() const {
        ProbeFileOptions options;
        if (!mapping.empty()) options.mapping = memberOfName<Mapping>(kMappingNames, mapping);
        if (!layout.empty()) options.layout = memberOfName<CubeLayout>(kLayoutNames, layout);
        if (ballDistance_radii > 0) options.ballDistance_radii = ballDistance_radii;
        return loadProbe(file, options);
    }
};

}  // namespace etalon
