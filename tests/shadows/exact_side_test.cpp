#include "shadows/exact_side.h"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <limits>

#include "tests/support/random_numbers.h"

using namespace etalon;

namespace {

using Wide = __int128;

// Points whose coordinates are whole numbers below 2^40: the determinant fits into 128 bits.
constexpr double kSize = 0x1p40;

int signOf(Wide v) { return v > 0 ? 1 : v < 0 ? -1 : 0; }

Wide whole(double v) { return static_cast<int64_t>(v); }

int integerSide(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& p) {
    std::array<std::array<Wide, 3>, 3> m;
    for (int i = 0; i < 3; i++) {
        m[0][static_cast<size_t>(i)] = whole(p[i]) - whole(a[i]);
        m[1][static_cast<size_t>(i)] = whole(b[i]) - whole(a[i]);
        m[2][static_cast<size_t>(i)] = whole(c[i]) - whole(a[i]);
    }
    return signOf(m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) +
                  m[0][1] * (m[1][2] * m[2][0] - m[1][0] * m[2][2]) +
                  m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]));
}

glm::dvec3 wholePoint(RandomNumbers& random, double size) {
    glm::dvec3 p;
    for (int i = 0; i < 3; i++) p[i] = std::floor(random.uniform(-size, size));
    return p;
}

}  // namespace

TEST_CASE("SidesAreThoseOfExactIntegers") {
    RandomNumbers random(1);
    int onPlane = 0;
    for (int n = 0; n < 20000; n++) {
        // Tiny grids have many points in one plane; large ones are bent by one unit of 2^40.
        const double size = n % 2 == 0 ? 3 : kSize / 4;
        const glm::dvec3 a = wholePoint(random, size), u = wholePoint(random, size),
                         v = wholePoint(random, size);
        glm::dvec3 p = wholePoint(random, size);
        if (n % 4 == 1) p = a + (u - v);
        if (n % 4 == 3) {
            p = a + u;
            p[n % 3] += 1;
        }
        const glm::dvec3 b = a + u, c = a + v;
        const int expected = integerSide(a, b, c, p);
        onPlane += expected == 0 ? 1 : 0;
        REQUIRE(sideOfTriangle(a, b, c, p) == expected);
        REQUIRE(sideOfTriangle(b, a, c, p) == -expected);
        // The line from a through p on one side of b -> c: the same determinant, by its other name.
        REQUIRE(sideOfEdge(a, p, b, c) == expected);
        REQUIRE(sideOfEdge(a, p, c, b) == -expected);
        REQUIRE(sideOfTriangleTowards(a, b, c, p - a) == expected);
        REQUIRE(sideOfEdgeTowards(a, p - a, b, c) == expected);
    }
    CHECK(onPlane > 1000);
}

TEST_CASE("TheLastBitOfACoordinateDecides") {
    // Points of a plane through far corners; products of tails decide.
    const glm::dvec3 a(0.1, 0.2, 0.3), b(1e6 + 0.1, 0.2, 1e6 + 0.3), c(0.1, 1e6 + 0.2, 1e6 + 0.3);
    RandomNumbers random(2);
    for (int n = 0; n < 1000; n++) {
        // Three of these are on a common line with a and b: exactly 0.
        CHECK(sideOfTriangle(a, b, c, a) == 0);
        glm::dvec3 p(random.uniform(0, 1e6), random.uniform(0, 1e6), 0);
        p.z = 0;
        // The height of the plane over p, found by bisection on the exact sign: neighbouring doubles.
        double low = -1e7, high = 1e7;
        while (std::nextafter(low, high) < high) {
            const double middle = low + (high - low) / 2;
            if (middle <= low || middle >= high) break;
            p.z = middle;
            (sideOfTriangle(a, b, c, p) > 0 ? high : low) = middle;
        }
        // z - 0.3 = (x - 0.1) + (y - 0.2) up to the rounding of the corners.
        CHECK(std::fabs(low - (p.x + p.y)) < 1e-8);
        p.z = high;
        REQUIRE(sideOfTriangle(a, b, c, p) == 1);
        p.z = std::nextafter(low, -1e9);
        REQUIRE(sideOfTriangle(a, b, c, p) == -1);
    }
}

TEST_CASE("SidesAreExactAtBothEndsOfTheRange") {
    for (const double scale : {0x1p-240, 0x1p-100, 1.0, 0x1p299}) {
        const glm::dvec3 a(0), b(scale, 0, 0), c(0, scale, 0);
        CHECK(sideOfTriangle(a, b, c, {scale, scale, scale}) == 1);
        CHECK(sideOfTriangle(a, b, c, {scale, scale, 0}) == 0);
        CHECK(sideOfTriangle(a, b, c, {scale, -scale, -0x1p-240}) == -1);
        CHECK(isExactPoint(b));
    }
    CHECK_FALSE(isExactCoordinate(0x1p-241));
    CHECK_FALSE(isExactCoordinate(0x1p301));
    CHECK_FALSE(isExactCoordinate(std::numeric_limits<double>::quiet_NaN()));
    CHECK_FALSE(isExactCoordinate(std::numeric_limits<double>::infinity()));
}
