#include "shadows/flat_mesh.h"

namespace etalon {

namespace {

// How far a vertex may be from a plane and lie in it.
double toleranceOf(const PlacedMesh& mesh) {
    constexpr double kDoubleError = 0x1p-48;  // of the largest coordinate: placing a vertex
    glm::dvec3 low(HUGE_VAL), high(-HUGE_VAL);
    for (size_t i = 0; i < mesh.mesh->positions.size(); i++) {
        const glm::dvec3 p = exactPosition(mesh, i);
        if (!isFinite(p)) continue;
        for (int c = 0; c < 3; c++) low[c] = std::min(low[c], p[c]), high[c] = std::max(high[c], p[c]);
    }
    if (!(low.x <= high.x)) return 0;
    return kFlatness * lengthOf(high - low) + kDoubleError * std::max(largestOf(low), largestOf(high));
}

}  // namespace

MeshPlane planeOf(const PlacedMesh& mesh) {
    MeshPlane plane;
    const size_t count = mesh.mesh->positions.size();
    if (count == 0) return plane;
    plane.tolerance_m = toleranceOf(mesh);
    const auto farthestOf = [&](auto&& measure) {
        glm::dvec3 best = exactPosition(mesh, 0);
        double most = -1;
        for (size_t i = 0; i < count; i++) {
            const glm::dvec3 p = exactPosition(mesh, i);
            const double value = measure(p);
            if (value > most) most = value, best = p;
        }
        return best;
    };
    const glm::dvec3 a = exactPosition(mesh, 0);
    const glm::dvec3 ab = farthestOf([&](const glm::dvec3& p) { return dotOf(p - a, p - a); }) - a;
    const auto across = [&](const glm::dvec3& p) { return crossOf(ab, p - a); };
    const glm::dvec3 normal =
        across(farthestOf([&](const glm::dvec3& p) { return dotOf(across(p), across(p)); }));
    const double length = lengthOf(normal);
    if (!(length > 0) || !std::isfinite(length)) return plane;
    plane.normal = scaledBy(normal, 1 / length);
    plane.offset = dotOf(plane.normal, a);
    for (size_t i = 0; i < count; i++)
        if (!(std::fabs(dotOf(plane.normal, exactPosition(mesh, i) - a)) <= plane.tolerance_m)) return plane;
    plane.exists = true;
    return plane;
}

}  // namespace etalon
