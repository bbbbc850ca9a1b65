#include "shadows/planar_shadow.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "lighting/lighting_passes.h"
#include "numeric/check.h"
#include "numeric/parallel.h"
#include "shadows/planar_passes.h"

namespace etalon {
namespace {

// Samples that are drawn before their stencil counts are added up: what 8 bits hold. Sample k of them is
// drawn at depth (kPerRound - k) / 256, nearer than those before it, so that each pixel counts it once
// however many triangles cover it. The depth is exact in float.
constexpr int kPerRound = 255;
constexpr double kDepthStep = 0x1p-8;
// Vertices that are projected in one call.
constexpr size_t kVerticesPerCall = size_t{1} << 20;

// The lights in front of a plane, in its frame and divided by their height: (s / h, t / h, 1, w / h).
std::vector<glm::dvec4> lightsInFront(const PlaneFrame& frame, std::span<const glm::dvec4> lights) {
    std::vector<glm::dvec4> result;
    for (const glm::dvec4& light : lights) {
        ETALON_CHECK(std::isfinite(light.x) && std::isfinite(light.y) && std::isfinite(light.z) &&
                         (light.w == 0 || light.w == 1),
                     "light ({}, {}, {}, {})", light.x, light.y, light.z, light.w);
        const glm::dvec4 l = frame.toFrame(light);
        const glm::dvec4 scaled(l.x / l.z, l.y / l.z, 1, l.w / l.z);
        if (l.z > 0 && std::isfinite(scaled.x) && std::isfinite(scaled.y) && std::isfinite(scaled.w))
            result.push_back(scaled);
    }
    return result;
}

// Height of a scaled light that casters end at; infinite for directions.
double casterLimit(const glm::dvec4& scaledLight) {
    return scaledLight.w > 0 ? (1 - kNearestToLight) / scaledLight.w
                             : std::numeric_limits<double>::infinity();
}

struct Box {
    glm::dvec2 lowest{std::numeric_limits<double>::infinity()};
    glm::dvec2 highest{-std::numeric_limits<double>::infinity()};

