// Hard cases, each with the outcome that is stated in its comment.
#include <doctest/doctest.h>

#include <algorithm>
#include <limits>
#include <numeric>

#include "shadows/shadow_bias.h"
#include "tests/shadows/shadow_scene.h"

using namespace etalon;
using namespace etalon::test;

namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

SurfaceScene groundAnd(SurfaceMesh caster, float edge = 4) {
    SurfaceScene scene;
    addObject(scene, tile({0, 0, 0}, edge), lambertian(0.5));
    addObject(scene, std::move(caster), lambertian(0.5));
    return scene;
}

MapRequest request(int size, ShadowDepth depth = ShadowDepth::d24) {
    MapRequest r;
    r.settings.size = size;
    r.settings.depth = depth;
    return r;
}

double mean(const std::vector<double>& v) {
    return std::accumulate(v.begin(), v.end(), 0.0) / static_cast<double>(v.size());
}
bool allAre(const std::vector<double>& v, double value) {
    return std::all_of(v.begin(), v.end(), [&](double x) { return x == value; });
}
double mostChange(const std::vector<double>& a, const std::vector<double>& b) {
    double most = 0;
    for (size_t i = 0; i < a.size(); i++) most = std::max(most, std::fabs(a[i] - b[i]));
    return most;
}

// The cube [-half, half]^3 about the centre, its faces to the outside.
SurfaceMesh cube(glm::vec3 c, float half) {
    SurfaceMesh mesh;
    const SurfaceScene inside = box(half, half, half);
    for (const SurfaceMesh& side : inside.meshes) {
        const auto first = static_cast<uint32_t>(mesh.positions.size());
        for (size_t i = 0; i < 4; i++) {
            mesh.positions.push_back(side.positions[i] + c);
            mesh.normals.push_back(-side.normals[i]);
        }
        for (size_t t = 0; t < 2; t++)
            for (const size_t k : {0u, 2u, 1u}) mesh.indices.push_back(first + side.indices[3 * t + k]);
    }
    return mesh;
}

}  // namespace

// Nothing is drawn, everything is lit.
TEST_CASE("AnEmptySceneIsLit") {
    const LitPoints points = gridOn(0, -1, 1, 5);
    for (const SurfaceLight& light : {sun({0, 1, 0}), bulb({0, 1, 0}), torch({0, 1, 0}, {0, -1, 0}, 0.8)}) {
        CHECK(mapOf({}, light, request(64)).layers.empty());
        CHECK(allAre(visibilityOf({}, light, points, request(64)), 1));
    }
}

// Nothing is drawn: what such a light does is not the map's to say.
TEST_CASE("ALightThatIsNotANumberCastsNothing") {
    const SurfaceScene scene = groundAnd(tile({0, 1, 0}, 1));
    for (const double bad : {kNan, std::numeric_limits<double>::infinity()}) {
        SurfaceLight lights[] = {sun({0, 1, 0}),
                                 bulb({0, 2, 0}),
                                 torch({0, 2, 0}, {0, -1, 0}, 0.8),
                                 torch({0, 2, 0}, {0, -1, 0}, 0.8),
                                 bulb({0, 2, 0}),
                                 sun({0, 1, 0})};
        lights[0].toLight.x = bad;
        lights[1].position_m.y = bad;
        lights[2].axis.z = bad;
        lights[3].cosOuter = kNan;
        lights[4].intensity.x = bad;
        lights[5].toLight = glm::dvec3(0);
        for (const SurfaceLight& light : lights) CHECK(mapOf(scene, light, request(64)).layers.empty());
    }
}

// Points that are not numbers, and points of no instance, are lit; the others do not notice.
TEST_CASE("PointsThatAreNotNumbersAreLit") {
    const SurfaceScene scene = groundAnd(tile({0, 1, 0}, 1));
    LitPoints points = gridOn(0, -0.1, 0.1, 3);
    points.position_m[0][0] = kNan;
    points.position_m[1][1] = kNan;
    points.position_m[2][2] = std::numeric_limits<double>::infinity();
    points.instance[3] = kNoInstance;
    for (const SurfaceLight& light : {sun({0, 1, 0}), bulb({0, 2, 0}), torch({0, 2, 0}, {0, -1, 0}, 0.8)}) {
        const std::vector<double> visibility = visibilityOf(scene, light, points, request(64));
        for (size_t i : {0u, 2u, 3u}) CHECK(visibility[i] == 1);
        for (size_t i = 4; i < points.size(); i++) CHECK(visibility[i] == 0);
    }
}

