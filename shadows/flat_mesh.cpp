#include "shadows/flat_mesh.h"

namespace etalon {

MeshPlane planeOf(const PlacedMesh& mesh) {
    MeshPlane plane;
    if (mesh.positions.empty()) return plane;
    const auto farthestOf = [&](auto&& measure) {
        size_t best = 0;
        double most = -1;
        for (size_t i = 0; i < mesh.positions.size(); i++) {
            const double value = measure(mesh.positions[i]);
            if (value > most) most = value, best = i;
        }
        return mesh.positions[best];
    };
    const glm::dvec3 a = mesh.positions.front();
    const glm::dvec3 ab = farthestOf([&](const glm::dvec3& p) { return dotOf(p - a, p - a); }) - a;
    const auto across = [&](const glm::dvec3& p) { return crossOf(ab, p - a); };
    glm::dvec3 normal = across(farthestOf([&](const glm::dvec3& p) { return dotOf(across(p), across(p)); }));
    const double length = std::sqrt(dotOf(normal, normal));
    if (!(length > 0) || !std::isfinite(length)) return plane;
    normal = scaledBy(normal, 1 / length);
    double largest = 0;
    for (const glm::dvec3& p : mesh.positions) largest = std::max(largest, largestOf(p));
    plane = {true, normal, dotOf(normal, a), largest * kFlatness};
    for (const glm::dvec3& p : mesh.positions)
        if (!(std::fabs(plane.above(p)) <= plane.tolerance_m)) return {};
    return plane;
}

}  // namespace etalon
