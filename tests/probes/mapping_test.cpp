#include "probes/mapping.h"

#include <ImathBox.h>
#include <ImathVec.h>
#include <OpenEXR/ImfEnvmap.h>
#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "numeric/truth.h"
#include "numeric/truth_elementary.h"
#include "probes/texel_grid.h"
#include "tests/support/random_numbers.h"

namespace etalon {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

glm::dvec3 randomUnit(RandomNumbers& random) {
    for (;;) {
        const glm::dvec3 d(random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0));
        const double square = d.x * d.x + d.y * d.y + d.z * d.z;
        if (square > 1e-4 && square < 1.0) return d / std::sqrt(square);
    }
}

const ProbeShape kShapes[] = {
    {Mapping::latLong, 64, 32},        {Mapping::cube, 16, 16},           {Mapping::angular, 33, 33},
    {Mapping::mirrorBall, 32, 32},     {Mapping::mirrorBall, 32, 32, 20}, {Mapping::mirrorBall, 31, 31, 2},
    {Mapping::mirrorBall, 8, 8, 1.05}, {Mapping::octahedral, 32, 32},     {Mapping::latLongPedersen, 40, 20}};

double distance(const glm::dvec3& a, const glm::dvec3& b) {
    const glm::dvec3 d = a - b;
    return std::sqrt(d.x * d.x + d.y * d.y + d.z * d.z);
}
glm::dvec3 unit(const glm::dvec3& d) { return d / distance(d, {}); }

}  // namespace

TEST_CASE("MappingsMeetTheirFixedDirections") {
    struct Row {
        Mapping mapping;
        glm::dvec3 d;
        double u, v;
    };
    const double quarter = 0.5 * std::sqrt(0.5);
    const Row rows[] = {
        // The middle, the right and the upper neighbour of +Z.
        {Mapping::angular, {0, 0, 1}, 0.5, 0.5},
        {Mapping::angular, {2, 0, 0}, 0.75, 0.5},
        {Mapping::angular, {0, 1, 0}, 0.5, 0.25},
        {Mapping::angular, {0, 0, -1}, 1, 0.5},
        {Mapping::mirrorBall, {0, 0, 1}, 0.5, 0.5},
        {Mapping::mirrorBall, {1, 0, 0}, 0.5 + quarter, 0.5},
        {Mapping::mirrorBall, {0, 1, 0}, 0.5, 0.5 - quarter},
        {Mapping::mirrorBall, {0, 0, -3}, 1, 0.5},
        {Mapping::octahedral, {0, 0, 1}, 0.5, 0.5},
        {Mapping::octahedral, {1, 0, 0}, 1, 0.5},
        {Mapping::octahedral, {0, 1, 0}, 0.5, 0},
        {Mapping::octahedral, {0, 0, -1}, 1, 0},
        // Listing 6.1: s = u, t = 1 - v.
        {Mapping::latLongPedersen, {1, 0, 0}, 0, 0.5},
        {Mapping::latLongPedersen, {0, 0, -1}, 0.25, 0.5},
        {Mapping::latLongPedersen, {-1, 0, 0}, 0.5, 0.5},
        {Mapping::latLongPedersen, {0, 0, 1}, 0.75, 0.5},
    };
    for (const Row& row : rows) {
        MappingKernel<double> kernel;
        const auto settings = mappingSettingsOf<MappingKernel<double>>({row.mapping, 4, 4});
        const auto p = kernel.mappingPoint(row.d, settings);
        CAPTURE(static_cast<int>(row.mapping));
        CAPTURE(row.d.x);
        CAPTURE(row.d.y);
        const double du = std::abs(p.u - row.u);
        CHECK((row.mapping == Mapping::latLongPedersen ? std::min(du, 1 - du) : du) <= 1e-15);
        CHECK(std::abs(p.v - row.v) <= 1e-15);
        CHECK(p.isShown);
    }
    const auto listing = MappingKernel<double>{}.listingDirection(0.3, 0.2);
    CHECK(std::abs(listing.x - std::sin(0.2 * M_PI) * std::cos(0.6 * M_PI)) <= 1e-15);
    CHECK(std::abs(listing.y + std::cos(0.2 * M_PI)) <= 1e-15);
    CHECK(std::abs(listing.z + std::sin(0.2 * M_PI) * std::sin(0.6 * M_PI)) <= 1e-15);
}

