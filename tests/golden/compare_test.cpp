#include "golden/compare.h"

#include <doctest/doctest.h>

#include <bit>
#include <cmath>
#include <limits>

namespace etalon {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN(),
                kInfinity = std::numeric_limits<float>::infinity();
constexpr float kDenormal = std::numeric_limits<float>::denorm_min(),
                kMax = std::numeric_limits<float>::max();

Image<float> imageOf(std::vector<float> values, int width) {
    Image<float> image(width, static_cast<int>(values.size()) / width);
    std::ranges::copy(values, image.values().begin());
    return image;
}

Frame frameOf(std::vector<float> values, const std::string& name = "R") {
    const int width = static_cast<int>(values.size());
    return {width, 1, {{name, imageOf(std::move(values), width)}}, {}};
}

ChannelComparison compareValues(std::vector<float> a, std::vector<float> b, int maxWorst = 5) {
    const Comparison comparison = compareFrames(frameOf(std::move(a)), frameOf(std::move(b)), maxWorst);
    REQUIRE(comparison.channels.size() == 1);
    CHECK(comparison.equal() == comparison.channels[0].equal());
    return comparison.channels[0];
}

float next(float value) { return std::bit_cast<float>(std::bit_cast<uint32_t>(value) + 1); }

}  // namespace

TEST_CASE("SameBitsAreIdentical") {
    const ChannelComparison result =
        compareValues({1, -2, kNan, kInfinity, 0.0f}, {1, -2, kNan, kInfinity, 0.0f});
    CHECK(result.identical());
    CHECK(result.finite == 3);
    CHECK(result.ulpHistogram[0] == 3);
    CHECK(result.worst.empty());
}

TEST_CASE("AllNanDiffersFromFinite") {
    const ChannelComparison result = compareValues({kNan, kNan, kNan}, {0, 1, 2});
    CHECK_FALSE(result.equal());
    CHECK(result.nanMismatches == 3);
    CHECK(result.differing == 3);
    CHECK(result.finite == 0);
    CHECK(result.fractionDiffering() == 1.0);
    REQUIRE(result.worst.size() == 3);
    CHECK(result.worst[0].x == 0);
    CHECK(result.worst[0].ulp == kIncomparableUlp);
}

TEST_CASE("OneInfinitePixelDiffers") {
    const ChannelComparison result = compareValues({1, 2, 3}, {1, kInfinity, 3.5f});
    CHECK(result.infinityMismatches == 1);
    CHECK(result.differing == 2);
    CHECK(result.worst[0].x == 1);
    CHECK(result.worst[1].x == 2);
    // The finite samples are still measured.
    CHECK(result.maxAbsolute == 0.5);
}

TEST_CASE("SignOfInfinityCounts") { CHECK(compareValues({kInfinity}, {-kInfinity}).infinityMismatches == 1); }

TEST_CASE("NanAgainstInfinityIsANanMismatch") {
    const ChannelComparison result = compareValues({kNan}, {kInfinity});
    CHECK(result.nanMismatches == 1);
    CHECK(result.infinityMismatches == 0);
}

TEST_CASE("NanPayloadsAreEqualButNotIdentical") {
    const float other = std::bit_cast<float>(0xffc00001u);
    const ChannelComparison result = compareValues({kNan, 1}, {other, 1});
    CHECK(result.equal());
    CHECK_FALSE(result.identical());
    CHECK(result.nanPayloads == 1);
}

TEST_CASE("SignedZerosAreEqualButNotIdentical") {
    const ChannelComparison result = compareValues({0.0f, -0.0f, 0.0f}, {-0.0f, 0.0f, 0.0f});
    CHECK(result.equal());
    CHECK_FALSE(result.identical());
    CHECK(result.signedZeros == 2);
    CHECK(result.maxUlp == 0);
    CHECK(result.ulpHistogram[0] == 3);
}

TEST_CASE("DifferentSizesDiffer") {
    const Comparison comparison = compareFrames(frameOf({1, 2}), frameOf({1, 2, 3}));
    CHECK_FALSE(comparison.equal());
    CHECK(comparison.channels.empty());
    CHECK(comparison.widthB == 3);
}

