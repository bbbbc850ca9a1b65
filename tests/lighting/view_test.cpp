#include "lighting/view.h"

#include <doctest/doctest.h>

#include <cmath>

#include "raster/cube_face.h"
#include "tests/support/random_numbers.h"

using namespace etalon;

namespace {

// Both sides are a few double operations on numbers of size 1 to 1000.
constexpr double kTolerance = 1e-9;

double row(const glm::dvec4& r, const glm::dvec3& p) { return r.x * p.x + r.y * p.y + r.z * p.z + r.w; }

glm::dvec3 pointOnRay(const View& view, double x_px, double y_px, double depth_m) {
    const double dx = x_px - view.centreX_px, dy = y_px - view.centreY_px;
    glm::dvec3 p;
    for (int k = 0; k < 3; k++)
        p[k] = view.eye[k] + depth_m * (view.forward[k] + dx * view.perX[k] + dy * view.perY[k]);
    return p;
}

void checkThatRaysProjectToTheirPixels(const View& view, RandomNumbers& random, double near_m, double far_m) {
    for (int i = 0; i < 100; i++) {
        const double x = random.uniform(0, view.width), y = random.uniform(0, view.height);
        const double depth_m = random.uniform(near_m, far_m);
        const glm::dvec3 p = pointOnRay(view, x, y, depth_m);
        const double w = row(view.worldToClip[3], p);
        CHECK(w == doctest::Approx(depth_m).epsilon(kTolerance));
        CHECK((row(view.worldToClip[0], p) / w + 1) / 2 * view.width ==
              doctest::Approx(x).epsilon(kTolerance));
        CHECK((1 - row(view.worldToClip[1], p) / w) / 2 * view.height ==
              doctest::Approx(y).epsilon(kTolerance));
        const double z = far_m * (depth_m - near_m) / ((far_m - near_m) * depth_m);
        CHECK(row(view.worldToClip[2], p) / w == doctest::Approx(z).epsilon(kTolerance));
    }
}

// 100 x 100 pixels, looking along -z from (3, -2, 1), with the near plane at 0.25 m.
PinholeCamera squareCamera() {
    PinholeCamera camera;
    camera.width = camera.height = 100;
    camera.fx = camera.fy = 100;
    camera.cx = camera.cy = 50;
    camera.position = {3, -2, 1};
    camera.near_m = 0.25;
    return camera;
}

}  // namespace

TEST_CASE("CameraRaysProjectToTheirPixels") {
    RandomNumbers random(4);
    PinholeCamera camera;
    camera.width = 320;
    camera.height = 200;
    camera.fx = 300;
    camera.fy = 310;
    camera.cx = 150;
    camera.cy = 110.5;
    camera.position = {1, 2, 3};
    // A rotation by 90 degrees about +Y: the camera looks along -X.
    camera.right = {0, 0, -1};
    camera.backward = {1, 0, 0};
    checkThatRaysProjectToTheirPixels(cameraView(camera), random, camera.near_m, camera.far_m);
    const View view = cameraView(camera);
    CHECK(view.forward.x == -1);
}

TEST_CASE("CubeFaceRaysAreTheDirectionsOfTheFaceTable") {
    RandomNumbers random(5);
    CubeFaceKernel<double> kernel;
    for (int face = 0; face < kCubeFaces; face++) {
        const View view = cubeFaceView(static_cast<CubeFace>(face), 64, {3, -1, 2}, 0.5, 20);
        checkThatRaysProjectToTheirPixels(view, random, 0.5, 20);
        for (int i = 0; i < 20; i++) {
            const double s = random.uniform(0, 1), t = random.uniform(0, 1);
            const glm::dvec3 p = pointOnRay(view, s * 64, t * 64, 1);
            const auto direction = kernel.cubeDirection(face, s, t);
            for (int k = 0; k < 3; k++) CHECK(std::fabs(p[k] - view.eye[k] - direction[k]) < kTolerance);
        }
    }
}

TEST_CASE("InfiniteFarPlanePutsPointsAtInfinityAtDepthOne") {
    RandomNumbers random(6);
    PinholeCamera camera = squareCamera();
    const View finite = cameraView(camera), view = withInfiniteFar(finite);
    camera.far_m = HUGE_VAL;
    CHECK(cameraView(camera).worldToClip[2] == view.worldToClip[2]);
    for (int i = 0; i < 100; i++) {
        const glm::dvec3 p(random.uniform(-9, 9), random.uniform(-9, 9), random.uniform(-1e9, 0.7));
        const double w = row(view.worldToClip[3], p), z = row(view.worldToClip[2], p);
        CHECK(z <= w);
        CHECK(z == doctest::Approx(w - 0.25).epsilon(kTolerance));
        CHECK(row(finite.worldToClip[3], p) == w);
        // A direction.
        glm::dvec4 zRow = view.worldToClip[2], wRow = view.worldToClip[3];
        zRow.w = wRow.w = 0;
        CHECK(row(zRow, p) == row(wRow, p));
    }
}

TEST_CASE("ReversedDepthsAreOneOnTheNearPlaneAndZeroOnTheFarOne") {
    RandomNumbers random(7);
    PinholeCamera camera = squareCamera();
    camera.far_m = 4000;
    for (const View& view : {cameraView(camera), withInfiniteFar(cameraView(camera)),
                             cubeFaceView(CubeFace::minusY, 64, {3, -1, 2}, 0.25, 4000)}) {
        const View reversed = inDirection(view, DepthDirection::reversed);
        CHECK(inDirection(reversed, DepthDirection::reversed).worldToClip == reversed.worldToClip);
        CHECK(inDirection(view, DepthDirection::forward).worldToClip == view.worldToClip);
        for (int i = 0; i < 100; i++) {
            const double d = random.uniform(0.25, 4000);
            const glm::dvec3 p = pointOnRay(view, random.uniform(0, 64), random.uniform(0, 64), d);
            const double w = row(reversed.worldToClip[3], p), depth = row(reversed.worldToClip[2], p) / w;
            const double expected = std::isinf(view.far_m) ? 0.25 / w : (4000 / w - 1) * 0.25 / 3999.75;
            CHECK(depth == doctest::Approx(expected).epsilon(1e-9));
        }
    }
}
