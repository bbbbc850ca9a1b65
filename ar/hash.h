// Hashes of decoded pixels.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "ar/frame.h"

namespace etalon {

// XXH64 with seed 0 over the concatenation of what is added [xxHash]. Not cryptographic.
class Xxh64 {
  public:
    void add(std::span<const std::byte> bytes);
    // Of everything added so far; more may be added afterwards.
    uint64_t digest() const;

  private:
    static constexpr size_t kStripe = 32;

    std::array<uint64_t, 4> lanes_ = {0x60ea27eeadc0b5d6u, 0xc2b2ae3d27d4eb4fu, 0, 0x61c8864e7a143579u};
    std::array<std::byte, kStripe> pending_{};
    uint64_t length_ = 0;
};

// The hash of some channels of one size, as 16 hexadecimal digits. Hashed are, in this order, the text
// "etalon-pixels-1", the width, the height and the number of channels; then for each channel, sorted by name,
// its name, its type ("float" or "uint32") and its samples row by row, the top row first. Numbers are 4
// bytes, little-endian; texts are preceded by their length. Every bit counts: the sign of a zero, the payload
// of a NaN.
std::string hashChannels(int width, int height, std::vector<const Channel*> channels);

// All channels of a frame. The metadata does not count.
std::string hashFrame(const Frame& frame);

}  // namespace etalon
