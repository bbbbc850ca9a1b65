#include "probes/texel_grid.h"

#include <doctest/doctest.h>

#include <cmath>

#include "numeric/check.h"
#include "numeric/sum.h"

namespace etalon {
namespace {

constexpr double kSphere_sr = 4 * M_PI;

template <class F>
double sumOver(const ProbeShape& shape, F&& value) {
    std::vector<double> values;
    for (int layer = 0; layer < shape.layers(); layer++)
        for (int y = 0; y < shape.height; y++)
            for (int x = 0; x < shape.width; x++) values.push_back(value(layer, x, y));
    return fixedSum(values);
}
double sumOf(const TexelGrid& grid) {
    return sumOver(grid.shape(), [&](int layer, int x, int y) { return grid.solidAngle_sr(layer, x, y); });
}

double length(const glm::dvec3& d) { return std::sqrt(d.x * d.x + d.y * d.y + d.z * d.z); }

}  // namespace

TEST_CASE("SolidAnglesAddUpToTheSphere") {
    for (const int size : {1, 2, 3, 7, 64, 129, 256}) {
        CAPTURE(size);
        for (const Mapping mapping : {Mapping::latLong, Mapping::latLongPedersen, Mapping::cube,
                                      Mapping::angular, Mapping::mirrorBall, Mapping::octahedral}) {
            CAPTURE(static_cast<int>(mapping));
            const double sum = sumOf(TexelGrid({mapping, size, size}));
            CHECK(std::abs(sum / kSphere_sr - 1) <= 1e-14);
        }
        // All but the cone that the ball hides.
        for (const double distance_radii : {1.1, 2.0, 5.0, 1000.0}) {
            const double sum = sumOf(TexelGrid({Mapping::mirrorBall, size, size, distance_radii}));
            const double hidden_sr = 2 * M_PI * (1 - std::sqrt(1 - 1 / (distance_radii * distance_radii)));
            CHECK(std::abs((sum + hidden_sr) / kSphere_sr - 1) <= 1e-14);
        }
    }
}

TEST_CASE("TexelDirectionsAreUnitsInsideTheirTexel") {
    for (const ProbeShape& shape : {ProbeShape{Mapping::latLong, 12, 5},
                                    {Mapping::latLongPedersen, 12, 5},
                                    {Mapping::cube, 9, 9},
                                    {Mapping::angular, 24, 24},
                                    {Mapping::mirrorBall, 24, 24},
                                    {Mapping::mirrorBall, 24, 24, 3},
                                    {Mapping::octahedral, 11, 11}}) {
        CAPTURE(static_cast<int>(shape.mapping));
        const TexelGrid grid(shape);
        MappingKernel<double> kernel;
        const auto settings = mappingSettingsOf<MappingKernel<double>>(shape);
        for (int layer = 0; layer < shape.layers(); layer++)
            for (int y = 0; y < shape.height; y++)
                for (int x = 0; x < shape.width; x++) {
                    const glm::dvec3 d = grid.direction(layer, x, y);
                    REQUIRE(std::abs(length(d) - 1) <= 0x1p-48);
                    REQUIRE((grid.solidAngle_sr(layer, x, y) > 0) == showsDirection(shape, x, y));
                    const double cx = (2.0 * x + 1 - shape.width) / shape.width,
                                 cy = (2.0 * y + 1 - shape.height) / shape.height;
                    if (isDisc(shape.mapping) && cx * cx + cy * cy >= 1) continue;
                    const auto p = kernel.mappingPoint(d, settings);
                    REQUIRE(p.layer == layer);
                    REQUIRE(kernel.nearestTexel(p.u, shape.width) == x);
                    REQUIRE(kernel.nearestTexel(p.v, shape.height) == y);
                }
    }
}

// Each texel's solid angle by the midpoint rule on 64 x 64 parts, from differences of directions.
TEST_CASE("DiscSolidAnglesAreIntegralsOfTheMapping") {
    for (const ProbeShape& shape : {ProbeShape{Mapping::angular, 8, 8},
                                    {Mapping::angular, 7, 7},
                                    {Mapping::mirrorBall, 8, 8},
                                    {Mapping::mirrorBall, 8, 8, 2.5}}) {
        const TexelGrid grid(shape);
        MappingKernel<double> kernel;
        const auto settings = mappingSettingsOf<MappingKernel<double>>(shape);
        constexpr int kParts = 64;
        for (int y = 0; y < shape.height; y++)
            for (int x = 0; x < shape.width; x++) {
                double sum = 0;
                bool isCut = false;
                for (int k = 0; k < kParts * kParts; k++) {
                    const double scale = 2.0 / (shape.width * kParts);
                    const double px = (x * kParts + k % kParts + 0.5) * scale - 1,
                                 py = 1 - (y * kParts + k / kParts + 0.5) * scale;
                    const bool isOn = px * px + py * py < 1;
                    isCut = isCut || !isOn;
                    if (isOn) sum += scale * scale * kernel.discDensity(px, py, settings);
                }
                const double exact = grid.solidAngle_sr(0, x, y);
                // The rule sees the rim in steps, and the density of a near ball grows without limit there.
                const double tolerance = isCut ? 0.05 : shape.ballDistance_radii < 10 ? 2e-3 : 2e-4;
                const double texel_sr = kSphere_sr / (M_PI / 4 * shape.width * shape.width);
                REQUIRE(std::abs(sum - exact) <= tolerance * texel_sr);
            }
    }
    // Constant inside the ball's disc.
    const TexelGrid ball({Mapping::mirrorBall, 16, 16});
    CHECK(std::abs(ball.solidAngle_sr(0, 8, 8) - 4.0 * 4 / (16 * 16)) <= 1e-16);
    CHECK(std::abs(ball.solidAngle_sr(0, 3, 6) - 4.0 * 4 / (16 * 16)) <= 1e-15);
}

// The density against the area of the image of a small square.
TEST_CASE("DiscDensityIsTheJacobianOfTheMapping") {
    for (const ProbeShape& shape : {ProbeShape{Mapping::angular, 4, 4},
                                    {Mapping::mirrorBall, 4, 4},
                                    {Mapping::mirrorBall, 4, 4, 1.2},
                                    {Mapping::mirrorBall, 4, 4, 10}}) {
        const auto settings = mappingSettingsOf<MappingKernel<double>>(shape);
        for (const glm::dvec2 p : {glm::dvec2(0.1, 0.2), {-0.7, 0.3}, {0.05, -0.9}}) {
            const double step = 1e-5;
            const auto at = [&](double dx, double dy) {
                return MappingKernel<double>{}.mappingDirection(0, 0.5 + 0.5 * (p.x + dx),
                                                                0.5 - 0.5 * (p.y + dy), settings);
            };
            const glm::dvec3 a = at(step, 0) - at(-step, 0), b = at(0, step) - at(0, -step);
            const glm::dvec3 cross(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
            const double density = MappingKernel<double>{}.discDensity(p.x, p.y, settings);
            CHECK(std::abs(length(cross) / (4 * step * step) / density - 1) <= 1e-6);
        }
    }
}

// paper_notes: +2.5e-5 and -5.0e-5 at 128 rows; +4.0e-2, +2.4e-4 and +1.5e-5 at 2, 32 and 128 texels along a
// face.
TEST_CASE("MidpointWeightsMissTheSphereByTheirKnownError") {
    const auto latLong = [](RowAngle angle) {
        return sumOver({Mapping::latLong, 256, 128},
                       [&](int, int, int y) { return latLongMidpointSolidAngle_sr(256, 128, y, angle); }) /
                   kSphere_sr -
               1;
    };
    CHECK(std::abs(latLong(RowAngle::centre) - 2.5e-5) <= 0.05e-5);
    CHECK(std::abs(latLong(RowAngle::upperBorder) + 5.0e-5) <= 0.05e-5);
    const auto cube = [](int size) {
        return sumOver({Mapping::cube, size, size},
                       [&](int, int x, int y) { return cubeMidpointSolidAngle_sr(size, x, y); }) /
                   kSphere_sr -
               1;
    };
    CHECK(std::abs(cube(2) - 4.0e-2) <= 0.05e-2);
    CHECK(std::abs(cube(32) - 2.4e-4) <= 0.1e-4);
    CHECK(std::abs(cube(128) - 1.5e-5) <= 0.05e-5);
    const double angular =
        sumOver({Mapping::angular, 128, 128},
                [&](int, int x, int y) { return angularMidpointSolidAngle_sr(128, x, y); }) /
            kSphere_sr -
        1;
    CHECK(std::abs(angular - 5.5e-6) <= 0.1e-6);
}

TEST_CASE("ShapesThatNoMappingHasAreRefused") {
    CHECK_THROWS_AS(TexelGrid({Mapping::cube, 4, 5}), PreconditionError);
    CHECK_THROWS_AS(TexelGrid({Mapping::latLong, 0, 5}), PreconditionError);
    CHECK_THROWS_AS(TexelGrid({Mapping::mirrorBall, 4, 4, 0.5}), PreconditionError);
    CHECK_THROWS_AS(TexelGrid({Mapping::mirrorBall, 4, 4, std::nan("")}), PreconditionError);
}

}  // namespace etalon
