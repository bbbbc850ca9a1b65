#include "shadows/planar_visibility.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <string_view>

#include "lighting/render_view.h"
#include "shadows/planar_lights.h"
#include "tests/shadows/planar_scene.h"

using namespace etalon;
using namespace etalon::test;

namespace {

const std::vector<glm::dvec4> kLight = {glm::dvec4(0.3, 2, 0.2, 1)};

PlanarShadow boxShadow(const char* profile, double blur_m, const std::vector<glm::dvec4>& lights = kLight) {
    Casters casters;
    casters.addBox({-0.3f, 0.2f, -0.2f}, {0.25f, 0.9f, 0.3f});
    PlanarShadowOptions options;
    options.resolution = 128;
    options.blurSigma_m = blur_m;
    return shadowOn(groundReceiver(), casters, lights, options, profile);
}

LitPoints pointsOn(const std::vector<glm::dvec3>& positions, uint32_t instance) {
    LitPoints points;
    for (const glm::dvec3& p : positions) {
        for (int c = 0; c < 3; c++) points.position_m[static_cast<size_t>(c)].push_back(p[c]);
        points.instance.push_back(instance);
    }
    return points;
}

std::vector<double> lookUp(const PlanarVisibility& visibility, const LitPoints& points) {
    std::vector<double> result(points.size(), -1);
    visibility.find(0, points, result);
    return result;
}

std::vector<PlanarVisibility::Entry> entryOf(PlanarShadow shadow, uint32_t instance = 0, size_t light = 0) {
    std::vector<PlanarVisibility::Entry> entries(1);
    entries[0] = {light, instance, std::move(shadow)};
    return entries;
}

}  // namespace

TEST_CASE("TexelCentresAreReadAsStoredAndBetweenThemBilinearly") {
    const PlanarShadow shadow = boxShadow("f64", 0.03);
    const PlanarGrid& grid = shadow.grid;
    const PlanarVisibility visibility(entryOf(shadow), *findProfile("f64"));
    std::vector<glm::dvec3> centres, middles;
    std::vector<double> expectedCentres, expectedMiddles;
    const auto stored = [&](int x, int y) { return static_cast<double>(shadow.shadow.at(x, y)); };
    for (int y = 0; y + 1 < grid.height; y += 3)
        for (int x = 0; x + 1 < grid.width; x += 3) {
            centres.push_back(grid.toWorld(x + 0.5, y + 0.5));
            expectedCentres.push_back(1 - stored(x, y));
            middles.push_back(grid.toWorld(x + 0.75, y + 1.0));
            expectedMiddles.push_back(1 - (0.75 * (stored(x, y) + stored(x, y + 1)) +
                                           0.25 * (stored(x + 1, y) + stored(x + 1, y + 1))) /
                                              2);
        }
    const auto check = [&](const std::vector<glm::dvec3>& positions, const std::vector<double>& expected) {
        const std::vector<double> found = lookUp(visibility, pointsOn(positions, 0));
        double worst = 0;
        for (size_t i = 0; i < found.size(); i++) worst = std::max(worst, std::abs(found[i] - expected[i]));
        CHECK(worst < 1e-11);
    };
    check(centres, expectedCentres);
    check(middles, expectedMiddles);
}

TEST_CASE("EveryProfileReadsTheShadowWithinItsPrecision") {
    // Against truth: the steepest slope of the blurred shadow times the error of a position, and the result's
    // rounding.
    const struct {
        const char* profile;
        double bound;
    } kBounds[] = {{"f64", 1e-12},       {"f32", 2e-4},      {"truth", 0},       {"d3d11", 3e-3},
                   {"vulkan-min", 3e-2}, {"nv40-fp32", 0.1}, {"nv40-fp16", 0.3}, {"r300-fp24", 0.6},
                   {"fp16", 0.3},        {"bf16", 1.0}};
    const PlanarShadow shadow = boxShadow("truth", 0.03);
    std::vector<glm::dvec3> positions;
    for (int i = 0; i < 900; i++)
        positions.emplace_back(-0.8 + 1.6 * ((i * 37) % 100) / 100.0, 0, -0.8 + 1.6 * ((i * 61) % 90) / 90.0);
    const LitPoints points = pointsOn(positions, 0);
    const auto truth = lookUp(PlanarVisibility(entryOf(shadow), *findProfile("truth")), points);
    for (const auto& entry : kBounds) {
        const auto found = lookUp(PlanarVisibility(entryOf(shadow), *findProfile(entry.profile)), points);
        double worst = 0;
        for (size_t i = 0; i < found.size(); i++) {
            CHECK(found[i] >= 0);
            CHECK(found[i] <= 1);
            worst = std::max(worst, std::abs(found[i] - truth[i]));
        }
        INFO(std::string(entry.profile));
        CHECK(worst <= entry.bound);
    }
}