    void add(const glm::dvec2& p) {
        for (int c = 0; c < 2; c++) {
            lowest[c] = std::min(lowest[c], p[c]);
            highest[c] = std::max(highest[c], p[c]);
        }
    }
    bool isEmpty() const { return !(lowest.x < highest.x && lowest.y < highest.y); }
};

// Around the shadows of all casters from all lights.
Box boxOfShadows(const PlanarReceiver& receiver, const PlanarCasters& casters,
                 const std::vector<glm::dvec4>& lights, double highest, int threads) {
    std::vector<bool> used(casters.vertices.size());
    for (const uint32_t i : casters.indices) used[i] = true;
    std::vector<glm::dvec3> vertices;
    for (size_t i = 0; i < used.size(); i++)
        if (used[i]) vertices.push_back(casters.vertices[i]);
    std::vector<Box> boxes(lights.size());
    parallelFor(lights.size(), threads, [&](size_t i) {
        const glm::dvec4& light = lights[i];
        // Beyond any bound below a light that is lower than a caster.
        if (highest > casterLimit(light)) {
            boxes[i].add(receiver.lowest_m());
            boxes[i].add(receiver.highest_m());
            return;
        }
        for (const glm::dvec3& p : vertices) {
            const double w = 1.0 - light.w * p.z;
            boxes[i].add({(p.x - light.x * p.z) / w, (p.y - light.y * p.z) / w});
        }
    });
    Box result;
    for (const Box& box : boxes) {
        result.add(box.lowest);
        result.add(box.highest);
    }
    return result;
}

// The smallest of 4, 5, 6 and 7 times a power of two that is not below x > 0.
double roundUpTexel(double x) {
    double step = 1;
    while (8 * step < x) step *= 2;
    while (4 * step >= x) step *= 0.5;
    for (const double factor : {5.0, 6.0, 7.0})
        if (factor * step >= x) return factor * step;
    return 8 * step;
}

PlanarGrid fitGrid(const PlanarReceiver& receiver, Box box, const PlanarShadowOptions& options) {
    PlanarGrid grid;
    grid.frame = receiver.frame;
    const double reach = kPlanarBlurReach * options.blurSigma_m;
    const glm::dvec2 lowest = receiver.lowest_m(), highest = receiver.highest_m();
    for (int c = 0; c < 2; c++) {
        box.lowest[c] = std::max(box.lowest[c], lowest[c] - reach);
        box.highest[c] = std::min(box.highest[c], highest[c] + reach);
    }
    if (box.isEmpty()) return grid;
    double largest = 0;
    for (int c = 0; c < 2; c++) {
        box.lowest[c] = std::max(box.lowest[c] - reach, lowest[c] - reach);
        box.highest[c] = std::min(box.highest[c] + reach, highest[c] + reach);
        largest = std::max({largest, std::abs(box.lowest[c]), std::abs(box.highest[c])});
    }
    // Two texels around the box, one that rounding to the grid can add; indices of texels stay below 2^30.
    const double extent = std::max(box.highest.x - box.lowest.x, box.highest.y - box.lowest.y);
    grid.texel_m = roundUpTexel(std::max(extent / (options.resolution - 6), largest * 0x1p-29));
    std::array<int, 2> size{};
    for (int c = 0; c < 2; c++) {
        const double first = std::floor(box.lowest[c] / grid.texel_m) - 2;
        const double last = std::ceil(box.highest[c] / grid.texel_m) + 2;
        grid.corner_m[c] = first * grid.texel_m;
        size[static_cast<size_t>(c)] = static_cast<int>(last - first);
    }
    grid.width = size[0], grid.height = size[1];
    return grid;
}

// Frame coordinates to x and y of clip space: row 0 is on top at the smallest t.
glm::dvec3 toClip(const PlanarGrid& grid, const glm::dvec3& p) {
    return {2.0 * ((p.x - grid.corner_m.x) / (grid.texel_m * grid.width)) - 1.0,
            1.0 - 2.0 * ((p.y - grid.corner_m.y) / (grid.texel_m * grid.height)), p.z};
}

// The light in the same coordinates.
glm::dvec4 lightToClip(const PlanarGrid& grid, const glm::dvec4& l) {
    return {2.0 * ((l.x - grid.corner_m.x * l.w) / (grid.texel_m * grid.width)) - l.w,
            l.w - 2.0 * ((l.y - grid.corner_m.y * l.w) / (grid.texel_m * grid.height)), l.z, l.w};
}

RenderTargetFormat formatOf(const Profile& profile, int samples) {
    RenderTargetFormat format;
    format.samples = samples;
    format.subpixelBits = profile.subpixelBits;
    return format;
}

// A sample of the light, ready to be drawn.
struct SampleDraw {
    std::vector<ClipVertex> vertices;
    std::vector<uint32_t> cutIndices;  // where the casters are cut below the light
    std::span<const uint32_t> indices;
};

// Draws samples into a stencil and counts.
class SampleCounter {
  public:
    SampleCounter(const PlanarCasters& casters, double highest, BlockedSamples& result, int samplesPerTexel,
                  const Profile& profile, const RasterOptions& raster)
        : casters_(casters),
          highest_(highest),
          result_(result),
          profile_(profile),
          raster_(raster),
          target_(result.grid.width, result.grid.height, formatOf(profile, samplesPerTexel)) {
        for (const glm::dvec3& p : casters.vertices) inClip_.push_back(toClip(result.grid, p));
        state_.cull = CullMode::none;
        state_.idWrite = false;
        state_.stencil.enabled = true;
        state_.stencil.front.onPass = state_.stencil.back.onPass = StencilOperation::incrementWrap;
    }

    void run(std::span<const glm::dvec4> lights) {
        const size_t perCall =
            std::clamp(kVerticesPerCall / std::max<size_t>(inClip_.size(), 1), size_t{1}, size_t{kPerRound});
        for (size_t round = 0; round < lights.size(); round += kPerRound) {
            const auto inRound = lights.subspan(round, std::min<size_t>(kPerRound, lights.size() - round));
            for (size_t first = 0; first < inRound.size(); first += perCall)
                draw(inRound.subspan(first, std::min(perCall, inRound.size() - first)), first);
            addCounts();
        }
    }

  private:
    void draw(std::span<const glm::dvec4> lights, size_t numberInRound) {
        draws_.resize(lights.size());
        parallelFor(lights.size(), raster_.threads, [&](size_t i) {
            project(lights[i], (kPerRound - static_cast<double>(numberInRound + i)) * kDepthStep, draws_[i]);
        });
        std::vector<Draw> list;
        for (const SampleDraw& sample : draws_) list.push_back({sample.vertices, sample.indices, state_});
        RasterOptions options = raster_;
        options.clear = numberInRound == 0;
        target_.forgetTriangles();
        rasterize(target_, {0, 0, target_.width(), target_.height()}, list, options);
    }

    void project(const glm::dvec4& light, double depth, SampleDraw& sample) const {
        const std::vector<glm::dvec3>* points = &inClip_;
        sample.indices = casters_.indices;
        PlanarCasters below;
        if (highest_ > casterLimit(light)) {
            below = clipAtHeight({inClip_, casters_.indices}, casterLimit(light), KeepSide::below);
            sample.cutIndices = below.indices;
            sample.indices = sample.cutIndices;
            points = &below.vertices;
        }
        const Plane plane{{0, 0, 1}, 0};
        const ProjectionRows rows = planeShadowMatrix(plane, lightToClip(result_.grid, light));
        sample.vertices.resize(points->size());
        lightingPasses().projectPoints(profile_.vertex, rows, *points, sample.vertices);
        for (ClipVertex& v : sample.vertices) v.z = depth * v.w;
    }

