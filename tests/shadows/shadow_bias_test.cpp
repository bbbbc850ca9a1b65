// Acne and detachment.
#include <doctest/doctest.h>

#include <algorithm>

#include "numeric/elementary.h"
#include "shadows/shadow_bias.h"
#include "tests/shadows/shadow_scene.h"

using namespace etalon;
using namespace etalon::test;

namespace {

constexpr ShadowDepth kDepths[] = {ShadowDepth::d16, ShadowDepth::d24, ShadowDepth::d32f,
                                   ShadowDepth::linear};
constexpr double kDegree = 0x1.1df46a2529d39p-6;

// A direction to the light at an angle from +Y, turned about +Y.
glm::dvec3 toLight(double fromNormal_deg, double turn_deg) {
    const double sine = sinOf(fromNormal_deg * kDegree);
    return {sine * cosOf(turn_deg * kDegree), cosOf(fromNormal_deg * kDegree),
            sine * sinOf(turn_deg * kDegree)};
}

// A ground of 2 m that is drawn into its own map, with something below it.
SurfaceScene groundAlone() {
    SurfaceScene scene;
    addObject(scene, tile({0, 0, 0}, 2), lambertian(0.5));
    return scene;
}

// The map of a scene in which every object is drawn, whether it matters or not.
ShadowMap mapOfAll(const SurfaceScene& scene, const SurfaceLight& light, const MapRequest& request) {
    const Profile& profile = *findProfile(request.profile);
    SurfaceScene withReceiver = scene;
    // Behind everything, so that everything matters, and not drawn.
    SurfaceMesh below = tile({0, 0, 0}, 2);
    for (glm::vec3& p : below.positions)
        p = glm::vec3(glm::dvec3(p) - (light.kind == LightKind::directional
                                           ? glm::dvec3(light.toLight.x * 0.05, light.toLight.y * 0.05,
                                                        light.toLight.z * 0.05)
                                           : glm::dvec3(0, 0.05, 0)));
    addObject(withReceiver, below, lambertian(0.5));
    const std::vector<PlacedMesh> placed = placeMeshes(withReceiver, profile.vertex, 1);
    ShadowFit fit = fitShadowMap(placed, light, {}, request.settings);
    REQUIRE(!fit.casters.empty());
    std::erase(fit.casters, static_cast<uint32_t>(scene.instances.size()));
    return renderShadowMap(withReceiver, placed, fit, request.settings, profile, {1, 64, false});
}

int acne(const std::vector<double>& visibility) {
    return static_cast<int>(
        std::count_if(visibility.begin(), visibility.end(), [](double v) { return v != 1.0; }));
}

}  // namespace

// The promise of shadow_bias.h, at its bounds: lit fraction exactly 1 on a plane that is drawn into its own
// map.
TEST_CASE("UnoccludedPlanesAreLitExactlyWhereTheBiasPromisesIt") {
    const LitPoints points = gridOn(0, -0.93, 0.93, 37);
    int acneWithoutBias = 0;
    for (const char* profile : {"f32", "f64", "d3d11"})
        for (const ShadowDepth depth : kDepths)
            for (const double fromNormal_deg : {0.0, 30.0, 60.0, 80.0, 89.0, 89.9})
                for (const double turn_deg : {0.0, 20.0, 45.0})
                    for (const bool isPlane : {true, false}) {
                        MapRequest request;
                        request.profile = profile;
                        request.settings.size = 128;
                        request.settings.depth = depth;
                        request.settings.receiverPlane = isPlane;
                        const SurfaceLight light = sun(toLight(fromNormal_deg, turn_deg));
                        acneWithoutBias +=
                            acne(lookUp(mapOfAll(groundAlone(), light, request), points, profile));
                        request.settings.bias = leastBias(request.settings);
                        CAPTURE(profile);
                        CAPTURE(static_cast<int>(depth));
                        CAPTURE(fromNormal_deg);
                        CAPTURE(turn_deg);
                        CAPTURE(isPlane);
                        CHECK(acne(lookUp(mapOfAll(groundAlone(), light, request), points, profile)) == 0);
                    }
    CHECK(acneWithoutBias > 10000);
}

