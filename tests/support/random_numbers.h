// Random numbers for tests: the same on every machine.
#pragma once

#include <cstdint>
#include <random>

namespace etalon {

class RandomNumbers {
  public:
    explicit RandomNumbers(uint64_t seed) : bits_(seed) {}
    uint64_t bits() { return bits_(); }
    // In [0, count).
    int below(int count) { return static_cast<int>(bits_() % static_cast<uint64_t>(count)); }
    // In [lo, hi), multiples of (hi - lo) 2^-53.
    double uniform(double lo, double hi) {
        return lo + (hi - lo) * (static_cast<double>(bits_() >> 11) * 0x1p-53);
    }

  private:
    std::mt19937_64 bits_;
};

}  // namespace etalon
