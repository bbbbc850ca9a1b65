#include "shadows/planar_casters.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "numeric/check.h"

namespace etalon {
namespace {

bool isUsable(const glm::dvec3& p) {
    constexpr double kLargest = 0x1p100;
    return std::abs(p.x) < kLargest && std::abs(p.y) < kLargest && std::abs(p.z) < kLargest;
}

}  // namespace

double PlanarCasters::highest() const {
    double height = 0;
    for (const uint32_t i : indices) height = std::max(height, vertices[i].z);
    return height;
}

PlanarCasters clipAtHeight(const PlanarCasters& casters, double height_m, KeepSide keep) {
    PlanarCasters result;
    result.vertices = casters.vertices;
    const auto distance = [&](const glm::dvec3& p) {
        return keep == KeepSide::above ? p.z - height_m : height_m - p.z;
    };
    for (size_t first = 0; first + 2 < casters.indices.size(); first += 3) {
        const uint32_t* corner = &casters.indices[first];
        std::array<double, 3> d{};
        for (size_t i = 0; i < 3; i++) d[i] = distance(casters.vertices[corner[i]]);
        const auto [lowest, farthest] = std::minmax({d[0], d[1], d[2]});
        if (!(farthest > 0)) continue;
        if (lowest >= 0) {
            result.indices.insert(result.indices.end(), corner, corner + 3);
            continue;
        }
        // The polygon of three or four vertices, as a fan.
        std::array<uint32_t, 4> polygon{};
        size_t count = 0;
        for (size_t i = 0; i < 3; i++) {
            const size_t next = (i + 1) % 3;
            if (d[i] >= 0) polygon[count++] = corner[i];
            if ((d[i] >= 0) == (d[next] >= 0)) continue;
            const size_t inside = d[i] >= 0 ? i : next, outside = d[i] >= 0 ? next : i;
            const glm::dvec3 &a = casters.vertices[corner[inside]], &b = casters.vertices[corner[outside]];
            const double t = d[inside] / (d[inside] - d[outside]);
            polygon[count++] = static_cast<uint32_t>(result.vertices.size());
            result.vertices.emplace_back(a.x + t * (b.x - a.x), a.y + t * (b.y - a.y), height_m);
        }
        for (size_t k = 2; k < count; k++)
            for (const uint32_t v : {polygon[0], polygon[k - 1], polygon[k]}) result.indices.push_back(v);
    }
    return result;
}

PlanarCasters castersAbove(const PlaneFrame& frame, std::span<const PlacedMesh* const> meshes,
                           double contact_m) {
    ETALON_CHECK(contact_m >= 0, "contact_m = {}", contact_m);
    PlanarCasters casters;
    for (const PlacedMesh* mesh : meshes) {
        const auto firstVertex = static_cast<uint32_t>(casters.vertices.size());
        for (const glm::dvec3& position : mesh->positions) {
            glm::dvec3 p = frame.toFrame(position);
            if (std::abs(p.z) <= contact_m) p.z = 0;
            casters.vertices.push_back(p);
        }
        const std::vector<uint32_t>& indices = mesh->mesh->indices;
        for (size_t first = 0; first + 2 < indices.size(); first += 3) {
            const std::array<uint32_t, 3> corner = {firstVertex + indices[first],
                                                    firstVertex + indices[first + 1],
                                                    firstVertex + indices[first + 2]};
            if (std::all_of(corner.begin(), corner.end(),
                            [&](uint32_t v) { return isUsable(casters.vertices[v]); }))
                casters.indices.insert(casters.indices.end(), corner.begin(), corner.end());
        }
    }
    return clipAtHeight(casters, 0, KeepSide::above);
}

}  // namespace etalon
