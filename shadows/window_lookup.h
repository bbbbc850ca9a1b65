// Percentage-closer filtering for native numbers: a faster arrangement of the comparisons of litTexels
// (shadows/kernels/shadow_filter.glsl), with the text's own functions. The texels of one point's window are compared
// side by side, and none of them where the nearest or the farthest of its surroundings decides. Counts are integers, so
// that the order of comparisons has no influence; the test WindowsSideBySideGiveTheBitsOfTheText compares the two.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <span>
#include <vector>

#include "lighting/light_visibility.h"
#include "lighting/render_view.h"
#include "shadows/shadow_kernels.h"

namespace etalon {

template <class T>
class WindowLookup {
  public:
    using K = ShadowKernels<T>;

    // The filter is pcf and not quantised. buffers and space outlive the object.
    WindowLookup(const ShadowBuffers<T>& buffers, const typename K::ShadowSpace& space,
                 const typename K::PointFilter& settings, int threads);

    // visibility[i] for all points.
    void find(const LitPoints& points, std::span<double> visibility) const;
    uint64_t memory_bytes() const {
        uint64_t bytes = 0;
        for (const Ranges& of : ranges_) bytes += (of.nearest.size() + of.farthest.size()) * sizeof(Stored);
        return bytes;
    }

  private:
    using vec3 = typename K::vec3;
    using boolean = typename K::boolean;
    using Stored = typename Number<T>::Stored;
    static_assert(Number<T>::isNative);
    static constexpr int N = Number<T>::lanes;
    static constexpr size_t kChunk = 256;  // points at a time
    static constexpr int kNoLayer = -1;
    static constexpr int kBlock = 8;

    // Of the texels of all windows that begin in a block of kBlock x kBlock texels, row after row.
    struct Ranges {
        std::vector<Stored> nearest, farthest;
    };
    // Where the points of a chunk fall; x, y: their windows' first texels.
    struct Places {
        std::array<int, kChunk> layer, x, y;
        std::array<Stored, kChunk> depth, perU, perV, fractionX, fractionY, centreU, centreV;
    };
    // Bits of lanes: the windows in which nothing is in the way, and those in which everything is; of others
    // neither.
    struct Decided {
        uint32_t lit = 0, shadowed = 0;
    };
    // Texels in the way in the taps x taps windows that begin at the first texel, one to the right, one
    // below, and both.
    using Windows = std::array<int, 4>;
    // The columns of a window, N at a time.
    using WindowColumns = std::array<T, kMaxWindowTaps / N + 1>;

    static int integerLane(const typename K::integer& a, int i) {
        if constexpr (N == 1)
            return a;
        else
            return a[i];
    }
    static uint32_t bitsOf(const boolean& c) {
        if constexpr (std::is_same_v<boolean, bool>)
            return c ? 1 : 0;
        else
            return laneBits(c);
    }
    size_t blockOf(int x, int y) const {
        const int pad = buffers_.texels.pad();
        return static_cast<size_t>((y + pad) / kBlock) * blocksPerRow_ +
               static_cast<size_t>((x + pad) / kBlock);
    }

    Ranges rangesOf(size_t layer, int threads) const;
    [[gnu::flatten]] void place(const LitPoints& points, size_t first, size_t count, Places& places) const;
    Decided decide(const Places& places, size_t offset, int active) const;
    uint32_t shadowedInRow(const Stored* row, const T& depth, const T& perU, const T& perV,
                           const WindowColumns& du, const T& dv) const;
    Windows shadowedInSmallWindow(const Stored* row, const T& depth, const T& perU, const T& perV,
                                  const T& centreU, const T& centreV) const;
    Windows shadowedInWindow(const Stored* row, const T& depth, const T& perU, const T& perV,
                             const T& centreU, const T& centreV) const;
    void weigh(const Places& places, size_t count, std::span<double> visibility) const;

