// The functions of float over sums of two floats: their parts against double, which holds them exactly, and their errors
// over all floats. Samples of those run always, all with ETALON_EXHAUSTIVE=1 (minutes). That gave, in units in the last
// place: sine 0.5016, cosine 0.5015, over all floats; power 0.5040, angle of a vector 0.5042, over 2^28 pairs each;
// logarithm 2^-37.92 of itself, over all significands.
#include <doctest/doctest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <vector>

#include "numeric/elementary.h"
#include "numeric/parallel.h"
#include "numeric/text.h"
#include "tests/support/random_numbers.h"

using namespace etalon;

namespace {

constexpr int kWidth = 8;
using F = Lanes<float, kWidth>;
using D = Lanes<double, kWidth>;
using Functions = ElementaryFunctions<F>;

bool isExhaustive() { return std::getenv("ETALON_EXHAUSTIVE") != nullptr; }

// |computed - exact| in units in the last place of a float at exact, which is in the normal range.
double ulpsOf(float computed, double exact) {
    return std::ldexp(std::abs(static_cast<double>(computed) - exact), 23 - std::ilogb(exact));
}

struct Worst {
    double error = 0;
    float at = 0, and_ = 0;
};

// error(first lane's index) over `count` groups of lanes, side by side: the worst.
template <class Error>
Worst worstOf(size_t count, Error&& error) {
    std::vector<Worst> worst((count + 0xffff) >> 16);
    parallelFor(worst.size(), 0, [&](size_t block) {
        const size_t end = std::min(count, (block + 1) << 16);
        for (size_t i = block << 16; i < end; i++) error(i, worst[block]);
    });
    return *std::max_element(worst.begin(), worst.end(),
                             [](const Worst& a, const Worst& b) { return a.error < b.error; });
}

void note(Worst& worst, double error, float at, float and_ = 0) {
    if (!(error <= worst.error)) worst = {error, at, and_};
}

// The floats from 2^-126 to 2^20, by groups of lanes: all, or every 509th.
constexpr uint32_t kFirst = 0x00800000, kLast = 0x49800000;
uint32_t strideOfFloats() { return isExhaustive() ? 1 : 509; }
size_t groupsOfFloats() { return (kLast - kFirst) / (strideOfFloats() * kWidth); }
F floatsOf(size_t group) {
    return F::generate([&](int i) {
        return std::bit_cast<float>(
            static_cast<uint32_t>(kFirst + (group * kWidth + static_cast<size_t>(i)) * strideOfFloats()));
    });
}

template <class OfFloats, class OfDoubles>
Worst worstOverAngles(OfFloats&& ofFloats, OfDoubles&& ofDoubles) {
    return worstOf(groupsOfFloats(), [&](size_t group, Worst& worst) {
        const F angle = floatsOf(group), computed = ofFloats(angle);
        const D exact = ofDoubles(convertLanes<double>(angle));
        for (int i = 0; i < kWidth; i++) note(worst, ulpsOf(computed[i], exact[i]), angle[i]);
    });
}

void report(const char* name, const Worst& worst) {
    MESSAGE(formatText("{}: {} at {:a}, {:a}", name, worst.error, worst.at, worst.and_));
}

}  // namespace

TEST_CASE("SumsAndProductsOfFloatsAreExact") {
    FloatTexts<float> texts;
    RandomNumbers random(1);
    for (int i = 0; i < 1 << 18; i++) {
        const auto number = [&](int exponents) {
            const double significand = random.uniform(1.0, 2.0);
            const float magnitude = static_cast<float>(std::ldexp(significand, random.below(exponents)));
            return random.below(2) == 0 ? magnitude : -magnitude;
        };
        const float a = number(8), b = number(8);
        const auto product = texts.productOf(a, b);
        CHECK(product.high == a * b);
        CHECK(static_cast<double>(product.high) + product.low == static_cast<double>(a) * b);
        const auto sum = texts.sumOf(a, b);
        CHECK(sum.high == a + b);
        CHECK(static_cast<double>(sum.high) + sum.low == static_cast<double>(a) + b);
        const float larger = std::abs(a) < std::abs(b) ? b : a, smaller = std::abs(a) < std::abs(b) ? a : b;
        CHECK(texts.sumOfOrdered(larger, smaller).low == sum.low);
        CHECK(texts.leadingPart(a) ==
              std::ldexp(std::trunc(std::ldexp(a, 11 - std::ilogb(a))), std::ilogb(a) - 11));
    }
}

// The tables are what their comments say.
TEST_CASE("TablesOfFloatFunctionsHoldTheirValues") {
    FloatTexts<float> texts;
    for (int i = 0; i < 32; i++) {
        const double high = texts.logarithmHigh(i), low = texts.logarithmLow(i);
        // 6 bits of significand, from 0.703125 on.
        const double centre = i < 19 ? (45 + i) / 64.0 : (i - 19 + 32) / 32.0;
        CHECK(std::abs(high + low - std::log(centre)) < 0x1p-50);
    }
    for (int j = 0; j < 16; j++) {
        const double high = texts.rootOfTwoHigh(j), low = texts.rootOfTwoLow(j);
        CHECK(std::abs(high + low - std::exp2(j / 16.0)) < 0x1p-36);
        CHECK(texts.leadingPart(texts.rootOfTwoHigh(j)) == high);
    }
    for (int k = 0; k <= 13; k++) {
        CHECK(std::abs(static_cast<double>(texts.sineHigh(k)) + texts.sineLow(k) - std::sin(k / 16.0)) <
              0x1p-36);
        CHECK(std::abs(static_cast<double>(texts.cosineHigh(k)) + texts.cosineLow(k) - std::cos(k / 16.0)) <
              0x1p-36);
        CHECK(texts.leadingPart(texts.sineHigh(k)) == texts.sineHigh(k));
        CHECK(texts.leadingPart(texts.cosineHigh(k)) == texts.cosineHigh(k));
    }
    for (int k = 0; k <= 8; k++)
        CHECK(std::abs(static_cast<double>(texts.arcTangentHigh(k)) + texts.arcTangentLow(k) -
                       std::atan(k / 8.0)) < 0x1p-48);
}

