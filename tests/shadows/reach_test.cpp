#include "shadows/reach.h"

#include <doctest/doctest.h>

#include "shadows/ambient_occlusion.h"
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
