// Which casters matter to a light, and the layer that holds them.
#include <algorithm>
#include <cmath>

#include "numeric/vectors.h"
#include "shadows/flat_mesh.h"
#include "shadows/shadow_map.h"

namespace etalon {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
// The layer's depths go beyond those of the scene by this part of their range.
constexpr double kDepthMargin = 0x1p-10;
// Texel edges of snapped layers have so many significant bits, so that they rarely change.
constexpr int kTexelBits = 5;

// Right, down and forward of a light that shines along `forward` (unit); right is perpendicular to +Y, or to
// +Z where forward is within 26 degrees (cosine 0.9) of the Y axis.
void setAxes(ShadowProjection& projection, const glm::dvec3& forward) {
    constexpr double kAlongY = 0.9;
    const bool isAlongY = std::fabs(forward.y) > kAlongY;
    const glm::dvec3 right = crossOf(forward, isAlongY ? glm::dvec3(0, 0, 1) : glm::dvec3(0, 1, 0));
    projection.forward = forward;
    projection.right = scaledBy(right, 1 / std::sqrt(dotOf(right, right)));
    projection.down = crossOf(projection.forward, projection.right);
}

// What a light sees of an object: its outline's box (metres, or tangents) and its depths. Empty: nothing.
struct Extent {
    double low[2] = {kInfinity, kInfinity}, high[2] = {-kInfinity, -kInfinity};
    double nearest = kInfinity, farthest = -kInfinity;

