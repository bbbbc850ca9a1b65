#include "app/report.h"

#include <bit>
#include <iterator>

#include "numeric/text.h"

namespace etalon {
namespace {

std::string ulpText(uint64_t ulp) {
    return ulp == kIncomparableUlp ? "incomparable" : formatText("{} ulp", ulp);
}

// "3-4" for the bucket of the distances 3 and 4.
std::string bucketText(int bucket) {
    const uint64_t end = ulpBucketEnd(bucket), begin = bucket < 2 ? end : ulpBucketEnd(bucket - 1) + 1;
    return begin == end ? formatText("{}", end) : formatText("{}-{}", begin, end);
}

void appendChannel(std::string& text, const ChannelComparison& channel) {
    if (channel.identical()) {
        text += formatText("  {}: identical\n", channel.name);
        return;
    }
    text += formatText("  {}: {} of {} samples differ ({:.4g} %)", channel.name, channel.differing,
                       channel.samples, 100 * channel.fractionDiffering());
    const auto count = [&](uint64_t number, const char* what) {
        if (number > 0) text += formatText(", {} {}", number, what);
    };
    count(channel.nanMismatches, "NaN in one only");
    count(channel.infinityMismatches, "infinity mismatches");
    count(channel.signedZeros, "zeros of other sign");
    count(channel.nanPayloads, "NaN of other bits");
    text += '\n';
    if (channel.differing == 0) return;
    text += formatText(
        "    ulp max {} mean {:.4g}; absolute max {:.6g} mean {:.4g}; relative max {:.6g} mean {:.4g}\n",
        channel.maxUlp, channel.meanUlp, channel.maxAbsolute, channel.meanAbsolute, channel.maxRelative,
        channel.meanRelative);
    text += formatText("    rmse {:.6g}, bias {:.6g}\n    samples by ulp:", channel.rmse, channel.bias);
    for (int bucket = 0; bucket < kUlpBuckets; ++bucket)
        if (const uint64_t number = channel.ulpHistogram[static_cast<size_t>(bucket)]; number > 0)
            text += formatText("  {}: {}", bucketText(bucket), number);
    text += '\n';
    for (const WorstPixel& pixel : channel.worst)
        text += formatText("    ({}, {}): {:.9g} against {:.9g}, {}\n", pixel.x, pixel.y, pixel.a, pixel.b,
                           ulpText(pixel.ulp));
}

Json channelJson(const ChannelComparison& channel) {
    Json histogram = Json::list(), worst = Json::list();
    for (int bucket = 0; bucket < kUlpBuckets; ++bucket)
        if (const uint64_t number = channel.ulpHistogram[static_cast<size_t>(bucket)]; number > 0)
            histogram.append({{"up_to_ulp", ulpBucketEnd(bucket)}, {"samples", number}});
    for (const WorstPixel& pixel : channel.worst)
        worst.append({{"x", pixel.x},
                      {"y", pixel.y},
                      {"a", Json::numberOf(pixel.a)},
                      {"b", Json::numberOf(pixel.b)},
                      {"ulp", pixel.ulp == kIncomparableUlp ? Json(nullptr) : Json(pixel.ulp)}});
    return {{"name", channel.name},
            {"equal", channel.equal()},
            {"identical", channel.identical()},
            {"samples", channel.samples},
            {"differing", channel.differing},
            {"fraction_differing", channel.fractionDiffering()},
            {"nan_mismatches", channel.nanMismatches},
            {"infinity_mismatches", channel.infinityMismatches},
            {"signed_zeros", channel.signedZeros},
            {"nan_payloads", channel.nanPayloads},
            {"finite", channel.finite},
            {"max_ulp", channel.maxUlp},
            {"mean_ulp", channel.meanUlp},
            {"max_absolute", channel.maxAbsolute},
            {"mean_absolute", channel.meanAbsolute},
            {"max_relative", channel.maxRelative},
            {"mean_relative", channel.meanRelative},
            {"rmse", channel.rmse},
            {"bias", channel.bias},
            {"ulp_histogram", histogram},
            {"worst", worst}};
}

}  // namespace

std::string comparisonText(const Comparison& comparison, const std::string& a, const std::string& b) {
    std::string text;
    const char* verdict = comparison.identical() ? "identical"
                          : comparison.equal()   ? "equal in value, not in bits"
                                                 : "different";
    text += formatText("{}: {} against {}\n", verdict, a, b);
    if (comparison.widthA != comparison.widthB || comparison.heightA != comparison.heightB)
        text += formatText("  size: {}x{} against {}x{}\n", comparison.widthA, comparison.heightA,
                           comparison.widthB, comparison.heightB);
    const auto list = [&](const std::vector<std::string>& names, const std::string& what) {
        if (!names.empty()) text += formatText("  channels {}: {}\n", what, joinText(names, ", "));
    };
    list(comparison.onlyInA, "only in " + a);
    list(comparison.onlyInB, "only in " + b);
    list(comparison.otherType, "of other type");
    for (const ChannelComparison& channel : comparison.channels) appendChannel(text, channel);
    return text;
}

Json comparisonJson(const Comparison& comparison) {
    Json channels = Json::list();
    for (const ChannelComparison& channel : comparison.channels) channels.append(channelJson(channel));
    return {{"equal", comparison.equal()},
            {"identical", comparison.identical()},
            {"size_a", Json::list({comparison.widthA, comparison.heightA})},
            {"size_b", Json::list({comparison.widthB, comparison.heightB})},
            {"only_in_a", comparison.onlyInA},
            {"only_in_b", comparison.onlyInB},
            {"other_type", comparison.otherType},
            {"channels", channels}};
}

}  // namespace etalon
