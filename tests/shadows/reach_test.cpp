#include "shadows/reach.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "numeric/random.h"
#include "numeric/transform.h"
#include "shadows/ambient_occlusion.h"
#include "shadows/flat_mesh.h"
#include "tests/support/box_scene.h"

using namespace etalon;
using namespace etalon::test;

namespace {

constexpr int kFloatBits = 24;

struct Placed {
    SurfaceScene scene;
    std::vector<PlacedMesh> placed;
    explicit Placed(std::vector<SurfaceMesh> meshes, bool twoSided = false) {
        for (SurfaceMesh& mesh : meshes) {
            addObject(scene, std::move(mesh), lambertian(0.5));
            scene.instances.back().twoSided = twoSided;
        }
        placed = placeMeshes(scene, RasterReal::fp32, 1);
    }
    bool isOpen(int mapSize = 64, int bits = kFloatBits) const {
        return isAllOpen(placed, scene.instances, std::vector<bool>(placed.size(), true), mapSize, bits);
    }
};

SurfaceLight sunFrom(const glm::dvec3& toLight) {
    SurfaceLight light;
    light.toLight = toLight;
    light.irradiance = glm::dvec3(1);
    return light;
}
SurfaceLight lampAt(const glm::dvec3& position_m) {
    SurfaceLight light;
    light.kind = LightKind::point;
    light.position_m = position_m;
    light.intensity = glm::dvec3(1);
    return light;
}

const SurfaceMesh kFloor = rectangle({0, 0, 0}, {2, 0, 0}, {0, 0, -2});

}  // namespace

TEST_CASE("LightsBehindAOneSidedSurfaceDoNotReachIt") {
    const Placed floor({kFloor});
    const auto reaches = [&](const SurfaceLight& light, bool twoSided = false, int bits = kFloatBits) {
        return lightReaches(floor.placed[0], twoSided, light, bits);
    };
    CHECK(reaches(sunFrom({0, 1, 0})));
    CHECK_FALSE(reaches(sunFrom({0, -1, 0})));
    CHECK(reaches(sunFrom({0, -1, 0}), true));
    CHECK(reaches(lampAt({0, 0.1, 0})));
    CHECK_FALSE(reaches(lampAt({0, -0.1, 0})));
    CHECK_FALSE(reaches(lampAt({50, -0.1, 0})));
    // In the plane itself, and as near to it as rounding may put it, the light counts as reaching it.
    CHECK(reaches(sunFrom({1, 0, 0})));
    CHECK(reaches(sunFrom({1, -1e-7, 0})));
    CHECK_FALSE(reaches(sunFrom({1, -1e-5, 0})));
    CHECK(reaches(sunFrom({1, -1e-5, 0}), false, 11));
    CHECK(reaches(sunFrom({0, -1, 0}), false, 4));
}

TEST_CASE("ANormalThatTurnsToTheLightIsReached") {
    SurfaceMesh mesh = kFloor;
    mesh.normals[3] = {0.9f, -0.1f, 0};
    const Placed floor({mesh});
    CHECK(lightReaches(floor.placed[0], false, sunFrom({0, -1, 0}), kFloatBits));
    CHECK_FALSE(lightReaches(floor.placed[0], false, sunFrom({-0.6, -0.8, 0}), kFloatBits) ==
                lightReaches(floor.placed[0], false, sunFrom({0.6, -0.8, 0}), kFloatBits));
}

// And then every direction of directionalOcclusion() finds them so.
TEST_CASE("OnlyFlatThingsWithNothingInFrontOfThemAreAllOpen") {
    CHECK(Placed({kFloor}).isOpen());
    CHECK(Placed({kFloor}, true).isOpen());
    const SurfaceMesh above = rectangle({0, 1, 0}, {0.5, 0, 0}, {0, 0, -0.5}),
                      below = rectangle({0, -1, 0}, {0.5, 0, 0}, {0, 0, -0.5}),
                      beside = rectangle({3, 0, 0}, {0.5, 0, 0}, {0, 0, -0.5});
    CHECK_FALSE(Placed({kFloor, above}).isOpen());
    CHECK(Placed({kFloor, beside}).isOpen());
    CHECK(Placed({kFloor, beside}, true).isOpen());
    const Placed cellar({kFloor, below});
    CHECK_FALSE(cellar.isOpen());
    CHECK(isAllOpen(cellar.placed, cellar.scene.instances, {true, false}, 64, kFloatBits));
    const Placed seenFromBelow({kFloor, below}, true);
    CHECK_FALSE(
        isAllOpen(seenFromBelow.placed, seenFromBelow.scene.instances, {true, false}, 64, kFloatBits));
    SurfaceMesh tilted = kFloor;
    tilted.normals[1] = {3.f, 4.f, 0};
    CHECK_FALSE(Placed({tilted}).isOpen());
    SurfaceMesh bent = kFloor;
    bent.positions[0].y = 0.1f;
    CHECK_FALSE(Placed({bent}).isOpen());
    // Rounding that may lift points off the surface.
    CHECK(Placed({kFloor}).isOpen(8, 17));
    CHECK_FALSE(Placed({kFloor}).isOpen(512, 11));

    DirectionalOptions options;
    options.directions = 64;
    options.mapSize = 64;
    options.raster.threads = 1;
    const Placed both({kFloor, beside});
    for (const PlacedMesh& mesh : both.placed)
        for (const Occlusion& of : directionalOcclusion(both.placed, occlusionPointsOf(mesh), options))
            CHECK(of.open == 1);
}

