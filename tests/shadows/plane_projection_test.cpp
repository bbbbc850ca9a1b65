#include "shadows/plane_projection.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <glm/vec2.hpp>

#include "numeric/check.h"
#include "numeric/random.h"

using namespace etalon;

namespace {

double dot(const glm::dvec3& a, const glm::dvec3& b) { return a.x * b.x + (a.y * b.y + a.z * b.z); }

glm::dvec3 randomVector(Random& random, double magnitude) {
    glm::dvec3 v;
    for (int c = 0; c < 3; c++) v[c] = random.uniform(-magnitude, magnitude);
    return v;
}

ShadowPlane randomPlane(Random& random) {
    const glm::dvec3 n = randomVector(random, 1);
    const double length = std::sqrt(dot(n, n));
    return {{n.x / length, n.y / length, n.z / length}, random.uniform(-2, 2)};
}

// Where the ray from a light through p meets the plane.
glm::dvec3 rayMeetsPlane(const ShadowPlane& plane, const glm::dvec4& light, const glm::dvec3& p) {
    const glm::dvec3 l(light.x, light.y, light.z);
    const glm::dvec3 way =
        light.w == 0 ? glm::dvec3(-l.x, -l.y, -l.z) : glm::dvec3(p.x - l.x, p.y - l.y, p.z - l.z);
    const double t = -(dot(plane.normal, p) + plane.offset_m) / dot(plane.normal, way);
    return {p.x + t * way.x, p.y + t * way.y, p.z + t * way.z};
}

glm::dvec3 divided(const glm::dvec4& h) { return {h.x / h.w, h.y / h.w, h.z / h.w}; }

double largestDifference(const glm::dvec3& a, const glm::dvec3& b) {
    return std::max({std::abs(a.x - b.x), std::abs(a.y - b.y), std::abs(a.z - b.z)});
}

// Of coordinates up to 8 m, light and point at least 0.1 m apart in height.
constexpr double kProjectionError_m = 1e-11;

}  // namespace

TEST_CASE("OnTheGroundTheMatrixIsThePapersFirstOne") {
    const ProjectionRows m = planeShadowMatrix({{0, 1, 0}, 0}, {2, 5, 3, 1});
    const double expected[4][4] = {{5, -2, 0, 0}, {0, 0, 0, 0}, {0, -3, 5, 0}, {0, -1, 0, 5}};
    for (size_t r = 0; r < 4; r++)
        for (int c = 0; c < 4; c++) CHECK(m[r][c] == expected[r][c]);
}

TEST_CASE("TheMatrixHasThePapersElements") {
    Random random(1);
    for (int i = 0; i < 100; i++) {
        const ShadowPlane plane = randomPlane(random);
        const glm::dvec3 l = randomVector(random, 4), n = plane.normal;
        const double d = plane.offset_m, nl = dot(n, l);
        const ProjectionRows m = planeShadowMatrix(plane, glm::dvec4(l, 1));
        for (int r = 0; r < 3; r++) {
            for (int c = 0; c < 3; c++)
                CHECK(m[static_cast<size_t>(r)][c] == (r == c ? nl + d - l[r] * n[c] : -(l[r] * n[c])));
            CHECK(m[static_cast<size_t>(r)].w == -(l[r] * d));
            CHECK(m[3][r] == -n[r]);
        }
        CHECK(m[3].w == nl);
    }
}

TEST_CASE("ShadowsAreWhereTheRayMeetsThePlane") {
    Random random(2);
    int checked = 0;
    double worst = 0;
    for (int i = 0; i < 20000; i++) {
        const ShadowPlane plane = randomPlane(random);
        const glm::dvec3 p = randomVector(random, 4);
        const bool isDirection = random.chance(0.5);
        const glm::dvec4 light(randomVector(random, isDirection ? 1 : 8), isDirection ? 0 : 1);
        const double towards = dot(plane.normal, {light.x, light.y, light.z});
        const double w = isDirection ? towards : towards - dot(plane.normal, p);
        if (std::abs(w) < 0.1) continue;
        const glm::dvec3 shadow = divided(applyRows(planeShadowMatrix(plane, light), p));
        const glm::dvec3 expected = rayMeetsPlane(plane, light, p);
        const double scale =
            std::max({1.0, std::abs(expected.x), std::abs(expected.y), std::abs(expected.z)});
        worst = std::max(worst, largestDifference(shadow, expected) / scale);
        // On the plane, and w tells whether the point is below the light.
        worst = std::max(worst, std::abs(dot(plane.normal, shadow) + plane.offset_m) / scale);
        CHECK((applyRows(planeShadowMatrix(plane, light), p).w > 0) == (w > 0));
        checked++;
    }
    CHECK(checked > 10000);
    CHECK(worst < kProjectionError_m);
}