    // Row by row; the samples of a texel are planes of the stencil.
    void addCounts() {
        parallelFor(static_cast<size_t>(result_.blocked.height()), raster_.threads, [&](size_t y) {
            const auto counts = result_.blocked.row(static_cast<int>(y));
            for (int s = 0; s < target_.format.samples; s++) {
                const auto stencil = std::as_const(target_).stencil.row(static_cast<int>(y), s);
                for (size_t x = 0; x < counts.size(); x++) counts[x] += stencil[x];
            }
        });
    }

    const PlanarCasters& casters_;
    double highest_;
    BlockedSamples& result_;
    const Profile& profile_;
    RasterOptions raster_;
    RenderTarget target_;
    std::vector<glm::dvec3> inClip_;
    DrawState state_;
    std::vector<SampleDraw> draws_;
};

}  // namespace

glm::dvec3 PlanarGrid::toWorld(double x, double y) const {
    return frame.toWorld(corner_m.x + x * texel_m, corner_m.y + y * texel_m);
}

BlockedSamples countBlocked(const PlanarReceiver& receiver, const PlanarCasters& casters,
                            std::span<const glm::dvec4> lights, const PlanarShadowOptions& options,
                            const Profile& profile, const RasterOptions& raster) {
    ETALON_CHECK(options.resolution >= kMinPlanarResolution && options.resolution <= kMaxPlanarResolution,
                 "resolution = {}", options.resolution);
    ETALON_CHECK(options.blurSigma_m >= 0 && std::isfinite(options.blurSigma_m), "blurSigma_m = {}",
                 options.blurSigma_m);
    BlockedSamples result;
    result.grid.frame = receiver.frame;
    const std::vector<glm::dvec4> inFront = lightsInFront(receiver.frame, lights);
    result.samples = static_cast<uint32_t>(inFront.size()) * static_cast<uint32_t>(options.samplesPerTexel);
    if (inFront.empty() || casters.indices.empty() || receiver.indices.empty()) return result;
    const double highest = casters.highest();
    result.grid =
        fitGrid(receiver, boxOfShadows(receiver, casters, inFront, highest, raster.threads), options);
    if (result.grid.width == 0) return result;
    result.blocked = Image<uint32_t>(result.grid.width, result.grid.height);
    SampleCounter(casters, highest, result, options.samplesPerTexel, profile, raster).run(inFront);
    return result;
}

PlanarShadow planarShadow(const PlanarReceiver& receiver, const PlanarCasters& casters,
                          std::span<const glm::dvec4> lights, const PlanarShadowOptions& options,
                          const Profile& profile, const RasterOptions& raster) {
    const BlockedSamples counts = countBlocked(receiver, casters, lights, options, profile, raster);
    PlanarShadow result{counts.grid, {}};
    if (counts.blocked.empty()) return result;
    result.shadow = Image<float>(counts.grid.width, counts.grid.height);
    for (size_t i = 0; i < result.shadow.values().size(); i++)
        result.shadow.values()[i] =
            static_cast<float>(static_cast<double>(counts.blocked.values()[i]) / counts.samples);
    if (options.blurSigma_m == 0) return result;
    const double sigma = options.blurSigma_m / counts.grid.texel_m;
    const int radius = static_cast<int>(std::ceil(kPlanarBlurReach * sigma));
    result.shadow = planarPasses(profile.fragment).blur(result.shadow, radius, sigma, raster.threads);
    for (float& value : result.shadow.values()) value = std::min(value, 1.0f);
    return result;
}

Image<uint8_t> receiverMask(const PlanarReceiver& receiver, const PlanarGrid& grid, const Profile& profile,
                            const RasterOptions& raster) {
    if (grid.width == 0) return {};
    std::vector<ClipVertex> vertices;
    for (const glm::dvec2& corner : receiver.corners_m) {
        const glm::dvec3 p = toClip(grid, {corner.x, corner.y, 0});
        vertices.push_back({p.x, p.y, 0.5, 1.0});
    }
    DrawState state;
    state.cull = CullMode::none;
    state.idWrite = false;
    state.stencil.enabled = true;
    state.stencil.reference = 1;
    state.stencil.front.onPass = state.stencil.back.onPass = StencilOperation::replace;
    RenderTarget target(grid.width, grid.height, formatOf(profile, 1));
    const Draw draw{vertices, receiver.indices, state};
    RasterOptions options = raster;
    options.clear = true;
    rasterize(target, {0, 0, grid.width, grid.height}, {&draw, 1}, options);
    return target.stencil;
}

}  // namespace etalon
