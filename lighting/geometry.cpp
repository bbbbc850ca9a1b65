#include "lighting/geometry.h"

#include <algorithm>

#include "lighting/transform.h"
#include "numeric/check.h"
#include "numeric/door.h"
#include "numeric/parallel.h"
#include "numeric/transform.h"

namespace etalon {
namespace {

constexpr size_t kVerticesPerTask = 16384;

// Calls body(begin, count) for the parts of [0, count).
template <class F>
void inTasks(size_t count, int threads, F&& body) {
    parallelFor((count + kVerticesPerTask - 1) / kVerticesPerTask, threads, [&](size_t task) {
        const size_t begin = task * kVerticesPerTask;
        body(begin, std::min(kVerticesPerTask, count - begin));
    });
}

void placeAll(RasterReal real, int threads, const TransformRows& rows, const std::vector<glm::vec3>& from,
              std::vector<glm::dvec3>& to) {
    to.resize(from.size());
    const auto transform = levelPasses<TransformPasses>().transformPoints;
    inTasks(from.size(), threads, [&](size_t begin, size_t count) {
        transform(real, rows, std::span(from).subspan(begin, count), std::span(to).subspan(begin, count));
    });
}

}  // namespace

std::vector<PlacedMesh> placeMeshes(const SurfaceScene& scene, RasterReal vertexReal, int threads) {
    std::vector<PlacedMesh> placed(scene.instances.size());
    for (size_t i = 0; i < placed.size(); i++) {
        const SurfaceInstance& instance = scene.instances[i];
        ETALON_CHECK(instance.mesh < scene.meshes.size() && instance.material < scene.materials.size(),
                     "instance {}: mesh {}, material {}", i, instance.mesh, instance.material);
        const SurfaceMesh& mesh = scene.meshes[instance.mesh];
        ETALON_CHECK(mesh.normals.size() == mesh.positions.size() &&
                         (mesh.uv_m.empty() || mesh.uv_m.size() == mesh.positions.size()),
                     "mesh {}: {} positions, {} normals, {} uv", instance.mesh, mesh.positions.size(),
                     mesh.normals.size(), mesh.uv_m.size());
        PlacedMesh& result = placed[i];
        result.mesh = &mesh;
        result.mirrored = determinant3(instance.toWorld) < 0;
        result.toWorld = instance.toWorld;
        result.arithmetic = vertexReal;
        const glm::dmat4& m = instance.toWorld;
        const glm::dmat3& n = instance.normalToWorld;
        TransformRows rows, normalRows;
        for (int r = 0; r < 4; r++)
            rows[static_cast<size_t>(r)] = glm::dvec4(m[0][r], m[1][r], m[2][r], m[3][r]);
        for (int r = 0; r < 3; r++)
            normalRows[static_cast<size_t>(r)] = glm::dvec4(n[0][r], n[1][r], n[2][r], 0);
        normalRows[3] = glm::dvec4(0, 0, 0, 1);
        placeAll(vertexReal, threads, rows, mesh.positions, result.positions);
        placeAll(vertexReal, threads, normalRows, mesh.normals, result.normals);
    }
    return placed;
}

void toClipSpace(const PlacedMesh& placed, const View& view, RasterReal vertexReal, int threads,
                 UninitializedVector<ClipVertex>& vertices) {
    vertices.resize(placed.positions.size());
    const auto project = levelPasses<TransformPasses>().projectPoints;
    inTasks(vertices.size(), threads, [&](size_t begin, size_t count) {
        project(vertexReal, view.worldToClip, std::span(placed.positions).subspan(begin, count),
                std::span(vertices).subspan(begin, count));
    });
}

}  // namespace etalon
