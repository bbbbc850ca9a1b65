#include "golden/compare.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "numeric/progress.h"

namespace etalon {
namespace {

bool isNan(float value) { return value != value; }
bool isNan(uint32_t) { return false; }
bool isFinite(float value) { return (std::bit_cast<uint32_t>(value) & 0x7f800000u) != 0x7f800000u; }
bool isFinite(uint32_t) { return true; }
uint64_t distance(float a, float b) { return ulpDistance(a, b); }
uint64_t distance(uint32_t a, uint32_t b) { return a < b ? b - a : a - b; }
double magnitude(double value) { return value < 0 ? -value : value; }

// What one pair of samples is; the order is that of the report.
enum class Relation { same, signedZero, nanPayload, nanMismatch, infinityMismatch, finite };

template <class T>
Relation relate(T a, T b) {
    if (std::bit_cast<uint32_t>(a) == std::bit_cast<uint32_t>(b)) return Relation::same;
    if (isNan(a) && isNan(b)) return Relation::nanPayload;
    if (isNan(a) || isNan(b)) return Relation::nanMismatch;
    if (!isFinite(a) || !isFinite(b)) return Relation::infinityMismatch;
    return a == b ? Relation::signedZero : Relation::finite;
}

// The greater distance first, then the reading order.
bool isWorse(const WorstPixel& a, const WorstPixel& b) {
    if (a.ulp != b.ulp) return a.ulp > b.ulp;
    return a.y != b.y ? a.y < b.y : a.x < b.x;
}

// Keeps the worst `limit` of what is added; a heap whose front is the least bad.
class WorstList {
  public:
    explicit WorstList(int limit) : limit_(static_cast<size_t>(limit)) {}
    void add(const WorstPixel& pixel) {
        if (limit_ == 0 || (pixels_.size() == limit_ && !isWorse(pixel, pixels_.front()))) return;
        if (pixels_.size() == limit_) {
            std::pop_heap(pixels_.begin(), pixels_.end(), isWorse);
            pixels_.pop_back();
        }
        pixels_.push_back(pixel);
        std::push_heap(pixels_.begin(), pixels_.end(), isWorse);
    }
    std::vector<WorstPixel> sorted() && {
        std::sort(pixels_.begin(), pixels_.end(), isWorse);
        return std::move(pixels_);
    }

