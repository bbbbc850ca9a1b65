#include "shadows/ambient_occlusion.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "bitcheck/inputs.h"
#include "tests/support/random_numbers.h"
#include "tests/support/shadow_meshes.h"

using namespace etalon;
using namespace etalon::test;

namespace {

constexpr double kPi = 3.14159265358979323846;

// Meshes where they are.
struct Placed {
    explicit Placed(std::vector<SurfaceMesh> list) : meshes(std::move(list)) {
        for (const SurfaceMesh& mesh : meshes) {
            PlacedMesh& p = placed.emplace_back();
            p.mesh = &mesh;
            for (const glm::vec3& v : mesh.positions) p.positions.emplace_back(v);
            for (const glm::vec3& v : mesh.normals) p.normals.emplace_back(v);
        }
    }
    std::vector<SurfaceMesh> meshes;
    std::vector<PlacedMesh> placed;
};

SurfaceMesh disc(double radius, float height, int corners) {
    SurfaceMesh mesh;
    mesh.positions.emplace_back(0, height, 0);
    for (int i = 0; i < corners; i++)
        mesh.positions.emplace_back(static_cast<float>(radius * std::cos(2 * kPi * i / corners)), height,
                                    static_cast<float>(radius * std::sin(2 * kPi * i / corners)));
    mesh.normals.resize(mesh.positions.size(), glm::vec3(0, -1, 0));
    for (int i = 0; i < corners; i++)
        for (const int k : {0, i + 1, (i + 1) % corners + 1})
            mesh.indices.push_back(static_cast<uint32_t>(k));
    return mesh;
}

SurfaceMesh ground() { return rectangle({0, 0, 0}, {0, 0, 20}, {20, 0, 0}); }

Occlusion hemicubeAt(const Placed& scene, const OcclusionPoint& point, int size = 128,
                     double maxDistance_m = HUGE_VAL) {
    HemicubeOptions options;
    options.size = size;
    options.maxDistance_m = maxDistance_m;
    options.threads = 1;
    return hemicubeOcclusion(scene.placed, std::span(&point, 1), options)[0];
}

const OcclusionPoint kOrigin = {{0, 0, 0}, {0, 1, 0}};

}  // namespace

TEST_CASE("HemicubeWeightsAreTheFormFactorsOfTheirTexels") {
    for (const int size : {2, 8, 64, 256}) {
        const HemicubeWeights weights(size);
        double sum = 0;
        for (const double w : weights.top) sum += w;
        for (const double w : weights.side) sum += 4 * w;
        CHECK(std::fabs(sum - 1) < 1e-13);
    }
    // Against a fine midpoint rule over cos cos' / (pi r^2).
    const HemicubeWeights weights(8);
    constexpr int kFine = 64;
    for (int y = 0; y < 8; y++)
        for (int x = 0; x < 8; x++) {
            double top = 0, side = 0;
            for (int j = 0; j < kFine; j++)
                for (int i = 0; i < kFine; i++) {
                    const double step = 2.0 / 8 / kFine;
                    const double s = -1 + 2.0 * x / 8 + (i + 0.5) * step,
                                 t = -1 + 2.0 * y / 8 + (j + 0.5) * step;
                    top += step * step / (kPi * std::pow(1 + s * s + t * t, 2));
                    side += -t * step * step / (kPi * std::pow(1 + s * s + t * t, 2));
                }
            CHECK(weights.top[static_cast<size_t>(8 * y + x)] == doctest::Approx(top).epsilon(1e-4));
            if (y < 4)
                CHECK(weights.side[static_cast<size_t>(8 * y + x)] == doctest::Approx(side).epsilon(1e-4));
        }
}

