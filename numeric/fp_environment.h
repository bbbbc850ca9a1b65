// The floating-point control word: rounding to nearest-even, no flush-to-zero, no denormals-are-zero.
#pragma once

namespace etalon {

// True when the calling thread computes with the IEEE defaults: round to nearest-even, subnormals kept in
// both operands and results. A library linked with -ffast-math silently changes this for a whole process.
bool fpEnvironmentIsDefault();

// Throws PreconditionError, naming the control word, unless fpEnvironmentIsDefault(). Every worker thread
// calls it before it computes.
void requireDefaultFpEnvironment();

// Puts the calling thread into flush-to-zero mode while it lives, then restores the old control word.
// For the tests that show that no intermediate of the f32 profile is subnormal.
class FlushToZeroScope {
  public:
    FlushToZeroScope();
    ~FlushToZeroScope();
    FlushToZeroScope(const FlushToZeroScope&) = delete;
    FlushToZeroScope& operator=(const FlushToZeroScope&) = delete;

  private:
    unsigned long long saved_;
};

}  // namespace etalon
