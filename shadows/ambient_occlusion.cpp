#include "shadows/ambient_occlusion.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "numeric/check.h"
#include "numeric/elementary.h"
#include "numeric/parallel.h"
#include "numeric/progress.h"
#include "numeric/vectors.h"
#include "shadows/occlusion_kernels.h"

namespace etalon {
namespace {

// The doubles next to pi and to the golden angle pi (3 - sqrt(5)).
constexpr double kGoldenAngle_rad = 0x1.3331febfa4bfcp+1;

constexpr size_t kPointsPerTask = 16384;
constexpr size_t kHemicubesPerTask = 8;

using Kernels = OcclusionKernels<double>;

glm::dvec3 unitOr(const glm::dvec3& v, const glm::dvec3& otherwise) {
    return Kernels().unitOr3(v, otherwise);
}

Occlusion occlusionOf(const Kernels::OpenPart& part) { return {part.open, part.bentNormal}; }

// Two unit vectors across a unit vector.
std::array<glm::dvec3, 2> acrossOf(const glm::dvec3& n) {
    const bool isX = std::fabs(n.x) < std::fabs(n.y);
    const glm::dvec3 axis = isX ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
    const glm::dvec3 u = unitOr(crossOf(axis, n), axis);
    return {u, crossOf(n, u)};
}

// Draws a scene again and again into small views.
class Drawer {
  public:
    explicit Drawer(std::span<const PlacedMesh> placed) : placed_(placed), vertices_(placed.size()) {}

    static RenderTarget target(int width, int height) {
        RenderTargetFormat format;
        format.real = RasterReal::fp64;
        return {width, height, format};
    }
    // Both sides of every triangle; nearer than the near plane counts as on it.
    void draw(const View& view, const RasterOptions& raster, RenderTarget& target) {
        std::vector<Draw> draws;
        for (size_t i = 0; i < placed_.size(); i++) {
            toClipSpace(placed_[i], view, RasterReal::fp64, raster.threads, vertices_[i]);
            Draw draw;
            draw.vertices = vertices_[i];
            draw.indices = placed_[i].mesh->indices;
            draw.state.cull = CullMode::none;
            draw.state.depthClamp = true;
            draws.push_back(draw);
        }
        RasterOptions cleared = raster;
        cleared.clear = true;
        rasterize(target, {0, 0, target.width(), target.height()}, draws, cleared);
    }

  private:
    std::span<const PlacedMesh> placed_;
    std::vector<UninitializedVector<ClipVertex>> vertices_;
};

// The faces of a hemicube, with what their texels weigh and the depths beyond which nothing covers.
class Hemicube {
  public:
    Hemicube(std::span<const PlacedMesh> placed, const HemicubeOptions& options,
             const HemicubeWeights& weights)
        : options_(options),
          weights_(weights),
          drawer_(placed),
          top_(Drawer::target(weights.size, weights.size)),
          side_(Drawer::target(weights.size, weights.size / 2)) {}

    Occlusion at(const OcclusionPoint& point) {
        const auto [u, v] = acrossOf(point.normal);
        const glm::dvec3& n = point.normal;
        camera_.position = point.position_m + options_.offset_m * n;
        sum_ = Kernels().noDirections(1);
        // Right, up and backward are right-handed; up is towards the normal on the sides.
        addFace(0, top_, weights_.top, v, u, n);
        addFace(1, side_, weights_.side, -v, n, u);
        addFace(2, side_, weights_.side, v, n, -u);
        addFace(3, side_, weights_.side, u, n, v);
        addFace(4, side_, weights_.side, -u, n, -v);
        return occlusionOf(Kernels().openPart(sum_, n));
    }

  private:
    // Draws it and adds what it shows; it is not kept.
    void addFace(int face, RenderTarget& target, const std::vector<double>& weights, const glm::dvec3& right,
                 const glm::dvec3& up, const glm::dvec3& forward) {
        const int size = weights_.size, height = static_cast<int>(weights.size()) / size;
        camera_.width = size;
        camera_.height = height;
        camera_.fx = camera_.fy = camera_.cx = camera_.cy = size / 2.0;
        camera_.right = right;
        camera_.up = up;
        camera_.backward = -forward;
        const bool isLimited = !std::isinf(options_.maxDistance_m);
        camera_.near_m = isLimited ? options_.maxDistance_m * 0x1p-10 : 1;
        camera_.far_m = HUGE_VAL;
        const View view = cameraView(camera_);
        drawer_.draw(view, {1, 64, false}, target);
        const Kernels::View drawn = {.target = &target,
                                     .face = {view.forward, view.perX, view.perY, view.centreX_px,
                                              view.centreY_px, size, height, isLimited ? 1 : 0},
                                     .weights = weights};
        Kernels kernels;
        kernels.views = {&drawn, 1};
        kernels.firstView = face;
        sum_ = kernels.addHemicubeFaces(sum_, face, face + 1);
    }