TEST_CASE("HemicubeOcclusionHasItsAnalyticValues") {
    for (const int size : {32, 128, 512}) {
        const double tolerance = kHemicubeError / size;
        // A disc of radius R at height h covers R^2 / (R^2 + h^2), a ball (R / h)^2.
        for (const auto& [r, h] : {std::pair(1.0, 1.0), std::pair(0.5, 1.0), std::pair(3.0, 0.5)}) {
            const Placed scene({ground(), disc(r, static_cast<float>(h), 256)});
            const Occlusion o = hemicubeAt(scene, kOrigin, size);
            CHECK(std::fabs(o.open - (1 - r * r / (r * r + h * h))) < tolerance);
            CHECK(o.bentNormal.y > 1 - tolerance);
        }
        const Placed ball({ground(), sphere(256, 128, {0.6f, 0.8f, 0}, 0.5f)});
        CHECK(std::fabs(hemicubeAt(ball, kOrigin, size).open - (1 - 0.8 * 0.25)) < tolerance);
        // The foot of a high wall, and of two: a half and a quarter of the hemisphere stay open.
        const OcclusionPoint foot = {{1e-3, 0, 1e-3}, {0, 1, 0}};
        const SurfaceMesh wall = rectangle({0, 0, 0}, {0, 0, 1000}, {0, 1000, 0}),
                          other = rectangle({0, 0, 0}, {1000, 0, 0}, {0, 1000, 0});
        const Occlusion half = hemicubeAt(Placed({ground(), wall}), foot, size);
        CHECK(std::fabs(half.open - 0.5) < tolerance);
        // Open: x > 0. The integrals of w cos over it are 2/3 and pi / 3.
        CHECK(std::fabs(half.bentNormal.x / half.bentNormal.y - 2 / kPi) < 2 * tolerance);
        CHECK(std::fabs(hemicubeAt(Placed({ground(), wall, other}), foot, size).open - 0.25) < tolerance);
    }
}

TEST_CASE("NothingCoveredIsExactlyOneAndAllCoveredIsZero") {
    const Placed plane({ground()});
    const Occlusion open = hemicubeAt(plane, {{0.3, 0, 0.2}, {0, 1, 0}});
    CHECK(open.open == 1);
    CHECK(open.bentNormal == glm::dvec3(0, 1, 0));
    const Placed room({solidBox({0, 0, 0}, {1, 1, 1})});
    const OcclusionPoint inside = {{0.2, -1, 0.3}, {0, 1, 0}};
    CHECK(hemicubeAt(room, inside).open < 1e-12);
    CHECK(hemicubeAt(room, inside).bentNormal == glm::dvec3(0, 1, 0));
    // What is beyond the largest distance covers nothing.
    CHECK(hemicubeAt(room, inside, 128, 0.69).open == 1);
    CHECK(hemicubeAt(room, inside, 128, 100).open < 1e-12);
    // No surface, and no scene.
    CHECK(hemicubeAt(room, {}).open == 1);
    CHECK(hemicubeAt(Placed({}), kOrigin).open == 1);
    DirectionalOptions options;
    options.directions = 64;
    const auto map = directionalOcclusion(
        plane.placed, std::vector<OcclusionPoint>{{{0.3, 0, 0.2}, {0, 1, 0}}, {}}, options);
    CHECK(map[0].open == 1);
    CHECK(map[1].open == 1);
    CHECK(directionalOcclusion(room.placed, std::span(&inside, 1), options)[0].open == 0);
    CHECK(directionalOcclusion({}, std::span(&inside, 1), options)[0].open == 1);
}

TEST_CASE("LargestDistanceCutsAWallAtACircle") {
    // A ceiling at height 1, within reach up to sqrt(2): a disc of radius 1, which covers a half.
    const Placed scene({ground(), rectangle({0, 1, 0}, {0, 0, 20}, {20, 0, 0})});
    CHECK(std::fabs(hemicubeAt(scene, kOrigin, 256, std::sqrt(2.0)).open - 0.5) < kHemicubeError / 256);
}

