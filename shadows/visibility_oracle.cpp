#include "shadows/visibility_oracle.h"

#include <algorithm>
#include <cmath>

#include "numeric/check.h"
#include "shadows/exact_side.h"

namespace etalon {
namespace {

constexpr uint32_t kTrianglesPerLeaf = 4;

// The line from the point to the light, as far as the light.
struct Ray {
    glm::dvec3 from;
    LightSource light;
    glm::dvec3 along;  // towards the light, rounded

    Ray(const glm::dvec3& point, const LightSource& source)
        : from(point), light(source), along(source.atInfinity ? source.place : source.place - point) {}
};

int sideOfLight(const WorldTriangle& t, const LightSource& light) {
    const auto& [a, b, c] = t.vertices;
    return light.atInfinity ? sideOfTriangleTowards(a, b, c, light.place)
                            : sideOfTriangle(a, b, c, light.place);
}

int sideOfRay(const Ray& ray, const glm::dvec3& a, const glm::dvec3& b) {
    return ray.light.atInfinity ? sideOfEdgeTowards(ray.from, ray.light.place, a, b)
                                : sideOfEdge(ray.from, ray.light.place, a, b);
}

bool blocks(const WorldTriangle& t, const Ray& ray) {
    const auto& [a, b, c] = t.vertices;
    // The plane passes between the point and the light.
    const int point = sideOfTriangle(a, b, c, ray.from);
    if (point == 0 || sideOfLight(t, ray.light) != -point) return false;
    // The line passes no edge on the outer side.
    const int ab = sideOfRay(ray, a, b);
    const int bc = sideOfRay(ray, b, c);
    if (ab * bc < 0) return false;
    const int ca = sideOfRay(ray, c, a);
    return ab * ca >= 0 && bc * ca >= 0;
}

// Whether the ray may meet the box: separating axes, with room for every rounding.
bool mayMeet(const glm::dvec3& centre, const glm::dvec3& halfSize, const Ray& ray) {
    // Each quantity below is rounded fewer than eight times.
    constexpr double kRoom = 0x1p-49;
    const glm::dvec3 offset = ray.from - centre;
    for (int i = 0; i < 3; i++) {
        // The part of the ray that is nearest to the box along this axis.
        const double limit = halfSize[i] + kRoom * (std::fabs(ray.from[i]) + std::fabs(centre[i]));
        const bool above = offset[i] > limit, below = offset[i] < -limit;
        if (!above && !below) continue;
        if (above ? ray.along[i] >= 0 : ray.along[i] <= 0) return false;
        if (ray.light.atInfinity) continue;
        const double end = ray.light.place[i] - centre[i];
        const double endLimit = halfSize[i] + kRoom * (std::fabs(ray.light.place[i]) + std::fabs(centre[i]));
        if (above ? end > endLimit : end < -endLimit) return false;
    }
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        const double p = ray.along[j] * offset[k], q = ray.along[k] * offset[j];
        const double reach = std::fabs(ray.along[j]) * halfSize[k] + std::fabs(ray.along[k]) * halfSize[j];
        if (std::fabs(p - q) > reach + kRoom * (std::fabs(p) + std::fabs(q) + reach)) return false;
    }
    return true;
}

}  // namespace

LightSource lightSourceOf(const SurfaceLight& light) {
    return light.kind == LightKind::directional ? LightSource{light.toLight, true}
                                                : LightSource{light.position_m, false};
}

std::vector<WorldTriangle> worldTriangles(std::span<const PlacedMesh> placed,
                                          std::span<const uint32_t> excluded) {
    std::vector<WorldTriangle> triangles;
    for (uint32_t i = 0; i < placed.size(); i++) {
        if (std::find(excluded.begin(), excluded.end(), i) != excluded.end()) continue;
        const std::vector<uint32_t>& indices = placed[i].mesh->indices;
        for (uint32_t t = 0; t < indices.size() / 3; t++) {
            const auto corner = [&](size_t k) { return placed[i].positions[indices[3 * size_t{t} + k]]; };
            triangles.push_back({{corner(0), corner(1), corner(2)}, {i, t}});
        }
    }
    return triangles;
}

std::vector<glm::dvec3> stratifiedPoints(const AreaLight& light, int n) {
    ETALON_CHECK(n >= 1, "{}", n);
    std::vector<glm::dvec3> points;
    for (int j = 0; j < n; j++)
        for (int i = 0; i < n; i++) {
            const double u = (2.0 * i + 1.0 - n) / n, v = (2.0 * j + 1.0 - n) / n;
            points.push_back(light.centre + (u * light.u + v * light.v));
        }
    return points;
}

VisibilityOracle::VisibilityOracle(std::vector<WorldTriangle> triangles, Search search)
    : triangles_(std::move(triangles)), search_(search) {
    for (const WorldTriangle& t : triangles_)
        for (const glm::dvec3& p : t.vertices)
            ETALON_CHECK(isExactPoint(p), "triangle {} of instance {}: {} {} {}", t.name.triangle,
                         t.name.instance, p.x, p.y, p.z);
    if (search == Search::allTriangles || triangles_.empty()) return;
    nodes_.emplace_back();
    build(0, 0, static_cast<uint32_t>(triangles_.size()));
}