    const HemicubeOptions& options_;
    const HemicubeWeights& weights_;
    Drawer drawer_;
    RenderTarget top_, side_;
    PinholeCamera camera_;
    Kernels::OcclusionSum sum_;
};

// An orthographic view of a ball along -towards, of radius_m around centre; z from 0 towards the light to 1.
View ballView(const glm::dvec3& towards, const glm::dvec3& centre, double radius_m, int size) {
    const auto [u, v] = acrossOf(towards);
    const auto row = [&](const glm::dvec3& axis, double scale, double offset) {
        return glm::dvec4(scale * axis.x, scale * axis.y, scale * axis.z,
                          offset - scale * dotOf(axis, centre));
    };
    View view;
    view.width = view.height = size;
    view.worldToClip = {row(u, 1 / radius_m, 0), row(v, 1 / radius_m, 0), row(towards, -0.5 / radius_m, 0.5),
                        glm::dvec4(0, 0, 0, 1)};
    return view;
}

// A ball around the finite vertices.
struct Ball {
    glm::dvec3 centre{0};
    double radius_m = 0;
};
Ball ballAround(std::span<const PlacedMesh> placed) {
    glm::dvec3 lowest(HUGE_VAL), highest(-HUGE_VAL);
    for (const PlacedMesh& mesh : placed)
        for (const glm::dvec3& p : mesh.positions) {
            if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) continue;
            for (int i = 0; i < 3; i++) {
                lowest[i] = std::min(lowest[i], p[i]);
                highest[i] = std::max(highest[i], p[i]);
            }
        }
    if (!(lowest.x <= highest.x)) return {};
    const glm::dvec3 half = 0.5 * highest - 0.5 * lowest;
    return {lowest + half, std::sqrt(dotOf(half, half))};
}

}  // namespace

std::vector<OcclusionPoint> occlusionPointsOf(const PlacedMesh& placed) {
    std::vector<OcclusionPoint> points(placed.positions.size());
    for (size_t i = 0; i < points.size(); i++)
        points[i] = {placed.positions[i], unitOr(placed.normals[i], glm::dvec3(0))};
    return points;
}

std::vector<OcclusionPoint> occlusionPointsOf(const View& view, const Image<float>& normals,
                                              const Image<float>& distance) {
    ETALON_CHECK(normals.width() == view.width && normals.height() == view.height &&
                     distance.width() == view.width && distance.height() == view.height &&
                     normals.channels() == 3,
                 "normals {}x{}, distance {}x{}, view {}x{}", normals.width(), normals.height(),
                 distance.width(), distance.height(), view.width, view.height);
    std::vector<OcclusionPoint> points;
    points.reserve(normals.pixelCount());
    for (int y = 0; y < view.height; y++)
        for (int x = 0; x < view.width; x++) {
            const glm::dvec3 n(normals.at(x, y, 0), normals.at(x, y, 1), normals.at(x, y, 2));
            const double distance_m = distance.at(x, y);
            if (!std::isfinite(distance_m)) {
                points.emplace_back();
                continue;
            }
            points.push_back(
                {Kernels().seenPoint(view.eye, view.forward, view.perX, view.perY, x + 0.5 - view.centreX_px,
                                     y + 0.5 - view.centreY_px, distance_m),
                 unitOr(n, glm::dvec3(0))});
        }
    return points;
}