TEST_CASE("PointsElsewhereAreLit") {
    const PlanarShadow shadow = boxShadow("f32", 0);
    const PlanarVisibility visibility(entryOf(shadow, 3, 0), *findProfile("f32"));
    CHECK(visibility.casts(0));
    CHECK(!visibility.casts(1));
    const std::vector<glm::dvec3> positions = {{-0.1, 0, 0}, {1.9, 0, 1.9}, {-1e6, 0, 0}};
    CHECK(lookUp(visibility, pointsOn(positions, 3)) == std::vector<double>{0, 1, 1});
    CHECK(lookUp(visibility, pointsOn(positions, 2)) == std::vector<double>{1, 1, 1});
    // A light whose receivers have no shadow casts none.
    CHECK(!PlanarVisibility(entryOf(PlanarShadow()), *findProfile("f32")).casts(0));
    // A position that is not a number has a texel.
    const double bad = lookUp(visibility, pointsOn({{std::numeric_limits<double>::quiet_NaN(), 0, 0}}, 3))[0];
    CHECK((bad == 0 || bad == 1));
}

TEST_CASE("TwoShadowsOfALightOnAReceiverAreMultiplied") {
    const PlanarShadow soft = boxShadow("f32", 0.1), hard = boxShadow("f32", 0.02);
    std::vector<glm::dvec3> positions;
    for (int i = 0; i < 400; i++) positions.emplace_back(-1 + 0.1 * (i % 20), 0, -1 + 0.1 * (i / 20));
    const LitPoints points = pointsOn(positions, 0);
    for (const char* name : {"f32", "f64", "nv40-fp16"}) {
        const Profile& profile = *findProfile(name);
        std::vector<PlanarVisibility::Entry> both = entryOf(soft);
        both.push_back({0, 0, hard});
        const auto product = lookUp(PlanarVisibility(both, profile), points);
        const auto first = lookUp(PlanarVisibility(entryOf(soft), profile), points);
        const auto second = lookUp(PlanarVisibility(entryOf(hard), profile), points);
        size_t wrong = 0, partly = 0;
        for (size_t i = 0; i < points.size(); i++) {
            // The product of two numbers of the arithmetic, rounded to it.
            const double exact = first[i] * second[i];
            const double rounded = std::string_view(name) == "f32" ? static_cast<float>(exact) : exact;
            wrong += std::string_view(name) == "nv40-fp16" ? std::abs(product[i] - exact) > 0x1p-11
                                                           : product[i] != rounded;
            partly += product[i] > 0 && product[i] < 1;
        }
        CHECK(wrong == 0);
        CHECK(partly > 20);
    }
}

TEST_CASE("EachLightLosesItsOwnShareOnly") {
    const PlanarShadow left = boxShadow("f64", 0, {glm::dvec4(1.5, 2, 0, 1)}),
                       right = boxShadow("f64", 0, {glm::dvec4(-1.5, 2, 0, 1)});
    const PlanarReceiver receiver = groundReceiver();
    PlanarGrid grid;
    grid.frame = receiver.frame;
    grid.corner_m = {-2.5, -2.5};
    grid.texel_m = 0.05;
    grid.width = grid.height = 100;
    const std::vector<WeightedShadow> lights = {{&left, 3}, {&right, 1}};
    const Image<float> composed = composeShadows(receiver, grid, lights, *findProfile("f64"), {1, 64});
    bool seen[4] = {};
    for (int y = 0; y < 100; y++)
        for (int x = 0; x < 100; x++) {
            const double s = -2.5 + (x + 0.5) * 0.05, t = -2.5 + (y + 0.5) * 0.05;
            const double l = shadowAt(left, s, t), r = shadowAt(right, s, t);
            const float value = composed.at(x, y);
            if (std::max(std::abs(s), std::abs(t)) > 2) {
                CHECK(value == 1);
                continue;
            }
            // Where the texels around agree.
            bool uniform = true;
            for (const double ds : {-0.03, 0.03})
                for (const double dt : {-0.03, 0.03})
                    uniform = uniform && shadowAt(left, s + ds, t + dt) == l &&
                              shadowAt(right, s + ds, t + dt) == r;
            if (!uniform) continue;
            CHECK(static_cast<double>(value) == doctest::Approx(1 - (3 * l + r) / 4).epsilon(1e-7));
            seen[(l == 1 ? 1 : 0) + (r == 1 ? 2 : 0)] = true;
        }
    for (const bool s : seen) CHECK(s);
    // No share, and no shadow.
    const std::vector<WeightedShadow> dark = {{&left, 0}};
    const PlanarShadow none;
    const std::vector<WeightedShadow> lit = {{&none, 2}};
    for (const auto& list : {dark, lit}) {
        const Image<float> unshadowed = composeShadows(receiver, grid, list, *findProfile("f32"), {1, 64});
        for (const float v : unshadowed.values()) CHECK(v == 1);
    }
}

