// A hash of bytes for comparing results between machines.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace etalon {

// XXH64 with seed 0 over the concatenation of what is added [xxHash]. Not cryptographic.
class Xxh64 {
  public:
    void add(std::span<const std::byte> bytes);
    // Little-endian on every machine.
    void addNumber(uint32_t number);
    void addNumber(uint64_t number);
    // The length as 4 bytes, then the bytes.
    void addText(std::string_view text);
    // Of everything added so far; more may be added afterwards.
    uint64_t digest() const;

  private:
    static constexpr size_t kStripe = 32;

    std::array<uint64_t, 4> lanes_ = {0x60ea27eeadc0b5d6u, 0xc2b2ae3d27d4eb4fu, 0, 0x61c8864e7a143579u};
    std::array<std::byte, kStripe> pending_{};
    uint64_t length_ = 0;
};

}  // namespace etalon
