// The comparators on arbitrary frames: what is the same, what differs and by how much agrees with a plain
// reading of the bits, and both orders of the frames agree.
#include <bit>
#include <cmath>
#include <limits>

#include "golden/compare.h"
#include "golden/golden.h"
#include "golden/hash.h"
#include "tests/fuzz/fuzz.h"

using namespace etalon;

namespace {

constexpr int kMaxEdge = 6, kMaxChannels = 4, kMaxWorst = 3;
constexpr std::string_view kNames[] = {"R", "G", "B", "A", "Z", "N.X", "N.Y", "id"};

uint32_t takeSample(fuzz::ByteReader& bytes) {
    constexpr float kSpecial[] = {0.0f,
                                  -0.0f,
                                  1.0f,
                                  -1.0f,
                                  std::numeric_limits<float>::infinity(),
                                  -std::numeric_limits<float>::infinity(),
                                  std::numeric_limits<float>::quiet_NaN(),
                                  std::numeric_limits<float>::max(),
                                  std::numeric_limits<float>::lowest(),
                                  std::numeric_limits<float>::min(),
                                  std::numeric_limits<float>::denorm_min()};
    return bytes.boolean() ? std::bit_cast<uint32_t>(bytes.pick(kSpecial)) : bytes.take<uint32_t>();
}

Frame takeFrame(fuzz::ByteReader& bytes) {
    Frame frame;
    frame.width = bytes.integer(0, kMaxEdge);
    frame.height = bytes.integer(0, kMaxEdge);
    const int channels = bytes.integer(1, kMaxChannels);
    for (int c = 0; c < channels; c++) {
        const std::string name(bytes.pick(kNames));
        if (frame.find(name) != nullptr) continue;
        if (bytes.boolean()) {
            Image<uint32_t> image(frame.width, frame.height);
            for (uint32_t& value : image.values()) value = takeSample(bytes);
            frame.channels.push_back({name, std::move(image)});
        } else {
            Image<float> image(frame.width, frame.height);
            for (float& value : image.values()) value = std::bit_cast<float>(takeSample(bytes));
            frame.channels.push_back({name, std::move(image)});
        }
    }
    return frame;
}

// A frame of its own, or the first with some samples replaced and its channels turned round.
Frame takeSecond(fuzz::ByteReader& bytes, const Frame& first) {
    if (bytes.boolean()) return takeFrame(bytes);
    Frame frame = first;
    if (bytes.boolean()) frame.channels.assign(first.channels.rbegin(), first.channels.rend());
    while (!bytes.atEnd() && frame.width * frame.height > 0) {
        Channel& channel =
            frame
                .channels[static_cast<size_t>(bytes.integer(0, static_cast<int>(frame.channels.size()) - 1))];
        const int x = bytes.integer(0, frame.width - 1), y = bytes.integer(0, frame.height - 1);
        const uint32_t value = takeSample(bytes);
        if (auto* image = std::get_if<Image<float>>(&channel.values))
            image->at(x, y) = std::bit_cast<float>(value);
        else
            std::get<Image<uint32_t>>(channel.values).at(x, y) = value;
    }
    return frame;
}

struct Counts {
    uint64_t otherBits = 0, otherValues = 0, nanInOne = 0, infinityInOne = 0;
};

template <class T>
Counts countsOf(const Image<T>& a, const Image<T>& b) {
    Counts counts;
    for (size_t i = 0; i < a.values().size(); i++) {
        const T va = a.values()[i], vb = b.values()[i];
        const bool nanA = va != va, nanB = vb != vb;
        const auto isInfinite = [](T v) {
            return std::is_same_v<T, float> && std::isinf(static_cast<double>(v));
        };
        counts.otherBits += std::bit_cast<uint32_t>(va) != std::bit_cast<uint32_t>(vb) ? 1 : 0;
        counts.otherValues += va != vb && !(nanA && nanB) ? 1 : 0;
        counts.nanInOne += nanA != nanB ? 1 : 0;
        counts.infinityInOne += !nanA && !nanB && va != vb && (isInfinite(va) || isInfinite(vb)) ? 1 : 0;
    }
    return counts;
}

Counts countsOf(const Channel& a, const Channel& b) {
    return std::visit(
        [&](const auto& image) { return countsOf(image, std::get<std::decay_t<decltype(image)>>(b.values)); },
        a.values);
}

void checkChannel(const ChannelComparison& c, const Channel& a, const Channel& b) {
    const Counts expected = countsOf(a, b);
    FUZZ_CHECK(c.differing == expected.otherValues && c.equal() == (expected.otherValues == 0));
    FUZZ_CHECK(c.nanMismatches == expected.nanInOne && c.infinityMismatches == expected.infinityInOne);
    FUZZ_CHECK(c.identical() == (expected.otherBits == 0));
    FUZZ_CHECK(c.differing + c.signedZeros + c.nanPayloads == expected.otherBits);
    uint64_t counted = 0;
    for (const uint64_t count : c.ulpHistogram) counted += count;
    FUZZ_CHECK(counted == c.finite && c.finite <= c.samples);
    for (const double figure :
         {c.meanUlp, c.maxAbsolute, c.meanAbsolute, c.maxRelative, c.meanRelative, c.rmse, std::fabs(c.bias)})
        FUZZ_CHECK(std::isfinite(figure) && figure >= 0);
    // Between numbers of opposite sign the relative distance is at most 2.
    FUZZ_CHECK(c.maxRelative <= 2 && c.maxUlp <= ulpBucketEnd(kUlpBuckets - 1));
    FUZZ_CHECK((c.maxUlp > 0) == (c.differing > c.nanMismatches + c.infinityMismatches));
    FUZZ_CHECK(c.worst.size() == std::min<uint64_t>(c.differing, kMaxWorst));
}

void checkMirrored(const ChannelComparison& c, const ChannelComparison& m) {
    FUZZ_CHECK(c.samples == m.samples && c.differing == m.differing && c.finite == m.finite);
    FUZZ_CHECK(c.nanMismatches == m.nanMismatches && c.infinityMismatches == m.infinityMismatches);
    FUZZ_CHECK(c.signedZeros == m.signedZeros && c.nanPayloads == m.nanPayloads);
    FUZZ_CHECK(c.ulpHistogram == m.ulpHistogram && c.maxUlp == m.maxUlp && c.meanUlp == m.meanUlp);
    FUZZ_CHECK(c.maxAbsolute == m.maxAbsolute && c.meanAbsolute == m.meanAbsolute);
    FUZZ_CHECK(c.maxRelative == m.maxRelative && c.meanRelative == m.meanRelative);
    FUZZ_CHECK(c.rmse == m.rmse && c.bias == -m.bias && c.worst.size() == m.worst.size());
    for (size_t i = 0; i < c.worst.size(); i++)
        FUZZ_CHECK(c.worst[i].x == m.worst[i].x && c.worst[i].y == m.worst[i].y &&
                   c.worst[i].ulp == m.worst[i].ulp);
}

void checkErrorFrame(const Frame& a, const Frame& b, const Comparison& comparison) {
    if (comparison.channels.empty()) return;
    const Frame error = errorFrame(a, b);
    for (const ChannelComparison& c : comparison.channels) {
        uint64_t above = 0, infinite = 0;
        for (const float value : std::get<Image<float>>(error.find(c.name)->values).values()) {
            FUZZ_CHECK(value >= 0);
            above += value > 0 ? 1 : 0;
            infinite += std::isinf(value) ? 1 : 0;
        }
        FUZZ_CHECK(above == c.differing && infinite == c.nanMismatches + c.infinityMismatches);
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    fuzz::ByteReader bytes(data, size);
    const Frame a = takeFrame(bytes), b = takeSecond(bytes, a);
    FUZZ_CHECK(compareFrames(a, a).identical() && compareFrames(b, b).identical());

    const Comparison ab = compareFrames(a, b, kMaxWorst), ba = compareFrames(b, a, kMaxWorst);
    FUZZ_CHECK(ab.equal() == ba.equal() && ab.identical() == ba.identical() &&
               ab.sameShape() == ba.sameShape());
    FUZZ_CHECK(ab.onlyInA == ba.onlyInB && ab.onlyInB == ba.onlyInA &&
               ab.otherType.size() == ba.otherType.size());
    FUZZ_CHECK(ab.channels.size() == ba.channels.size());
    for (const ChannelComparison& c : ab.channels) {
        checkChannel(c, *a.find(c.name), *b.find(c.name));
        for (const ChannelComparison& m : ba.channels)
            if (m.name == c.name) checkMirrored(c, m);
    }
    checkErrorFrame(a, b, ab);
    FUZZ_CHECK((hashFrame(a) == hashFrame(b)) == ab.identical());
    FUZZ_CHECK((hashGroups(a) == hashGroups(b)) == ab.identical());
    return 0;
}