TEST_CASE("TheShadowStaysOnTheReceiversPolygon") {
    // A triangle as receiver, a caster that covers the sky.
    PlanarReceiver receiver = groundReceiver(1);
    receiver.indices = {0, 1, 2};
    Casters casters;
    casters.addSquare(0, 1, 0, 3);
    const PlanarShadow shadow = shadowOn(receiver, casters, kLight);
    const std::vector<WeightedShadow> lights = {{&shadow, 1}};
    const Image<float> composed = composeShadows(receiver, shadow.grid, lights, *findProfile("f32"), {1, 64});
    int dark = 0, leaked = 0, missing = 0;
    for (int y = 0; y < shadow.grid.height; y++)
        for (int x = 0; x < shadow.grid.width; x++) {
            const glm::dvec3 p = shadow.grid.toWorld(x + 0.5, y + 0.5);
            // (-1,-1), (1,-1), (1,1)
            const double inside = std::min({1 - p.x, p.z + 1, p.x - p.z});
            if (inside < -shadow.grid.texel_m / 64 && composed.at(x, y) != 1) leaked++;
            if (inside > shadow.grid.texel_m / 64 && composed.at(x, y) != 0) missing++;
            if (composed.at(x, y) == 0) dark++;
        }
    CHECK(leaked == 0);
    CHECK(missing == 0);
    CHECK(dark > 1000);
}

TEST_CASE("PlanarReceiversAreFound") {
    SurfaceScene scene;
    addObject(scene, rectangle({1, 0.5f, -2}, {3, 0, 0}, {0, 0, -1}), lambertian(0.5));
    addObject(scene, rectangle({1, 0.5f, -2}, {3, 1, 0.3f}, {0, 2, -1}), lambertian(0.5));
    SurfaceMesh bent = rectangle({0, 0, 0}, {1, 0, 0}, {0, 0, -1});
    bent.positions[3].y = 1e-4f;
    addObject(scene, bent, lambertian(0.5));
    SurfaceMesh line = rectangle({0, 0, 0}, {1, 0, 0}, {1, 0, 0});
    addObject(scene, line, lambertian(0.5));
    for (const RasterReal real : {RasterReal::fp32, RasterReal::fp64}) {
        const auto placed = placeMeshes(scene, real, 1);
        const auto ground = planarReceiverOf(placed[0]);
        REQUIRE(ground);
        CHECK(ground->frame.normal == glm::dvec3(0, 1, 0));
        CHECK(ground->frame.s == glm::dvec3(1, 0, 0));
        CHECK(ground->highest_m().x - ground->lowest_m().x == 6);
        CHECK(ground->highest_m().y - ground->lowest_m().y == 2);
        CHECK(planarReceiverOf(placed[1]));
        CHECK(!planarReceiverOf(placed[2]));
        CHECK(!planarReceiverOf(placed[3]));
        // From behind the same points have the same places.
        const PlanarReceiver behind = ground->reversed();
        const glm::dvec3 p = placed[0].positions[2], q = behind.frame.toFrame(p);
        CHECK(q.x == behind.corners_m[2].x);
        CHECK(q.y == behind.corners_m[2].y);
        CHECK(behind.frame.normal.y == -1);
    }
}

