#include "shadows/planar_receiver.h"

#include <algorithm>
#include <cmath>

#include "shadows/flat_mesh.h"

namespace etalon {
namespace {

glm::dvec2 extreme(const std::vector<glm::dvec2>& corners, const std::vector<uint32_t>& indices,
                   bool highest) {
    if (indices.empty()) return glm::dvec2(0);
    glm::dvec2 result = corners[indices[0]];
    for (const uint32_t i : indices)
        for (int c = 0; c < 2; c++)
            result[c] = highest ? std::max(result[c], corners[i][c]) : std::min(result[c], corners[i][c]);
    return result;
}

}  // namespace

glm::dvec2 PlanarReceiver::lowest_m() const { return extreme(corners_m, indices, false); }
glm::dvec2 PlanarReceiver::highest_m() const { return extreme(corners_m, indices, true); }

// s stays, t and the normal turn around.
PlanarReceiver PlanarReceiver::reversed() const {
    PlanarReceiver result = *this;
    for (int c = 0; c < 3; c++) {
        result.frame.normal[c] = -frame.normal[c];
        result.frame.t[c] = -frame.t[c];
    }
    for (glm::dvec2& corner : result.corners_m) corner.y = -corner.y;
    return result;
}

std::optional<PlanarReceiver> planarReceiverOf(const PlacedMesh& mesh) {
    const std::vector<uint32_t>& indices = mesh.mesh->indices;
    double largestSquare = 0;
    glm::dvec3 normal(0), origin(0);
    for (size_t first = 0; first + 2 < indices.size(); first += 3) {
        const glm::dvec3 &a = mesh.positions[indices[first]], &b = mesh.positions[indices[first + 1]],
                         &c = mesh.positions[indices[first + 2]];
        const glm::dvec3 u(b.x - a.x, b.y - a.y, b.z - a.z), v(c.x - a.x, c.y - a.y, c.z - a.z);
        const glm::dvec3 n(u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z, u.x * v.y - u.y * v.x);
        const double square = n.x * n.x + (n.y * n.y + n.z * n.z);
        if (!std::isfinite(square)) return std::nullopt;
        if (square > largestSquare) largestSquare = square, normal = n, origin = a;
    }
    if (largestSquare == 0) return std::nullopt;
    if (mesh.mirrored) normal = {-normal.x, -normal.y, -normal.z};
    PlanarReceiver receiver;
    receiver.frame = planeFrame(origin, normal);
    receiver.indices = indices;
    for (const glm::dvec3& position : mesh.positions) {
        const glm::dvec3 p = receiver.frame.toFrame(position);
        receiver.corners_m.emplace_back(p.x, p.y);
    }
    if (!planeOf(mesh).exists) return std::nullopt;
    return receiver;
}

}  // namespace etalon