// A caster behind a lamp casts nothing (no anti-shadow), one on both sides of it only its part in front.
TEST_CASE("ACasterBehindTheLightCastsNothing") {
    const LitPoints points = gridOn(0, -1.9, 1.9, 20);
    for (const SurfaceLight& light : {torch({0, 1, 0}, {0, -1, 0}, 0.6), bulb({0, 1, 0})})
        CHECK(allAre(visibilityOf(groundAnd(tile({0, 1.5f, 0}, 1)), light, points, request(64)), 1));
    // An upright sheet from y = 0.5 to 1.5 beside the lamp, at x = 0.2: its shadow begins at x = 0.4.
    const SurfaceScene scene = groundAnd(rectangle({0.2f, 1, 0}, {0, 0.5f, 0}, {0, 0, 3}));
    for (const SurfaceLight& light : {torch({0, 1, 0}, {0, -1, 0}, 0.3), bulb({0, 1, 0})}) {
        const std::vector<double> visibility = visibilityOf(scene, light, points, request(512));
        for (size_t i = 0; i < points.size(); i++) {
            const double x = points.position_m[0][i];
            if (x < 0.25) CHECK(visibility[i] == 1);
            if (x > 0.55) CHECK(visibility[i] == 0);
        }
    }
}

// A caster nearer than the near plane is drawn on it: 1 mm from a lamp that lights 10 m.
TEST_CASE("ACasterThroughTheNearPlaneStillCasts") {
    for (const ShadowDepth depth :
         {ShadowDepth::d16, ShadowDepth::d24, ShadowDepth::d32f, ShadowDepth::linear})
        for (const SurfaceLight& light : {torch({0, 10, 0}, {0, -1, 0}, 0.8), bulb({0, 10, 0})}) {
            // Half as wide as far away: a shadow of 10 m.
            const SurfaceScene scene = groundAnd(tile({0, 9.999f, 0}, 0.001f), 20);
            const ShadowMap map = mapOf(scene, light, request(256, depth));
            CHECK(map.projection.near_m > 0.001);
            CHECK(allAre(lookUp(map, gridOn(0, -4, 4, 8)), 0));
            CHECK(lookUp(map, gridOn(0, 6.5, 6.6, 1))[0] == 1);
            // A sheet that crosses the near plane: one end beside the lamp, the other 2 m below.
            const SurfaceScene sheet = groundAnd(rectangle({0.0005f, 9, 0}, {0, 1, 0}, {0, 0, 3}), 20);
            for (const double v : lookUp(mapOf(sheet, light, request(256, depth)), gridOn(0, 2, 3, 4)))
                CHECK(v == 0);
        }
}

// Everything outside a closed mesh around the lamp is dark, everything inside is lit.
TEST_CASE("ALightInsideAMeshLightsNothingOutside") {
    const SurfaceScene scene = groundAnd(cube({0, 1, 0}, 0.5f));
    for (const ShadowDepth depth :
         {ShadowDepth::d16, ShadowDepth::d24, ShadowDepth::d32f, ShadowDepth::linear})
        for (const ShadowFaces faces : {ShadowFaces::both, ShadowFaces::back}) {
            MapRequest r = request(64, depth);
            r.settings.faces = faces;
            const ShadowMap map = mapOf(scene, bulb({0.2, 1.3, -0.1}), r);
            CHECK(allAre(lookUp(map, gridOn(0, -1.9, 1.9, 20)), 0));
            CHECK(allAre(lookUp(map, gridOn(0.8, -0.3, 0.3, 10)), 1));
        }
}