    bool isEmpty() const { return !(nearest <= farthest); }
    void add(const Extent& other) {
        if (other.isEmpty()) return;
        for (int k = 0; k < 2; k++) {
            low[k] = std::min(low[k], other.low[k]);
            high[k] = std::max(high[k], other.high[k]);
        }
        nearest = std::min(nearest, other.nearest);
        farthest = std::max(farthest, other.farthest);
    }
    bool overlaps(const Extent& other) const {
        return low[0] <= other.high[0] && other.low[0] <= high[0] && low[1] <= other.high[1] &&
               other.low[1] <= high[1];
    }
};

Extent extentOf(const PlacedMesh& mesh, const ShadowProjection& projection) {
    Extent extent;
    bool crosses = false;
    const auto include = [&](double x, double y) {
        extent.low[0] = std::min(extent.low[0], x), extent.high[0] = std::max(extent.high[0], x);
        extent.low[1] = std::min(extent.low[1], y), extent.high[1] = std::max(extent.high[1], y);
    };
    for (const glm::dvec3& p : mesh.positions) {
        if (!isFinite(p)) continue;
        const glm::dvec3 d = p - projection.origin;
        if (projection.isCube) {
            const double distance = std::sqrt(dotOf(d, d));
            extent.nearest = 0;
            extent.farthest = std::max(extent.farthest, distance);
            include(0, 0);
            continue;
        }
        const double along = dotOf(projection.forward, d);
        double x = dotOf(projection.right, d), y = dotOf(projection.down, d);
        extent.nearest = std::min(extent.nearest, along);
        extent.farthest = std::max(extent.farthest, along);
        if (projection.isPerspective) {
            if (!(along > 0)) {
                crosses = true;
                continue;
            }
            x /= along, y /= along;
        }
        include(x, y);
    }
    if (projection.isPerspective && !projection.isCube) {
        if (extent.farthest <= 0) return {};  // behind the light
        if (crosses) include(kInfinity, kInfinity), include(-kInfinity, -kInfinity);
        extent.nearest = std::max(extent.nearest, 0.0);
    }
    return extent;
}

struct Box {
    glm::dvec3 low{kInfinity}, high{-kInfinity};
    double distanceTo(const glm::dvec3& p) const {
        double square = 0;
        for (int k = 0; k < 3; k++) {
            const double d = std::max({low[k] - p[k], p[k] - high[k], 0.0});
            square += d * d;
        }
        return std::sqrt(square);
    }
};
Box boxOf(const PlacedMesh& mesh) {
    Box box;
    for (const glm::dvec3& p : mesh.positions) {
        if (!isFinite(p)) continue;
        for (int k = 0; k < 3; k++) {
            box.low[k] = std::min(box.low[k], p[k]);
            box.high[k] = std::max(box.high[k], p[k]);
        }
    }
    return box;
}

// Whether all of a receiver lies on the light's side of a flat caster. tolerance_m: of its vertices.
bool isBefore(const MeshPlane& plane, const PlacedMesh& receiver, double tolerance_m,
              const SurfaceLight& light) {
    const double side = light.kind == LightKind::directional ? dotOf(plane.normal, light.toLight)
                                                             : plane.above(light.position_m);
    const double error = light.kind == LightKind::directional ? kFlatness : plane.tolerance_m;
    if (std::fabs(side) <= error) return true;  // seen from its edge
    for (size_t i = 0; i < receiver.mesh->positions.size(); i++)
        if (plane.above(exactPosition(receiver, i)) * (side > 0 ? 1 : -1) <
            -(plane.tolerance_m + tolerance_m))
            return false;
    return true;
}

// The number of kTexelBits significant bits that is not below x > 0.
double roundedUp(double x) {
    int exponent = 0;
    const double fraction = std::frexp(x, &exponent);  // [1/2, 1)
    return std::ldexp(std::ceil(std::ldexp(fraction, kTexelBits)), exponent - kTexelBits);
}

// Lays the texels of a single layer over the rectangle.
void placeTexels(ShadowProjection& projection, const double low[2], const double high[2],
                 const ShadowMapSettings& settings) {
    const int margin = std::min(filterReach_texels(settings) + 1, (settings.size - 1) / 2);
    const int inside = settings.size - 2 * margin;
    const double extent = std::max({high[0] - low[0], high[1] - low[1], 1e-9});
    // A snapped rectangle may begin up to one texel before.
    double texel = extent / std::max(inside - (settings.snap ? 1 : 0), 1);
    double centre[2];
    const int half = settings.size / 2;
    if (settings.snap) texel = roundedUp(texel);
    for (int k = 0; k < 2; k++) {
        const double first =
            settings.snap ? std::floor(low[k] / texel) * texel : (low[k] + high[k]) / 2 - texel * inside / 2;
        centre[k] = first + texel * (half - margin);
    }
    projection.width = settings.size;
    projection.scale = 1 / texel;
    projection.centreU = projection.centreV = half;
    if (projection.isPerspective) {
        projection.centreU -= centre[0] / texel;
        projection.centreV -= centre[1] / texel;
    } else {
        projection.origin = scaledBy(projection.right, centre[0]) + scaledBy(projection.down, centre[1]);
    }
}

// error_m: of the depths that are drawn.
void placeDepths(ShadowProjection& projection, double nearest, double farthest, double error_m) {
    const double margin =
        std::max({kDepthMargin * (farthest - nearest), error_m, std::numeric_limits<double>::min()});
    projection.far_m = farthest + margin;
    if (projection.isPerspective) {
        projection.near_m = std::max(nearest - margin, projection.far_m * kShadowNearRatio);
        projection.depthScale = projection.far_m / (projection.far_m - projection.near_m);
        projection.depthOffset = projection.near_m * projection.depthScale;
        return;
    }
    // The origin moves onto the near plane.
    const double near_m = nearest - margin;
    projection.origin = projection.origin + scaledBy(projection.forward, near_m);
    projection.far_m -= near_m;
    projection.near_m = 0;
    projection.depthScale = 1 / projection.far_m;
    projection.depthOffset = 0;
}

// Whether a box may be seen in a face with its border.
bool isInFace(const Box& box, const ShadowProjection& projection, int face) {
    constexpr double kRounding = 1 + 0x1p-10;
    const View view = shadowView(projection, face);
    const double slope = projection.width / (2 * projection.scale) * kRounding;
    bool outside[4] = {true, true, true, true};
    for (int corner = 0; corner < 8; corner++) {
        const glm::dvec3 d =
            glm::dvec3(corner & 1 ? box.high.x : box.low.x, corner & 2 ? box.high.y : box.low.y,
                       corner & 4 ? box.high.z : box.low.z) -
            projection.origin;
        const double along = dotOf(view.forward, d), x = dotOf(view.perX, d) * projection.scale,
                     y = dotOf(view.perY, d) * projection.scale;
        const double across[4] = {x, -x, y, -y};
        for (int k = 0; k < 4; k++) outside[k] = outside[k] && across[k] > along * slope;
    }
    return !(outside[0] || outside[1] || outside[2] || outside[3]);
}

bool isUsable(const SurfaceLight& light) {
    const auto isDirection = [](const glm::dvec3& d) { return isFinite(d) && dotOf(d, d) > 0; };
    switch (light.kind) {
        case LightKind::directional:
            return isDirection(light.toLight) && isFinite(light.irradiance);
        case LightKind::point:
            return isFinite(light.position_m) && isFinite(light.intensity);
        case LightKind::spot:
            return isFinite(light.position_m) && isFinite(light.intensity) && isDirection(light.axis) &&
                   std::isfinite(light.cosOuter);
    }
    return false;
}

}  // namespace