TEST_CASE("MissingChannelsDiffer") {
    Frame a = frameOf({1}, "R"), b = frameOf({1}, "R");
    a.channels.push_back({"Z", imageOf({1}, 1)});
    b.channels.push_back({"A", imageOf({1}, 1)});
    const Comparison comparison = compareFrames(a, b);
    CHECK_FALSE(comparison.equal());
    CHECK(comparison.onlyInA == std::vector<std::string>{"Z"});
    CHECK(comparison.onlyInB == std::vector<std::string>{"A"});
    REQUIRE(comparison.channels.size() == 1);
    CHECK(comparison.channels[0].identical());
}

TEST_CASE("ChannelTypesDiffer") {
    Frame a = frameOf({0}, "id"), b = a;
    b.channels[0].values = Image<uint32_t>(1, 1);
    const Comparison comparison = compareFrames(a, b);
    CHECK_FALSE(comparison.equal());
    CHECK(comparison.otherType == std::vector<std::string>{"id"});
}

TEST_CASE("OrderOfChannelsDoesNotMatter") {
    Frame a = frameOf({1}, "R"), b = frameOf({2}, "G");
    a.channels.push_back(b.channels[0]);
    b.channels.push_back(a.channels[0]);
    CHECK(compareFrames(a, b).identical());
}

TEST_CASE("FramesWithoutChannelsAreRefused") { CHECK_THROWS_AS(compareFrames({}, {}), PreconditionError); }

TEST_CASE("NeighboursAreOneUlpApart") {
    // Inside a binade, across a power of two, between denormals, from the largest denormal to the least
    // normal, and from zero to the least denormal of either sign.
    for (const float value :
         {1.5f, std::bit_cast<float>(0x3f7fffffu), kDenormal, std::bit_cast<float>(0x007fffffu), 0.0f}) {
        CHECK(ulpDistance(value, next(value)) == 1);
        CHECK(ulpDistance(-value, -next(value)) == 1);
        CHECK(compareValues({value}, {next(value)}).maxUlp == 1);
    }
    CHECK(std::bit_cast<float>(0x3f7fffffu) < 1.0f);
    CHECK(ulpDistance(-0.0f, kDenormal) == 1);
}

TEST_CASE("UlpDistanceCrossesZero") {
    CHECK(ulpDistance(-kDenormal, kDenormal) == 2);
    CHECK(ulpDistance(0.0f, -0.0f) == 0);
    CHECK(ulpDistance(-kMax, kMax) == 2 * uint64_t{0x7f7fffff});
    CHECK(orderedInteger(-kDenormal) == -1);
}

TEST_CASE("HistogramCountsEveryFiniteSampleOnce") {
    CHECK(ulpBucket(0) == 0);
    CHECK(ulpBucket(1) == 1);
    CHECK(ulpBucket(2) == 2);
    for (int bucket = 3; bucket < kUlpBuckets; ++bucket) {
        CHECK(ulpBucket(ulpBucketEnd(bucket)) == bucket);
        CHECK(ulpBucket(ulpBucketEnd(bucket - 1) + 1) == bucket);
    }
    CHECK(ulpBucketEnd(kUlpBuckets - 1) == uint64_t{1} << 32);
    const auto plus = [](uint32_t ulp) { return std::bit_cast<float>(0x3f800000u + ulp); };
    const ChannelComparison result =
        compareValues({1, 1, 1, 1, 1, kNan}, {1, plus(1), plus(3), plus(4), plus(5), 1});
    CHECK(result.ulpHistogram[0] == 1);
    CHECK(result.ulpHistogram[1] == 1);
    CHECK(result.ulpHistogram[2] == 0);
    CHECK(result.ulpHistogram[3] == 2);
    CHECK(result.ulpHistogram[4] == 1);
    CHECK(result.finite == 5);
}

TEST_CASE("FiguresAreThoseOfTheDefinition") {
    const ChannelComparison result = compareValues({1, 2, 4, 0}, {1, 4, 3, 0});
    CHECK(result.differing == 2);
    CHECK(result.fractionDiffering() == 0.5);
    CHECK(result.maxAbsolute == 2.0);
    CHECK(result.meanAbsolute == 0.75);
    CHECK(result.maxRelative == 0.5);
    CHECK(result.meanRelative == (0.5 + 0.25) / 4);
    CHECK(result.rmse * result.rmse == doctest::Approx(5.0 / 4));
    CHECK(result.bias == 0.25);
    CHECK(result.maxUlp == uint64_t{1} << 23);
}