TEST_CASE("DirectionsComeBackFromTheirPoint") {
    RandomNumbers random(1);
    for (const ProbeShape& shape : kShapes) {
        MappingKernel<double> kernel;
        const auto settings = mappingSettingsOf<MappingKernel<double>>(shape);
        CAPTURE(static_cast<int>(shape.mapping));
        CAPTURE(shape.ballDistance_radii);
        int hidden = 0;
        for (int i = 0; i < 5000; i++) {
            const glm::dvec3 d = randomUnit(random);
            const auto p = kernel.mappingPoint(3.0 * d, settings);
            hidden += p.isShown ? 0 : 1;
            if (!p.isShown) continue;
            const glm::dvec3 back = unit(kernel.mappingDirection(p.layer, p.u, p.v, settings));
            // Near the rim of a ball directions change fast with the point.
            REQUIRE(distance(back, d) <= 4e-9);
            const bool isNearRim = shape.mapping == Mapping::mirrorBall && d.z < -0.5;
            // Newton's method ends within 2^-50, times how fast the view of a near ball changes.
            if (!isNearRim) REQUIRE(distance(back, d) <= (shape.ballDistance_radii < 2 ? 1e-12 : 1e-13));
        }
        const double k = shape.mapping == Mapping::mirrorBall ? 1 / shape.ballDistance_radii : 0;
        // The cone behind the ball.
        const double share = 0.5 * (1 - std::sqrt(1 - k * k));
        CHECK(std::abs(hidden / 5000.0 - share) <= 4 * std::sqrt(share / 5000.0));
    }
}

// The ray of a pixel, cut with the ball and reflected, in plain geometry.
TEST_CASE("MirrorBallDirectionsAreReflectedRays") {
    RandomNumbers random(2);
    for (const double distance_radii : {1.05, 1.5, 4.0, 100.0, 1e5}) {
        const auto settings =
            mappingSettingsOf<MappingKernel<double>>({Mapping::mirrorBall, 4, 4, distance_radii});
        for (int i = 0; i < 2000; i++) {
            const double x = random.uniform(-1, 1), y = random.uniform(-1, 1);
            if (x * x + y * y > 0.999) continue;
            const double tangent = 1 / std::sqrt(distance_radii * distance_radii - 1);
            const glm::dvec3 eye(0, 0, distance_radii), ray = unit({x * tangent, y * tangent, -1});
            const double b = eye.z * ray.z, root = std::sqrt(b * b - (distance_radii * distance_radii - 1));
            const glm::dvec3 normal = eye + (-b - root) * ray;
            const double along = ray.x * normal.x + ray.y * normal.y + ray.z * normal.z;
            const glm::dvec3 reflected = ray - 2 * along * normal;
            const glm::dvec3 d = MappingKernel<double>{}.ballDirection(x, y, settings);
            REQUIRE(distance(d, reflected) <= 1e-12 * distance_radii * distance_radii);
        }
    }
    // Far away it is the orthographic view: n = (x, y, sqrt(1 - r^2)), 2 n.z n - (0, 0, 1).
    const auto far = mappingSettingsOf<MappingKernel<double>>({Mapping::mirrorBall, 4, 4, kInfinity});
    const glm::dvec3 d = MappingKernel<double>{}.ballDirection(0.6, 0.0, far);
    CHECK(distance(d, {2 * 0.8 * 0.6, 0, 2 * 0.8 * 0.8 - 1}) <= 1e-15);
}

TEST_CASE("CubeDirectionsAgreeWithOpenExr") {
    // OpenEXR's faces are mirror images of the face table: left and right on X and Z, upside down on Y.
    constexpr int kSize = 5;
    const Imath::Box2i window(Imath::V2i(0, 0), Imath::V2i(kSize - 1, 6 * kSize - 1));
    RandomNumbers random(3);
    for (int i = 0; i < 20000; i++) {
        const glm::dvec3 d = randomUnit(random);
        Imf::CubeMapFace face{};
        Imath::V2f inFace;
        Imf::CubeMap::faceAndPixelPosition(
            {static_cast<float>(d.x), static_cast<float>(d.y), static_cast<float>(d.z)}, window, face,
            inFace);
        const Imath::V2f position = Imf::CubeMap::pixelPosition(face, window, inFace);
        const auto c = MappingKernel<double>{}.cubeCoordinates(d);
        REQUIRE(c.face == static_cast<int>(face));
        const bool isY = c.face == 2 || c.face == 3;
        // OpenEXR's pixel positions put the first and last pixel on the face's borders.
        const double x = (isY ? c.s : 1 - c.s) * (kSize - 1), y = (isY ? 1 - c.t : c.t) * (kSize - 1);
        REQUIRE(std::abs(position.x - x) <= 4e-6 * kSize);
        REQUIRE(std::abs(position.y - (c.face * kSize + y)) <= 4e-6 * kSize);
    }
}