TEST_CASE("TheUnitBoxHasTheSameShadowsAndTellsWhatCasts") {
    Random random(3);
    double worst = 0;
    int above = 0, below = 0, beyond = 0;
    for (int i = 0; i < 5000; i++) {
        Parallelogram receiver;
        receiver.corner = randomVector(random, 2);
        receiver.edgeX = randomVector(random, 2);
        receiver.edgeY = randomVector(random, 2);
        const glm::dvec3 x = receiver.edgeX, y = receiver.edgeY;
        const glm::dvec3 n(x.y * y.z - x.z * y.y, x.z * y.x - x.x * y.z, x.x * y.y - x.y * y.x);
        const double area = std::sqrt(dot(n, n));
        if (area < 0.5) continue;
        const bool isDirection = random.chance(0.5);
        glm::dvec4 light(randomVector(random, isDirection ? 1 : 8), isDirection ? 0 : 1);
        // The plane that faces the light.
        ShadowPlane plane{{n.x / area, n.y / area, n.z / area}, 0};
        plane.offset_m = -dot(plane.normal, receiver.corner);
        const glm::dvec3 l(light.x, light.y, light.z);
        double lightHeight = dot(plane.normal, l) + plane.offset_m * light.w;
        if (lightHeight < 0) {
            plane = {{-plane.normal.x, -plane.normal.y, -plane.normal.z}, -plane.offset_m};
            lightHeight = -lightHeight;
        }
        if (lightHeight < 0.1) continue;
        const glm::dvec3 p = randomVector(random, 4);
        const double height = dot(plane.normal, p) + plane.offset_m;
        const double below_m = isDirection ? 1 : lightHeight - height;
        if (std::abs(height) < 0.01 || std::abs(below_m) < 0.1) continue;

        const glm::dvec4 q = applyRows(unitBoxShadowMatrix(receiver, light), p);
        CHECK((q.w > 0) == (below_m > 0));
        if (q.w > 0) CHECK((q.z > q.w) == (height > 0));
        (below_m <= 0 ? beyond : height > 0 ? above : below)++;
        const glm::dvec3 shadow = rayMeetsPlane(plane, light, p);
        const glm::dvec3 c = receiver.corner;
        const glm::dvec3 inBox(c.x + (q.x / q.w * x.x + q.y / q.w * y.x),
                               c.y + (q.x / q.w * x.y + q.y / q.w * y.y),
                               c.z + (q.x / q.w * x.z + q.y / q.w * y.z));
        const double scale = std::max({1.0, std::abs(shadow.x), std::abs(shadow.y), std::abs(shadow.z)});
        worst = std::max(worst, largestDifference(shadow, inBox) / scale);
    }
    CHECK(above > 100);
    CHECK(below > 100);
    CHECK(beyond > 100);
    CHECK(worst < kProjectionError_m);
}

TEST_CASE("CornersOfTheParallelogramAreCornersOfTheUnitBox") {
    const Parallelogram receiver{{1, 0, 2}, {4, 0, 0}, {1, 0, -2}};
    for (const glm::dvec4& light : {glm::dvec4(2, 8, 1, 1), glm::dvec4(1, 2, 0.5, 0)}) {
        const ProjectionRows m = unitBoxShadowMatrix(receiver, light);
        for (const glm::dvec2& ab :
             {glm::dvec2(0, 0), glm::dvec2(1, 0), glm::dvec2(0, 1), glm::dvec2(1, 1)}) {
            const glm::dvec3 p(1 + ab.x * 4 + ab.y, 0, 2 - 2 * ab.y);
            const glm::dvec4 q = applyRows(m, p);
            CHECK(largestDifference({q.x, q.y, q.z}, {ab.x, ab.y, 1}) < 1e-14);
            CHECK(std::abs(q.w - 1) < 1e-14);
        }
    }
    CHECK_THROWS_AS(unitBoxShadowMatrix(receiver, {2, 0, 1, 1}), PreconditionError);
    CHECK_THROWS_AS(unitBoxShadowMatrix({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {0, 1, 0, 1}), PreconditionError);
}

TEST_CASE("FramesAreSeenFromTheFront") {
    Random random(4);
    for (int i = 0; i < 1000; i++) {
        const glm::dvec3 normal = randomVector(random, 3), origin = randomVector(random, 5);
        const PlaneFrame f = planeFrame(origin, normal);
        const glm::dvec3 cross(f.s.y * f.t.z - f.s.z * f.t.y, f.s.z * f.t.x - f.s.x * f.t.z,
                               f.s.x * f.t.y - f.s.y * f.t.x);
        CHECK(largestDifference(cross, {-f.normal.x, -f.normal.y, -f.normal.z}) < 1e-15);
        CHECK(std::abs(dot(f.s, f.normal)) < 1e-15);
        const glm::dvec3 p = randomVector(random, 5), q = f.toFrame(p);
        const glm::dvec3 back = f.toWorld(q.x, q.y);
        CHECK(largestDifference(p, {back.x + q.z * f.normal.x, back.y + q.z * f.normal.y,
                                    back.z + q.z * f.normal.z}) < 1e-14);
        const ShadowPlane plane = f.plane();
        CHECK(std::abs(dot(plane.normal, p) + plane.offset_m - q.z) < 1e-14);
    }
    const PlaneFrame ground = planeFrame({0, 0, 0}, {0, 2, 0});
    CHECK(ground.s == glm::dvec3(1, 0, 0));
    CHECK(ground.t == glm::dvec3(0, 0, 1));
}
