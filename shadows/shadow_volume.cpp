#include "shadows/shadow_volume.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "numeric/check.h"
#include "numeric/elementary.h"
#include "numeric/parallel.h"
#include "numeric/vectors.h"
#include "shadows/exact_side.h"

namespace etalon {
namespace {

constexpr size_t kTrianglesPerTask = 4096;

// Some triangles of a mesh.
struct Part {
    std::span<const glm::dvec3> positions;
    std::span<const uint32_t> indices, triangles;

    // Calls visit(a, b, c) for each.
    template <class Visit>
    void forEachTriangle(Visit visit) const {
        for (const uint32_t t : triangles)
            visit(positions[indices[3 * size_t{t}]], positions[indices[3 * size_t{t} + 1]],
                  positions[indices[3 * size_t{t} + 2]]);
    }
};

bool isInBox(const Part& part, const glm::dvec3& point) {
    glm::dvec3 lowest(HUGE_VAL), highest(-HUGE_VAL);
    part.forEachTriangle([&](const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
        for (int i = 0; i < 3; i++) {
            lowest[i] = std::min({lowest[i], a[i], b[i], c[i]});
            highest[i] = std::max({highest[i], a[i], b[i], c[i]});
        }
    });
    for (int i = 0; i < 3; i++)
        if (point[i] < lowest[i] || point[i] > highest[i]) return false;
    return true;
}

// For each triangle: 1 if the light sees it counter-clockwise, -1 if clockwise, 0 if edge-on or left out.
std::vector<int8_t> facingOf(std::span<const glm::dvec3> positions, std::span<const uint32_t> indices,
                             const MeshTopology& topology, const LightSource& light, int threads) {
    const size_t count = indices.size() / 3;
    std::vector<int8_t> facing(count, 0);
    parallelFor((count + kTrianglesPerTask - 1) / kTrianglesPerTask, threads, [&](size_t task) {
        const size_t end = std::min(count, (task + 1) * kTrianglesPerTask);
        for (size_t t = task * kTrianglesPerTask; t < end; t++) {
            if (!topology.isUsed[t]) continue;
            const glm::dvec3 &a = positions[indices[3 * t]], &b = positions[indices[3 * t + 1]],
                             &c = positions[indices[3 * t + 2]];
            facing[t] = static_cast<int8_t>(light.atInfinity ? sideOfTriangleTowards(a, b, c, light.place)
                                                             : sideOfTriangle(a, b, c, light.place));
        }
    });
    return facing;
}

// The side behind the edge a -> b of a cap.
void addSide(ShadowVolume& volume, uint32_t a, uint32_t b, uint32_t vertices, bool atInfinity) {
    if (atInfinity)
        volume.sides.insert(volume.sides.end(), {b, a, vertices});
    else
        volume.sides.insert(volume.sides.end(), {b, a, vertices + a, b, vertices + a, vertices + b});
}

}  // namespace

double signedVolume(std::span<const glm::dvec3> positions, std::span<const uint32_t> indices,
                    std::span<const uint32_t> triangles) {
    double sum = 0;
    const glm::dvec3 origin =
        triangles.empty() ? glm::dvec3(0) : positions[indices[3 * size_t{triangles[0]}]];
    Part{positions, indices, triangles}.forEachTriangle(
        [&](const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
            sum = sum + dotOf(a - origin, crossOf(b - origin, c - origin));
        });
    return sum / 6;
}

bool mayBeInside(std::span<const glm::dvec3> positions, std::span<const uint32_t> indices,
                 std::span<const uint32_t> triangles, const glm::dvec3& point) {
    const Part part{positions, indices, triangles};
    if (!isInBox(part, point)) return false;
    // Solid angles by [Oosterom83]; a closed surface turns a whole number of times around a point.
    double turned_rad = 0;
    part.forEachTriangle([&](const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
        const glm::dvec3 u = a - point, v = b - point, w = c - point;
        const double lu = std::sqrt(dotOf(u, u)), lv = std::sqrt(dotOf(v, v)), lw = std::sqrt(dotOf(w, w));
        const double divisor = lu * lv * lw + (dotOf(u, v) * lw + (dotOf(v, w) * lu + dotOf(w, u) * lv));
        turned_rad = turned_rad + 2 * atan2Of(dotOf(u, crossOf(v, w)), divisor);
    });
    constexpr double kQuarterOfASphere = 3.14;
    return !(std::fabs(turned_rad) < kQuarterOfASphere);
}

ShadowVolume shadowVolumeOf(std::span<const glm::dvec3> positions, std::span<const uint32_t> indices,
                            const MeshTopology& topology, const LightSource& light, int threads) {
    ETALON_CHECK(isExactPoint(light.place), "light {} {} {}", light.place.x, light.place.y, light.place.z);
    std::vector<int8_t> facing = facingOf(positions, indices, topology, light, threads);

    ShadowVolume volume;
    for (size_t p = 0; p < topology.partCount(); p++) {
        const std::span<const uint32_t> part = topology.trianglesOf(p);
        if (!topology.isClosed[p]) continue;
        if (!light.atInfinity && mayBeInside(positions, indices, part, light.place)) continue;
        volume.closedParts++;
        const int8_t front = signedVolume(positions, indices, part) >= 0 ? 1 : -1;
        for (const uint32_t t : part)
            if (facing[t] != front) facing[t] = 0;
    }

    for (uint32_t t = 0; t < facing.size(); t++) {
        if (facing[t] > 0) volume.facing.push_back(t);
        if (facing[t] < 0) volume.away.push_back(t);
    }
    const auto vertices = static_cast<uint32_t>(positions.size());
    for (const MeshEdge& edge : topology.edges) {
        int count = 0;
        for (uint32_t i = 0; i < edge.useCount; i++) {
            const EdgeUse& use = topology.uses[edge.firstUse + i];
            count += use.direction * facing[use.triangle];
        }
        volume.silhouetteEdges += count != 0 ? 1 : 0;
        for (int i = 0; i < std::abs(count); i++)
            addSide(volume, count > 0 ? edge.from : edge.to, count > 0 ? edge.to : edge.from, vertices,
                    light.atInfinity);
    }
    return volume;
}

}  // namespace etalon