// The receiver does not shadow itself, and what stands on it shadows what is behind.
TEST_CASE("ALightInTheReceiversPlaneIsDefined") {
    const LitPoints points = gridOn(0, -1.9, 1.9, 20);
    for (const SurfaceLight& light : {sun({1, 0, 0}), bulb({3, 0, 0}), torch({3, 0, 0}, {-1, 0, 0}, 0.6)}) {
        CHECK(allAre(visibilityOf(groundAnd(tile({0, 0, 0}, 1)), light, points, request(64)), 1));
        // A wall of 1 m, half of it below the ground, at x = 0.5.
        const SurfaceScene scene = groundAnd(rectangle({0.5f, 0, 0}, {0, 0, 3}, {0, 0.5f, 0}));
        const std::vector<double> visibility = visibilityOf(scene, light, points, request(64));
        for (size_t i = 0; i < points.size(); i++)
            if (points.position_m[0][i] < 0.4)
                CHECK(visibility[i] == 0);
            else if (points.position_m[0][i] > 0.6)
                CHECK(visibility[i] == 1);
    }
}

// A caster thinner than a texel covers texels whose centres it meets and no others: along the strip some are
// hit and some may be missed, and no point farther from its shadow than the window reaches is dimmed.
TEST_CASE("ACasterBelowATexelIsNeverWidenedBeyondTheWindow") {
    SurfaceScene scene = groundAnd(rectangle({0, 1, 0}, {0.7f, 0, 0.7f}, {0.002f, 0, -0.002f}));
    for (const ShadowFilter filter : {ShadowFilter::hard, ShadowFilter::pcf}) {
        MapRequest r = request(64);
        r.settings.filter = filter;
        const ShadowMap map = mapOf(scene, sun({0, 1, 0}), r);
        const double texel_m = 1 / map.projection.scale;
        CHECK(texel_m > 5 * 0.004 * std::sqrt(2.0) / 2);
        const LitPoints points = gridOn(0, -1.9, 1.9, 80);
        const std::vector<double> visibility = lookUp(map, points);
        const double reach_m = texel_m * (filter == ShadowFilter::hard ? 1 : 3) * std::sqrt(2.0) + 0.003;
        int dimmed = 0;
        for (size_t i = 0; i < points.size(); i++) {
            const double away_m =
                std::fabs(points.position_m[0][i] - points.position_m[2][i]) / std::sqrt(2.0);
            if (away_m > reach_m) CHECK(visibility[i] == 1);
            dimmed += visibility[i] < 1 ? 1 : 0;
        }
        CHECK(dimmed > 0);
    }
}

// 0.01 m to 10,000 m in one map. A distance resolves all of it; a depth is too coarse beyond some 10 near
// distances, because the near plane cannot be nearer than kShadowNearRatio of the far one: casters are still
// right (they are clamped), but a receiver nearer than the near plane is lit.
TEST_CASE("AHugeRangeOfDepthsNeedsDistances") {
    for (const ShadowDepth depth :
         {ShadowDepth::d16, ShadowDepth::d24, ShadowDepth::d32f, ShadowDepth::linear}) {
        SurfaceScene scene;
        addObject(scene, rectangle({0, 0, -10000}, {1000, 0, 0}, {0, 1000, 0}), lambertian(0.5));
        addObject(scene, rectangle({0, 0, -100}, {1, 0, 0}, {0, 1, 0}), lambertian(0.5));
        addObject(scene, rectangle({-0.001f, 0, -0.01f}, {0.001f, 0, 0}, {0, 0.001f, 0}), lambertian(0.5));
        addObject(scene, rectangle({0, 0, -0.02f}, {0.01f, 0, 0}, {0, 0.01f, 0}), lambertian(0.5));
        const auto at = [&](double x, double z) {
            LitPoints point = gridOn(0, 0, 1, 1);
            point.position_m = {std::vector{x}, std::vector{0.0}, std::vector{z}};
            return point;
        };
        MapRequest r = request(512, depth);
        r.settings.bias = {2, 1, 0};
        const ShadowMap map = mapOf(scene, torch({0, 0, 0}, {0, 0, -1}, 0.9), r);
        CAPTURE(static_cast<int>(depth));
        // Behind the plate at 0.02 m, far and near.
        CHECK(lookUp(map, at(0, -10000))[0] == 0);
        CHECK(lookUp(map, at(0, -100))[0] == 0);
        // Just behind the small plate at 0.01 m, 2 m before the near plane of the depths.
        const double between = lookUp(map, at(-0.001, -0.015))[0];
        CHECK(between == (depth == ShadowDepth::linear ? 0.0 : 1.0));
    }
}