  private:
    size_t limit_;
    std::vector<WorstPixel> pixels_;
};

struct Sums {
    double ulp = 0, absolute = 0, relative = 0, square = 0, signedDifference = 0;
    void add(const Sums& row) {
        ulp += row.ulp;
        absolute += row.absolute;
        relative += row.relative;
        square += row.square;
        signedDifference += row.signedDifference;
    }
};

template <class T>
ChannelComparison compareChannel(const std::string& name, const Image<T>& a, const Image<T>& b,
                                 int maxWorst) {
    ChannelComparison result;
    result.name = name;
    result.samples = a.pixelCount();
    WorstList worst(maxWorst);
    Sums total;
    for (int y = 0; y < a.height(); ++y) {
        Sums row;
        for (int x = 0; x < a.width(); ++x) {
            const T va = a.at(x, y), vb = b.at(x, y);
            const Relation relation = relate(va, vb);
            const double da = static_cast<double>(va), db = static_cast<double>(vb);
            if (relation == Relation::nanMismatch || relation == Relation::infinityMismatch) {
                ++(relation == Relation::nanMismatch ? result.nanMismatches : result.infinityMismatches);
                ++result.differing;
                worst.add({x, y, da, db, kIncomparableUlp});
                continue;
            }
            if (relation == Relation::signedZero) ++result.signedZeros;
            if (relation == Relation::nanPayload) ++result.nanPayloads;
            if (!isFinite(va)) continue;
            ++result.finite;
            if (relation != Relation::finite) {
                ++result.ulpHistogram[0];
                continue;
            }
            const uint64_t ulp = distance(va, vb);
            const double difference = db - da, absolute = magnitude(difference);
            const double relative = absolute / std::max(magnitude(da), magnitude(db));
            ++result.differing;
            ++result.ulpHistogram[static_cast<size_t>(ulpBucket(ulp))];
            result.maxUlp = std::max(result.maxUlp, ulp);
            result.maxAbsolute = std::max(result.maxAbsolute, absolute);
            result.maxRelative = std::max(result.maxRelative, relative);
            row.add({static_cast<double>(ulp), absolute, relative, difference * difference, difference});
            worst.add({x, y, da, db, ulp});
        }
        total.add(row);
    }
    if (result.finite > 0) {
        const double count = static_cast<double>(result.finite);
        result.meanUlp = total.ulp / count;
        result.meanAbsolute = total.absolute / count;
        result.meanRelative = total.relative / count;
        result.rmse = std::sqrt(total.square / count);
        result.bias = total.signedDifference / count;
    }
    result.worst = std::move(worst).sorted();
    return result;
}

template <class T>
Image<float> errorOf(const Image<T>& a, const Image<T>& b) {
    ETALON_CHECK(a.width() == b.width() && a.height() == b.height() && a.channels() == b.channels(),
                 "{}x{}x{} against {}x{}x{}", a.width(), a.height(), a.channels(), b.width(), b.height(),
                 b.channels());
    Image<float> error(a.width(), a.height(), a.channels());
    for (size_t i = 0; i < a.values().size(); ++i) {
        const T va = a.values()[i], vb = b.values()[i];
        const Relation relation = relate(va, vb);
        if (relation == Relation::nanMismatch || relation == Relation::infinityMismatch) {
            error.values()[i] = std::numeric_limits<float>::infinity();
        } else if (relation == Relation::finite) {
            const double absolute = magnitude(static_cast<double>(vb) - static_cast<double>(va));
            const double largest = static_cast<double>(std::numeric_limits<float>::max());
            error.values()[i] = static_cast<float>(std::min(absolute, largest));
        }
    }
    return error;
}

}  // namespace

int64_t orderedInteger(float value) {
    const uint32_t bits = std::bit_cast<uint32_t>(value);
    const auto magnitudeBits = static_cast<int64_t>(bits & 0x7fffffffu);
    return (bits >> 31) != 0 ? -magnitudeBits : magnitudeBits;
}

uint64_t ulpDistance(float a, float b) {
    const int64_t difference = orderedInteger(a) - orderedInteger(b);
    return static_cast<uint64_t>(difference < 0 ? -difference : difference);
}

int ulpBucket(uint64_t ulp) { return ulp == 0 ? 0 : 1 + static_cast<int>(std::bit_width(ulp - 1)); }

uint64_t ulpBucketEnd(int bucket) { return bucket == 0 ? 0 : uint64_t{1} << (bucket - 1); }

bool Comparison::equal() const {
    return sameShape() && std::ranges::all_of(channels, &ChannelComparison::equal);
}

bool Comparison::identical() const {
    return sameShape() && std::ranges::all_of(channels, &ChannelComparison::identical);
}

Comparison compareFrames(const Frame& a, const Frame& b, int maxWorst) {
    checkFrame(a);
    checkFrame(b);
    ETALON_CHECK(maxWorst >= 0, "{} worst pixels", maxWorst);
    Comparison result{a.width, a.height, b.width, b.height, {}, {}, {}, {}};
    const bool sameSize = a.width == b.width && a.height == b.height;
    for (const Channel& channel : b.channels)
        if (!a.find(channel.name)) result.onlyInB.push_back(channel.name);
    ProgressLoop progress(a.channels.size());
    for (const Channel& channel : a.channels) {
        const Channel* other = b.find(channel.name);
        if (!other) {
            result.onlyInA.push_back(channel.name);
        } else if (other->values.index() != channel.values.index()) {
            result.otherType.push_back(channel.name);
        } else if (sameSize) {
            std::visit(
                [&](const auto& image) {
                    const auto& otherImage = std::get<std::decay_t<decltype(image)>>(other->values);
                    result.channels.push_back(compareChannel(channel.name, image, otherImage, maxWorst));
                },
                channel.values);
        }
        progress.next();
    }
    return result;
}

Image<float> errorImage(const Image<float>& a, const Image<float>& b) { return errorOf(a, b); }

Frame errorFrame(const Frame& a, const Frame& b) {
    checkFrame(a);
    checkFrame(b);
    ETALON_CHECK(a.width == b.width && a.height == b.height, "{}x{} against {}x{}", a.width, a.height,
                 b.width, b.height);
    Frame error{a.width, a.height, {}, {}};
    for (const Channel& channel : a.channels) {
        const Channel* other = b.find(channel.name);
        if (!other || other->values.index() != channel.values.index()) continue;
        std::visit(
            [&](const auto& image) {
                const auto& otherImage = std::get<std::decay_t<decltype(image)>>(other->values);
                error.channels.push_back({channel.name, errorOf(image, otherImage)});
            },
            channel.values);
    }
    checkFrame(error);
    return error;
}

}  // namespace etalon
