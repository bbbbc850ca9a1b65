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
    // The number of a pixel's turn.
    int numberOf(uint32_t x_px, uint32_t y_px) const {
        uint64_t h = seed_ ^ (uint64_t{x_px} | uint64_t{y_px} << 32);
        h = (h ^ (h >> 30)) * 0xbf58476d1ce4e5b9u;
        h = (h ^ (h >> 27)) * 0x94d049bb133111ebu;
        return static_cast<int>((h >> 33) % kPatternTurns);
    }
    const glm::dvec2& operator[](int number) const { return turns_[static_cast<size_t>(number)]; }

  private:
    uint64_t seed_;
    std::array<glm::dvec2, kPatternTurns> turns_;
};

}  // namespace etalon