// A directional light has no place, so that nothing depends on how far away it is: the map's origin lies at
// the scene. A lamp 1e8 m away has one: fp32 has steps of 8 m there, fp24 of 1024 m. Its map stays defined,
// every visibility in [0, 1], and in double it is that of the sun; in fp32 what is above a caster cannot be
// told from what is below (fp24 subtracts toward zero and may tell them by luck).
TEST_CASE("ALampAHundredMillionMetresAwayIsNoSun") {
    const SurfaceScene scene = groundAnd(tile({0, 1, 0}, 1));
    const LitPoints points = gridOn(0, -1.9, 1.9, 40);
    for (const char* profile : {"f32", "r300-fp24", "f64"}) {
        MapRequest r = request(128);
        r.profile = profile;
        const ShadowMap far = mapOf(scene, sun({0, 1, 0}), r);
        const double distance_m = std::sqrt(far.projection.origin.x * far.projection.origin.x +
                                            far.projection.origin.y * far.projection.origin.y +
                                            far.projection.origin.z * far.projection.origin.z);
        CHECK(distance_m < 4);
        const std::vector<double> ofSun = lookUp(far, points, profile),
                                  above = lookUp(far, gridOn(1.5, -1.9, 1.9, 40), profile);
        CHECK(allAre(above, 1));
        CHECK(mean(ofSun) == doctest::Approx(1 - 1 / (3.8 * 3.8)).epsilon(0.01));
        const SurfaceLight lamp = torch({0, 1e8, 0}, {0, -1, 0}, 0.9);
        r.settings.depth = ShadowDepth::d32f;
        const ShadowMap map = mapOf(scene, lamp, r);
        const std::vector<double> ofLamp = lookUp(map, points, profile);
        const double wrong = std::fabs(mean(ofSun) - mean(ofLamp)) +
                             (1 - mean(lookUp(map, gridOn(1.5, -1.9, 1.9, 40), profile)));
        for (const double v : ofLamp) CHECK((v >= 0 && v <= 1));
        CAPTURE(std::string(profile));
        CAPTURE(wrong);
        if (std::string(profile) == "f64") CHECK(wrong < 0.01);
        if (std::string(profile) == "f32") CHECK(wrong > 0.05);
    }
}

// A light of size 0 under the soft filter: no radius but half a texel; nothing is half-lit farther from the
// edge.
TEST_CASE("ALightWithoutAnAreaHasHardShadows") {
    const SurfaceScene scene = groundAnd(tile({0, 1, 0}, 1));
    for (const SurfaceLight& light : {sun({0, 1, 0}), torch({0, 3, 0}, {0, -1, 0}, 0.7), bulb({0, 3, 0})})
        for (const ShadowDepth depth : {ShadowDepth::d24, ShadowDepth::linear}) {
            MapRequest r = request(128, depth);
            r.settings.filter = ShadowFilter::soft;
            r.settings.taps = 16;
            const ShadowMap map = mapOf(scene, light, r);
            const LitPoints points = gridOn(0, -1.9, 1.9, 60);
            const double half_m = light.kind == LightKind::directional ? 0.5 : 0.75;
            const double texel_m = (light.kind == LightKind::directional ? 1 : 3) / map.projection.scale;
            const std::vector<double> visibility = lookUp(map, points);
            for (size_t i = 0; i < points.size(); i++) {
                const double x = std::fabs(points.position_m[0][i]), z = std::fabs(points.position_m[2][i]);
                const double away_m = std::max(x, z) - half_m;
                if (std::fabs(away_m) > 1.5 * texel_m) CHECK(visibility[i] == (away_m > 0 ? 1.0 : 0.0));
            }
        }
}

