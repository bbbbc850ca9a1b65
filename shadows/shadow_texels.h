// The texels of a shadow map as numbers of T: what look-ups read.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <vector>

#include "numeric/number.h"
#include "numeric/parallel.h"
#include "raster/depth.h"
#include "shadows/shadow_map.h"

namespace etalon {

// A copy of a map's texels, each rounded once, with `pad` texels of the farthest depth around every layer. Where
// references are quantised the texels are the map's stored integers, else depths or distances.
template <class T>
class ShadowTexels {
  public:
    using Stored = typename Number<T>::Stored;
    using Integer = typename Number<T>::Integer;
    using Boolean = decltype(std::declval<T>() < std::declval<T>());
    static constexpr int N = Number<T>::lanes;

    ShadowTexels(const ShadowMap& map, int threads);

    bool isAnyDrawn() const { return !layers_.empty(); }
    bool isDrawn(size_t layer) const { return !layers_[layer].empty(); }
    int width() const { return width_; }
    int pad() const { return pad_; }
    size_t layers() const { return layers_.size(); }
    uint64_t memory_bytes() const {
        uint64_t bytes = 0;
        for (const auto& layer : layers_) bytes += layer.size() * sizeof(Stored);
        return bytes;
    }
    // Of the stored integers; 0: the texels are none.
    double levels() const { return levels_; }
    // What a reference is limited to: nothing is farther, and the texels outside are that far away.
    T farthest() const { return farthest_; }

    // A texel with -pad <= x, y < width + pad; the next ones of its row are behind it, the row below is stride
    // behind. N texels may be read behind the last of a row, and one row below the last one.
    const Stored* row(size_t layer, int x, int y) const {
        return layers_[layer].data() + static_cast<ptrdiff_t>(y + pad_) * stride_ + (x + pad_);
    }
    ptrdiff_t stride() const { return stride_; }

    // Lane by lane, what shadows/shadow_scope.inc says.
    Boolean isDrawn(const Integer& layer) const;
    T at(const Integer& layer, const Integer& x, const Integer& y) const;
    Boolean isBelowStored(const T& texel, const T& depth) const;

  private:
    static int laneOf(const Integer& a, int i) {
        if constexpr (N == 1)
            return a;
        else
            return a[i];
    }
    // Moved to the nearest texel that there is, the padding included: outside all are the same.
    Integer inside(const Integer& i) const {
        const int last = width_ + pad_ - 1;
        if constexpr (N == 1)
            return std::clamp(i, -pad_, last);
        else {
            const Integer least(-pad_), most(last);
            const Integer atLeast = select(i < least, least, i);
            return select(most < atLeast, most, atLeast);
        }
    }
    // The integer that a depth is written as by rule 22.
    template <class S>
    S written(const S& z) const {
        const DepthFormat format =
            levels_ == depthLevels(DepthFormat::d16) ? DepthFormat::d16 : DepthFormat::d24;
        if constexpr (std::is_floating_point_v<S>)
            return static_cast<S>(storedDepth(format, rounding_, Lanes<S, 1>(z))[0]);
        else
            return convertLanes<typename S::Scalar>(storedDepth(format, rounding_, z));
    }
    void fill(const ShadowMap& map, size_t layer, int threads);
    bool fillUnorm(const ShadowMap& map, const uint32_t* stored, Stored* line) const;

