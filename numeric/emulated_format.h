// The format that numeric/emulated.h computes in: a value of the calling thread. EmulatedScope sets it, and
// parallelFor hands it on to its threads.
#pragma once

#include <bit>
#include <cstdint>
#include <limits>

#include "numeric/format.h"

namespace etalon {

// What the operations read of a format.
struct EmulatedFormat {
    // How the rounding is computed.
    enum class Path : uint8_t {
        binary32,     // to nearest even through the processor's float
        nearestEven,  // other formats to nearest even
        truncated,    // toward zero, subnormals flushed: the low bits are cut off
        general,      // any rounding
    };

    double beyond = 0;       // the first power of two beyond the format
    double leastNormal = 0;  // the smallest normal number
    double perBinade = 0;    // of a binade: adding it leaves a sum whose last bit is the format's
    double step = 0;         // from 1 to the next number
    double largest = 0;      // finite
    double flushBelow = 0;   // results below are 0
    double whenInfinite = 0, whenNan = 0;
    double overflow[2] = {0, 0};  // what is beyond the largest number, above and below zero, as a magnitude
    double lowestExponent = 0;    // of the smallest number above zero
    int64_t keptBits = 0;         // of a double's pattern, if the format truncates
    Path path = Path::nearestEven;
    bool isBinary16 = false;  // fp16, of the two formats of numeric/narrow.h
    Rounding rounding = Rounding::nearestEven;

    constexpr EmulatedFormat() = default;
    constexpr explicit EmulatedFormat(Format f)
        : beyond(powerOfTwo(f.maxExponent + 1)),
          leastNormal(smallestNormal(f)),
          perBinade(powerOfTwo(kDoubleBits - f.significandBits)),
          step(epsilonOf(f)),
          largest(largestFinite(f)),
          flushBelow(f.subnormals == Subnormals::flush ? smallestNormal(f) : 0.0),
          whenInfinite(f.overflow == Overflow::saturate ? largest : std::numeric_limits<double>::infinity()),
          whenNan(f.overflow == Overflow::saturate ? 0.0 : kCanonicalNan),
          overflow{overflowOf(f, true), overflowOf(f, false)},
          lowestExponent(f.minExponent - (f.subnormals == Subnormals::keep ? f.significandBits - 1 : 0)),
          keptBits(-(int64_t{1} << (kDoubleBits - f.significandBits))),
          path(pathOf(f)),
          isBinary16(f == kFp16),
          rounding(f.rounding) {}

  private:
    static constexpr int kDoubleBits = 53;

    static constexpr double overflowOf(Format f, bool isPositive) {
        const bool isCut =
            f.rounding == Rounding::towardZero || f.rounding == (isPositive ? Rounding::down : Rounding::up);
        return isCut || f.overflow == Overflow::saturate ? largestFinite(f)
                                                         : std::numeric_limits<double>::infinity();
    }
    static constexpr Path pathOf(Format f) {
        if (f.rounding == Rounding::nearestEven) {
            const bool hasRangeOfFloat = f.minExponent == kFp32.minExponent &&
                                         f.maxExponent == kFp32.maxExponent &&
                                         f.overflow == Overflow::infinity;
            return f.significandBits == kFp32.significandBits && hasRangeOfFloat ? Path::binary32
                                                                                 : Path::nearestEven;
        }
        return f.rounding == Rounding::towardZero && f.subnormals == Subnormals::flush ? Path::truncated
                                                                                       : Path::general;
    }
};

// The format of the calling thread; until it is set, fp32.

extern thread_local constinit EmulatedFormat emulatedFormat [[gnu::tls_model("initial-exec")]];

// Sets the format of the calling thread until the scope ends. The format is one that isSupported has.
class EmulatedScope {
  public:
    explicit EmulatedScope(Format format) : EmulatedScope(EmulatedFormat(format)) {}
    explicit EmulatedScope(const EmulatedFormat& format) : before_(emulatedFormat) {
        emulatedFormat = format;
    }
    ~EmulatedScope() { emulatedFormat = before_; }
    EmulatedScope(const EmulatedScope&) = delete;
    EmulatedScope& operator=(const EmulatedScope&) = delete;

  private:
    EmulatedFormat before_;
};

// What an object that computes in T keeps of the format of the thread that made it, to compute in the same
// wherever it is called: `[[maybe_unused]] const auto scope = format_.enter();`. Only emulated numbers (numeric/emulated.h) have
// one.
template <class T>
struct KeptFormat {
    struct Scope {};
    Scope enter() const { return {}; }
};

}  // namespace etalon
