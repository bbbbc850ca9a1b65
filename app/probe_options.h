// The options that every verb about a probe in a file shares.
#pragma once

#include <string>

#include "files/probe_file.h"
#include "probes/names.h"

namespace etalon {

class Verb;

struct ProbeInput {
    std::string file, mapping, layout;
    double ballDistance_radii = 0;  // not above 0: the file's

    void addTo(Verb& verb);
    Probe load() const;
};

}  // namespace etalon
