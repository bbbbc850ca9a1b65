#include "shadows/planar_shadow.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "lighting/transform.h"
#include "numeric/check.h"
#include "numeric/door.h"
#include "numeric/parallel.h"
#include "numeric/progress.h"
#include "raster/blur.h"
#include "raster/fragments.h"
#include "shadows/composition_kernel.h"
#include "shadows/light_samples.h"
#include "shadows/planar_passes.h"

namespace etalon {
namespace {

// Sample k is drawn at depth 1 - (k + 1) kDepthStep, nearer than those before it, so that a target is cleared
// once for all samples, and tells afterwards where the last one is. These depths are exact in float.
constexpr double kDepthStep = 0x1p-17;
static_assert(kMaxLightSamples * kDepthStep <= 0.5);

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

constexpr double kUnbounded_m = 0x1p200;

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

// For each light the box around the shadows of all casters.
std::vector<Box> boxesOfShadows(const PlanarCasters& casters, const std::vector<glm::dvec4>& lights,
                                double highest, int threads) {
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
            boxes[i].add({-kUnbounded_m, -kUnbounded_m});
            boxes[i].add({kUnbounded_m, kUnbounded_m});
            return;
        }
        for (const glm::dvec3& p : vertices) {
            const double reciprocal = 1.0 / (1.0 - light.w * p.z);
            boxes[i].add({(p.x - light.x * p.z) * reciprocal, (p.y - light.y * p.z) * reciprocal});
        }
    });
    return boxes;
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

PlanarGrid fitGrid(const PlanarReceiver& receiver, const std::vector<Box>& boxes,
                   const PlanarShadowOptions& options) {
    PlanarGrid grid;
    grid.frame = receiver.frame;
    Box box;
    for (const Box& one : boxes) box.add(one.lowest), box.add(one.highest);
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
    const double smallest = std::max(extent / (options.resolution - 6), largest * 0x1p-29);
    grid.texel_m = options.texel_m > 0 ? options.texel_m : roundUpTexel(smallest);
    while (grid.texel_m < smallest) grid.texel_m *= 2;
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

// The texels that a box of the frame can cover: x0 <= x < x1, y0 <= y < y1; one more on each side for
// snapping.
PixelRectangle texelsOf(const PlanarGrid& grid, const Box& box) {
    const auto texel = [&](double v_m, int c, int beyond, int size) {
        const double position = std::floor((v_m - grid.corner_m[c]) / grid.texel_m) + beyond;
        return static_cast<int>(std::clamp(position, 0.0, static_cast<double>(size)));
    };
    return {texel(box.lowest.x, 0, -1, grid.width), texel(box.lowest.y, 1, -1, grid.height),
            texel(box.highest.x, 0, 2, grid.width), texel(box.highest.y, 1, 2, grid.height)};
}

// What drawing the samples reads.
struct CountJob {
    const PlanarCasters& casters;
    double highest;
    const std::vector<glm::dvec4>& lights;  // in front, divided by their height
    const std::vector<Box>& boxes;          // of each light
    const PlanarGrid& grid;
    RenderTargetFormat format;
    RasterReal vertex;
    std::vector<glm::dvec3> inClip;  // the casters' vertices
};

// Draws samples one after the other and counts where each is.
class SampleCounter {
  public:
    SampleCounter(const CountJob& job, const RasterOptions& raster)
        : counts(job.grid.width, job.grid.height),
          job_(job),
          raster_(raster),
          target_(job.grid.width, job.grid.height, job.format) {
        state_.cull = CullMode::none;
        state_.idWrite = false;
    }

    void count(size_t light) {
        const double depth = 1.0 - static_cast<double>(drawn_++ + 1) * kDepthStep;
        project(job_.lights[light], depth);
        target_.forgetTriangles();
        const Draw draw{vertices_, indices_, state_};
        rasterize(target_, {0, 0, target_.width(), target_.height()}, {&draw, 1}, raster_);
        const uint32_t key = std::bit_cast<uint32_t>(static_cast<float>(depth));
        const PixelRectangle texels = texelsOf(job_.grid, job_.boxes[light]);
        if (texels.x0 >= texels.x1) return;
        const auto width = static_cast<size_t>(texels.width());
        for (int y = texels.y0; y < texels.y1; y++)
            for (int s = 0; s < job_.format.samples; s++) {
                const uint32_t* stored = &target_.depth.at(texels.x0, y, s);
                uint32_t* to = &counts.at(texels.x0, y);
                for (size_t x = 0; x < width; x++) to[x] += stored[x] == key ? 1u : 0u;
            }
    }

    Image<uint32_t> counts;

  private:
    void project(const glm::dvec4& light, double depth) {
        std::span<const glm::dvec3> points = job_.inClip;
        indices_ = job_.casters.indices;
        if (job_.highest > casterLimit(light)) {
            below_ = clipAtHeight({job_.inClip, job_.casters.indices}, casterLimit(light), KeepSide::below);
            points = below_.vertices;
            indices_ = below_.indices;
        }
        const ShadowPlane plane{{0, 0, 1}, 0};
        const ProjectionRows rows = planeShadowMatrix(plane, lightToClip(job_.grid, light));
        vertices_.resize(points.size());
        levelPasses<TransformPasses>().projectPoints(job_.vertex, rows, points, vertices_);
        for (ClipVertex& v : vertices_) v.z = depth * v.w;
    }

    const CountJob& job_;
    RasterOptions raster_;
    RenderTarget target_;
    DrawState state_;
    PlanarCasters below_;
    std::vector<ClipVertex> vertices_;
    std::span<const uint32_t> indices_;
    int drawn_ = 0;
};

// Parts of the samples on threads of their own; sums of integers.
Image<uint32_t> countAll(const CountJob& job, const RasterOptions& raster) {
    const size_t threads = static_cast<size_t>(raster.threads > 0 ? raster.threads : hardwareThreads());
    const size_t samples = job.lights.size(), parts = samples < threads ? 1 : threads;
    RasterOptions inPart = raster;
    inPart.clear = false;
    if (parts > 1) inPart.threads = 1;
    std::vector<Image<uint32_t>> counts(parts);
    ProgressLoop progress(samples);
    parallelFor(parts, raster.threads, [&](size_t part) {
        SampleCounter counter(job, inPart);
        for (size_t i = part * samples / parts; i < (part + 1) * samples / parts; i++, progress.next())
            counter.count(i);
        counts[part] = std::move(counter.counts);
    });
    Image<uint32_t>& sum = counts[0];
    parallelFor(static_cast<size_t>(sum.height()), raster.threads, [&](size_t y) {
        const auto to = sum.row(static_cast<int>(y));
        for (size_t part = 1; part < parts; part++) {
            const auto from = std::as_const(counts[part]).row(static_cast<int>(y));
            for (size_t x = 0; x < to.size(); x++) to[x] += from[x];
        }
    });
    return std::move(sum);
}

}  // namespace