// The map does not depend on the camera: receivers, not pixels, are fitted. A light that turns, or a caster
// that moves, by a fraction of a texel changes each 4 x 4 window by at most what its weights change, not by
// whole texels.
TEST_CASE("SubTexelSweepsDoNotPop") {
    const LitPoints points = gridOn(0, -1.9, 1.9, 60);
    MapRequest r = request(128);
    // The caster moves by 1/16 texel (snapped texels stay where they are on the ground).
    std::vector<double> before;
    double most = 0, mostOfMean = 0;
    for (int step = 0; step < 32; step++) {
        const float x = 0.3f + static_cast<float>(step) * 0.001f;
        const ShadowMap map = mapOf(groundAnd(tile({x, 1, 0.1f}, 1)), sun({0.2, 1, 0.1}), r);
        CHECK(1 / map.projection.scale > 0.008);
        const std::vector<double> now = lookUp(map, points);
        if (!before.empty()) {
            most = std::max(most, mostChange(before, now));
            mostOfMean = std::max(mostOfMean, std::fabs(mean(before) - mean(now)));
        }
        before = now;
    }
    // A texel's column more or less in a window of four, and at a corner a row as well.
    CHECK(most <= 0.25);
    CHECK(mostOfMean < 0.002);
    // The light turns by 1/1000.
    before.clear();
    most = mostOfMean = 0;
    for (int step = 0; step < 32; step++) {
        const std::vector<double> now =
            visibilityOf(groundAnd(tile({0.3f, 1, 0.1f}, 1)), sun({0.2 + step * 0.001, 1, 0.1}), points, r);
        if (!before.empty()) {
            most = std::max(most, mostChange(before, now));
            mostOfMean = std::max(mostOfMean, std::fabs(mean(before) - mean(now)));
        }
        before = now;
    }
    CHECK(most <= 0.5);
    CHECK(mostOfMean < 0.002);
}

// Without snapping the texels move with the caster; with it they stay where they are.
TEST_CASE("SnappedTexelsStayWhereTheyAre") {
    for (const bool snap : {true, false}) {
        MapRequest r = request(128);
        r.settings.snap = snap;
        double fraction = -1;
        bool moves = false;
        for (int step = 0; step < 16; step++) {
            const float x = 0.3f + static_cast<float>(step) * 0.001f;
            const ShadowProjection p = mapOf(groundAnd(tile({x, 1, 0.1f}, 1)), sun({0, 1, 0}), r).projection;
            const double texels = p.origin.x * p.scale;
            const double now = texels - std::floor(texels + 0.5);
            if (fraction >= 0) moves = moves || std::fabs(now - fraction) > 1e-6;
            fraction = now;
            if (snap) CHECK(std::fabs(now) < 1e-6);
        }
        CHECK(moves == !snap);
    }
}

// Narrow formats: nothing is outside [0, 1], and nothing is not a number; also where they cannot tell texels
// apart.
TEST_CASE("EveryProfileGivesFractions") {
    const SurfaceScene scene = groundAnd(tile({0, 1, 0}, 1));
    const LitPoints points = gridOn(0, -1.9, 1.9, 10);
    for (const Profile& profile : profiles())
        for (const ShadowFilter filter :
             {ShadowFilter::hard, ShadowFilter::pcf, ShadowFilter::disc, ShadowFilter::soft})
            for (const SurfaceLight& light : {sun({0.1, 1, 0}), bulb({0, 3, 0})}) {
                MapRequest r = request(64, ShadowDepth::linear);
                r.profile = profile.name.data();
                r.settings.filter = filter;
                r.settings.receiverPlane = true;
                r.settings.normalOffset_texels = 1;
                r.settings.lightSize_m = 0.1;
                for (const double v : visibilityOf(scene, light, points, r)) CHECK((v >= 0 && v <= 1));
            }
    for (const ShadowFilter filter : {ShadowFilter::pcf, ShadowFilter::disc}) {
        MapRequest r = request(2000, ShadowDepth::d16);
        r.profile = "bf16";
        r.settings.filter = filter;
        for (const double v : visibilityOf(scene, sun({0.1, 1, 0}), points, r)) CHECK((v >= 0 && v <= 1));
    }
}
