#include "lighting/cube_faces.h"

#include <doctest/doctest.h>

#include <cmath>

#include "lighting/render_view.h"
#include "numeric/random.h"
#include "raster/rasterizer.h"
#include "tests/support/box_scene.h"

using namespace etalon;
using namespace etalon::test;

namespace {

// Triangles of every size around a centre, some of them through it or through edges and corners of its faces.
SurfaceMesh soup(Random& random, const glm::dvec3& centre, int count) {
    SurfaceMesh mesh;
    const auto coordinate = [&] { return random.integer(-1000, 1000) / 1000.0; };
    for (int t = 0; t < count; t++) {
        glm::dvec3 around(coordinate(), coordinate(), coordinate());
        if (t % 4 == 1) around.y = around.x;                        // near the edge between +X and +Y
        if (t % 4 == 2) around.y = around.x, around.z = -around.x;  // near a corner
        const double size = t % 3 == 0 ? 0.001 : t % 3 == 1 ? 0.1 : 3.0;
        for (int k = 0; k < 3; k++) {
            const glm::dvec3 p =
                centre + around + size * glm::dvec3(coordinate(), coordinate(), coordinate());
            mesh.indices.push_back(static_cast<uint32_t>(mesh.positions.size()));
            mesh.positions.emplace_back(p);
            mesh.normals.emplace_back(0, 1, 0);
        }
    }
    return mesh;
}

}  // namespace

TEST_CASE("TrianglesLeftOutOfAFaceCoverNoSampleOfIt") {
    Random random(77);
    for (const RasterReal real : {RasterReal::fp32, RasterReal::fp64})
        for (const glm::dvec3& centre : {glm::dvec3(0), glm::dvec3(100, -3, 0.5)}) {
            SurfaceScene scene;
            scene.meshes.push_back(soup(random, centre, 3000));
            scene.materials.resize(1);
            scene.instances.resize(1);
            const std::vector<PlacedMesh> placed = placeMeshes(scene, real, 1);
            const auto lists = trianglesOfFaces(placed[0], centre, 2);
            CHECK(lists == trianglesOfFaces(placed[0], centre, 1));
            size_t listed = 0;
            for (size_t face = 0; face < kCubeFaces; face++) {
                listed += lists[face].size();
                for (int size : {1, 7, 64}) {
                    const View view = cubeFaceView(static_cast<CubeFace>(face), size, centre, 0.001, 100);
                    UninitializedVector<ClipVertex> vertices;
                    toClipSpace(placed[0], view, real, 1, vertices);
                    Draw draw{vertices, scene.meshes[0].indices, {}};
                    draw.state.cull = CullMode::none;
                    RenderTargetFormat format;
                    format.real = real;
                    RenderTarget all(size, size, format), some(size, size, format);
                    rasterize(all, {0, 0, size, size}, {&draw, 1});
                    draw.only = lists[face];
                    rasterize(some, {0, 0, size, size}, {&draw, 1});
                    CHECK(all.depth == some.depth);
                    int wrong = 0;
                    for (size_t i = 0; i < all.id.pixelCount(); i++) {
                        const uint32_t a = all.id.values()[i], b = some.id.values()[i];
                        const bool same = a == kNoTriangle || b == kNoTriangle
                                              ? a == b
                                              : all.triangle(a).triangle == some.triangle(b).triangle;
                        wrong += same ? 0 : 1;
                    }
                    CHECK(wrong == 0);
                }
            }
            // A small triangle is in one or two of the six lists.
            CHECK(listed < 3 * 3000);
            CHECK(listed > 3000);
        }
}

TEST_CASE("ATriangleWithAVertexThatIsNotFiniteIsInEveryList") {
    SurfaceMesh mesh;
    mesh.positions = {{1, 0, 0}, {1, std::numeric_limits<float>::quiet_NaN(), 0}, {1, 0, 0.1f}};
    mesh.indices = {0, 1, 2};
    PlacedMesh placed;
    placed.mesh = &mesh;
    for (const glm::vec3& p : mesh.positions) placed.positions.emplace_back(p);
    placed.positions[1].x = placed.positions[1].z = placed.positions[1].y;
    for (const auto& list : trianglesOfFaces(placed, glm::dvec3(0), 1)) CHECK(list.size() == 1);
}

TEST_CASE("CubeDepthsHoldWhatIsSeen") {
    SurfaceScene scene;
    // A floor 2 m below, a wall 3 m away whose edges are nearer than its vertices.
    addObject(scene, rectangle({0, -2, 0}, {10, 0, 0}, {0, 0, -10}), lambertian(0.5));
    addObject(scene, rectangle({3, 0, 0}, {0, 0, 1}, {0, 1, 0}), lambertian(0.5));
    const std::vector<PlacedMesh> placed = placeMeshes(scene, RasterReal::fp64, 1);
    const CubeDepths both = cubeDepthsOf(placed, glm::dvec3(0), kNoInstance, 1);
    CHECK(both.near_m == doctest::Approx(2 / (2 * std::sqrt(3.0))).epsilon(1e-12));
    CHECK(both.far_m == doctest::Approx(std::sqrt(204.0)).epsilon(2e-3));
    CHECK(both.far_m > std::sqrt(204.0));
    const CubeDepths wall = cubeDepthsOf(placed, glm::dvec3(0), 0, 1);
    CHECK(wall.near_m == doctest::Approx(3 / (2 * std::sqrt(3.0))).epsilon(1e-12));
    // Beside the wall the nearest point is on its edge, beside an edge's end it is a corner.
    CHECK(cubeDepthsOf(placed, {3, 0, 2}, 0, 1).near_m ==
          doctest::Approx(1 / (2 * std::sqrt(3.0))).epsilon(1e-6));
    CHECK(cubeDepthsOf(placed, {3, 4, 5}, 0, 1).near_m ==
          doctest::Approx(5 / (2 * std::sqrt(3.0))).epsilon(1e-6));
    // In the wall itself.
    const CubeDepths inside = cubeDepthsOf(placed, {3, 0, 0}, 0, 1);
    CHECK(inside.near_m == inside.far_m * kCubeNearRatio);
    CHECK(cubeDepthsOf({}, glm::dvec3(0), kNoInstance, 1).far_m == 2);
}