// The same for a lamp above the plane, in one layer and in a cube.
TEST_CASE("UnoccludedPlanesUnderALampAreLitExactlyToo") {
    const LitPoints points = gridOn(0, -0.93, 0.93, 37);
    for (const SurfaceLight& light :
         {bulb({0.3, 0.7, 0.1}), bulb({0.3, 0.02, 0.1}), torch({0.5, 1.5, 0.2}, {-0.4, -1, 0}, 0.6)})
        for (const ShadowDepth depth : kDepths)
            for (const bool isPlane : {true, false}) {
                MapRequest request;
                request.settings.size = 128;
                request.settings.depth = depth;
                request.settings.receiverPlane = isPlane;
                request.settings.bias = leastBias(request.settings);
                CAPTURE(static_cast<int>(light.kind));
                CAPTURE(light.position_m.y);
                CAPTURE(static_cast<int>(depth));
                CAPTURE(isPlane);
                CHECK(acne(lookUp(mapOfAll(groundAlone(), light, request), points)) == 0);
            }
}

// A flat object that nothing lies behind is not drawn at all: no bias is needed.
TEST_CASE("AGroundThatNothingLiesBehindIsNotDrawn") {
    MapRequest request;
    request.settings.size = 64;
    request.settings.bias = {};
    const LitPoints points = gridOn(0, -0.93, 0.93, 20);
    const SurfaceLight light = sun({0.3, 1, 0.2});
    CHECK(mapOf(groundAlone(), light, request).layers.empty());
    // A ball above it casts, the ground does not.
    SurfaceScene scene = groundAlone();
    addObject(scene, tile({0, 0.5f, 0}, 0.2f), lambertian(0.5));
    const ShadowMap map = mapOf(scene, light, request);
    CHECK(map.triangles == 2);
    const std::vector<double> visibility = lookUp(map, points);
    CHECK(*std::min_element(visibility.begin(), visibility.end()) == 0.0);
    // Two coplanar grounds that overlap: neither is behind the other.
    SurfaceScene twice = groundAlone();
    addObject(twice, tile({0.5f, 0, 0.25f}, 1), lambertian(0.5));
    CHECK(mapOf(twice, light, request).layers.empty());
}

// The larger the bias, the farther from a wall its shadow begins, and never by more than the bias says.
TEST_CASE("DetachmentIsTheBiasOverTheSlope") {
    SurfaceScene scene;
    addObject(scene, tile({0, 0, 0}, 2), lambertian(0.5));
    addObject(scene, rectangle({0, 0.5f, 0}, {0, 0, 1}, {0, 0.5f, 0}), lambertian(0.5));
    // Light from -X, 45 degrees high: the shadow of the wall of 1 m reaches from x = 0 to 1.
    const SurfaceLight light = sun({-1, 1, 0});
    LitPoints points;
    for (int i = 0; i < 2000; i++) {
        const LitPoints one = gridOn(0, 0, 0, 1);
        points.position_m[0].push_back((i + 0.5) / 2000);
        points.position_m[1].push_back(0);
        points.position_m[2].push_back(0.013);
        for (size_t k = 0; k < 3; k++) {
            points.normal[k].push_back(one.normal[k][0]);
            points.faceNormal[k].push_back(one.faceNormal[k][0]);
        }
        points.instance.push_back(0);
        points.x_px.push_back(0), points.y_px.push_back(0);
    }
    double before = 0;
    for (const double offset_m : {0.0, 0.05, 0.1, 0.2}) {
        MapRequest request;
        request.settings.size = 512;
        request.settings.filter = ShadowFilter::hard;
        const ShadowMap unbiased = mapOf(scene, light, request);
        request.settings.depthOffset = offset_m * unbiased.projection.depthScale;
        const std::vector<double> visibility = visibilityOf(scene, light, points, request);
        const auto first = std::find(visibility.begin(), visibility.end(), 0.0);
        const double detachment_m = points.position_m[0][static_cast<size_t>(first - visibility.begin())];
        // A point at x is x / sqrt(2) ... its depth is sqrt(2) x behind the wall where the ray meets it.
        CHECK(detachment_m >= before);
        CHECK(std::fabs(detachment_m - offset_m / std::sqrt(2.0)) < 2.0 / unbiased.projection.scale);
        before = detachment_m;
    }
}
