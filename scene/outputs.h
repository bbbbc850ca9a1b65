// What a render can write: one table for scene files, the command, the plan and docs/outputs.md.
#pragma once

#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "lighting/shade.h"

namespace etalon {

// Channels of an output that are made alike.
struct OutputPart {
    // Their names in a file, layer and all: "N.X" is X of the layer N. Words in capitals of more than one letter stand
    // for the names of lights, or for numbers: there is a channel, or a file, for each.
    std::vector<std::string_view> channels;
    std::optional<ShadeOutput> image;  // that shading makes, plane by plane; none: another pass makes them
    float missing = 0;                 // what they hold where no pass made them, as nothing would show
    std::string_view unit, range;      // "" and "1" as text: none; of a surface
    std::string_view pixel;            // what a pixel with several samples is
    std::string_view background;       // where nothing is visible
};

struct OutputDescription {
    std::string_view name;     // in scene files and --outputs
    std::string_view meaning;  // one line of Markdown
    std::vector<OutputPart> parts;
    // Of outputs that are files of their own beside the image: "a.NAME.exr" beside "a.exr"; "" of those in it.
    std::string_view file = "";
};

// In the order in which a file has them.
std::span<const OutputDescription> outputDescriptions();
// Their names, in that order.
std::span<const std::string_view> outputNames();
// Null if no output has that name.
const OutputDescription* findOutput(std::string_view name);

}  // namespace etalon