TEST_CASE("AMeshIsFlatToItsOwnSizeWhereverItIs") {
    const auto planeWith = [](float lifted_m, double scale, double away_m) {
        SurfaceMesh mesh = kFloor;
        mesh.positions[3].y = lifted_m;
        SurfaceScene scene;
        addObject(scene, std::move(mesh), lambertian(0.5));
        scene.instances[0].toWorld = multiplied(translation(glm::dvec3(away_m)), scaling(glm::dvec3(scale)));
        return planeOf(placeMeshes(scene, RasterReal::fp32, 1)[0]);
    };
    const MeshPlane plane = planeWith(0, 1, 0);
    CHECK(plane.exists);
    CHECK(std::abs(plane.normal.y) == 1);
    CHECK(plane.tolerance_m == doctest::Approx(4 * std::sqrt(2.0) * kFlatness));
    for (const double scale : {1e-6, 1.0, 1e6})
        for (const double away_m : {0.0, 1e3, 1e6, 1e9}) {
            CAPTURE(scale);
            CAPTURE(away_m);
            if (away_m > 1e6 * scale) continue;
            CHECK(planeWith(0x1p-20f, scale, away_m).exists);
            CHECK_FALSE(planeWith(0x1p-16f, scale, away_m).exists);
        }
    CHECK_FALSE(planeWith(std::numeric_limits<float>::infinity(), 1, 0).exists);
    SurfaceMesh line = kFloor;
    for (auto& p : line.positions) p.z = 0;
    CHECK_FALSE(planeOf(Placed({line}).placed[0]).exists);
}

// Plates whose corners and normals are moved about what is allowed.
TEST_CASE("WhatIsAllOpenIsFoundOpenInEveryDirection") {
    DirectionalOptions options;
    options.directions = 48;
    options.mapSize = 16;
    options.raster.threads = 1;
    Random random(11);
    int open = 0, closed = 0, covered = 0;
    for (int scene = 0; scene < 200; scene++) {
        const double reach_m = std::ldexp(1, random.integer(-24, -1));
        const auto moved = [&](SurfaceMesh mesh) {
            for (auto& p : mesh.positions)
                for (int c = 0; c < 3; c++) p[c] += static_cast<float>(random.uniform(-reach_m, reach_m));
            for (auto& n : mesh.normals)
                for (int c = 0; c < 3; c++) n[c] += static_cast<float>(random.uniform(-reach_m, reach_m));
            return mesh;
        };
        const float height_m = static_cast<float>(random.uniform(-1, 1) * reach_m);
        const bool isBoth = random.chance(0.5);
        const Placed plates({moved(kFloor), moved(rectangle({3, height_m, 0}, {0.5, 0, 0}, {0, 0, -0.5}))},
                            isBoth);
        size_t notOpen = 0;
        for (const PlacedMesh& mesh : plates.placed) {
            std::vector<OcclusionPoint> points = occlusionPointsOf(mesh);
            if (isBoth)
                for (size_t i = points.size(); i-- > 0;)
                    points.push_back({points[i].position_m, -points[i].normal});
            for (const Occlusion& of : directionalOcclusion(plates.placed, points, options))
                notOpen += of.open != 1;
        }
        const bool isOpen = plates.isOpen(options.mapSize);
        if (isOpen) CHECK(notOpen == 0);
        (isOpen ? open : closed)++;
        covered += notOpen > 0;
    }
    CHECK(open > 30);
    CHECK(closed > 30);
    CHECK(covered > 10);
}
