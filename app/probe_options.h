// The options that every verb about a probe in a file shares.
#pragma once

#include <algorithm>
#include <iterator>
#include <string>
#include <string_view>

#include "files/probe_file.h"

namespace etalon {

class Verb;

// In the order of CubeLayout.
inline constexpr std::string_view kLayoutNames[] = {"openexr", "strip", "horizontal_cross", "vertical_cross"};

// The member of an enumeration whose names are in its order.
template <class Enum, class Names>
Enum memberOfName(const Names& names, const std::string& name) {
    return static_cast<Enum>(std::find(std::begin(names), std::end(names), name) - std::begin(names));
}

struct ProbeInput {
    std::string file, mapping, layout;
    double ballDistance_radii = 0;  // not above 0: the file's

    void addTo(Verb& verb);
    Probe load() const;
};

}  // namespace etalon
