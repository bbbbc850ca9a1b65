// Hashes of decoded pixels.
#pragma once

#include <string>
#include <vector>

#include "files/frame.h"

namespace etalon {

// The hash of some channels of one size, as 16 hexadecimal digits. Hashed are, in this order, the text
// "etalon-pixels-1", the width, the height and the number of channels; then for each channel, sorted by name,
// its name, its type ("float" or "uint32") and its samples row by row, the top row first. Numbers are 4
// bytes, little-endian; texts are preceded by their length. Every bit counts: the sign of a zero, the payload
// of a NaN.
std::string hashChannels(int width, int height, std::vector<const Channel*> channels);

// All channels of a frame. The metadata does not count.
std::string hashFrame(const Frame& frame);

}  // namespace etalon