int filterReach_texels(const ShadowMapSettings& settings) {
    switch (settings.filter) {
        case ShadowFilter::hard:
            return 1;
        case ShadowFilter::pcf:
            return settings.taps / 2 + 1;
        case ShadowFilter::disc:
        case ShadowFilter::soft:
            break;
    }
    return static_cast<int>(std::ceil(settings.radius_texels)) + 1;
}

ShadowFit fitShadowMap(std::span<const PlacedMesh> placed, const SurfaceLight& light,
                       const std::vector<bool>& receivers, const ShadowMapSettings& settings) {
    ShadowFit fit;
    ShadowProjection& projection = fit.projection;
    if (!isUsable(light)) return fit;
    projection.isPerspective = light.kind != LightKind::directional;
    projection.isCube =
        light.kind == LightKind::point || (light.kind == LightKind::spot && light.cosOuter < kOneLayerCosine);
    if (projection.isPerspective) projection.origin = light.position_m;
    if (light.kind == LightKind::directional) setAxes(projection, scaledBy(light.toLight, -1));
    if (light.kind == LightKind::spot && !projection.isCube) setAxes(projection, light.axis);

    std::vector<Extent> extents;
    std::vector<MeshPlane> planes;
    for (const PlacedMesh& mesh : placed) {
        extents.push_back(extentOf(mesh, projection));
        planes.push_back(planeOf(mesh));
    }

    // Pairs of a caster and a receiver behind it.
    Extent casters, behind;
    double error_m = 0;
    for (uint32_t c = 0; c < placed.size(); c++) {
        bool matters = false;
        for (uint32_t r = 0; r < placed.size(); r++) {
            if (!receivers.empty() && !receivers[r]) continue;
            const Extent &caster = extents[c], &receiver = extents[r];
            if (caster.isEmpty() || receiver.isEmpty() || !caster.overlaps(receiver) ||
                !(caster.nearest < receiver.farthest))
                continue;
            if (planes[c].exists && (c == r || isBefore(planes[c], placed[r], planes[r].tolerance_m, light)))
                continue;
            matters = true;
            behind.add(receiver);
        }
        if (!matters) continue;
        fit.casters.push_back(c);
        casters.add(extents[c]);
        const Box box = boxOf(placed[c]);
        error_m =
            std::max(error_m, placed[c].placingError_m(std::max(largestOf(box.low), largestOf(box.high))));
    }
    if (fit.casters.empty()) return fit;

    if (projection.isCube) {
        double nearest = kInfinity;
        std::vector<Box> boxes;
        for (const uint32_t c : fit.casters) {
            boxes.push_back(boxOf(placed[c]));
            nearest = std::min(nearest, boxes.back().distanceTo(projection.origin));
        }
        projection.border = filterReach_texels(settings) + 1;
        projection.width = settings.size + 2 * projection.border;
        projection.scale = settings.size / 2.0;
        projection.centreU = projection.centreV = projection.width / 2.0;
        // A distance is at most sqrt(3) of the depth in its face, and in the border a little more.
        placeDepths(projection, nearest / 2, behind.farthest, error_m);
        for (int face = 0; face < kCubeFaces; face++)
            fit.layerDrawn.push_back(std::any_of(
                boxes.begin(), boxes.end(), [&](const Box& box) { return isInFace(box, projection, face); }));
        return fit;
    }

    double low[2], high[2];
    const double cone = light.kind == LightKind::spot
                            ? std::sqrt(1 - light.cosOuter * light.cosOuter) / light.cosOuter
                            : kInfinity;
    for (int k = 0; k < 2; k++) {
        low[k] = std::max({casters.low[k], behind.low[k], -cone});
        high[k] = std::min({casters.high[k], behind.high[k], cone});
        if (!(low[k] <= high[k])) return {};
    }
    fit.layerDrawn = {true};
    placeTexels(projection, low, high, settings);
    placeDepths(projection, casters.nearest, behind.farthest, error_m);
    return fit;
}

}  // namespace etalon