void VisibilityOracle::build(uint32_t node, uint32_t first, uint32_t count) {
    const std::span<WorldTriangle> own(&triangles_[first], count);
    glm::dvec3 lowest = own[0].vertices[0], highest = lowest;
    for (const WorldTriangle& t : own)
        for (const glm::dvec3& p : t.vertices)
            for (int i = 0; i < 3; i++) {
                lowest[i] = std::min(lowest[i], p[i]);
                highest[i] = std::max(highest[i], p[i]);
            }
    Node& here = nodes_[node];
    int longest = 0;
    for (int i = 0; i < 3; i++) {
        here.centre[i] = 0.5 * lowest[i] + 0.5 * highest[i];
        here.halfSize[i] = std::max(highest[i] - here.centre[i], here.centre[i] - lowest[i]) * (1 + 0x1p-50);
        if (here.halfSize[i] > here.halfSize[longest]) longest = i;
    }
    if (count <= kTrianglesPerLeaf) {
        here.first = first;
        here.count = count;
        return;
    }
    const auto sum = [&](const WorldTriangle& t) {
        return t.vertices[0][longest] + (t.vertices[1][longest] + t.vertices[2][longest]);
    };
    const uint32_t half = count / 2;
    std::nth_element(own.begin(), own.begin() + half, own.end(),
                     [&](const WorldTriangle& s, const WorldTriangle& t) { return sum(s) < sum(t); });
    const auto child = static_cast<uint32_t>(nodes_.size());
    here.child = child;
    nodes_.resize(nodes_.size() + 2);
    build(child, first, half);
    build(child + 1, first + half, count - half);
}

// Calls visit() for each triangle in between, until it returns false.
template <class Visit>
void VisibilityOracle::visitBlockers(const glm::dvec3& point, const LightSource& light, TriangleName receiver,
                                     Visit visit) const {
    ETALON_CHECK(isExactPoint(point) && isExactPoint(light.place), "point {} {} {}, light {} {} {}", point.x,
                 point.y, point.z, light.place.x, light.place.y, light.place.z);
    const Ray ray(point, light);
    const auto isBlocker = [&](const WorldTriangle& t) { return t.name != receiver && blocks(t, ray); };
    if (search_ == Search::allTriangles) {
        for (const WorldTriangle& t : triangles_)
            if (isBlocker(t) && !visit()) return;
        return;
    }
    // Half of the triangles are in each child: the depth is below 32, and each level leaves one node behind.
    std::array<uint32_t, 40> waiting;
    size_t count = 0;
    if (!nodes_.empty()) waiting[count++] = 0;
    while (count > 0) {
        const Node& node = nodes_[waiting[--count]];
        if (!mayMeet(node.centre, node.halfSize, ray)) continue;
        for (uint32_t i = 0; i < node.count; i++)
            if (isBlocker(triangles_[node.first + i]) && !visit()) return;
        if (node.count > 0) continue;
        waiting[count++] = node.child;
        waiting[count++] = node.child + 1;
    }
}

bool VisibilityOracle::isVisible(const glm::dvec3& point, const LightSource& light,
                                 TriangleName receiver) const {
    bool visible = true;
    visitBlockers(point, light, receiver, [&] { return visible = false; });
    return visible;
}

size_t VisibilityOracle::blockers(const glm::dvec3& point, const LightSource& light,
                                  TriangleName receiver) const {
    size_t count = 0;
    visitBlockers(point, light, receiver, [&] {
        count++;
        return true;
    });
    return count;
}

double VisibilityOracle::visibleFraction(const glm::dvec3& point, std::span<const glm::dvec3> lightPoints,
                                         TriangleName receiver) const {
    ETALON_CHECK(!lightPoints.empty(), "no points");
    size_t visible = 0;
    for (const glm::dvec3& place : lightPoints) visible += isVisible(point, {place, false}, receiver) ? 1 : 0;
    return static_cast<double>(visible) / static_cast<double>(lightPoints.size());
}

OracleVisibility::OracleVisibility(const VisibilityOracle& oracle, const SurfaceScene& scene, double offset_m)
    : oracle_(&oracle), offset_m_(offset_m) {
    for (const SurfaceLight& light : scene.lights) lights_.push_back(lightSourceOf(light));
}

bool OracleVisibility::casts(size_t) const { return oracle_->size() > 0; }

void OracleVisibility::find(size_t light, const LitPoints& points, std::span<double> visibility) const {
    for (size_t i = 0; i < points.size(); i++) {
        glm::dvec3 p;
        for (int c = 0; c < 3; c++)
            p[c] = points.position_m[static_cast<size_t>(c)][i] +
                   offset_m_ * points.faceNormal[static_cast<size_t>(c)][i];
        visibility[i] = oracle_->isVisible(p, lights_[light]) ? 1 : 0;
    }
}

}  // namespace etalon
