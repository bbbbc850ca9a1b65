// A frame: what a render returns and what an image file holds.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "raster/image.h"

namespace etalon {

// One named plane, as an EXR file names it: "R", "Z", "N.X" (layer N, component X), "id". The image has one
// plane of the frame's size. Floats are linear values in the units of the output; uint32_t are identifiers.
struct Channel {
    std::string name;
    std::variant<Image<float>, Image<uint32_t>> values;
};

// Channels of one size with distinct names, and text that travels with them (scene, profile, rules version).
struct Frame {
    int width = 0, height = 0;  // pixels
    std::vector<Channel> channels;
    std::map<std::string, std::string> metadata;

    // The channel of that name, or null.
    const Channel* find(std::string_view name) const {
        for (const Channel& channel : channels)
            if (channel.name == name) return &channel;
        return nullptr;
    }
};

// Throws PreconditionError unless the frame has at least one channel, every channel is one plane of the
// frame's size, and no name is empty or used twice.
inline void checkFrame(const Frame& frame) {
    ETALON_CHECK(!frame.channels.empty(), "a frame of {}x{} without channels", frame.width, frame.height);
    for (const Channel& channel : frame.channels) {
        std::visit(
            [&](const auto& image) {
                ETALON_CHECK(
                    image.width() == frame.width && image.height() == frame.height && image.channels() == 1,
                    "channel {} is {}x{}x{}, the frame is {}x{}", channel.name, image.width(), image.height(),
                    image.channels(), frame.width, frame.height);
            },
            channel.values);
        ETALON_CHECK(!channel.name.empty() && frame.find(channel.name) == &channel,
                     "channel name \"{}\" is empty or used twice", channel.name);
    }
}

}  // namespace etalon
