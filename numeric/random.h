// Random numbers that are the same on every machine: for inputs that are made, not read.
#pragma once

#include <cstddef>
#include <cstdint>

namespace etalon {

// What splitmix64 [Steele2014] yields of a state, which then grows by kSplitMixStep. Unsigned: uint64_t, or lanes of it.
inline constexpr uint64_t kSplitMixStep = 0x9e3779b97f4a7c15u;
template <class Unsigned>
Unsigned splitMix64(Unsigned state) {
    Unsigned z = state + kSplitMixStep;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
}

// The same sequence on every machine, unlike the standard distributions.
class Random {
  public:
    explicit Random(uint64_t seed) : state_(seed) {}

    uint64_t next() {
        const uint64_t z = splitMix64(state_);
        state_ += kSplitMixStep;
        return z;
    }
    // In [low, high).
    double uniform(double low, double high) {
        return low + static_cast<double>(next() >> 11) * 0x1p-53 * (high - low);
    }
    // In low ... high, both included.
    int integer(int low, int high) {
        return low + static_cast<int>(next() % (static_cast<uint64_t>(high - low) + 1));
    }
    bool chance(double probability) { return uniform(0, 1) < probability; }
    template <class T, size_t N>
    T pick(const T (&values)[N]) {
        return values[next() % N];
    }

  private:
    uint64_t state_;
};

}  // namespace etalon