// What is infinite or NaN in a frame is counted, and is no part of a mean: not above the line, not below.
TEST_CASE("MeansAreThoseOfTheFiniteSamples") {
    const ChannelComparison finite = compareValues({1, 2, 4, 0}, {1, 4, 3, 0});
    const ChannelComparison mixed = compareValues({1, kNan, 2, kInfinity, 4, kInfinity, 0, -kInfinity, kNan},
                                                  {1, kNan, 4, kInfinity, 3, 1, 0, kInfinity, 1});
    CHECK(mixed.samples == 9);
    CHECK(mixed.finite == 4);
    CHECK(mixed.nanMismatches == 1);
    CHECK(mixed.infinityMismatches == 2);
    for (const ChannelComparison& result : {finite, mixed}) {
        CHECK(result.meanUlp == ((1 << 23) + (1 << 22)) / 4.0);
        CHECK(result.meanAbsolute == (2.0 + 1.0) / 4);
        CHECK(result.meanRelative == (0.5 + 0.25) / 4);
        CHECK(result.rmse == std::sqrt((4.0 + 1.0) / 4));
        CHECK(result.bias == (2.0 - 1.0) / 4);
    }
}

TEST_CASE("LargestDistancesDoNotOverflow") {
    const ChannelComparison result = compareValues({-kMax}, {kMax});
    CHECK(result.maxAbsolute == 2 * static_cast<double>(kMax));
    CHECK(result.rmse == 2 * static_cast<double>(kMax));
    CHECK(result.maxRelative == 2.0);
}

TEST_CASE("WorstPixelsAreTheFurthestInReadingOrder") {
    const Image<float> a(3, 3);
    Image<float> b(3, 3);
    b.at(2, 0) = kDenormal;
    b.at(0, 1) = 3 * kDenormal;
    b.at(1, 1) = 2 * kDenormal;
    b.at(2, 2) = 3 * kDenormal;
    b.at(0, 0) = 2 * kDenormal;
    const Comparison comparison = compareFrames({3, 3, {{"R", a}}, {}}, {3, 3, {{"R", b}}, {}}, 3);
    const std::vector<WorstPixel>& worst = comparison.channels[0].worst;
    REQUIRE(worst.size() == 3);
    CHECK((worst[0].x == 0 && worst[0].y == 1 && worst[0].ulp == 3));
    CHECK((worst[1].x == 2 && worst[1].y == 2 && worst[1].ulp == 3));
    CHECK((worst[2].x == 0 && worst[2].y == 0 && worst[2].ulp == 2));
    CHECK(worst[0].b == 3 * static_cast<double>(kDenormal));
    CHECK(compareValues({1}, {2}, 0).worst.empty());
}

TEST_CASE("IdentifiersAreComparedAsIntegers") {
    Image<uint32_t> a(2, 1), b(2, 1);
    // As floats these would be NaN of different payloads.
    a.at(0, 0) = 0xffffffffu;
    b.at(0, 0) = 0xfffffffeu;
    b.at(1, 0) = 0xffffffffu;
    const Comparison comparison = compareFrames({2, 1, {{"id", a}}, {}}, {2, 1, {{"id", b}}, {}});
    CHECK(comparison.channels[0].differing == 2);
    CHECK(comparison.channels[0].ulpHistogram[1] == 1);
    CHECK(comparison.channels[0].maxUlp == 0xffffffffu);
}

TEST_CASE("ErrorImageMarksWhatCannotBeCompared") {
    const Image<float> error = errorImage(imageOf({1, kNan, kNan, 0.0f, kInfinity, -kMax}, 3),
                                          imageOf({3, kNan, 1, -0.0f, 1, kMax}, 3));
    CHECK(error == imageOf({2, 0, kInfinity, 0, kInfinity, kMax}, 3));
    CHECK_THROWS_AS(errorImage(Image<float>(1, 1), Image<float>(2, 1)), PreconditionError);
}

TEST_CASE("ErrorFrameHoldsTheSharedChannels") {
    Frame a = frameOf({1}, "R"), b = frameOf({4}, "R");
    a.channels.push_back({"Z", imageOf({1}, 1)});
    a.channels.push_back({"id", Image<uint32_t>(1, 1)});
    b.channels.push_back({"id", Image<uint32_t>(1, 1)});
    const Frame error = errorFrame(a, b);
    CHECK(error.channels.size() == 2);
    CHECK(std::get<Image<float>>(error.find("R")->values).at(0, 0) == 3.0f);
    CHECK(std::get<Image<float>>(error.find("id")->values).at(0, 0) == 0.0f);
}

}  // namespace etalon
