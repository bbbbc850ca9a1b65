// The 16-bit formats against an implementation that knows only their bit patterns and integers.
#include <doctest/doctest.h>

#include <array>
#include <atomic>
#include <bit>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <vector>

#include "numeric/parallel.h"
#include "numeric/rounded.h"

using namespace etalon;

namespace {

constexpr uint32_t kPatterns = 1u << 16;
constexpr int kWidth = 8;

// Sum and product of IEEE-like 16-bit patterns: a sign, 16 - p exponent bits, p - 1 fraction bits.
template <Format F>
class IntegerFloat {
  public:
    static constexpr int kFractionBits = F.significandBits - 1;
    static constexpr int kExponentCodes = 1 << (16 - F.significandBits);
    static constexpr uint32_t kInfinity = static_cast<uint32_t>(kExponentCodes - 1) << kFractionBits;
    static constexpr uint32_t kNan = kInfinity | 1u << (kFractionBits - 1);
    static constexpr uint32_t kSign = 1u << 15;
    static_assert(F.subnormals == Subnormals::keep && F.overflow == Overflow::infinity);
    static_assert(F.maxExponent == kExponentCodes / 2 - 1 && F.minExponent == 1 - F.maxExponent);

    static bool isNan(uint32_t a) { return (a & ~kSign) > kInfinity; }

    // The number that a finite pattern stands for is +-significand * 2^exponent.
    struct Parts {
        bool negative;
        uint64_t significand;
        int exponent;
    };
    static Parts parts(uint32_t a) {
        const int code = static_cast<int>((a & ~kSign) >> kFractionBits);
        const uint64_t fraction = a & ((1u << kFractionBits) - 1);
        const uint64_t leading = code == 0 ? 0 : uint64_t{1} << kFractionBits;
        return {(a & kSign) != 0, leading | fraction, (code == 0 ? 1 : code) + kLeastExponent - 1};
    }

    static uint32_t sum(uint32_t a, uint32_t b) {
        if (isNan(a) || isNan(b)) return kNan;
        const bool infiniteA = (a & ~kSign) == kInfinity, infiniteB = (b & ~kSign) == kInfinity;
        if (infiniteA) return infiniteB && a != b ? kNan : a;
        if (infiniteB) return b;
        Parts x = parts(a), y = parts(b);
        if (x.exponent < y.exponent) std::swap(x, y);
        // x moves up by kGuardBits, so that y is either aligned exactly or too small to matter but for its
        // sign.
        constexpr int kGuardBits = 48;
        const int distance = x.exponent - y.exponent;
        const int64_t large = static_cast<int64_t>(x.significand << kGuardBits);
        const bool lost = distance > kGuardBits && y.significand != 0;
        const int64_t small =
            distance > kGuardBits ? 0 : static_cast<int64_t>(y.significand << (kGuardBits - distance));
        int64_t total;
        if (x.negative == y.negative)
            total = large + small;
        else
            total = large - small - static_cast<int64_t>(lost);
        if (total == 0) return x.negative && y.negative ? kSign : 0;
        const bool negative = total < 0 ? !x.negative : x.negative;
        return packed(negative, static_cast<uint64_t>(total < 0 ? -total : total), x.exponent - kGuardBits,
                      lost);
    }

    static uint32_t product(uint32_t a, uint32_t b) {
        if (isNan(a) || isNan(b)) return kNan;
        const uint32_t sign = (a ^ b) & kSign, magnitudeA = a & ~kSign, magnitudeB = b & ~kSign;
        if (magnitudeA == kInfinity || magnitudeB == kInfinity)
            return magnitudeA == 0 || magnitudeB == 0 ? kNan : sign | kInfinity;
        if (magnitudeA == 0 || magnitudeB == 0) return sign;
        const Parts x = parts(a), y = parts(b);
        return packed(sign != 0, x.significand * y.significand, x.exponent + y.exponent, false);
    }

  private:
    // The exponent of the last bit of subnormal numbers.
    static constexpr int kLeastExponent = F.minExponent - kFractionBits;

