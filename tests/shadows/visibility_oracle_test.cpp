#include "shadows/visibility_oracle.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "bitcheck/inputs.h"
#include "numeric/check.h"
#include "tests/support/random_numbers.h"
#include "tests/support/shadow_meshes.h"

using namespace etalon;
using namespace etalon::test;

namespace {

VisibilityOracle oracleOf(const std::vector<WorldTriangle>& triangles) { return VisibilityOracle(triangles); }

// The square |x|, |z| <= 1 at height 1.
std::vector<WorldTriangle> square() {
    return {{{{{-1, 1, -1}, {-1, 1, 1}, {1, 1, 1}}}, {0, 0}},
            {{{{-1, 1, -1}, {1, 1, 1}, {1, 1, -1}}}, {0, 1}}};
}

}  // namespace

TEST_CASE("SquareOverAPlaneShadowsItsProjection") {
    const VisibilityOracle oracle = oracleOf(square());
    // From height 3 the square is 3/2 as large on the ground; all numbers are exact.
    for (int j = -40; j <= 40; j++)
        for (int i = -40; i <= 40; i++) {
            const double x = i / 16.0, z = j / 16.0;
            REQUIRE(oracle.isVisible({x, 0, z}, {{0, 3, 0}, false}) ==
                    !(std::fabs(x) <= 1.5 && std::fabs(z) <= 1.5));
            REQUIRE(oracle.isVisible({x, 0, z}, {{0, 7, 0}, true}) ==
                    !(std::fabs(x) <= 1 && std::fabs(z) <= 1));
            REQUIRE(oracle.isVisible({x, 0, z}, {{1, 2, 0}, true}) ==
                    !(std::fabs(x + 0.5) <= 1 && std::fabs(z) <= 1));
        }
}

TEST_CASE("BordersBlockAndEndsDoNot") {
    const VisibilityOracle oracle = oracleOf(square());
    // The common diagonal belongs to both triangles, an edge and a vertex to what they bound.
    CHECK(oracle.blockers({0.5, 0, 0.5}, {{0.5, 2, 0.5}, false}) == 2);
    CHECK(oracle.blockers({1, 0, 0.5}, {{1, 2, 0.5}, false}) == 1);
    CHECK(oracle.blockers({-1, 0, -1}, {{-1, 2, -1}, false}) == 2);
    CHECK(oracle.isVisible({std::nextafter(1.0, 2.0), 0, 0}, {{std::nextafter(1.0, 2.0), 2, 0}, false}));
    // On the triangle, or with the light on it or below it.
    CHECK(oracle.isVisible({0.25, 1, 0}, {{0, 3, 0}, false}));
    CHECK(oracle.isVisible({0.25, 0, 0}, {{0, 1, 0}, false}));
    CHECK(oracle.isVisible({0.25, 0, 0}, {{0, 0.75, 0}, false}));
    // In the plane: edge-on.
    CHECK(oracle.isVisible({-3, 1, 0}, {{3, 1, 0}, false}));
    CHECK(oracle.isVisible({-3, 1, 0}, {{1, 0, 0}, true}));
    // The light is behind the caster, seen from the point.
    CHECK(oracle.isVisible({0, 2, 0}, {{0, 3, 0}, false}));
    CHECK(oracle.isVisible({0, 0, 0}, {{0, -1, 0}, true}));
    // A point that a rounding puts below its own triangle, and without its name.
    const glm::dvec3 below(0.5, 1 - 0x1p-53, 0.25);
    CHECK_FALSE(oracle.isVisible(below, {{0, 3, 0}, false}));
    CHECK(oracle.isVisible(below, {{0.5, 3, 0.25}, false}, {0, 1}));
}

TEST_CASE("TrianglesWithoutAnAreaBlockNothing") {
    const VisibilityOracle oracle = oracleOf(
        {{{{{-1, 1, 0}, {0, 1, 0}, {1, 1, 0}}}, {0, 0}}, {{{{0, 1, 0}, {0, 1, 0}, {0, 1, 0}}}, {0, 1}}});
    CHECK(oracle.isVisible({0, 0, 0}, {{0, 2, 0}, false}));
    CHECK(VisibilityOracle({}).isVisible({0, 0, 0}, {{0, 2, 0}, false}));
}

TEST_CASE("SphereShadowsACircle") {
    // Under a directional light from above the shadow's border is between the polyhedron's inscribed and
    // circumscribed circles.
    const VisibilityOracle oracle = oracleOf(trianglesOf(sphere(64, 32, {0, 2, 0}, 1)));
    const double inner = std::cos(3.14159265358979 / 64);
    RandomNumbers random(3);
    int shadowed = 0;
    for (int n = 0; n < 4000; n++) {
        const double x = random.uniform(-1.5, 1.5), z = random.uniform(-1.5, 1.5), r = std::hypot(x, z);
        const bool visible = oracle.isVisible({x, 0, z}, {{0, 1, 0}, true});
        if (r > 1.000001) REQUIRE(visible);
        if (r < inner) REQUIRE_FALSE(visible);
        shadowed += visible ? 0 : 1;
    }
    CHECK(shadowed > 1000);
}

