#include "shadows/lookup_passes.h"

#include <algorithm>
#include <array>
#include <bit>

#include "lighting/render_view.h"
#include "numeric/door.h"
#include "numeric/number.h"
#include "numeric/parallel.h"
#include "raster/depth.h"
#include "raster/texture.h"
#include "shadows/shadow_pattern.h"

namespace etalon {
namespace {

template <class T>
struct ShadowKernels {
#include "numeric/kernel_scope.inc"
#include "raster/texture_scope.inc"
#include "numeric/kernels/vector.glsl"
#include "raster/kernels/sampler.glsl"
#include "raster/kernels/cube_face.glsl"
#include "shadows/kernels/shadow_point.glsl"
#include "shadows/kernels/shadow_filter.glsl"
};

template <class T>
class ShadowLookupOf final : public ShadowLookup {
  public:
    ShadowLookupOf(const ShadowMap& map, int fractionBits, int threads, WindowSearch search);
    void find(const LitPoints& points, std::span<double> visibility) const override;

  private:
    using K = ShadowKernels<T>;
    using vec3 = typename K::vec3;
    using integer = typename K::integer;
    using boolean = typename K::boolean;
    using Stored = typename Number<T>::Stored;
    static constexpr int N = Number<T>::lanes;
    static constexpr size_t kChunk = 256;  // points at a time
    static constexpr int kNoLayer = -1;
    static constexpr int kBlock = 8;

    // A layer's texels with `pad` texels of the farthest depth around them.
    struct Plane {
        std::vector<Stored> texels;
        // Of the texels of all windows that begin in a block of kBlock x kBlock texels, row after row.
        std::vector<Stored> nearest, farthest;
        bool isDrawn() const { return !texels.empty(); }
    };
    // Where the points of a chunk fall.
    struct Places {
        std::array<int, kChunk> layer, x, y;  // x, y: pcf's first texel
        std::array<Stored, kChunk> u, v, depth, perU, perV, fractionX, fractionY, centreU, centreV;
    };

    // The columns of a window, N at a time.
    using WindowColumns = std::array<T, kMaxWindowTaps / N + 1>;

