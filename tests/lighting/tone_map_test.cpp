#include "lighting/tone_map.h"

#include <doctest/doctest.h>

#include <bit>
#include <cmath>
#include <limits>
#include <vector>

#include "numeric/format.h"
#include "numeric/rounded.h"
#include "numeric/truth.h"
#include "numeric/truth_elementary.h"
#include "tests/support/random_numbers.h"

namespace etalon {
namespace {

constexpr ToneMap kOperators[] = {ToneMap::linear, ToneMap::reinhard, ToneMap::filmic};

int byteOf(float radiance, ToneMap operation, double stops = 0.0) {
    Image<float> image(1, 1);
    image.at(0, 0) = radiance;
    return toneMap<float>(image, operation, stops, 1).at(0, 0);
}

// 255 v + 1/2 before the floor, in Truth, with the standard's own constants in decimal.
Truth decimal(const char* text) {
    Truth r;
    mpfr_set_str(r.get(), text, 10, MPFR_RNDN);
    return r;
}
Truth trueEncoding(const Truth& x) {
    if (x <= decimal("0.0031308")) return decimal("12.92") * x;
    return decimal("1.055") * ElementaryFunctions<Truth>::powOf(x, Truth(1.0) / decimal("2.4")) -
           decimal("0.055");
}
Truth trueDecoding(const Truth& x) {
    if (x <= decimal("0.04045")) return x / decimal("12.92");
    return ElementaryFunctions<Truth>::powOf((x + decimal("0.055")) / decimal("1.055"), decimal("2.4"));
}
Truth trueOperator(const Truth& x, ToneMap operation) {
    Truth y = x;
    if (operation == ToneMap::reinhard) y = x / (Truth(1.0) + x);
    if (operation == ToneMap::filmic)
        y = x * (decimal("2.51") * x + decimal("0.03")) /
            (x * (decimal("2.43") * x + decimal("0.59")) + decimal("0.14"));
    return y < Truth(1.0) ? y : Truth(1.0);
}

}  // namespace

TEST_CASE("SrgbCurvesInFloatStayBelowTheirErrorBound") {
    RandomNumbers random(1);
    ToneMapKernel<float> kernel;
    double worstEncoding = 0.0, worstDecoding = 0.0;
    for (int i = 0; i < 20000; i++) {
        const auto x = static_cast<float>(i == 0  ? 1.0
                                          : i % 2 ? random.uniform(0.0, 1.0)
                                                  : std::exp2(random.uniform(-12.0, 0.0)));
        worstEncoding = std::max(worstEncoding,
                                 std::abs((Truth(kernel.encodeSrgb(x)) - trueEncoding(Truth(x))).toDouble()));
        worstDecoding = std::max(worstDecoding,
                                 std::abs((Truth(kernel.decodeSrgb(x)) - trueDecoding(Truth(x))).toDouble()));
    }
    CHECK(worstEncoding <= kSrgbFloatError);
    CHECK(worstDecoding <= kSrgbFloatError);
    CHECK(std::max(worstEncoding, worstDecoding) >= 0.25 * kSrgbFloatError);
}

TEST_CASE("SrgbHasItsFixedPoints") {
    ToneMapKernel<float> kernel;
    CHECK(kernel.encodeSrgb(0.0f) == 0.0f);
    CHECK(kernel.decodeSrgb(0.0f) == 0.0f);
    CHECK(std::abs(kernel.encodeSrgb(1.0f) - 1.0f) <= 0x1p-23f);
    CHECK(std::abs(kernel.decodeSrgb(1.0f) - 1.0f) <= 0x1p-23f);
    // Middle grey: linear 0.2140411 is 0.5 (the standard's curve to seven digits).
    CHECK(std::abs(kernel.encodeSrgb(0.21404114f) - 0.5f) <= 1e-6f);
    CHECK(byteOf(0.21404114f, ToneMap::linear) == 128);
    CHECK(byteOf(0.18f, ToneMap::linear) == 118);
}

TEST_CASE("EveryByteSurvivesDecodingAndEncoding") {
    ToneMapKernel<float> kernel;
    for (int byte = 0; byte < 256; byte++)
        REQUIRE(byteOf(kernel.decodeSrgb(static_cast<float>(byte) / 255.0f), ToneMap::linear) == byte);
}

TEST_CASE("EncodingIsMonotone") {
    ToneMapKernel<float> kernel;
    // Through the joint and upwards, then every power of two and its neighbours.
    float previous = 0.0f;
    for (uint32_t bits = std::bit_cast<uint32_t>(0.0031f); bits < std::bit_cast<uint32_t>(0.0032f); bits++) {
        const auto x = std::bit_cast<float>(bits);
        const float v = kernel.encodeSrgb(x);
        const bool isFirstOfCurve = x > 0.0031308f && std::bit_cast<float>(bits - 1) <= 0.0031308f;
        REQUIRE(v >= previous - (isFirstOfCurve ? static_cast<float>(kSrgbJointFall) : 0.0f));
        previous = v;
    }
    for (ToneMap operation : kOperators) {
        int last = 0;
        float lastLinear = 0.0f;
        for (int exponent = -126; exponent < 128; exponent++)
            for (float x :
                 {std::nextafter(std::ldexp(1.0f, exponent), 0.0f), std::ldexp(1.0f, exponent),
                  std::ldexp(1.25f, exponent), std::ldexp(1.5f, exponent), std::ldexp(1.75f, exponent)}) {
                const int byte = byteOf(x, operation);
                const float linear = kernel.displayLinear(x, 1.0f, static_cast<int>(operation));
                REQUIRE(byte >= last);
                REQUIRE(linear >= lastLinear * (1.0f - static_cast<float>(kOperatorFloatError)));
                last = byte;
                lastLinear = linear;
            }
        CHECK(last == 255);
        CHECK(lastLinear == 1.0f);
    }
}

TEST_CASE("BytesDifferFromTruthOnlyAtRoundingBoundaries") {
    RandomNumbers random(2);
    for (ToneMap operation : kOperators) {
        int differing = 0;
        for (int i = 0; i < 20000; i++) {
            const auto x = static_cast<float>(std::exp2(random.uniform(-14.0, 6.0)));
            const double stops = random.below(9) - 4;
            const Truth exposed = Truth(x) * Truth(exposureScale(stops));
            const Truth position = trueEncoding(trueOperator(exposed, operation)) * Truth(255.0) + Truth(0.5);
            const int truth = toInteger(floorOf(position));
            const int byte = byteOf(x, operation, stops);
            if (byte == truth) continue;
            differing++;
            REQUIRE(std::abs(byte - truth) == 1);
            const double nearest = std::nearbyint(position.toDouble());
            REQUIRE(std::abs(position.toDouble() - nearest) <= kToneMapFloatErrorLsb);
        }
        CHECK(differing <= 20);
    }
}

TEST_CASE("OperatorsInFloatStayBelowTheirErrorBound") {
    RandomNumbers random(4);
    ToneMapKernel<float> kernel;
    for (ToneMap operation : {ToneMap::reinhard, ToneMap::filmic}) {
        double worst = 0.0;
        for (int i = 0; i < 20000; i++) {
            const auto x = static_cast<float>(std::exp2(random.uniform(-20.0, 30.0)));
            const Truth truth = trueOperator(Truth(x), operation);
            const Truth error = Truth(kernel.displayLinear(x, 1.0f, static_cast<int>(operation))) - truth;
            worst = std::max(worst, std::abs((error / truth).toDouble()));
        }
        CHECK(worst <= kOperatorFloatError);
        CHECK(worst >= 0.1 * kOperatorFloatError);
    }
}

TEST_CASE("OperatorsHaveTheirAnalyticValues") {
    ToneMapKernel<float> kernel;
    auto at = [&](float x, ToneMap operation) {
        return kernel.displayLinear(x, 1.0f, static_cast<int>(operation));
    };
    CHECK(at(0.25f, ToneMap::linear) == 0.25f);
    CHECK(at(3.0f, ToneMap::linear) == 1.0f);
    CHECK(at(1.0f, ToneMap::reinhard) == 0.5f);
    CHECK(at(3.0f, ToneMap::reinhard) == 0.75f);
    CHECK(std::abs(at(1.0f, ToneMap::filmic) - 2.54f / 3.16f) <= 1e-7f);
    CHECK(at(8.0f, ToneMap::filmic) == 1.0f);
    for (ToneMap operation : kOperators) CHECK(at(0.0f, operation) == 0.0f);
    CHECK(exposureScale(3.0) == 8.0);
    CHECK(exposureScale(-64.0) == 0x1p-64);
    CHECK(std::abs(exposureScale(0.5) - std::sqrt(2.0)) <= 0x1p-51);
    CHECK(byteOf(0.25f, ToneMap::reinhard, 2.0) == byteOf(1.0f, ToneMap::reinhard));
}

TEST_CASE_TEMPLATE("NonFiniteAndNegativeRadianceHaveDefinedBytes", R, float, double, Rounded<kFp32>,
                   Rounded<kFp16>, Lanes<float, 4>) {
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    Image<float> image(6, 1);
    const float values[6] = {std::numeric_limits<float>::quiet_NaN(), -1.0f, -kInfinity, -0.0f, kInfinity,
                             std::numeric_limits<float>::max()};
    for (int x = 0; x < 6; x++) image.at(x, 0) = values[x];
    for (ToneMap operation : kOperators)
        for (double stops : {-3.0, 0.0, 3.0}) {
            const Image<uint8_t> bytes = toneMap<R>(image, operation, stops, 1);
            for (int x = 0; x < 4; x++) CHECK(bytes.at(x, 0) == 0);
            for (int x = 4; x < 6; x++) CHECK(bytes.at(x, 0) == 255);
        }
    CHECK_THROWS_AS(toneMap(image, ToneMap::linear, 65.0), PreconditionError);
    CHECK_THROWS_AS(toneMap(image, ToneMap::linear, std::nan("")), PreconditionError);
}

TEST_CASE("ToneMappingDependsNeitherOnThreadsNorOnLanes") {
    RandomNumbers random(3);
    Image<float> image(29, 11, 3);
    for (float& v : image.values()) v = static_cast<float>(std::exp2(random.uniform(-12.0, 8.0)));
    for (ToneMap operation : kOperators) {
        const Image<uint8_t> scalar = toneMap<float>(image, operation, 0.3, 1);
        CHECK(toneMap(image, operation, 0.3, 1) == scalar);
        CHECK(toneMap(image, operation, 0.3, 3) == scalar);
        CHECK(toneMap<Lanes<float, 32>>(image, operation, 0.3, 2) == scalar);
        CHECK(toneMap<Rounded<kFp32, Lanes<double, 4>>>(image, operation, 0.3, 2) == scalar);
    }
    CHECK(toneMap(Image<float>(0, 0), ToneMap::linear, 0.0).empty());
}

}  // namespace etalon
