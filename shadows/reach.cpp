#include "shadows/reach.h"

#include <algorithm>
#include <cmath>

#include "numeric/vectors.h"
#include "shadows/flat_mesh.h"

namespace etalon {
namespace {

constexpr double kRoundings = 64;

// Whether the normals of a triangle's corners, at any of its points, may turn to the light.
bool isReached(const PlacedMesh& placed, const uint32_t* corners, const SurfaceLight& light,
               double rounding) {
    for (int i = 0; i < 3; i++) {
        const glm::dvec3& n = placed.normals[corners[i]];
        const double part = rounding * lengthOf(n);
        if (light.kind == LightKind::directional) {
            if (!(dotOf(n, light.toLight) < -part * lengthOf(light.toLight))) return true;
            continue;
        }
        for (int k = 0; k < 3; k++) {
            const glm::dvec3& p = placed.positions[corners[k]];
            const double extent = largestOf(p) + largestOf(light.position_m);
            if (!(dotOf(n, light.position_m - p) < -part * extent)) return true;
        }
    }
    return false;
}

struct Bounds {
    glm::dvec3 low{HUGE_VAL}, high{-HUGE_VAL};
    double largest = 0;

    explicit Bounds(std::span<const PlacedMesh> placed) {
        for (const PlacedMesh& mesh : placed)
            for (const glm::dvec3& p : mesh.positions) {
                if (!isFinite(p)) continue;
                for (int k = 0; k < 3; k++)
                    low[k] = std::min(low[k], p[k]), high[k] = std::max(high[k], p[k]);
                largest = std::max(largest, largestOf(p));
            }
    }
    double radius() const { return low.x <= high.x ? lengthOf(high - low) / 2 : 0; }
};

}  // namespace

int significandBitsOf(const Arithmetic& arithmetic) {
    constexpr int kDoubleBits = 53;
    switch (arithmetic.type()) {
        case NumberType::fp32:
            return kFp32.significandBits;
        case NumberType::narrow:
        case NumberType::emulated:
            return arithmetic.format->significandBits;
        case NumberType::fp64:
        case NumberType::truth:
            break;
    }
    return kDoubleBits;
}

bool lightReaches(const PlacedMesh& placed, bool twoSided, const SurfaceLight& light, int significandBits) {
    if (twoSided) return true;
    const double rounding = std::ldexp(kRoundings, -significandBits);
    const std::vector<uint32_t>& indices = placed.mesh->indices;
    for (size_t first = 0; first + 2 < indices.size(); first += 3)
        if (isReached(placed, &indices[first], light, rounding)) return true;
    return false;
}

bool isAllOpen(std::span<const PlacedMesh> placed, std::span<const SurfaceInstance> instances,
               const std::vector<bool>& marked, int mapSize, int significandBits) {
    // A point is looked up 3/4 of a texel above its surface, at most sqrt(1/2) of one from the texel's centre: it
    // is covered only by what is more than 1/24 of a texel above the plane through it across its normal. That much
    // no vertex is: its distance from the mesh's plane and the point's are at most 1/128 each, and the normal leans
    // by at most 1/64 over the scene's diameter. What is left is for snapped vertices (1/360) and for roundings.
    constexpr double kPartOfTexel = 1.0 / 64;
    const Bounds bounds(placed);
    const double radius_m = bounds.radius();
    if (!(radius_m > 0)) return true;
    const double tolerance_m = 2 * radius_m / mapSize * kPartOfTexel;
    if (!(std::ldexp(kRoundings, -significandBits) * std::max(bounds.largest, 2 * radius_m) <
          2 * tolerance_m))
        return false;
    std::vector<MeshPlane> planes;
    for (const PlacedMesh& mesh : placed) {
        planes.push_back(planeOf(mesh));
        if (!(planes.back().tolerance_m + mesh.placingError_m(bounds.largest) <= tolerance_m / 2))
            return false;
    }
    const double tilt = tolerance_m / (2 * radius_m);
    for (size_t i = 0; i < placed.size(); i++) {
        if (!marked[i] || placed[i].mesh->indices.empty()) continue;
        const PlacedMesh& mesh = placed[i];
        const MeshPlane& plane = planes[i];
        if (!plane.exists) return false;
        const double side = dotOf(plane.normal, mesh.normals[mesh.mesh->indices[0]]) > 0 ? 1 : -1;
        for (const uint32_t v : mesh.mesh->indices) {
            const glm::dvec3 lean = unitOf(mesh.normals[v]) - side * plane.normal;
            if (!(lengthOf(lean) <= tilt)) return false;
        }
        for (size_t j = 0; j < placed.size(); j++) {
            const double allowed_m = std::max(plane.tolerance_m, planes[j].tolerance_m);
            for (size_t v = 0; v < placed[j].mesh->positions.size(); v++) {
                const double height_m = side * plane.above(exactPosition(placed[j], v));
                if (height_m > allowed_m || (instances[i].twoSided && height_m < -allowed_m)) return false;
            }
        }
    }
    return true;
}

}  // namespace etalon
