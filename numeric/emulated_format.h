// The format that numeric/emulated.h computes in: a value of the calling thread. EmulatedScope sets it, and
// parallelFor hands it on to its threads.
//
// Stochastic rounding. Between two neighbours of the format that are one quantum apart, an exact result whose
// magnitude is the smaller one's plus a fraction f of the quantum, 0 <= f < 1, becomes the larger one where
//     f > (u + 1/2) 2^-24,  u a whole number from 0 to 2^24 - 1
// is drawn: with probability f to within 2^-25, never for f = 0. u is the 24 leading bits of a hash,
//     h = m(m(m(m(seed + operation) ^ item) ^ bits of a) ^ bits of b),
// m the step of splitmix64 [Steele2014] on its argument as the state, the seed that of the format, the operation an
// EmulatedOperation, a and b its operands as doubles (b is 0 where there is one), the item a key of the lane that the
// pass sets: its pixel, say. So nothing depends on the order of work: lanes, tiles and threads that skip or repeat some
// change no bit, and equal expressions of an item are equal numbers. The price: an operation that an item repeats on
// the same operands is rounded the same way again, so that a sum of equal terms that once stays where it is stays
// there; a pass that adds up such terms puts the number of the term into the item's key. Conversions to the format
// have item 0: equal numbers are converted to equal numbers. The shading of fragments has the place of the sample in
// subpixels as its items, the mean over the samples of a pixel that of the pixel; other passes have 0. pow, atan2,
// sine and cosine draw with the fraction of their value in double.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
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
    Division division = Division::exact;
    Power power = Power::exact;
    bool hasPlainDivision = true;  // quotients and roots are those of double, rounded
    uint64_t seed = 0;

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
          rounding(f.rounding),
          division(f.division),
          power(f.power),
          hasPlainDivision(f.division == Division::exact && f.rounding != Rounding::stochastic),
          seed(f.seed) {}

  private:
    static constexpr int kDoubleBits = 53;

    static constexpr double overflowOf(Format f, bool isPositive) {
        const bool isCut =
            f.rounding == Rounding::towardZero || f.rounding == (isPositive ? Rounding::down : Rounding::up);
        return isCut || f.overflow == Overflow::saturate ? largestFinite(f)
                                                         : std::numeric_limits<double>::infinity();
    }
    static constexpr Path pathOf(Format f) {
        if (roundsAsFloat(f)) return Path::binary32;
        if (f.rounding == Rounding::nearestEven) return Path::nearestEven;
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

// What draws (above), as a part of the key. The numbers are part of the rules.
enum class EmulatedOperation : uint64_t {
    sum = 1,  // also differences: a - b is a + -b
    product = 2,
    quotient = 3,
    root = 4,
    reciprocal = 5,
    reciprocalRoot = 6,
    conversion = 7,
    logarithm = 8,
    exponential = 9,
    power = 10,
    angle = 11,
    sine = 12,
    cosine = 13,
};

// The keys of the items that the lanes of the calling thread work on. 0 until a pass sets them; parallelFor starts each
// of its items with 0.
inline constexpr int kEmulatedItems = 16;
struct EmulatedItems {
    std::array<uint64_t, kEmulatedItems> keys{};
};
extern thread_local constinit EmulatedItems emulatedItems [[gnu::tls_model("initial-exec")]];

// Lane i works on keys[i]; lanes beyond the `count` keys, of which there are at most kEmulatedItems, on 0.
inline void setEmulatedItems(const uint64_t* keys, int count) {
    for (int i = 0; i < kEmulatedItems; i++)
        emulatedItems.keys[static_cast<size_t>(i)] = i < count ? keys[i] : 0;
}

// For passes over a number type T, of `lanes` lanes: lane i works on the item keyOf(i). Nothing where T is no emulated
// number or its rounding does not draw.
template <class T>
inline constexpr bool kIsEmulated = false;
template <class T, int lanes, class KeyOf>
void setItemsOf(KeyOf&& keyOf) {
    if constexpr (kIsEmulated<T>) {
        if (emulatedFormat.rounding != Rounding::stochastic) return;
        for (int i = 0; i < lanes; i++) emulatedItems.keys[static_cast<size_t>(i)] = keyOf(i);
    }
}
// The key of a place in an image, in pixels or subpixels.
constexpr uint64_t itemOfPlace(int64_t x, int64_t y) {
    return static_cast<uint64_t>(y) << 32 | (static_cast<uint64_t>(x) & 0xffffffffu);
}

// All items are 0 at its beginning, and at its end what they were before.
class EmulatedItemsScope {
  public:
    EmulatedItemsScope() : before_(emulatedItems) { emulatedItems = EmulatedItems(); }
    ~EmulatedItemsScope() { emulatedItems = before_; }
    EmulatedItemsScope(const EmulatedItemsScope&) = delete;
    EmulatedItemsScope& operator=(const EmulatedItemsScope&) = delete;

  private:
    EmulatedItems before_;
};

// What an object that computes in T keeps of the format of the thread that made it, to compute in the same
// wherever it is called: `[[maybe_unused]] const auto scope = format_.enter();`. Only the numbers of numeric/emulated.h
// and numeric/narrow.h have one.
template <class T>
struct KeptFormat {
    struct Scope {};
    Scope enter() const { return {}; }
};

}  // namespace etalon
