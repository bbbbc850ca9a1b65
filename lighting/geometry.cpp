#include "lighting/geometry.h"

#include <algorithm>

#include "numeric/check.h"
#include "numeric/kernel_types.h"
#include "numeric/parallel.h"

namespace etalon {
namespace {

template <class T>
struct VertexKernels {
#include "numeric/kernel_scope.inc"
#include "raster/kernels/transform.glsl"
};

constexpr size_t kVerticesPerTask = 16384;

using Rows = std::array<glm::dvec4, 4>;

// Calls write(i, x, y, z, w) with the rows applied to the point (get(i), 1) for each i in [0, count).
template <class S, class Get, class Write>
void transformRange(const Rows& rows, size_t begin, size_t end, Get get, Write write) {
    using T = Lanes<S, kNativeLanes<S>>;
    using Kernels = VertexKernels<T>;
    using vec4 = typename Kernels::vec4;
    Kernels kernels;
    const auto toLanes = [](const glm::dvec4& row) { return vec4(T(row.x), T(row.y), T(row.z), T(row.w)); };
    const vec4 row0 = toLanes(rows[0]), row1 = toLanes(rows[1]), row2 = toLanes(rows[2]),
               row3 = toLanes(rows[3]);
    forEachLaneGroup<T::size>(end - begin, [&](size_t first, int active) {
        const auto item = [&](int lane) {
            return begin + first + static_cast<size_t>(std::min(lane, active - 1));
        };
        const typename Kernels::vec3 p(T::generate([&](int i) { return get(item(i)).x; }),
                                       T::generate([&](int i) { return get(item(i)).y; }),
                                       T::generate([&](int i) { return get(item(i)).z; }));
        const vec4 q = kernels.transformPoint(row0, row1, row2, row3, p);
        for (int i = 0; i < active; i++)
            write(item(i), static_cast<double>(q.x[i]), static_cast<double>(q.y[i]),
                  static_cast<double>(q.z[i]), static_cast<double>(q.w[i]));
    });
}

template <class Get, class Write>
void transformAll(RasterReal real, int threads, const Rows& rows, size_t count, Get get, Write write) {
    const size_t tasks = (count + kVerticesPerTask - 1) / kVerticesPerTask;
    parallelFor(tasks, threads, [&](size_t task) {
        const size_t begin = task * kVerticesPerTask, end = std::min(begin + kVerticesPerTask, count);
        if (real == RasterReal::fp32)
            transformRange<float>(rows, begin, end, get, write);
        else
            transformRange<double>(rows, begin, end, get, write);
    });
}

double determinant(const glm::dmat4& m) {
    return m[0][0] * (m[1][1] * m[2][2] - m[2][1] * m[1][2]) -
           m[1][0] * (m[0][1] * m[2][2] - m[2][1] * m[0][2]) +
           m[2][0] * (m[0][1] * m[1][2] - m[1][1] * m[0][2]);
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
        result.mirrored = determinant(instance.toWorld) < 0;
        result.positions.resize(mesh.positions.size());
        result.normals.resize(mesh.normals.size());
        const glm::dmat4& m = instance.toWorld;
        const glm::dmat3& n = instance.normalToWorld;
        Rows rows, normalRows;
        for (int r = 0; r < 4; r++)
            rows[static_cast<size_t>(r)] = glm::dvec4(m[0][r], m[1][r], m[2][r], m[3][r]);
        for (int r = 0; r < 3; r++)
            normalRows[static_cast<size_t>(r)] = glm::dvec4(n[0][r], n[1][r], n[2][r], 0);
        normalRows[3] = glm::dvec4(0, 0, 0, 1);
        transformAll(
            vertexReal, threads, rows, mesh.positions.size(), [&](size_t v) { return mesh.positions[v]; },
            [&](size_t v, double x, double y, double z, double) {
                result.positions[v] = {x, y, z};
            });
        transformAll(
            vertexReal, threads, normalRows, mesh.normals.size(), [&](size_t v) { return mesh.normals[v]; },
            [&](size_t v, double x, double y, double z, double) {
                result.normals[v] = {x, y, z};
            });
    }
    return placed;
}

std::vector<ClipVertex> toClipSpace(const PlacedMesh& placed, const View& view, RasterReal vertexReal,
                                    int threads) {
    std::vector<ClipVertex> vertices(placed.positions.size());
    transformAll(
        vertexReal, threads, view.worldToClip, vertices.size(), [&](size_t v) { return placed.positions[v]; },
        [&](size_t v, double x, double y, double z, double w) {
            vertices[v] = {x, y, z, w};
        });
    return vertices;
}

}  // namespace etalon