glm::dvec3 PlanarGrid::toWorld(double x, double y) const {
    return frame.toWorld(corner_m.x + x * texel_m, corner_m.y + y * texel_m);
}

BlockedSamples countBlocked(const PlanarReceiver& receiver, const PlanarCasters& casters,
                            std::span<const glm::dvec4> lights, const PlanarShadowOptions& options,
                            const Profile& profile, const RasterOptions& raster) {
    ETALON_CHECK(options.resolution >= kMinPlanarResolution && options.resolution <= kMaxPlanarResolution,
                 "resolution = {}", options.resolution);
    ETALON_CHECK(lights.size() <= size_t{kMaxLightSamples}, "{} lights", lights.size());
    ETALON_CHECK(options.blurSigma_m >= 0 && std::isfinite(options.blurSigma_m), "blurSigma_m = {}",
                 options.blurSigma_m);
    ETALON_CHECK(options.texel_m >= 0 && std::isfinite(options.texel_m), "texel_m = {}", options.texel_m);
    BlockedSamples result;
    result.grid.frame = receiver.frame;
    const std::vector<glm::dvec4> inFront = lightsInFront(receiver.frame, lights);
    result.samples = static_cast<uint32_t>(inFront.size()) * static_cast<uint32_t>(options.samplesPerTexel);
    if (inFront.empty() || casters.indices.empty() || receiver.indices.empty()) return result;
    const double highest = casters.highest();
    const std::vector<Box> boxes = boxesOfShadows(casters, inFront, highest, raster.threads);
    result.grid = fitGrid(receiver, boxes, options);
    if (result.grid.width == 0) return result;
    CountJob job{casters,        highest,     inFront,
                 boxes,          result.grid, formatOf(profile, options.samplesPerTexel),
                 profile.vertex, {}};
    for (const glm::dvec3& p : casters.vertices) job.inClip.push_back(toClip(result.grid, p));
    result.blocked = countAll(job, raster);
    return result;
}

PlanarShadow planarShadow(const PlanarReceiver& receiver, const PlanarCasters& casters,
                          std::span<const glm::dvec4> lights, const PlanarShadowOptions& options,
                          const Profile& profile, const RasterOptions& raster) {
    const BlockedSamples counts = countBlocked(receiver, casters, lights, options, profile, raster);
    PlanarShadow result{counts.grid, {}};
    if (counts.blocked.empty()) return result;
    result.shadow = Image<float>(counts.grid.width, counts.grid.height);
    CompositionKernel<double> kernel;
    for (size_t i = 0; i < result.shadow.values().size(); i++)
        result.shadow.values()[i] =
            static_cast<float>(kernel.blockedPart(counts.blocked.values()[i], counts.samples));
    if (options.blurSigma_m == 0) return result;
    const double sigma = options.blurSigma_m / counts.grid.texel_m;
    const int radius = static_cast<int>(std::ceil(kPlanarBlurReach * sigma));
    result.shadow =
        passesIn<BlurPasses>(profile.fragment)->blur(result.shadow, radius, sigma, raster.threads);
    CompositionKernel<float> ofBlurred;
    for (float& value : result.shadow.values()) value = ofBlurred.limitedShadow(value);
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
