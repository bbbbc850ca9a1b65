// Points of a disc for filters that take few samples, and how each pixel turns them.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <vector>

namespace etalon {

// `count` points of the unit disc, no two of them near each other: each is the one of several random
// candidates that is farthest from those before it [Mitchell91]. The same for the same count and seed.
std::vector<glm::dvec2> discPattern(int count, uint64_t seed);

// Cosine and sine of kPatternTurns angles, one of them at random for each pixel.
inline constexpr int kPatternTurns = 256;
class PatternTurns {
  public:
    explicit PatternTurns(uint64_t seed);
    // What the number of a pixel's turn is made with (shadows/kernels/pattern_turn.glsl), in halves of 32 bits.
    uint32_t keyHigh() const { return static_cast<uint32_t>(key_ >> 32); }
    uint32_t keyLow() const { return static_cast<uint32_t>(key_); }
    const glm::dvec2& operator[](int number) const { return turns_[static_cast<size_t>(number)]; }

  private:
    uint64_t key_;
    std::array<glm::dvec2, kPatternTurns> turns_;
};

}  // namespace etalon