TEST_CASE("ClosedMeshesHaveNoGaps") {
    // From the middle, exactly through vertices, edges and faces.
    const SurfaceMesh mesh = sphere(16, 8, {0, 0, 0}, 1);
    const VisibilityOracle oracle = oracleOf(trianglesOf(mesh));
    for (const glm::vec3& p : mesh.positions) {
        CHECK_FALSE(oracle.isVisible({0, 0, 0}, {glm::dvec3(p) * 3.0, false}));
        for (const glm::vec3& q : mesh.positions) {
            // Both ends of the pair are floats: their sum in double is exact.
            const glm::dvec3 towards = glm::dvec3(p) + glm::dvec3(q);
            if (std::fabs(towards.x) + std::fabs(towards.y) + std::fabs(towards.z) < 1e-3) continue;
            REQUIRE_FALSE(oracle.isVisible({0, 0, 0}, {towards, true}));
        }
    }
}

TEST_CASE("TheTreeAnswersAsAllTrianglesDo") {
    std::vector<WorldTriangle> triangles = trianglesOf(torusKnotMesh(48, 8));
    for (const WorldTriangle& t : square()) triangles.push_back(t);
    const VisibilityOracle tree(triangles), all(triangles, VisibilityOracle::Search::allTriangles);
    RandomNumbers random(4);
    const auto point = [&] {
        glm::dvec3 p;
        for (int i = 0; i < 3; i++) p[i] = random.uniform(-2, 2);
        return p;
    };
    const auto meshPoint = [&] {
        return triangles[static_cast<size_t>(random.below(static_cast<int>(triangles.size())))]
            .vertices[static_cast<size_t>(random.below(3))];
    };
    size_t blockers = 0;
    for (int n = 0; n < 1500; n++) {
        // Half of them through vertices of the mesh, or parallel to axes.
        const glm::dvec3 p = n % 2 == 0 ? point() : meshPoint();
        const glm::dvec3 q = n % 4 < 2 ? point() : meshPoint();
        glm::dvec3 axis(0);
        axis[n % 3] = n % 5 - 2.5;
        for (const LightSource& light :
             {LightSource{q, false}, LightSource{q, true}, LightSource{axis, true}}) {
            const size_t expected = all.blockers(p, light);
            REQUIRE(tree.blockers(p, light) == expected);
            REQUIRE(tree.isVisible(p, light) == (expected == 0));
            blockers += expected;
        }
    }
    CHECK(blockers > 1000);
}

TEST_CASE("PenumbraOfAStraightEdgeIsLinear") {
    // A half plane at height 1 with its edge at x = 0 below a light of half width 1/4 at height 2.
    const VisibilityOracle oracle = oracleOf({{{{{0, 1, -100}, {-100, 1, 0}, {0, 1, 100}}}, {0, 0}}});
    for (const int n : {4, 16, 64}) {
        const auto light = stratifiedPoints({{0, 2, 0}, {0.25, 0, 0}, {0, 0, 0.25}}, n);
        for (int i = -24; i <= 24; i++) {
            // The line through the edge meets the light at -x.
            const double x = i / 64.0, expected = std::clamp((-x + 0.25) / 0.5, 0.0, 1.0);
            const double fraction = oracle.visibleFraction({x, 0, 0}, light);
            CHECK(std::fabs(fraction - (1 - expected)) <= 1.0 / n);
        }
    }
}

TEST_CASE("LightWithoutAreaIsItsCentre") {
    const VisibilityOracle oracle = oracleOf(square());
    const auto light = stratifiedPoints({{0, 3, 0}, {0, 0, 0}, {0, 0, 0}}, 4);
    for (int i = -32; i <= 32; i++) {
        const glm::dvec3 p(i / 16.0, 0, 0.25);
        CHECK(oracle.visibleFraction(p, light) == (oracle.isVisible(p, {{0, 3, 0}, false}) ? 1.0 : 0.0));
    }
}

TEST_CASE("NumbersBeyondTheRangeOfTheOracleAreRejected") {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const VisibilityOracle oracle = oracleOf(square());
    CHECK_THROWS_AS(oracle.isVisible({0, 0, 0}, {{nan, 1, 0}, false}), PreconditionError);
    CHECK_THROWS_AS(oracle.isVisible({0, 0, HUGE_VAL}, {{0, 1, 0}, false}), PreconditionError);
    CHECK_THROWS_AS(VisibilityOracle({{{{{nan, 0, 0}, {1, 0, 0}, {0, 1, 0}}}, {0, 0}}}), PreconditionError);
}
