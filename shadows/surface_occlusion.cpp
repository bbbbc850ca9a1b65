#include "shadows/surface_occlusion.h"

namespace etalon {

TileOcclusion fragmentOcclusion(const ShadeJob& job, const DirectionalOptions& options) {
    std::vector<OcclusionPoint> points;
    TileOcclusion occlusion;
    for (const LitPoints& tile : fragmentPoints(job)) {
        occlusion.emplace_back(tile.size());
        const auto at = [](const auto& components, size_t i) {
            return glm::dvec3(components[0][i], components[1][i], components[2][i]);
        };
        for (size_t i = 0; i < tile.size(); i++)
            points.push_back({at(tile.position_m, i), at(tile.normal, i)});
    }
    const std::vector<Occlusion> found = directionalOcclusion(*job.placed, points, options);
    auto next = found.begin();
    for (std::vector<Occlusion>& tile : occlusion)
        for (Occlusion& of : tile) of = *next++;
    return occlusion;
}

std::vector<VertexOcclusion> vertexOcclusion(const ShadeJob& job, const DirectionalOptions& options) {
    // The front of each vertex, then the back, mesh by mesh.
    std::vector<OcclusionPoint> points;
    std::vector<VertexOcclusion> occlusion(job.placed->size());
    const std::vector<bool> visible = visibleInstances(job);
    for (size_t i = 0; i < occlusion.size(); i++) {
        if (!visible[i]) continue;
        const std::vector<OcclusionPoint> front = occlusionPointsOf((*job.placed)[i]);
        points.insert(points.end(), front.begin(), front.end());
        for (const OcclusionPoint& point : front) points.push_back({point.position_m, -point.normal});
        for (std::vector<Occlusion>& side : occlusion[i]) side.resize(front.size());
    }
    const std::vector<Occlusion> found = directionalOcclusion(*job.placed, points, options);
    auto next = found.begin();
    for (VertexOcclusion& sides : occlusion)
        for (std::vector<Occlusion>& side : sides)
            for (Occlusion& of : side) of = *next++;
    return occlusion;
}

}  // namespace etalon
