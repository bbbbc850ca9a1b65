#include "lighting/cube_faces.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "numeric/check.h"
#include "numeric/parallel.h"
#include "numeric/vectors.h"

namespace etalon {
namespace {

constexpr size_t kItemsPerTask = 8192;
constexpr int kPlanesOfFace = 4;
constexpr uint32_t kFaceMask = (1u << kPlanesOfFace) - 1;
constexpr double kOutwards = 1.0 + 1.0 / 64;
constexpr double kArithmeticError = 0x1p-20;

// Bit 4 f + k: the point, relative to the centre, is outside plane k of face f by more than the error.
uint32_t outsidePlanes(const glm::dvec3& d, double error) {
    uint32_t bits = 0;
    int bit = 0;
    for (int axis = 0; axis < 3; axis++) {
        const double u = d[(axis + 1) % 3], v = d[(axis + 2) % 3];
        for (const double along : {d[axis], -d[axis]}) {
            const double bound = along * kOutwards + error;
            for (const double across : {u, -u, v, -v}) bits |= (across > bound ? 1u : 0u) << bit++;
        }
    }
    return bits;
}

// Squares of the distances from the origin to a segment and a triangle.
double squaredDistanceTo(const glm::dvec3& a, const glm::dvec3& b) {
    const glm::dvec3 along = b - a;
    const double length = dotOf(along, along);
    const double t = length > 0 ? std::clamp(-dotOf(a, along) / length, 0.0, 1.0) : 0;
    const glm::dvec3 p = a + scaledBy(along, t);
    return dotOf(p, p);
}
double squaredDistanceTo(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    const double toEdges =
        std::min({squaredDistanceTo(a, b), squaredDistanceTo(b, c), squaredDistanceTo(c, a)});
    const glm::dvec3 normal = crossOf(b - a, c - a);
    const double square = dotOf(normal, normal);
    const auto isInside = [&](const glm::dvec3& p, const glm::dvec3& q) {
        return dotOf(crossOf(p, q), normal) >= 0;
    };
    if (!(square > 0 && isInside(a, b) && isInside(b, c) && isInside(c, a))) return toEdges;
    const double height = dotOf(normal, a);
    return std::min(toEdges, height * height / square);
}

}  // namespace

CubeDepths cubeDepthsOf(const std::vector<PlacedMesh>& placed, const glm::dvec3& centre, uint32_t excluded,
                        int threads) {
    constexpr double kBehind = 1 + 0x1p-10, kSqrt3 = 0x1.bb67ae8584caap+0;
    double nearest = HUGE_VAL, farthest = 0;
    for (uint32_t i = 0; i < placed.size(); i++) {
        if (i == excluded) continue;
        const PlacedMesh& mesh = placed[i];
        const std::vector<uint32_t>& indices = mesh.mesh->indices;
        const size_t triangles = indices.size() / 3;
        std::vector<std::pair<double, double>> parts((triangles + kItemsPerTask - 1) / kItemsPerTask,
                                                     {HUGE_VAL, 0.0});
        parallelFor(parts.size(), threads, [&](size_t task) {
            auto& [low, high] = parts[task];
            const size_t last = std::min((task + 1) * kItemsPerTask, triangles);
            for (size_t t = task * kItemsPerTask; t < last; t++) {
                const auto corner = [&](size_t k) { return mesh.positions[indices[3 * t + k]] - centre; };
                const glm::dvec3 a = corner(0), b = corner(1), c = corner(2);
                if (!(isFinite(a) && isFinite(b) && isFinite(c))) continue;
                low = std::min(low, squaredDistanceTo(a, b, c));
                high = std::max({high, dotOf(a, a), dotOf(b, b), dotOf(c, c)});
            }
        });
        for (const auto& [low, high] : parts)
            nearest = std::min(nearest, low), farthest = std::max(farthest, high);
    }
    if (!(farthest > 0)) return {};
    const double far_m = std::sqrt(farthest) * kBehind;
    return {std::max(std::sqrt(nearest) / (2 * kSqrt3), far_m * kCubeNearRatio), far_m};
}

std::array<std::vector<uint32_t>, kCubeFaces> trianglesOfFaces(const PlacedMesh& mesh,
                                                               const glm::dvec3& centre, int threads) {
    // Codes of the vertices.
    double largest = std::max({std::fabs(centre.x), std::fabs(centre.y), std::fabs(centre.z)});
    for (const glm::dvec3& p : mesh.positions)
        largest = std::max({largest, std::fabs(p.x), std::fabs(p.y), std::fabs(p.z)});
    const double error = largest * kArithmeticError;
    std::vector<uint32_t> codes(mesh.positions.size());
    const auto tasks = [](size_t count) { return (count + kItemsPerTask - 1) / kItemsPerTask; };
    parallelFor(tasks(codes.size()), threads, [&](size_t task) {
        const size_t last = std::min((task + 1) * kItemsPerTask, codes.size());
        for (size_t i = task * kItemsPerTask; i < last; i++)
            codes[i] = outsidePlanes(mesh.positions[i] - centre, error);
    });

    // Lists of each task, then of all.
    using Lists = std::array<std::vector<uint32_t>, kCubeFaces>;
    const std::vector<uint32_t>& indices = mesh.mesh->indices;
    const size_t triangles = indices.size() / 3;
    std::vector<Lists> parts(tasks(triangles));
    const auto codeOf = [&](size_t i) {
        ETALON_CHECK(indices[i] < codes.size(), "index {} is {}, vertices: {}", i, indices[i], codes.size());
        return codes[indices[i]];
    };
    parallelFor(parts.size(), threads, [&](size_t task) {
        const size_t last = std::min((task + 1) * kItemsPerTask, triangles);
        for (size_t t = task * kItemsPerTask; t < last; t++) {
            const uint32_t outside = codeOf(3 * t) & codeOf(3 * t + 1) & codeOf(3 * t + 2);
            for (size_t face = 0; face < kCubeFaces; face++)
                if ((outside >> (kPlanesOfFace * face) & kFaceMask) == 0)
                    parts[task][face].push_back(static_cast<uint32_t>(t));
        }
    });
    Lists lists;
    for (const Lists& part : parts)
        for (size_t face = 0; face < kCubeFaces; face++)
            lists[face].insert(lists[face].end(), part[face].begin(), part[face].end());
    return lists;
}

}  // namespace etalon
