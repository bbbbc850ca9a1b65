#include "shadows/lookup_passes.h"

#include <algorithm>
#include <optional>

#include "lighting/render_view.h"
#include "numeric/door.h"
#include "shadows/window_lookup.h"

namespace etalon {
namespace {

// Half a texel: what a map resolves.
constexpr double kLeastRadius_texels = 0.5;

template <class T>
class ShadowLookupOf final : public ShadowLookup {
  public:
    ShadowLookupOf(const ShadowMap& map, const SamplerSettings& sampler, int threads, WindowSearch search);
    void find(const LitPoints& points, std::span<double> visibility) const override;
    uint64_t memory_bytes() const override {
        uint64_t bytes = buffers_.texels.memory_bytes();
        if constexpr (Number<T>::isNative) bytes += windows_ ? windows_->memory_bytes() : 0;
        return bytes;
    }

  private:
    using K = ShadowKernels<T>;
    using vec3 = typename K::vec3;
    using integer = typename K::integer;
    static constexpr int N = Number<T>::lanes;

    static vec3 constant(const glm::dvec3& v) { return vec3(T(v.x), T(v.y), T(v.z)); }
    static std::vector<glm::dvec2> patternOf(const ShadowMapSettings& settings) {
        if (settings.filter == ShadowFilter::hard || settings.filter == ShadowFilter::pcf) return {};
        return discPattern(settings.taps, settings.seed);
    }
    void setSpace(const ShadowMap& map);
    void setFilter(const ShadowMap& map, const SamplerSettings& sampler);
    void findByText(const LitPoints& points, std::span<double> visibility) const;
    [[gnu::flatten]] void findByTextFlattened(const LitPoints& points, std::span<double> visibility) const {
        findByText(points, visibility);
    }

    KeptFormat<T> format_;
    ShadowBuffers<T> buffers_;
    typename K::ShadowSpace space_;
    typename K::PointFilter filter_;
    // Instead of the text.
    struct None {};
    std::conditional_t<Number<T>::isNative, std::optional<WindowLookup<T>>, None> windows_;
};

template <class T>
ShadowLookupOf<T>::ShadowLookupOf(const ShadowMap& map, const SamplerSettings& sampler, int threads,
                                  WindowSearch search)
    : buffers_{ShadowTexels<T>(map, threads), patternOf(map.settings), PatternTurns(map.settings.seed)} {
    setSpace(map);
    setFilter(map, sampler);
    if constexpr (Number<T>::isNative)
        if (map.settings.filter == ShadowFilter::pcf && filter_.isQuantised == 0 &&
            search == WindowSearch::sideBySide)
            windows_.emplace(buffers_, space_, filter_, threads);
}

template <class T>
void ShadowLookupOf<T>::setSpace(const ShadowMap& map) {
    const ShadowMapSettings& settings = map.settings;
    const ShadowProjection& p = map.projection;
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
    space_.reach = T(filterReach_texels(settings));
}

template <class T>
void ShadowLookupOf<T>::setFilter(const ShadowMap& map, const SamplerSettings& sampler) {
    const ShadowMapSettings& settings = map.settings;
    const ShadowProjection& p = map.projection;
    filter_.kind = static_cast<int>(settings.filter);
    filter_.taps = settings.taps;
    filter_.sampling = samplingOfAnySize<K>(sampler, p.width, p.width);
    filter_.isQuantised = buffers_.texels.levels() > 0 ? 1 : 0;
    filter_.holdsDistance = map.holdsDistance() ? 1 : 0;
    filter_.farthest = buffers_.texels.farthest();
    filter_.levels = T(buffers_.texels.levels());
    filter_.radius = T(settings.radius_texels);
    filter_.leastRadius = T(std::min(kLeastRadius_texels, settings.radius_texels));
    filter_.blurScale = filter_.nearest = T(0.0);
    if (settings.filter != ShadowFilter::soft) return;
    // See blurRadius and blurRadiusOfDistance.
    const double halfSize = settings.lightSize_m / 2 * p.scale;
    filter_.blurScale = T(!p.isPerspective      ? settings.tangentOfHalfAngle * p.scale / p.depthScale
                          : map.holdsDistance() ? halfSize
                                                : halfSize / p.depthOffset);
    filter_.nearest = T(map.holdsDistance() ? p.near_m : 0.0);
}

template <class T>
void ShadowLookupOf<T>::find(const LitPoints& points, std::span<double> visibility) const {
    ETALON_CHECK(visibility.size() == points.size(), "{} values of {} points", visibility.size(),
                 points.size());
    [[maybe_unused]] const auto scope = format_.enter();
    if (!buffers_.texels.isAnyDrawn()) {
        std::fill(visibility.begin(), visibility.end(), 1.0);
        return;
    }
    if constexpr (Number<T>::isNative) {
        if (windows_) return windows_->find(points, visibility);
        findByTextFlattened(points, visibility);
    } else {
        findByText(points, visibility);
    }
    for (size_t i = 0; i < points.size(); i++)
        if (points.instance[i] == kNoInstance) visibility[i] = 1;
}

template <class T>
void ShadowLookupOf<T>::findByText(const LitPoints& points, std::span<double> visibility) const {
    K kernels{buffers_};
    const typename K::Halves key{buffers_.turns.keyHigh(), buffers_.turns.keyLow()};
    forEachLaneGroup<N>(points.size(), [&](size_t first, int active) {
        const auto load = [&](const std::array<std::vector<double>, 3>& from) {
            const auto number = [&](size_t c) { return Number<T>::load(&from[c][first], active); };
            return vec3(number(0), number(1), number(2));
        };
        const auto turnOf = [&](int i) {
            const size_t at = first + static_cast<size_t>(std::min(i, active - 1));
            return kernels.turnOfPixel(key, points.x_px[at], points.y_px[at], kPatternTurns);
        };
        integer turn(0);
        if (!buffers_.pattern.empty()) {
            if constexpr (N == 1)
                turn = turnOf(0);
            else
                turn = integer::generate(turnOf);
        }
        const T lit = kernels.pointVisibility(space_, filter_, load(points.position_m), load(points.normal),
                                              load(points.faceNormal), turn);
        Number<T>::store(lit, &visibility[first], active);
    });
}

}  // namespace

template <class T>
constexpr LookupPasses kPassesOver<LookupPasses, T> = {
    [](const ShadowMap& map, const SamplerSettings& sampler, int threads,
       WindowSearch search) -> std::unique_ptr<ShadowLookup> {
        return std::make_unique<ShadowLookupOf<T>>(map, sampler, threads, search);
    }};
template const LookupPasses& ETALON_LEVEL::passesOf<LookupPasses>(NumberType);

}  // namespace etalon