TEST_CASE("LightsOfASceneCastOnItsPlanes") {
    // A ground, a wall behind it, a square above; a lamp below the ground lights its lower side.
    SurfaceScene scene;
    addObject(scene, rectangle({0, 0, 0}, {2, 0, 0}, {0, 0, -2}), lambertian(0.5));
    addObject(scene, rectangle({0, 1, -2}, {2, 0, 0}, {0, 1, 0}), lambertian(0.5));
    addObject(scene, rectangle({0, 0.5f, 0}, {0.3f, 0, 0}, {0, 0, -0.3f}), lambertian(0.5));
    scene.lights.resize(3);
    scene.lights[0].kind = LightKind::point;
    scene.lights[0].position_m = {0, 2, 0.5};
    scene.lights[1].toLight = {0, 0.6, 0.8};
    scene.lights[2].kind = LightKind::point;
    scene.lights[2].position_m = {0, -2, 0};
    const Profile& profile = *findProfile("f32");
    const auto placed = placeMeshes(scene, profile.vertex, 1);
    PlanarLightSettings settings;
    settings.lightSize_m = 0.2;
    settings.tangentOfHalfAngle = 0.05;
    const auto shadowsOf = [&](size_t light, const std::vector<bool>& receivers) {
        return planarShadowsOf(scene.lights[light], light, placed, settings, receivers, profile, {1, 64});
    };
    const auto lamp = shadowsOf(0, {});
    const auto at = [](const PlanarShadow& shadow, const glm::dvec3& p) {
        const glm::dvec3 q = shadow.grid.frame.toFrame(p);
        return shadowAt(shadow, q.x, q.y);
    };
    REQUIRE(!lamp.empty());
    CHECK(lamp[0].instance == 0);
    CHECK(lamp[0].light == 0);
    CHECK(at(lamp[0].shadow, {0, 0, -0.15}) == 1);
    CHECK(at(lamp[0].shadow, {0, 0, 1}) == 0);
    const auto sun = shadowsOf(1, {true, false, false});
    REQUIRE(sun.size() == 1);
    // 0.5 m high: 2/3 m further back.
    CHECK(at(sun[0].shadow, {0, 0, -0.667}) == 1);
    CHECK(at(sun[0].shadow, {0, 0, 0}) == 0);
    CHECK(shadowsOf(1, {false, false, false}).empty());
    // From below nothing stands between the lamp and the ground.
    CHECK(shadowsOf(2, {true, false, false}).empty());
    scene.lights[0].position_m.x = std::numeric_limits<double>::quiet_NaN();
    CHECK(shadowsOf(0, {}).empty());
}

TEST_CASE("ShadingMultipliesEachLightWithWhatReachesThePlane") {
    SurfaceScene scene;
    const uint32_t ground = addObject(scene, rectangle({0, 0, 0}, {2, 0, 0}, {0, 0, -2}), lambertian(0.5));
    addObject(scene, rectangle({0, 0.5f, 0}, {0.3f, 0, 0}, {0, 0, -0.3f}), lambertian(0.5));
    for (int i = 0; i < 2; i++) {
        SurfaceLight light;
        light.kind = LightKind::point;
        light.position_m = {i == 0 ? 1.0 : -1.0, 2, 0};
        light.intensity = glm::dvec3(i == 0 ? 3 : 1);
        scene.lights.push_back(light);
    }
    PinholeCamera camera;
    camera.width = camera.height = 64;
    camera.fx = camera.fy = 40;
    camera.cx = camera.cy = 32;
    camera.right = {1, 0, 0}, camera.up = {0, 0, -1}, camera.backward = {0, 1, 0};
    camera.position = {0, 4, 0};
    const View view = cameraView(camera);
    const Profile& profile = *findProfile("f32");
    const auto placed = placeMeshes(scene, profile.vertex, 1);
    const VisibleScene visible = findVisible(scene, placed, view, profile, 1, {1, 64});
    ShadeJob job = shadeJobOf(visible, scene, placed, view, profile, {1, 64});
    job.request[ShadeOutput::beauty] = true;
    const Image<float> unshadowed = shade(job)[ShadeOutput::beauty];

    const PlanarReceiver receiver = *planarReceiverOf(placed[ground]);
    const PlacedMesh* caster = &placed[1];
    const PlanarCasters casters = castersAbove(receiver.frame, {&caster, 1}, 1e-5);
    std::vector<PlanarVisibility::Entry> entries(1);
    entries[0] = {0, ground,
                  planarShadow(receiver, casters, std::vector{glm::dvec4(scene.lights[0].position_m, 1)}, {},
                               profile, {1, 64})};
    const PlanarVisibility visibility(std::move(entries), profile);
    job.visibility = &visibility;
    const Image<float> shadowed = shade(job)[ShadeOutput::beauty];
    scene.lights[0].intensity = glm::dvec3(0);
    const Image<float> second = shade(job)[ShadeOutput::beauty];

    // The first light's shadow is 4/3 (p - l) + l: around (-1/3, 0), 0.4 to each side.
    int inShadow = 0, unchanged = 0;
    for (int y = 0; y < 64; y++)
        for (int x = 0; x < 64; x++) {
            const double s = (x + 0.5 - 32) * 4 / 40, t = (y + 0.5 - 32) * 4 / 40;
            if (visible.target.id.at(x, y) == kNoTriangle) continue;
            if (visible.instanceOfDraw[visible.target.triangles[visible.target.id.at(x, y)].draw] != ground) {
                CHECK(shadowed.at(x, y) == unshadowed.at(x, y));
                continue;
            }
            const double outside = std::max(std::abs(s + 1.0 / 3), std::abs(t)) - 0.4;
            if (std::abs(outside) < 0.02) continue;
            CHECK(shadowed.at(x, y) == (outside > 0 ? unshadowed : second).at(x, y));
            (outside > 0 ? unchanged : inShadow)++;
        }
    CHECK(inShadow > 5);
    CHECK(unchanged > 1000);
}