    const ShadowBuffers<T>& buffers_;
    const typename K::ShadowSpace& space_;
    int taps_;
    typename K::Sampling sampling_;
    T farthest_;  // what a reference is limited to
    ptrdiff_t stride_;
    size_t blocksPerRow_;
    std::vector<Ranges> ranges_;          // of each layer
    WindowColumns columns_;               // 0, 1, 2 ...
    T columnsOfTwoRows_, rowsOfTwoRows_;  // with 16 lanes: 0 ... 7 twice; 0 eight times, then 1
    uint64_t window_ = 0;                 // taps columns of taps rows, a byte for each row
};

template <class T>
WindowLookup<T>::WindowLookup(const ShadowBuffers<T>& buffers, const typename K::ShadowSpace& space,
                              const typename K::PointFilter& settings, int threads)
    : buffers_(buffers),
      space_(space),
      taps_(settings.taps),
      sampling_(settings.sampling),
      farthest_(settings.farthest),
      stride_(buffers.texels.stride()) {
    const ShadowTexels<T>& texels = buffers.texels;
    blocksPerRow_ = static_cast<size_t>((texels.width() + 2 * texels.pad() + kBlock - 1) / kBlock);
    for (size_t layer = 0; layer < texels.layers(); layer++)
        ranges_.push_back(texels.isDrawn(layer) ? rangesOf(layer, threads) : Ranges{});
    for (size_t part = 0; part < columns_.size(); part++)
        columns_[part] = Number<T>::generate([&](int i) { return static_cast<double>(part * N) + i; });
    columnsOfTwoRows_ = Number<T>::generate([](int i) { return i % 8; });
    rowsOfTwoRows_ = Number<T>::generate([](int i) { return i / 8; });
    for (int j = 0; j < std::min(taps_, 8); j++) window_ |= ((uint64_t{1} << taps_) - 1) << (8 * j);
}

// Down the columns of a row of blocks first, then along it.
template <class T>
typename WindowLookup<T>::Ranges WindowLookup<T>::rangesOf(size_t layer, int threads) const {
    const ShadowTexels<T>& texels = buffers_.texels;
    const int pad = texels.pad(), rows = texels.width() + 2 * pad;
    Ranges ranges;
    ranges.nearest.resize(blocksPerRow_ * blocksPerRow_), ranges.farthest.resize(ranges.nearest.size());
    parallelFor(blocksPerRow_, threads, [&](size_t block) {
        const int first = static_cast<int>(block) * kBlock, last = std::min(first + kBlock + taps_, rows);
        const auto rowOf = [&](int y) { return texels.row(layer, -pad, y - pad); };
        std::vector<Stored> nearest(rowOf(first), rowOf(first) + stride_);
        std::vector<Stored> farthest = nearest;
        for (int y = first + 1; y < last; y++) {
            const Stored* row = rowOf(y);
            for (size_t x = 0; x < nearest.size(); x++) {
                nearest[x] = row[x] < nearest[x] ? row[x] : nearest[x];
                farthest[x] = row[x] > farthest[x] ? row[x] : farthest[x];
            }
        }
        for (size_t b = 0; b < blocksPerRow_; b++) {
            const auto from = static_cast<ptrdiff_t>(b * kBlock),
                       to = std::min<ptrdiff_t>(from + kBlock + taps_, rows);
            ranges.nearest[block * blocksPerRow_ + b] =
                *std::min_element(&nearest[from], &nearest[from] + (to - from));
            ranges.farthest[block * blocksPerRow_ + b] =
                *std::max_element(&farthest[from], &farthest[from] + (to - from));
        }
    });
    return ranges;
}

template <class T>
void WindowLookup<T>::find(const LitPoints& points, std::span<double> visibility) const {
    Places places;
    for (size_t first = 0; first < points.size(); first += kChunk) {
        const size_t count = std::min(kChunk, points.size() - first);
        place(points, first, count, places);
        weigh(places, count, visibility.subspan(first, count));
    }
}

template <class T>
void WindowLookup<T>::place(const LitPoints& points, size_t first, size_t count, Places& places) const {
    K kernels{buffers_};
    const ShadowTexels<T>& texels = buffers_.texels;
    forEachLaneGroup<N>(count, [&](size_t offset, int active) {
        const auto load = [&](const std::array<std::vector<double>, 3>& from) {
            const auto number = [&](size_t c) { return Number<T>::load(&from[c][first + offset], active); };
            return vec3(number(0), number(1), number(2));
        };
        const vec3 position = load(points.position_m), normal = load(points.normal),
                   face = load(points.faceNormal);
        const typename K::ShadowPoint p = kernels.shadowPoint(space_, position, normal, face);
        const typename K::TexelPair x = kernels.windowStart(p.u, taps_, sampling_);
        const typename K::TexelPair y = kernels.windowStart(p.v, taps_, sampling_);
        const T centreU = kernels.firstCentre(p.u, x), centreV = kernels.firstCentre(p.v, y);
        const std::array<std::pair<const T*, Stored*>, 7> values = {{{&p.depth, places.depth.data()},
                                                                     {&p.perU, places.perU.data()},
                                                                     {&p.perV, places.perV.data()},
                                                                     {&x.fraction, places.fractionX.data()},
                                                                     {&y.fraction, places.fractionY.data()},
                                                                     {&centreU, places.centreU.data()},
                                                                     {&centreV, places.centreV.data()}}};
        for (const auto& [value, to] : values) Number<T>::store(*value, to + offset, active);
        const uint32_t inFront = bitsOf(p.isInFront);
        for (int i = 0; i < active; i++) {
            const size_t j = offset + static_cast<size_t>(i);
            const int layer = integerLane(p.layer, i);
            const bool isLookedUp = (inFront >> i & 1) != 0 && points.instance[first + j] != kNoInstance &&
                                    texels.isDrawn(static_cast<size_t>(layer));
            places.layer[j] = isLookedUp ? layer : kNoLayer;
            // A window that is moved stays outside the layer.
            const int last = texels.width() + texels.pad() - taps_ - 1;
            places.x[j] = std::clamp(integerLane(x.first, i), -texels.pad(), last);
            places.y[j] = std::clamp(integerLane(y.first, i), -texels.pad(), last);
        }
    });
}

// The reference depth rises or falls with du and with dv, roundings included: its extremes are at the corners
// of the window. Where it is not a number it is 0, which shadows nothing.
template <class T>
typename WindowLookup<T>::Decided WindowLookup<T>::decide(const Places& places, size_t offset,
                                                          int active) const {
    K kernels{buffers_};
    std::array<Stored, N> nearest{}, farthest{};
    for (int i = 0; i < active; i++) {
        const size_t at = offset + static_cast<size_t>(i), lane = static_cast<size_t>(i);
        if (places.layer[at] == kNoLayer) continue;
        const Ranges& ranges = ranges_[static_cast<size_t>(places.layer[at])];
        const size_t block = blockOf(places.x[at], places.y[at]);
        nearest[lane] = ranges.nearest[block], farthest[lane] = ranges.farthest[block];
    }
    const auto load = [&](const std::array<Stored, kChunk>& from) {
        return Number<T>::load(&from[offset], active);
    };
    const T depth = load(places.depth), perU = load(places.perU), perV = load(places.perV),
            left = load(places.centreU), upper = load(places.centreV), taps(static_cast<double>(taps_)),
            right = left + taps, lower = upper + taps, most = farthest_;
    const T a = kernels.referenceDepth(depth, perU, perV, left, upper, most),
            b = kernels.referenceDepth(depth, perU, perV, right, upper, most),
            c = kernels.referenceDepth(depth, perU, perV, left, lower, most),
            d = kernels.referenceDepth(depth, perU, perV, right, lower, most);
    const T lowest = K::minOf(K::minOf(a, b), K::minOf(c, d)),
            highest = K::maxOf(K::maxOf(a, b), K::maxOf(c, d));
    const uint32_t lanes = static_cast<uint32_t>((uint64_t{1} << active) - 1);
    Decided decided;
    decided.lit = bitsOf(highest <= Number<T>::load(nearest.data())) & lanes;
    decided.shadowed = bitsOf(Number<T>::load(farthest.data()) < lowest) & lanes;
    return decided;
}

// Bit i: texel i of the row is in the way. du: from the point to the texels' centres, in lanes.
template <class T>
[[gnu::always_inline]] inline uint32_t WindowLookup<T>::shadowedInRow(const Stored* row, const T& depth,
                                                                      const T& perU, const T& perV,
                                                                      const WindowColumns& du,
                                                                      const T& dv) const {
    K kernels{buffers_};
    uint32_t bits = 0;
    for (int part = 0; part * N <= taps_; part++) {
        const T reference =
            kernels.referenceDepth(depth, perU, perV, du[static_cast<size_t>(part)], dv, farthest_);
        bits |= bitsOf(Number<T>::load(row + part * N) < reference) << (part * N);
    }
    return bits;
}

// The window of up to 8 x 8 texels as one word, a byte for each row; two rows at a time where that many lanes
// are.
template <class T>
[[gnu::always_inline]] inline typename WindowLookup<T>::Windows WindowLookup<T>::shadowedInSmallWindow(
    const Stored* row, const T& depth, const T& perU, const T& perV, const T& centreU,
    const T& centreV) const {
    uint64_t bits = 0;
    if constexpr (std::is_same_v<T, Lanes<float, 16>>) {
        K kernels{buffers_};
        const T du = centreU + columnsOfTwoRows_;
        // The row behind the last one is not counted.
        for (int j = 0; j <= taps_; j += 2, row += 2 * stride_) {
            const T dv = centreV + (rowsOfTwoRows_ + T(static_cast<double>(j)));
            using Row = Lanes<Stored, N / 2>;
            const T texels(joinLanes(Row::load(row), Row::load(row + stride_)).v);
            const T reference = kernels.referenceDepth(depth, perU, perV, du, dv, farthest_);
            bits |= uint64_t{bitsOf(texels < reference)} << (8 * j);
        }
    } else {
        WindowColumns du;
        for (size_t part = 0; part * N <= static_cast<size_t>(taps_); part++)
            du[part] = centreU + columns_[part];
        for (int j = 0; j <= taps_; j++, row += stride_) {
            const T dv = centreV + T(static_cast<double>(j));
            bits |= uint64_t{shadowedInRow(row, depth, perU, perV, du, dv) & 0xff} << (8 * j);
        }
    }
    const auto count = [&](int shift) { return std::popcount(bits >> shift & window_); };
    return {count(0), count(1), count(8), count(9)};
}

template <class T>
typename WindowLookup<T>::Windows WindowLookup<T>::shadowedInWindow(const Stored* row, const T& depth,
                                                                    const T& perU, const T& perV,
                                                                    const T& centreU,
                                                                    const T& centreV) const {
    const uint32_t window = (1u << taps_) - 1;
    WindowColumns du;
    for (size_t part = 0; part * N <= static_cast<size_t>(taps_); part++) du[part] = centreU + columns_[part];
    Windows shadowed{};
    for (int j = 0; j <= taps_; j++, row += stride_) {
        const T dv = centreV + T(static_cast<double>(j));
        const uint32_t bits = shadowedInRow(row, depth, perU, perV, du, dv);
        const int left = std::popcount(bits & window), right = std::popcount(bits >> 1 & window);
        if (j < taps_) shadowed[0] += left, shadowed[1] += right;
        if (j > 0) shadowed[2] += left, shadowed[3] += right;
    }
    return shadowed;
}

// The comparisons of each point side by side, then the weights of all points.
template <class T>
void WindowLookup<T>::weigh(const Places& places, size_t count, std::span<double> visibility) const {
    K kernels{buffers_};
    std::array<std::array<Stored, kChunk>, 4> lit;
    Decided decided;
    for (size_t i = 0; i < count; i++) {
        const size_t lane = i % N;
        if (lane == 0) decided = decide(places, i, static_cast<int>(std::min<size_t>(N, count - i)));
        const bool isShadowed = (decided.shadowed >> lane & 1) != 0 && places.layer[i] != kNoLayer;
        const auto whole = static_cast<Stored>(taps_ * taps_);
        for (auto& corner : lit) corner[i] = isShadowed ? Stored(0) : whole;
        if (places.layer[i] == kNoLayer || isShadowed || (decided.lit >> lane & 1) != 0) continue;
        const T depth(places.depth[i]), perU(places.perU[i]), perV(places.perV[i]);
        const Stored* row =
            buffers_.texels.row(static_cast<size_t>(places.layer[i]), places.x[i], places.y[i]);
        const Windows shadowed =
            taps_ < 8
                ? shadowedInSmallWindow(row, depth, perU, perV, T(places.centreU[i]), T(places.centreV[i]))
                : shadowedInWindow(row, depth, perU, perV, T(places.centreU[i]), T(places.centreV[i]));
        for (size_t corner = 0; corner < lit.size(); corner++)
            lit[corner][i] = whole - static_cast<Stored>(shadowed[corner]);
    }
    forEachLaneGroup<N>(count, [&](size_t offset, int active) {
        const auto load = [&](const std::array<Stored, kChunk>& from) {
            return Number<T>::load(&from[offset], active);
        };
        const T part = kernels.litPart(load(lit[0]), load(lit[1]), load(lit[2]), load(lit[3]),
                                       load(places.fractionX), load(places.fractionY), taps_, sampling_);
        for (int i = 0; i < active; i++) {
            const size_t at = offset + static_cast<size_t>(i);
            visibility[at] = places.layer[at] == kNoLayer ? 1.0 : numberLane(part, i);
        }
    });
}

}  // namespace etalon