TEST_CASE("SpiralDirectionsAreEvenOverTheSphere") {
    for (const int n : {1, 2, 256, 1000}) {
        glm::dvec3 mean(0);
        double squares[3] = {0, 0, 0};
        for (int i = 0; i < n; i++) {
            const glm::dvec3 d = spiralDirection(i, n);
            CHECK(std::fabs(d.x * d.x + d.y * d.y + d.z * d.z - 1) < 1e-14);
            mean += d;
            for (int k = 0; k < 3; k++) squares[k] += d[k] * d[k];
        }
        if (n < 256) continue;
        for (int k = 0; k < 3; k++) {
            CHECK(std::fabs(mean[k]) < 1);
            CHECK(std::fabs(squares[k] / n - 1.0 / 3) < 1.0 / n);
        }
    }
}

TEST_CASE("DirectionalOcclusionIsTheOraclesForTheSameDirections") {
    const Placed scene({torusKnotMesh(96, 12)});
    const std::vector<OcclusionPoint> points = occlusionPointsOf(scene.placed[0]);
    DirectionalOptions options;
    options.directions = 128;
    options.mapSize = 1024;
    options.raster.threads = 1;
    const auto found = directionalOcclusion(scene.placed, points, options);
    const VisibilityOracle oracle(worldTriangles(scene.placed));
    HemicubeOptions gather;
    gather.threads = 1;
    double squares = 0, bias = 0, toHemicube = 0;
    int count = 0;
    std::vector<OcclusionPoint> some;
    std::vector<double> someOpen;
    for (size_t i = 0; i < points.size(); i += 7) {
        double total = 0, open = 0;
        for (int k = 0; k < options.directions; k++) {
            const glm::dvec3 d = spiralDirection(k, options.directions), n = points[i].normal;
            const double weight = n.x * d.x + n.y * d.y + n.z * d.z;
            if (weight <= 0) continue;
            total += weight;
            if (oracle.isVisible(points[i].position_m + 1e-4 * n, {d, true})) open += weight;
        }
        const double error = found[i].open - open / total;
        squares += error * error;
        bias += error;
        count++;
        some.push_back(points[i]);
        someOpen.push_back(found[i].open);
    }
    const auto gathered = hemicubeOcclusion(scene.placed, some, gather);
    for (size_t i = 0; i < some.size(); i++) toHemicube += std::pow(someOpen[i] - gathered[i].open, 2);
    // 64 directions over each hemisphere, and texels of 1/360 of the knot.
    CHECK(std::sqrt(squares / count) < 0.006);
    CHECK(std::fabs(bias / count) < 0.001);
    CHECK(std::sqrt(toHemicube / count) < directionalErrorBound(options.directions));
}

TEST_CASE("ThreadsChangeNoBitOfOcclusion") {
    const Placed scene({torusKnotMesh(48, 8)});
    const std::vector<OcclusionPoint> points = occlusionPointsOf(scene.placed[0]);
    HemicubeOptions one, many;
    one.size = many.size = 16;
    one.threads = 1;
    many.threads = 4;
    DirectionalOptions oneMap, manyMaps;
    oneMap.directions = manyMaps.directions = 16;
    oneMap.mapSize = manyMaps.mapSize = 64;
    oneMap.raster = {1, 64, false};
    manyMaps.raster = {4, 16, false};
    const auto a = hemicubeOcclusion(scene.placed, points, one),
               b = hemicubeOcclusion(scene.placed, points, many);
    const auto c = directionalOcclusion(scene.placed, points, oneMap),
               d = directionalOcclusion(scene.placed, points, manyMaps);
    for (size_t i = 0; i < points.size(); i++) {
        REQUIRE(a[i].open == b[i].open);
        REQUIRE(a[i].bentNormal == b[i].bentNormal);
        REQUIRE(c[i].open == d[i].open);
        REQUIRE(c[i].bentNormal == d[i].bentNormal);
    }
}