HemicubeWeights::HemicubeWeights(int texels) : size(texels) {
    ETALON_CHECK(texels >= 2 && texels <= 4096 && texels % 2 == 0, "{}", texels);
    const auto arcTangent = [](double v) { return atan2Of(v, 1.0); };
    // Form factors of a rectangle from the foot of its corner to (x, y): above and parallel, and standing at
    // the side with its lower border from the foot [Cohen85].
    const auto parallel = [&](double x, double y) {
        const double a = std::sqrt(1 + x * x), b = std::sqrt(1 + y * y);
        return (x / a * arcTangent(y / a) + y / b * arcTangent(x / b)) / (2 * kPi);
    };
    const auto upright = [&](double y, double z) {
        const double a = std::sqrt(1 + z * z);
        return (arcTangent(y) - arcTangent(y / a) / a) / (2 * kPi);
    };
    const auto integrate = [&](const auto& corner, double x0, double x1, double y0, double y1) {
        return (corner(x1, y1) - corner(x0, y1)) - (corner(x1, y0) - corner(x0, y0));
    };
    const auto place = [&](int i) { return (2.0 * i - size) / size; };
    for (int y = 0; y < size; y++)
        for (int x = 0; x < size; x++)
            top.push_back(integrate(parallel, place(x), place(x + 1), place(y), place(y + 1)));
    for (int y = 0; y < size / 2; y++)
        for (int x = 0; x < size; x++)
            side.push_back(integrate(upright, place(x), place(x + 1), -place(y + 1), -place(y)));
}

std::vector<Occlusion> hemicubeOcclusion(std::span<const PlacedMesh> placed,
                                         std::span<const OcclusionPoint> points,
                                         const HemicubeOptions& options) {
    ETALON_CHECK(options.maxDistance_m > 0, "{}", options.maxDistance_m);
    const HemicubeWeights weights(options.size);
    std::vector<Occlusion> result(points.size());
    parallelFor((points.size() + kHemicubesPerTask - 1) / kHemicubesPerTask, options.threads,
                [&](size_t task) {
                    Hemicube hemicube(placed, options, weights);
                    const size_t end = std::min(points.size(), (task + 1) * kHemicubesPerTask);
                    for (size_t i = task * kHemicubesPerTask; i < end; i++)
                        if (points[i].normal != glm::dvec3(0)) result[i] = hemicube.at(points[i]);
                });
    return result;
}

glm::dvec3 spiralDirection(int i, int n) {
    ETALON_CHECK(n >= 1 && i >= 0 && i < n, "{} of {}", i, n);
    const double y = (n - 1.0 - 2.0 * i) / n, radius = std::sqrt(1 - y * y);
    const double azimuth_rad = i * kGoldenAngle_rad;
    return {radius * sinOf(azimuth_rad), y, radius * cosOf(azimuth_rad)};
}

std::vector<Occlusion> directionalOcclusion(std::span<const PlacedMesh> placed,
                                            std::span<const OcclusionPoint> points,
                                            const DirectionalOptions& options) {
    ETALON_CHECK(options.directions >= 1 && options.mapSize >= 1, "{} directions, maps of {}",
                 options.directions, options.mapSize);
    const Ball ball = ballAround(placed);
    std::vector<Kernels::OcclusionSum> sums(points.size(), Kernels().noDirections(0));
    Drawer drawer(placed);
    RenderTarget target = Drawer::target(options.mapSize, options.mapSize);
    const int size = options.mapSize;
    // A plane within a texel is at most half a diagonal from where the texel's centre shows it.
    const double texel_m = 2 * ball.radius_m / size, offset_m = 0.75 * texel_m;
    ProgressLoop directions(static_cast<size_t>(options.directions));
    for (int k = 0; k < options.directions && ball.radius_m > 0; k++, directions.next()) {
        const glm::dvec3 towards = spiralDirection(k, options.directions);
        // Room for what is moved off the surface.
        const View view = ballView(towards, ball.centre, ball.radius_m * (1 + 2.0 / size), size);
        drawer.draw(view, options.raster, target);
        const Kernels::View drawn = {.target = &target,
                                     .parallel = {towards, view.worldToClip[0], view.worldToClip[1],
                                                  view.worldToClip[2], size, offset_m}};
        // One view at a time is kept.
        Kernels kernels;
        kernels.views = {&drawn, 1};
        kernels.firstView = k;
        parallelFor(
            (points.size() + kPointsPerTask - 1) / kPointsPerTask, options.raster.threads, [&](size_t task) {
                Kernels ofTask = kernels;
                const size_t end = std::min(points.size(), (task + 1) * kPointsPerTask);
                for (size_t i = task * kPointsPerTask; i < end; i++)
                    sums[i] =
                        ofTask.addParallelViews(sums[i], points[i].position_m, points[i].normal, k, k + 1);
            });
    }
    std::vector<Occlusion> result(points.size());
    for (size_t i = 0; i < points.size(); i++)
        result[i] = occlusionOf(Kernels().openPart(sums[i], points[i].normal));
    return result;
}

}  // namespace etalon