    // The pattern of +-(significand + rest) * 2^exponent rounded to F, where rest is 0, or in (0, 1) if
    // `sticky`.
    static uint32_t packed(bool negative, uint64_t significand, int exponent, bool sticky) {
        const uint32_t sign = negative ? kSign : 0;
        const int width = std::bit_width(significand);
        int target = exponent + width - F.significandBits;
        if (target < kLeastExponent) target = kLeastExponent;
        const int shift = target - exponent;
        uint64_t kept;
        if (shift <= 0) {
            kept = significand << -shift;
        } else if (shift > width + 1) {
            kept = 0;  // below half of the smallest number
        } else {
            kept = significand >> shift;
            const uint64_t half = uint64_t{1} << (shift - 1);
            const uint64_t rest = significand & (2 * half - 1);
            const bool above = rest > half || (rest == half && (sticky || (kept & 1) != 0));
            if (F.rounding == Rounding::nearestEven && above) kept++;
        }
        if (kept == uint64_t{1} << F.significandBits) {
            kept >>= 1;
            target++;
        }
        const bool normal = kept >> kFractionBits != 0;
        const int code = normal ? target - kLeastExponent + 1 : 0;
        if (code >= kExponentCodes - 1)
            return sign | (F.rounding == Rounding::nearestEven ? kInfinity : kInfinity - 1);
        return sign | static_cast<uint32_t>(code) << kFractionBits |
               (static_cast<uint32_t>(kept) & ((1u << kFractionBits) - 1));
    }
};

// The double of every pattern; all NaN patterns give the one NaN of Rounded.
template <Format F>
std::vector<double> decodedPatterns() {
    using I = IntegerFloat<F>;
    std::vector<double> values(kPatterns);
    for (uint32_t a = 0; a < kPatterns; a++) {
        const auto x = I::parts(a);
        double magnitude = static_cast<double>(x.significand) * powerOfTwo(x.exponent);
        if ((a & ~I::kSign) == I::kInfinity) magnitude = std::numeric_limits<double>::infinity();
        values[a] = I::isNan(a) ? kCanonicalNan : x.negative ? -magnitude : magnitude;
    }
    return values;
}

struct Differences {
    size_t pairs = 0, sum = 0, product = 0;
};

// Compares sums and products of every pattern a with the b = start(a), start(a) + stride, ... (count of
// them).
template <Format F>
Differences compareAll(uint32_t count, uint32_t stride) {
    using I = IntegerFloat<F>;
    using R = Rounded<F, Lanes<double, kWidth>>;
    using L = Lanes<double, kWidth>;
    const std::vector<double> values = decodedPatterns<F>();
    std::atomic<size_t> sums = 0, products = 0;
    parallelFor(kPatterns, 0, [&](size_t index) {
        const uint32_t a = static_cast<uint32_t>(index);
        const R x = R::ofRepresentable(L(values[a]));
        size_t sumDifferences = 0, productDifferences = 0;
        for (uint32_t j = 0; j < count; j += kWidth) {
            std::array<uint32_t, kWidth> b;
            for (uint32_t i = 0; i < kWidth; i++) b[i] = (a * 40503u + (j + i) * stride) % kPatterns;
            const R y =
                R::ofRepresentable(L::generate([&](int i) { return values[b[static_cast<size_t>(i)]]; }));
            const L sum = (x + y).v, product = (x * y).v;
            for (int i = 0; i < kWidth; i++) {
                const uint32_t other = b[static_cast<size_t>(i)];
                sumDifferences +=
                    std::bit_cast<int64_t>(sum[i]) != std::bit_cast<int64_t>(values[I::sum(a, other)]);
                productDifferences += std::bit_cast<int64_t>(product[i]) !=
                                      std::bit_cast<int64_t>(values[I::product(a, other)]);
            }
        }
        sums += sumDifferences;
        products += productDifferences;
    });
    return {size_t{kPatterns} * count, sums, products};
}

template <Format F>
void checkPatterns(uint32_t count, uint32_t stride) {
    const Differences found = compareAll<F>(count, stride);
    CHECK(found.pairs == size_t{kPatterns} * count);
    CHECK(found.sum == 0);
    CHECK(found.product == 0);
}

// Pairs per pattern in the normal run, and a stride that varies high and low bits of the pattern at once.
constexpr uint32_t kSampleCount = 128;
constexpr uint32_t kSampleStride = 513;

const bool kExhaustive = std::getenv("ETALON_EXHAUSTIVE") != nullptr;

}  // namespace

TEST_CASE("SixteenBitFormatsEqualIntegerArithmeticOnASampleOfPairs") {
    checkPatterns<kFp16>(kSampleCount, kSampleStride);
    checkPatterns<kFp16TowardZero>(kSampleCount, kSampleStride);
    checkPatterns<kBf16>(kSampleCount, kSampleStride);
}

TEST_CASE("IntegerArithmeticTellsRoundingDirectionsApart") {
    using Nearest = IntegerFloat<kFp16>;
    using Truncated = IntegerFloat<kFp16TowardZero>;
    const uint32_t one = 0x3c00, oneUlp = 0x1400, halfUlp = 0x1000;  // 1, 2^-10, 2^-11
    CHECK(Nearest::sum(one, oneUlp) == 0x3c01);
    CHECK(Nearest::sum(one, halfUlp) == 0x3c00);     // a tie goes to even
    CHECK(Nearest::sum(0x3c01, halfUlp) == 0x3c02);  // also up
    CHECK(Truncated::sum(0x3c01, halfUlp) == 0x3c01);
    CHECK(Nearest::product(0x7bff, 0x4000) == 0x7c00);  // 65504 * 2
    CHECK(Truncated::product(0x7bff, 0x4000) == 0x7bff);
    CHECK(Nearest::product(0x0001, 0x3800) == 0x0000);  // half of the smallest subnormal: tie to even
    CHECK(Nearest::product(0x0003, 0x3800) == 0x0002);
    CHECK(Truncated::product(0x0003, 0x3800) == 0x0001);
}

// All 2^32 pairs for + and *; runs with ETALON_EXHAUSTIVE=1 in the environment (minutes).
TEST_CASE("Fp16EqualsIntegerArithmeticForAllPairs" * doctest::skip(!kExhaustive)) {
    checkPatterns<kFp16>(kPatterns, 1);
}
TEST_CASE("Fp16TowardZeroEqualsIntegerArithmeticForAllPairs" * doctest::skip(!kExhaustive)) {
    checkPatterns<kFp16TowardZero>(kPatterns, 1);
}
TEST_CASE("Bf16EqualsIntegerArithmeticForAllPairs" * doctest::skip(!kExhaustive)) {
    checkPatterns<kBf16>(kPatterns, 1);
}
