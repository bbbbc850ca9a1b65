// Comparison of two frames: shape, then NaN and infinity positions, then distances.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "files/frame.h"

namespace etalon {

// The integer that orders floats: consecutive finite floats map to consecutive integers, both zeros to 0.
// Not for NaN.
int64_t orderedInteger(float value);

// Number of representable values from a to b: 0 for +0 and -0. Below 2^32. Both must be finite.
uint64_t ulpDistance(float a, float b);

// The distance of two samples of which only one is NaN, or which are not the same infinity.
inline constexpr uint64_t kIncomparableUlp = UINT64_MAX;

// Buckets of the histogram of distances: 0, 1, 2, 3-4, 5-8, ... up to (2^31, 2^32].
inline constexpr int kUlpBuckets = 34;
// The bucket of a distance of at most 2^32, and the largest distance that a bucket counts.
int ulpBucket(uint64_t ulp);
uint64_t ulpBucketEnd(int bucket);

// A sample where the frames are furthest apart. Integers are exact in double.
struct WorstPixel {
    int x = 0, y = 0;
    double a = 0, b = 0;
    uint64_t ulp = 0;  // or kIncomparableUlp
};

// One channel that both frames have, with the same type and size. For uint32_t channels the distance in ULP
// is the difference of the integers.
struct ChannelComparison {
    std::string name;
    uint64_t samples = 0;
    uint64_t differing = 0;           // samples of different value, all mismatches included
    uint64_t nanMismatches = 0;       // NaN in one frame only
    uint64_t infinityMismatches = 0;  // no NaN, and not both finite or the same infinity
    uint64_t signedZeros = 0;         // +0 against -0: the same value, other bits
    uint64_t nanPayloads = 0;         // NaN against NaN with other bits
    // Over the samples that are finite in both frames; every figure is 0 when there are none. Sums are in
    // double, row by row and then over the rows. Relative: |b - a| / max(|a|, |b|), 0 for two zeros. Bias:
    // mean of b - a.
    uint64_t finite = 0;
    std::array<uint64_t, kUlpBuckets> ulpHistogram{};
    uint64_t maxUlp = 0;
    double meanUlp = 0, maxAbsolute = 0, meanAbsolute = 0, maxRelative = 0, meanRelative = 0, rmse = 0,
           bias = 0;
    // Differing samples, the greatest distance first, then in reading order.
    std::vector<WorstPixel> worst;

    // The same values: NaN equals NaN, +0 equals -0, an infinity equals itself only.
    bool equal() const { return differing == 0; }
    // The same bits.
    bool identical() const { return differing == 0 && signedZeros == 0 && nanPayloads == 0; }
    // Of all samples, in [0, 1].
    double fractionDiffering() const {
        return samples == 0 ? 0.0 : static_cast<double>(differing) / static_cast<double>(samples);
    }
};

struct Comparison {
    int widthA = 0, heightA = 0, widthB = 0, heightB = 0;
    // Names of channels that one frame lacks, and of those that are float in one and uint32 in the other.
    std::vector<std::string> onlyInA, onlyInB, otherType;
    // The channels that could be compared, in the order of a; none when the sizes differ.
    std::vector<ChannelComparison> channels;

    bool sameShape() const {
        return widthA == widthB && heightA == heightB && onlyInA.empty() && onlyInB.empty() &&
               otherType.empty();
    }
    bool equal() const;
    bool identical() const;
};

// Compares channel by channel, by name; the order of channels and the metadata do not matter. Keeps the
// maxWorst worst samples of each channel. Both frames must pass checkFrame.
Comparison compareFrames(const Frame& a, const Frame& b, int maxWorst = 5);

// |b - a| per sample, rounded to float once and at most the largest float; +infinity where the samples are
// incomparable (kIncomparableUlp). Same width, height and channels.
Image<float> errorImage(const Image<float>& a, const Image<float>& b);

// The error images of the channels that both frames have with the same type, under their names; |b - a| of
// uint32_t channels likewise as float. The frames must have the same size and share a channel.
Frame errorFrame(const Frame& a, const Frame& b);

}  // namespace etalon