    static vec3 constant(const glm::dvec3& v) { return vec3(T(v.x), T(v.y), T(v.z)); }
    static int integerLane(const integer& a, int i) {
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
    // Of points first, first + 1 ...
    static vec3 load(const std::array<std::vector<double>, 3>& from, size_t first, int active) {
        return vec3(Number<T>::load(&from[0][first], active), Number<T>::load(&from[1][first], active),
                    Number<T>::load(&from[2][first], active));
    }

    void fillPlane(size_t layer, int threads);
    void findRanges(Plane& plane, int threads) const;
    bool unormRow(const uint32_t* stored, Stored* line) const;
    size_t blockOf(int x, int y) const {
        return static_cast<size_t>((y + pad_) / kBlock) * blocksPerRow_ +
               static_cast<size_t>((x + pad_) / kBlock);
    }
    const Stored* texel(int layer, int x, int y) const {
        return planes_[static_cast<size_t>(layer)].texels.data() +
               static_cast<ptrdiff_t>(y + pad_) * stride_ + (x + pad_);
    }
    void place(const LitPoints& points, size_t first, size_t count, Places& places) const {
        if constexpr (Number<T>::isNative)
            placeFlattened(points, first, count, places);
        else
            placeEach(points, first, count, places);
    }
    [[gnu::flatten]] void placeFlattened(const LitPoints& points, size_t first, size_t count,
                                         Places& places) const {
        placeEach(points, first, count, places);
    }
    void placeEach(const LitPoints& points, size_t first, size_t count, Places& places) const;
    uint32_t shadowedInRow(const Stored* row, const T& depth, const T& perU, const T& perV,
                           const WindowColumns& du, const T& dv) const;
    uint32_t compareQuantised(const T& texels, const T& reference) const;
    // Bits of lanes: the windows in which nothing is in the way, and those in which everything is; of others
    // neither.
    struct Decided {
        uint32_t lit = 0, shadowed = 0;
    };
    Decided decide(const Places& places, size_t offset, int active) const;
    // Texels in the way in the taps x taps windows that begin at the first texel, one to the right, one
    // below, and both.
    using Windows = std::array<int, 4>;
    Windows shadowedInSmallWindow(const Stored* row, const T& depth, const T& perU, const T& perV,
                                  const T& centreU, const T& centreV) const;
    Windows shadowedInWindow(const Stored* row, const T& depth, const T& perU, const T& perV,
                             const T& centreU, const T& centreV) const;
    void findWindow(const Places& places, size_t count, std::span<double> visibility) const;
    void findDisc(const LitPoints& points, size_t first, const Places& places, size_t count,
                  std::span<double> visibility) const;
    T fetch(const std::array<int, kChunk>& layers, size_t first, const integer& x, const integer& y) const;

    const ShadowMap& map_;
    KeptFormat<T> format_;
    int fractionBits_ = 0, windowTaps_ = 0;
    int pad_ = 0;
    ptrdiff_t stride_ = 0;
    size_t blocksPerRow_ = 0;  // of the ranges; 0: there are none
    double levels_ = 0;        // quantised: the texels are integers up to this
    T farthest_{};
    typename K::ShadowSpace space_;
    WindowColumns columns_;               // 0, 1, 2 ...
    T columnsOfTwoRows_, rowsOfTwoRows_;  // with 16 lanes: 0 ... 7 twice; 0 eight times, then 1
    uint64_t window_ = 0;                 // taps columns of taps rows, a byte for each row
    std::vector<Plane> planes_;
    std::vector<glm::dvec2> pattern_;
    PatternTurns turns_;
    double blurScale_ = 0, nearest_ = 0;
};

template <class T>
ShadowLookupOf<T>::ShadowLookupOf(const ShadowMap& map, int fractionBits, int threads, WindowSearch search)
    : map_(map), turns_(map.settings.seed) {
    const ShadowMapSettings& settings = map.settings;
    const ShadowProjection& p = map.projection;
    // hard is a window of one point without fractions; disc and soft have none.
    const bool isWindow = settings.filter == ShadowFilter::pcf;
    windowTaps_ = isWindow ? settings.taps : 1;
    fractionBits_ = isWindow ? fractionBits : 0;
    if (settings.reference == ShadowReference::quantised && !map.holdsDistance())
        levels_ = depthLevels(map.format());
    constexpr double kBeyondEveryDistance = 0x1p+60;
    farthest_ = T(map.holdsDistance() ? kBeyondEveryDistance : 1.0);

    const int reach = filterReach_texels(settings);
    space_.isPerspective = p.isPerspective ? 1 : 0;
    space_.isCube = p.isCube ? 1 : 0;
    space_.holdsDistance = map.holdsDistance() ? 1 : 0;
    space_.receiverPlane = settings.receiverPlane ? 1 : 0;
    space_.movesAlongNormal = settings.normalOffset_texels != 0 ? 1 : 0;
    space_.origin = constant(p.origin);
    space_.right = constant(p.right);
    space_.down = constant(p.down);
    space_.forward = constant(p.forward);
    space_.centreU = T(p.centreU);
    space_.centreV = T(p.centreV);
    space_.scale = T(p.scale);
    space_.depthScale = T(p.depthScale);
    space_.depthOffset = T(p.depthOffset);
    space_.bias = T(settings.depthOffset);
    space_.nearer = T(1.0 - settings.bias.constant * kLinearBiasUnit);
    space_.slopeBias = T(map.holdsDistance() ? settings.bias.slopeScale : 0.0);
    space_.normalOffset = T(settings.normalOffset_texels);
    space_.width = T(p.width);
    space_.reach = T(reach);

    if (settings.filter == ShadowFilter::disc || settings.filter == ShadowFilter::soft)
        pattern_ = discPattern(settings.taps, settings.seed);
    if (settings.filter == ShadowFilter::soft) {
        // See blurRadius and blurRadiusOfDistance.
        const double halfSize = settings.lightSize_m / 2 * p.scale;
        blurScale_ = !p.isPerspective      ? settings.tangentOfHalfAngle * p.scale / p.depthScale
                     : map.holdsDistance() ? halfSize
                                           : halfSize / p.depthOffset;
        nearest_ = map.holdsDistance() ? p.near_m : 0;
    }

    for (size_t part = 0; part < columns_.size(); part++)
        columns_[part] = Number<T>::generate([&](int i) { return static_cast<double>(part * N) + i; });
    columnsOfTwoRows_ = Number<T>::generate([](int i) { return i % 8; });
    rowsOfTwoRows_ = Number<T>::generate([](int i) { return i / 8; });
    for (int j = 0; j < std::min(windowTaps_, 8); j++)
        window_ |= ((uint64_t{1} << windowTaps_) - 1) << (8 * j);
    pad_ = 2 * reach + 2;
    stride_ = p.width + 2 * pad_ + N;
    planes_.resize(map.layers.size());
    for (size_t layer = 0; layer < planes_.size(); layer++) fillPlane(layer, threads);
    if (!isWindow || levels_ > 0 || search == WindowSearch::everyTexel) return;
    blocksPerRow_ = static_cast<size_t>((p.width + 2 * pad_ + kBlock - 1) / kBlock);
    for (Plane& plane : planes_)
        if (plane.isDrawn()) findRanges(plane, threads);
}

// Down the columns of a row of blocks first, then along it.
template <class T>
void ShadowLookupOf<T>::findRanges(Plane& plane, int threads) const {
    const int rows = map_.projection.width + 2 * pad_;
    plane.nearest.resize(blocksPerRow_ * blocksPerRow_), plane.farthest.resize(plane.nearest.size());
    parallelFor(blocksPerRow_, threads, [&](size_t block) {
        const int first = static_cast<int>(block) * kBlock,
                  last = std::min(first + kBlock + windowTaps_, rows);
        std::vector<Stored> nearest(&plane.texels[static_cast<size_t>(first * stride_)],
                                    &plane.texels[static_cast<size_t>(first * stride_)] + stride_);
        std::vector<Stored> farthest = nearest;
        for (int y = first + 1; y < last; y++) {
            const Stored* row = &plane.texels[static_cast<size_t>(y * stride_)];
            for (size_t x = 0; x < nearest.size(); x++) {
                nearest[x] = row[x] < nearest[x] ? row[x] : nearest[x];
                farthest[x] = row[x] > farthest[x] ? row[x] : farthest[x];
            }
        }
        for (size_t b = 0; b < blocksPerRow_; b++) {
            const auto from = static_cast<ptrdiff_t>(b * kBlock),
                       to = std::min<ptrdiff_t>(from + kBlock + windowTaps_, rows);
            plane.nearest[block * blocksPerRow_ + b] =
                *std::min_element(&nearest[from], &nearest[from] + (to - from));
            plane.farthest[block * blocksPerRow_ + b] =
                *std::max_element(&farthest[from], &farthest[from] + (to - from));
        }
    });
}

// The reference depth rises or falls with du and with dv, roundings included: its extremes are at the corners
// of the window. Where it is not a number it is 0, which shadows nothing.
template <class T>
typename ShadowLookupOf<T>::Decided ShadowLookupOf<T>::decide(const Places& places, size_t offset,
                                                              int active) const {
    Decided decided;
    if (blocksPerRow_ == 0) return decided;
    K kernels;
    std::array<Stored, N> nearest{}, farthest{};
    for (int i = 0; i < active; i++) {
        const size_t at = offset + static_cast<size_t>(i), lane = static_cast<size_t>(i);
        if (places.layer[at] == kNoLayer) continue;
        const Plane& plane = planes_[static_cast<size_t>(places.layer[at])];
        const size_t block = blockOf(places.x[at], places.y[at]);
        nearest[lane] = plane.nearest[block], farthest[lane] = plane.farthest[block];
    }
    const T depth = Number<T>::load(&places.depth[offset], active),
            perU = Number<T>::load(&places.perU[offset], active),
            perV = Number<T>::load(&places.perV[offset], active),
            left = Number<T>::load(&places.centreU[offset], active),
            upper = Number<T>::load(&places.centreV[offset], active), taps(static_cast<double>(windowTaps_)),
            right = left + taps, lower = upper + taps;
    const T a = kernels.referenceDepth(depth, perU, perV, left, upper, farthest_),
            b = kernels.referenceDepth(depth, perU, perV, right, upper, farthest_),
            c = kernels.referenceDepth(depth, perU, perV, left, lower, farthest_),
            d = kernels.referenceDepth(depth, perU, perV, right, lower, farthest_);
    const T least = K::minOf(K::minOf(a, b), K::minOf(c, d)), most = K::maxOf(K::maxOf(a, b), K::maxOf(c, d));
    const uint32_t lanes = static_cast<uint32_t>((uint64_t{1} << active) - 1);
    decided.lit = bitsOf(most <= Number<T>::load(nearest.data())) & lanes;
    decided.shadowed = bitsOf(Number<T>::load(farthest.data()) < least) & lanes;
    return decided;
}

template <class T>
void ShadowLookupOf<T>::fillPlane(size_t layer, int threads) {
    const ShadowLayer& from = map_.layers[layer];
    const bool isDistance = !from.distance_m.empty();
    if (!isDistance && from.stored.empty()) return;
    const int width = map_.projection.width;
    const DepthFormat format = map_.format();
    std::vector<Stored>& to = planes_[layer].texels;
    Stored farthest;
    Number<T>::store(levels_ > 0 ? T(levels_) : farthest_, &farthest, 1);
    // One more row than is looked at, for those that read two.
    to.resize(static_cast<size_t>(stride_) * static_cast<size_t>(width + 2 * pad_ + 1));
    parallelFor(static_cast<size_t>(width + 2 * pad_), threads, [&](size_t row) {
        Stored* line = &to[row * static_cast<size_t>(stride_)];
        const int y = static_cast<int>(row) - pad_;
        if (y < 0 || y >= width) {
            std::fill(line, line + stride_, farthest);
            return;
        }
        std::fill(line, line + pad_, farthest);
        std::fill(line + pad_ + width, line + stride_, farthest);
        line += pad_;
        const auto convert = [&](auto&& valueAt) {
            forEachLaneGroup<N>(static_cast<size_t>(width), [&](size_t first, int active) {
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
        if (unormRow(stored, line)) return;
        if constexpr (std::is_same_v<T, Lanes<float, N>> || std::is_same_v<T, float>)
            if (format == DepthFormat::d32f) {
                std::memcpy(line, stored, static_cast<size_t>(width) * sizeof(float));
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
bool ShadowLookupOf<T>::unormRow(const uint32_t* stored, Stored* line) const {
    if constexpr (N > 1 && std::is_same_v<T, Lanes<float, N>>) {
        const double levels = depthLevels(map_.format());
        if (levels == 0 || levels_ > 0) return false;
        // Half the lanes of float fill a register as doubles.
        constexpr size_t kHalf = N / 2;
        const auto width = static_cast<size_t>(map_.projection.width);
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
void ShadowLookupOf<T>::find(const LitPoints& points, std::span<double> visibility) const {
    ETALON_CHECK(visibility.size() == points.size(), "{} values of {} points", visibility.size(),
                 points.size());
    [[maybe_unused]] const auto scope = format_.enter();
    if (planes_.empty()) {
        std::fill(visibility.begin(), visibility.end(), 1.0);
        return;
    }
    Places places;
    for (size_t first = 0; first < points.size(); first += kChunk) {
        const size_t count = std::min(kChunk, points.size() - first);
        const std::span<double> part = visibility.subspan(first, count);
        place(points, first, count, places);
        if (pattern_.empty())
            findWindow(places, count, part);
        else
            findDisc(points, first, places, count, part);
        for (size_t i = 0; i < count; i++)
            if (places.layer[i] == kNoLayer) part[i] = 1;
    }
}

template <class T>
void ShadowLookupOf<T>::placeEach(const LitPoints& points, size_t first, size_t count, Places& places) const {
    K kernels;
    forEachLaneGroup<N>(count, [&](size_t offset, int active) {
        const size_t at = first + offset;
        const vec3 position = load(points.position_m, at, active), normal = load(points.normal, at, active),
                   face = load(points.faceNormal, at, active);
        const typename K::ShadowPoint p = kernels.shadowPoint(space_, position, normal, face);
        const typename K::TexelPair x = kernels.windowStart(p.u, windowTaps_, fractionBits_);
        const typename K::TexelPair y = kernels.windowStart(p.v, windowTaps_, fractionBits_);
        const T centreU = kernels.firstCentre(p.u, x), centreV = kernels.firstCentre(p.v, y);
        const std::array<std::pair<const T*, Stored*>, 9> values = {{{&p.u, places.u.data()},
                                                                     {&p.v, places.v.data()},
                                                                     {&p.depth, places.depth.data()},
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
                                    planes_[static_cast<size_t>(layer)].isDrawn();
            places.layer[j] = isLookedUp ? layer : kNoLayer;
            // Narrow formats round positions near the border by more than a texel.
            const int last = map_.projection.width + pad_ - windowTaps_ - 1;
            places.x[j] = std::clamp(integerLane(x.first, i), -pad_, last);
            places.y[j] = std::clamp(integerLane(y.first, i), -pad_, last);
        }
    });
}

// Texels below the reference, as the bits of lanes, both as integers of the format.
template <class T>
uint32_t ShadowLookupOf<T>::compareQuantised(const T& texels, const T& reference) const {
    RasterKernels<double> kernels;
    uint32_t bits = 0;
    for (int i = 0; i < N; i++)
        bits |= (numberLane(texels, i) < kernels.unormDepth(numberLane(reference, i), levels_) ? 1u : 0u)
                << i;
    return bits;
}

// Bit i: texel i of the row is in the way. du: from the point to the texels' centres, in lanes.
template <class T>
[[gnu::always_inline]] inline uint32_t ShadowLookupOf<T>::shadowedInRow(const Stored* row, const T& depth,
                                                                        const T& perU, const T& perV,
                                                                        const WindowColumns& du,
                                                                        const T& dv) const {
    K kernels;
    uint32_t bits = 0;
    for (int part = 0; part * N <= windowTaps_; part++) {
        const T reference =
            kernels.referenceDepth(depth, perU, perV, du[static_cast<size_t>(part)], dv, farthest_);
        const T texels = Number<T>::load(row + part * N);
        bits |= (levels_ > 0 ? compareQuantised(texels, reference) : bitsOf(texels < reference))
                << (part * N);
    }
    return bits;
}

// The window of up to 8 x 8 texels as one word, a byte for each row; two rows at a time where that many lanes
// are.
template <class T>
[[gnu::always_inline]] inline typename ShadowLookupOf<T>::Windows ShadowLookupOf<T>::shadowedInSmallWindow(
    const Stored* row, const T& depth, const T& perU, const T& perV, const T& centreU,
    const T& centreV) const {
    const int taps = windowTaps_;
    uint64_t bits = 0;
    if constexpr (std::is_same_v<T, Lanes<float, 16>>) {
        K kernels;
        const T du = centreU + columnsOfTwoRows_;
        // The row behind the last one is not counted.
        for (int j = 0; j <= taps; j += 2, row += 2 * stride_) {
            const T dv = centreV + (rowsOfTwoRows_ + T(static_cast<double>(j)));
            using Row = Lanes<Stored, N / 2>;
            const T texels(joinLanes(Row::load(row), Row::load(row + stride_)).v);
            const T reference = kernels.referenceDepth(depth, perU, perV, du, dv, farthest_);
            const uint64_t two =
                levels_ > 0 ? compareQuantised(texels, reference) : bitsOf(texels < reference);
            bits |= two << (8 * j);
        }
    } else {
        WindowColumns du;
        for (size_t part = 0; part * N <= static_cast<size_t>(taps); part++)
            du[part] = centreU + columns_[part];
        for (int j = 0; j <= taps; j++, row += stride_) {
            const T dv = centreV + T(static_cast<double>(j));
            bits |= uint64_t{shadowedInRow(row, depth, perU, perV, du, dv) & 0xff} << (8 * j);
        }
    }
    const auto count = [&](int shift) { return std::popcount(bits >> shift & window_); };
    return {count(0), count(1), count(8), count(9)};
}

template <class T>
typename ShadowLookupOf<T>::Windows ShadowLookupOf<T>::shadowedInWindow(const Stored* row, const T& depth,
                                                                        const T& perU, const T& perV,
                                                                        const T& centreU,
                                                                        const T& centreV) const {
    const int taps = windowTaps_;
    const uint32_t window = (1u << taps) - 1;
    WindowColumns du;
    for (size_t part = 0; part * N <= static_cast<size_t>(taps); part++) du[part] = centreU + columns_[part];
    Windows shadowed{};
    for (int j = 0; j <= taps; j++, row += stride_) {
        const T dv = centreV + T(static_cast<double>(j));
        const uint32_t bits = shadowedInRow(row, depth, perU, perV, du, dv);
        const int left = std::popcount(bits & window), right = std::popcount(bits >> 1 & window);
        if (j < taps) shadowed[0] += left, shadowed[1] += right;
        if (j > 0) shadowed[2] += left, shadowed[3] += right;
    }
    return shadowed;
}

// pcf: the comparisons of each point side by side, then the weights of all points.
template <class T>
void ShadowLookupOf<T>::findWindow(const Places& places, size_t count, std::span<double> visibility) const {
    K kernels;
    const int taps = windowTaps_;
    std::array<std::array<Stored, kChunk>, 4> lit;
    Decided decided;
    for (size_t i = 0; i < count; i++) {
        const size_t lane = i % N;
        if (lane == 0) decided = decide(places, i, static_cast<int>(std::min<size_t>(N, count - i)));
        const bool isShadowed = (decided.shadowed >> lane & 1) != 0 && places.layer[i] != kNoLayer;
        const auto whole = static_cast<Stored>(taps * taps);
        for (auto& corner : lit) corner[i] = isShadowed ? Stored(0) : whole;
        if (places.layer[i] == kNoLayer || isShadowed || (decided.lit >> lane & 1) != 0) continue;
        const T depth(places.depth[i]), perU(places.perU[i]), perV(places.perV[i]);
        const Stored* row = texel(places.layer[i], places.x[i], places.y[i]);
        const Windows shadowed =
            taps < 8
                ? shadowedInSmallWindow(row, depth, perU, perV, T(places.centreU[i]), T(places.centreV[i]))
                : shadowedInWindow(row, depth, perU, perV, T(places.centreU[i]), T(places.centreV[i]));
        for (size_t corner = 0; corner < lit.size(); corner++)
            lit[corner][i] = whole - static_cast<Stored>(shadowed[corner]);
    }
    forEachLaneGroup<N>(count, [&](size_t offset, int active) {
        const T part = kernels.litPart(
            Number<T>::load(&lit[0][offset], active), Number<T>::load(&lit[1][offset], active),
            Number<T>::load(&lit[2][offset], active), Number<T>::load(&lit[3][offset], active),
            Number<T>::load(&places.fractionX[offset], active),
            Number<T>::load(&places.fractionY[offset], active), taps);
        for (int i = 0; i < active; i++) visibility[offset + static_cast<size_t>(i)] = numberLane(part, i);
    });
}

template <class T>
T ShadowLookupOf<T>::fetch(const std::array<int, kChunk>& layers, size_t first, const integer& x,
                           const integer& y) const {
    return Number<T>::generate([&](int i) {
        const int layer = layers[std::min(first + static_cast<size_t>(i), kChunk - 1)];
        if (layer == kNoLayer) return 0.0;
        const int last = map_.projection.width + pad_ - 1;
        return static_cast<double>(*texel(layer, std::clamp(integerLane(x, i), -pad_, last),
                                          std::clamp(integerLane(y, i), -pad_, last)));
    });
}

// disc and soft: points side by side, one point of the pattern after the other.
template <class T>
void ShadowLookupOf<T>::findDisc(const LitPoints& points, size_t first, const Places& places, size_t count,
                                 std::span<double> visibility) const {
    K kernels;
    const ShadowMapSettings& settings = map_.settings;
    const T most(settings.radius_texels);
    forEachLaneGroup<N>(count, [&](size_t offset, int active) {
        const T u = Number<T>::load(&places.u[offset], active),
                v = Number<T>::load(&places.v[offset], active),
                depth = Number<T>::load(&places.depth[offset], active),
                perU = Number<T>::load(&places.perU[offset], active),
                perV = Number<T>::load(&places.perV[offset], active);
        const auto turn = [&](bool isSine) {
            return Number<T>::generate([&](int i) {
                const size_t j = first + offset + static_cast<size_t>(std::min(i, active - 1));
                const glm::dvec2& t = turns_.of(points.x_px[j], points.y_px[j]);
                return isSine ? t.y : t.x;
            });
        };
        const T cosine = turn(false), sine = turn(true);
        std::array<int, kChunk> layers;
        for (int i = 0; i < N; i++)
            layers[static_cast<size_t>(i)] =
                places.layer[offset + static_cast<size_t>(std::min(i, active - 1))];
        // Calls use(texel, whether it is in the way) for the pattern at a radius.
        const auto forPattern = [&](const T& radius, auto&& use) {
            for (const glm::dvec2& point : pattern_) {
                const auto shift = kernels.turned(T(point.x), T(point.y), cosine, sine, radius);
                const T x = K::floor(u + shift.x), y = K::floor(v + shift.y);
                const T texels = fetch(layers, 0, K::toInteger(x), K::toInteger(y));
                const T half(0.5);
                const T reference =
                    kernels.referenceDepth(depth, perU, perV, (x + half) - u, (y + half) - v, farthest_);
                if (levels_ > 0) {
                    const uint32_t bits = compareQuantised(texels, reference);
                    const T inTheWay =
                        Number<T>::generate([&](int i) { return (bits >> i & 1) != 0 ? 1.0 : 0.0; });
                    use(texels / T(levels_), inTheWay > T(0.0));
                } else {
                    use(texels, texels < reference);
                }
            }
        };
        T radius = most;
        T blockers(1.0);
        if (settings.filter == ShadowFilter::soft) {
            T sum(0.0);
            blockers = T(0.0);
            const T perDepth(blurScale_), zero(0.0);
            const auto radiusPast = [&](const T& blocker, double least) {
                return map_.holdsDistance()
                           ? kernels.blurRadiusOfDistance(depth, blocker, perDepth, T(least), most)
                           : kernels.blurRadius(depth, blocker, perDepth, T(least), most);
            };
            forPattern(radiusPast(T(nearest_), 0), [&](const T& texel, const boolean& isInTheWay) {
                sum = sum + K::select(isInTheWay, texel, zero);
                blockers = blockers + K::select(isInTheWay, T(1.0), zero);
            });
            const boolean isBlocked = blockers > zero;
            // Half a texel: what the map resolves.
            constexpr double kLeastRadius_texels = 0.5;
            radius = radiusPast(sum / K::select(isBlocked, blockers, T(1.0)),
                                std::min(kLeastRadius_texels, settings.radius_texels));
        }
        T lit(0.0);
        forPattern(radius, [&](const T&, const boolean& isInTheWay) {
            lit = lit + K::select(isInTheWay, T(0.0), T(1.0));
        });
        T part = lit / T(static_cast<double>(pattern_.size()));
        part = K::select(blockers > T(0.0), part, T(1.0));
        for (int i = 0; i < active; i++) visibility[offset + static_cast<size_t>(i)] = numberLane(part, i);
    });
}

}  // namespace

template <class T>
constexpr LookupPasses kPassesOver<LookupPasses, T> = {
    [](const ShadowMap& map, int fractionBits, int threads,
       WindowSearch search) -> std::unique_ptr<ShadowLookup> {
        return std::make_unique<ShadowLookupOf<T>>(map, fractionBits, threads, search);
    }};
template const LookupPasses& ETALON_LEVEL::passesOf<LookupPasses>(NumberType);

}  // namespace etalon
