#include "numeric/sum.h"

#include <doctest/doctest.h>

#include <bit>
#include <cmath>
#include <limits>
#include <vector>

#include "numeric/truth.h"
#include "tests/support/random_numbers.h"

using namespace etalon;

namespace {

// Positive numbers of very different size, as the texels of an HDR image.
std::vector<float> texels(size_t count) {
    RandomNumbers random(3);
    std::vector<float> r(count);
    for (float& x : r)
        x = static_cast<float>(random.uniform(0.0, 1.0) * (random.below(1000) == 0 ? 1000.0 : 1.0));
    return r;
}

// Exact: whole multiples of 2^-60 in 128 bits hold every float in [2^-36, 2^20) and 2^24 of them.
double exactSum(const std::vector<float>& values) {
    __extension__ using Wide = __int128;
    Wide sum = 0;
    for (float x : values) sum += static_cast<Wide>(static_cast<double>(x) * 0x1p60);
    return static_cast<double>(sum) * 0x1p-60;
}

// The bound that the docstring of fixedSum states, per unit of the sum of the magnitudes.
double errorBound(size_t count) {
    const double tiles = std::ceil(static_cast<double>(count) / kSumTile);
    return (static_cast<double>(kSumTile) / kSumLanes + 5.0 + std::ceil(std::log2(tiles))) * 0x1p-53;
}

uint64_t bitsOf(double x) { return std::bit_cast<uint64_t>(x); }

}  // namespace

TEST_CASE("SumsHaveTheSameBitsForAnyNumberOfThreads") {
    for (size_t count : {1u, 31u, 33u, 1023u, 1024u, 1025u, 65536u, 300001u}) {
        const std::vector<float> values = texels(count);
        std::vector<double> wide(values.begin(), values.end());
        const double one = fixedSum(std::span<const float>(values), 1);
        for (int threads : {0, 2, 7}) {
            CHECK(bitsOf(fixedSum(std::span<const float>(values), threads)) == bitsOf(one));
            CHECK(bitsOf(fixedSum(std::span<const double>(wide), threads)) == bitsOf(one));
        }
    }
}

TEST_CASE("SumOf16MillionFloatsIsWithinItsBoundWhereARunningFloatSumIsNot") {
    const std::vector<float> values = texels(size_t{1} << 24);
    const double exact = exactSum(values);
    const double error = std::abs(fixedSum(std::span<const float>(values), 2) - exact) / exact;
    MESSAGE("relative error " << error);
    CHECK(error <= errorBound(values.size()));

    float running = 0.f;
    for (float x : values) running += x;
    CHECK(std::abs(running - exact) / exact > 1e-3);
}

TEST_CASE("SumOfCancellingDoublesIsWithinItsBound") {
    RandomNumbers random(9);
    for (size_t count : {5u, 1000u, 5000u}) {
        std::vector<double> values(count);
        Truth exact(0.0);
        double magnitudes = 0.0;
        for (double& x : values) {
            x = std::ldexp(random.uniform(-1.0, 1.0), random.below(60));
            exact = exact + Truth(x);
            magnitudes += std::abs(x);
        }
        const double sum = fixedSum(std::span<const double>(values));
        CHECK(std::abs((Truth(sum) - exact).toDouble()) <= errorBound(count) * magnitudes);
    }
}

TEST_CASE("SumsFollowTheWrittenShape") {
    // 2^53 swallows a single 1 that is added to it, but not 2. Lane 0 adds values 0 and 32, lane 16 joins
    // lane 0.
    std::vector<double> values(64, 0.0);
    values[0] = 0x1p53;
    values[32] = 1.0;
    CHECK(fixedSum(std::span<const double>(values)) == 0x1p53);
    values[32] = 0.0;
    values[16] = values[48] = 1.0;
    CHECK(fixedSum(std::span<const double>(values)) == 0x1p53 + 2.0);
    // Tiles 0 and 1 are added first, then 2 joins.
    values.assign(3 * kSumTile, 0.0);
    values[0] = 0x1p53;
    values[kSumTile] = values[2 * kSumTile] = 1.0;
    CHECK(fixedSum(std::span<const double>(values)) == 0x1p53);
    values[kSumTile] = 0.0;
    values[2 * kSumTile] = 2.0;
    CHECK(fixedSum(std::span<const double>(values)) == 0x1p53 + 2.0);
}

TEST_CASE("SumsOfNothingAreZeroAndNanAndInfinityPass") {
    const double inf = std::numeric_limits<double>::infinity(),
                 nan = std::numeric_limits<double>::quiet_NaN();
    CHECK(bitsOf(fixedSum(std::span<const float>())) == 0);
    CHECK(bitsOf(fixedSum(std::span<const double>(), 3)) == 0);
    std::vector<double> values(5000, 1.0);
    values[4000] = inf;
    CHECK(fixedSum(std::span<const double>(values)) == inf);
    values[10] = -inf;
    CHECK(bitsOf(fixedSum(std::span<const double>(values))) == bitsOf(nan));
    values[10] = -nan;
    CHECK(bitsOf(fixedSum(std::span<const double>(values))) == bitsOf(nan));
}