TEST_CASE("MappingsInFloatStayBelowTheirErrorBound") {
    RandomNumbers random(4);
    for (const ProbeShape& shape : kShapes) {
        if (shape.mapping == Mapping::mirrorBall && shape.ballDistance_radii < 2) continue;
        CAPTURE(static_cast<int>(shape.mapping));
        CAPTURE(shape.ballDistance_radii);
        double worst = 0;
        for (int i = 0; i < 3000; i++) {
            const glm::dvec3 wide = randomUnit(random);
            const glm::vec<3, float> d(wide);
            const auto p =
                MappingKernel<float>{}.mappingPoint(d, mappingSettingsOf<MappingKernel<float>>(shape));
            const auto t = MappingKernel<Truth>{}.mappingPoint(
                {Truth(d.x), Truth(d.y), Truth(d.z)}, mappingSettingsOf<MappingKernel<Truth>>(shape));
            if (p.layer != t.layer || !p.isShown || !t.isShown) continue;
            const double du = std::abs(p.u - t.u.toDouble());
            worst = std::max({worst, isLatLong(shape.mapping) ? std::min(du, 1 - du) : du,
                              std::abs(p.v - t.v.toDouble())});
        }
        CHECK(worst <= kMappingFloatError);
        CHECK(worst >= 0.125 * kMappingFloatError);
    }
}

TEST_CASE_TEMPLATE("MappingsInLanesGiveTheBitsOfScalars", L, Lanes<float, 16>, Lanes<double, 4>) {
    using S = typename L::Scalar;
    RandomNumbers random(5);
    for (const ProbeShape& shape : kShapes) {
        for (int i = 0; i < 100; i++) {
            S d[3][L::size];
            for (auto& row : d)
                for (S& x : row)
                    x = static_cast<S>(random.below(6) == 0 ? random.below(3) - 1.0 : random.uniform(-1, 1));
            MappingKernel<L> laned;
            MappingKernel<S> scalar;
            const auto settings = mappingSettingsOf<MappingKernel<L>>(shape);
            const auto p = laned.mappingPoint({L::load(d[0]), L::load(d[1]), L::load(d[2])}, settings);
            const auto e = laned.mappingDirection(p.layer, p.u, p.v, settings);
            for (int lane = 0; lane < L::size; lane++) {
                const auto one = mappingSettingsOf<MappingKernel<S>>(shape);
                const auto q = scalar.mappingPoint({d[0][lane], d[1][lane], d[2][lane]}, one);
                const auto f = scalar.mappingDirection(q.layer, q.u, q.v, one);
                REQUIRE(p.layer[lane] == q.layer);
                REQUIRE(p.u[lane] == q.u);
                REQUIRE(p.v[lane] == q.v);
                REQUIRE(p.isShown[lane] == q.isShown);
                for (int c = 0; c < 3; c++) REQUIRE(e[c][lane] == f[c]);
            }
        }
    }
}

TEST_CASE("OctahedralTexelsHaveEqualAreas") {
    // The solid angle of small squares, by the cross product of finite differences.
    const auto settings = mappingSettingsOf<MappingKernel<double>>({Mapping::octahedral, 4, 4});
    RandomNumbers random(6);
    const double step = 1e-4;
    for (int i = 0; i < 2000; i++) {
        const double u = random.uniform(0.01, 0.99), v = random.uniform(0.01, 0.99);
        const double x = std::abs(2 * u - 1), y = std::abs(2 * v - 1);
        // Not across a fold.
        if (std::min({x, y, std::abs(x + y - 1)}) < 1e-3) continue;
        const auto at = [&](double du, double dv) {
            return MappingKernel<double>{}.mappingDirection(0, u + du, v + dv, settings);
        };
        const glm::dvec3 a = at(step, 0) - at(-step, 0), b = at(0, step) - at(0, -step);
        const glm::dvec3 cross(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
        REQUIRE(std::abs(distance(cross, {}) / (4 * step * step) / (4 * M_PI) - 1) <= 1e-5);
    }
}

TEST_CASE("DegenerateDirectionsHaveAPoint") {
    constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
    for (const ProbeShape& shape : kShapes) {
        const auto settings = mappingSettingsOf<MappingKernel<float>>(shape);
        for (const glm::vec<3, float>& d :
             {glm::vec<3, float>(0, 0, 0), {kNan, 0, 0}, {kNan, kNan, kNan}, {0, 0, -1}, {-0.0f, -0.0f, 1}}) {
            const auto p = MappingKernel<float>{}.mappingPoint(d, settings);
            CHECK((p.u >= 0 && p.u <= 1 && p.v >= 0 && p.v <= 1));
        }
    }
}

}  // namespace etalon