// Two thousand million floats with ETALON_EXHAUSTIVE: those below 2^-15 are their sines, and their cosines are 1.
TEST_CASE("SineAndCosineOfEveryFloatAreWithinTheBound") {
    const Worst sine = worstOverAngles(&Functions::sinOf, &ElementaryFunctions<D>::sinOf);
    const Worst cosine = worstOverAngles(&Functions::cosOf, &ElementaryFunctions<D>::cosOf);
    report("sin, float, ulp", sine);
    report("cos, float, ulp", cosine);
    CHECK(sine.error <= kFloatErrorUlp);
    CHECK(cosine.error <= kFloatErrorUlp);
}

// For every significand, or every 31st, between the smallest and the largest exponent: what a power's error follows from.
TEST_CASE("LogarithmsOfFloatsAreWithinTheirBound") {
    const uint32_t stride = isExhaustive() ? 1 : 31;
    double worst = 0;
    for (const int exponent : {-126, -20, -2, -1, 0, 1, 2, 30, 127}) {
        const Worst found = worstOf((size_t{1} << 23) / (stride * kWidth), [&](size_t group, Worst& at) {
            const F x = F::generate([&](int i) {
                const size_t fraction = (group * kWidth + static_cast<size_t>(i)) * stride;
                return std::bit_cast<float>(
                    static_cast<uint32_t>(static_cast<size_t>(exponent + 127) << 23 | fraction));
            });
            const auto logarithm = FloatTexts<F>{}.pairLogarithm(x);
            const D exact = log2InDouble(convertLanes<double>(x)) * D(0x1.62e42fefa39efp-1);
            for (int i = 0; i < kWidth; i++) {
                if (x[i] == 1) continue;
                const double sum = static_cast<double>(logarithm.high[i]) + logarithm.low[i];
                note(at, std::abs(sum / exact[i] - 1), x[i]);
            }
        });
        worst = std::max(worst, found.error);
    }
    MESSAGE(formatText("ln, float, relative: 2^{}", std::log2(worst)));
    CHECK(worst < 0x1.1p-38);
}

// A million pairs, with ETALON_EXHAUSTIVE 2^28: bases of all magnitudes and near 1, results of the whole range.
TEST_CASE("PowersOfFloatsAreWithinTheBound") {
    const size_t groups = (size_t{1} << (isExhaustive() ? 28 : 20)) / kWidth;
    const Worst worst = worstOf(groups, [&](size_t group, Worst& at) {
        RandomNumbers random(group);
        F x, y;
        for (int i = 0; i < kWidth; i++) {
            const double fraction = random.uniform(0.0, 1.0), target = random.uniform(-126.0, 128.0);
            const int exponent = random.below(24);
            float base = static_cast<float>(fraction);
            if (i % 4 == 1) base = static_cast<float>(1 + std::ldexp(fraction, -exponent));
            if (i % 4 == 2) base = static_cast<float>(1 - std::ldexp(fraction, -exponent - 1));
            if (i % 4 == 3)
                base = std::bit_cast<float>(static_cast<uint32_t>(0x00800000 + fraction * 0x7f000000));
            if (!(base > 0) || base == 1) base = 0.5f;
            x.set(i, base);
            y.set(i, static_cast<float>(target / std::log2(static_cast<double>(base))));
        }
        const F power = Functions::powOf(x, y);
        const D exact = ElementaryFunctions<D>::powOf(convertLanes<double>(x), convertLanes<double>(y));
        for (int i = 0; i < kWidth; i++)
            if (exact[i] >= 0x1p-126 && exact[i] < 0x1p128 - 0x1p103)
                note(at, ulpsOf(power[i], exact[i]), x[i], y[i]);
    });
    report("pow, float, ulp", worst);
    CHECK(worst.error <= kFloatErrorUlp);
}

// The same for angles of vectors.
TEST_CASE("AnglesOfFloatVectorsAreWithinTheBound") {
    const size_t groups = (size_t{1} << (isExhaustive() ? 28 : 20)) / kWidth;
    const Worst worst = worstOf(groups, [&](size_t group, Worst& at) {
        RandomNumbers random(group);
        F y, x;
        for (int i = 0; i < kWidth; i++) {
            const double a = random.uniform(-1.0, 1.0), b = random.uniform(-1.0, 1.0);
            const int exponent = random.below(i % 2 == 0 ? 4 : 60), magnitude = random.below(60) - 30;
            y.set(i, static_cast<float>(std::ldexp(a, magnitude)));
            x.set(i, static_cast<float>(std::ldexp(b, magnitude - exponent)));
        }
        const F angle = Functions::atan2Of(y, x);
        const D exact = ElementaryFunctions<D>::atan2Of(convertLanes<double>(y), convertLanes<double>(x));
        for (int i = 0; i < kWidth; i++)
            if (std::abs(exact[i]) >= 0x1p-126) note(at, ulpsOf(angle[i], exact[i]), y[i], x[i]);
    });
    report("atan2, float, ulp", worst);
    CHECK(worst.error <= kFloatErrorUlp);
}