    std::vector<std::vector<Stored>> layers_;  // row after row; empty: nothing is drawn
    std::array<const Stored*, kCubeFaces> first_{};
    int width_, pad_;
    ptrdiff_t stride_;
    double levels_ = 0;
    DepthRounding rounding_;
    T farthest_;
};

template <class T>
ShadowTexels<T>::ShadowTexels(const ShadowMap& map, int threads)
    : layers_(map.layers.size()),
      width_(map.projection.width),
      pad_(2 * filterReach_texels(map.settings) + 2),
      stride_(width_ + 2 * pad_ + N),
      rounding_(map.depthRounding) {
    if (map.settings.reference == ShadowReference::quantised && !map.holdsDistance())
        levels_ = depthLevels(map.format());
    constexpr double kBeyondEveryDistance = 0x1p+60;
    farthest_ = T(map.holdsDistance() ? kBeyondEveryDistance : 1.0);
    for (size_t layer = 0; layer < layers_.size(); layer++) {
        fill(map, layer, threads);
        first_[layer] = layers_[layer].empty() ? nullptr : row(layer, 0, 0);
    }
}

template <class T>
void ShadowTexels<T>::fill(const ShadowMap& map, size_t layer, int threads) {
    const ShadowLayer& from = map.layers[layer];
    const bool isDistance = !from.distance_m.empty();
    if (!isDistance && from.stored.empty()) return;
    const DepthFormat format = map.format();
    std::vector<Stored>& to = layers_[layer];
    Stored farthest;
    Number<T>::store(levels_ > 0 ? T(levels_) : farthest_, &farthest, 1);
    to.resize(static_cast<size_t>(stride_) * static_cast<size_t>(width_ + 2 * pad_ + 1));
    parallelFor(static_cast<size_t>(width_ + 2 * pad_), threads, [&](size_t row) {
        Stored* line = &to[row * static_cast<size_t>(stride_)];
        const int y = static_cast<int>(row) - pad_;
        if (y < 0 || y >= width_) {
            std::fill(line, line + stride_, farthest);
            return;
        }
        std::fill(line, line + pad_, farthest);
        std::fill(line + pad_ + width_, line + stride_, farthest);
        line += pad_;
        const auto convert = [&](auto&& valueAt) {
            forEachLaneGroup<N>(static_cast<size_t>(width_), [&](size_t first, int active) {
                const T value = Number<T>::generate(
                    [&](int i) { return valueAt(first + static_cast<size_t>(std::min(i, active - 1))); });
                Number<T>::store(value, line + first, active);
            });
        };
        if (isDistance) {
            const float* distances = &from.distance_m.at(0, y);
            convert([&](size_t x) { return static_cast<double>(distances[x]); });
            return;
        }
        const uint32_t* stored = &from.stored.at(0, y);
        if (fillUnorm(map, stored, line)) return;
        if constexpr (std::is_same_v<T, Lanes<float, N>> || std::is_same_v<T, float>)
            if (format == DepthFormat::d32f) {
                std::memcpy(line, stored, static_cast<size_t>(width_) * sizeof(float));
                return;
            }
        if (levels_ > 0)
            convert([&](size_t x) { return static_cast<double>(stored[x]); });
        else if (format == DepthFormat::d32f)
            convert([&](size_t x) { return static_cast<double>(std::bit_cast<float>(stored[x])); });
        else
            convert([&, levels = depthLevels(format)](size_t x) { return stored[x] / levels; });
    });
}

// A row of UNORM depths where there are lanes of float; the quotient in double, rounded once.
template <class T>
bool ShadowTexels<T>::fillUnorm(const ShadowMap& map, const uint32_t* stored, Stored* line) const {
    if constexpr (N > 1 && std::is_same_v<T, Lanes<float, N>>) {
        const double levels = depthLevels(map.format());
        if (levels == 0 || levels_ > 0) return false;
        // Half the lanes of float fill a register as doubles.
        constexpr size_t kHalf = N / 2;
        const auto width = static_cast<size_t>(width_);
        size_t x = 0;
        for (; x + kHalf <= width; x += kHalf) {
            Lanes<int32_t, N / 2> integers;
            std::memcpy(&integers.v, stored + x, sizeof(integers.v));
            convertLanes<float>(convertLanes<double>(integers) / Lanes<double, N / 2>(levels))
                .store(line + x);
        }
        for (; x < width; x++) line[x] = static_cast<float>(stored[x] / levels);
        return true;
    }
    return false;
}

template <class T>
typename ShadowTexels<T>::Boolean ShadowTexels<T>::isDrawn(const Integer& layer) const {
    return Number<T>::generate(
               [&](int i) { return isDrawn(static_cast<size_t>(laneOf(layer, i))) ? 1.0 : 0.0; }) > T(0.0);
}

template <class T>
T ShadowTexels<T>::at(const Integer& layer, const Integer& x, const Integer& y) const {
    using Kept = typename Number<T>::Kept;
    // At most 2^27 texels.
    const Integer offset = inside(y) * Integer(static_cast<int32_t>(stride_)) + inside(x);
    std::array<Kept, N> texels;
    for (int i = 0; i < N; i++) {
        const Stored* first = first_[static_cast<size_t>(laneOf(layer, i))];
        texels[static_cast<size_t>(i)] = first ? static_cast<Kept>(first[laneOf(offset, i)]) : Kept(0.0);
    }
    return Number<T>::loadKept(texels.data());
}

// In the scalar that the numbers are stored as, in which unormDepth and the writes of rule 22 are exact whatever the
// arithmetic.
template <class T>
typename ShadowTexels<T>::Boolean ShadowTexels<T>::isBelowStored(const T& texel, const T& depth) const {
    const auto isBelow = [&](const auto& stored, const auto& z) {
        using Exact = std::decay_t<decltype(z)>;
        if (rounding_ == DepthRounding::fixedFunction) return stored < written(z);
        RasterKernels<Exact> kernels;
        return stored < kernels.unormDepth(z, Exact(levels_));
    };
    if constexpr (N == 1)
        return isBelow(numberLane(texel, 0), numberLane(depth, 0));
    else if constexpr (Number<T>::isNative)
        return isBelow(texel, depth);
    else
        return Boolean(isBelow(texel.v, depth.v).m);
}

}  // namespace etalon
