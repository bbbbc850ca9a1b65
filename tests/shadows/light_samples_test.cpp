#include "shadows/light_samples.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <utility>

#include "numeric/check.h"
#include "numeric/vectors.h"

using namespace etalon;

TEST_CASE("EachCellHoldsOneSampleAndAllHaveTheSameArea") {
    for (const int count : {2, 3, 7, 16, 25, 49, 256, 509, 512, 4096}) {
        const auto samples = stratifiedSamples(count, 7);
        REQUIRE(samples.size() == static_cast<size_t>(count));
        int rows = 1;
        while (rows * (rows + 1) < count) rows++;
        size_t i = 0;
        for (int row = 0; row < rows; row++) {
            const int first = row * count / rows, last = (row + 1) * count / rows, cells = last - first;
            for (int cell = 0; cell < cells; cell++, i++) {
                CHECK(samples[i].x >= static_cast<double>(cell) / cells);
                CHECK(samples[i].x < static_cast<double>(cell + 1) / cells);
                CHECK(samples[i].y >= static_cast<double>(first) / count);
                CHECK(samples[i].y < static_cast<double>(last) / count);
            }
        }
    }
}

TEST_CASE("SquareCountsAreSquareGrids") {
    const auto samples = stratifiedSamples(25, 3);
    for (size_t i = 0; i < 25; i++) {
        CHECK(std::floor(samples[i].x * 5) == static_cast<double>(i % 5));
        CHECK(std::floor(samples[i].y * 5) == static_cast<double>(i / 5));
    }
}

TEST_CASE("SeedsRepeatAndDiffer") {
    CHECK(stratifiedSamples(25, 1) == stratifiedSamples(25, 1));
    CHECK(stratifiedSamples(25, 1) != stratifiedSamples(25, 2));
    CHECK(stratifiedSamples(1, 1) == stratifiedSamples(1, 2));
    CHECK_THROWS_AS(stratifiedSamples(0, 1), PreconditionError);
    CHECK_THROWS_AS(stratifiedSamples(kMaxLightSamples + 1, 1), PreconditionError);
}

TEST_CASE("OneSampleAndPatchesWithoutAreaAreTheCentreToTheBit") {
    RectangularPatch patch{{0.1, 2.3, -0.7}, {0.3, 0.1, 0}, {0, 0, 0.2}};
    CHECK(lightSamples(patch, 1, 5)[0] == glm::dvec4(0.1, 2.3, -0.7, 1));
    patch.halfU_m = patch.halfV_m = glm::dvec3(0);
    for (const glm::dvec4& light : lightSamples(patch, 49, 5)) CHECK(light == glm::dvec4(0.1, 2.3, -0.7, 1));
    SphericalPatch sphere;
    sphere.radius_m = std::numeric_limits<double>::infinity();
    sphere.direction = {0, 3, 4};
    for (const glm::dvec4& light : lightSamples(sphere, 9, 5)) CHECK(light == glm::dvec4(0, 0.6, 0.8, 0));
}

TEST_CASE("SamplesOfARectangleLieOnIt") {
    const RectangularPatch patch{{1, 5, 2}, {0.5, 0, 0}, {0, 0, 0.25}};
    glm::dvec3 sum(0);
    for (const glm::dvec4& light : lightSamples(patch, 1024, 9)) {
        CHECK(std::abs(light.x - 1) <= 0.5);
        CHECK(light.y == 5);
        CHECK(std::abs(light.z - 2) <= 0.25);
        CHECK(light.w == 1);
        for (int c = 0; c < 3; c++) sum[c] += light[c] / 1024;
    }
    CHECK(std::abs(sum.x - 1) < 0.005);
    CHECK(std::abs(sum.z - 2) < 0.0025);
}

TEST_CASE("SamplesOfADiscLieOnItInCellsOfEqualArea") {
    for (const double w : {1.0, 0.0}) {
        const DiscPatch disc{{1, 5, 2, w}, {0, -3, 4}, 0.5};
        int inner = 0;
        for (const glm::dvec4& light : lightSamples(disc, 400, 9)) {
            const glm::dvec3 d(light.x - 1, light.y - 5, light.z - 2);
            CHECK(light.w == w);
            CHECK(std::abs(-3 * d.y + 4 * d.z) < 1e-14);
            const double square = d.x * d.x + (d.y * d.y + d.z * d.z);
            CHECK(square <= 0.25 + 1e-14);
            if (square < 0.125) inner++;
        }
        CHECK(inner == 200);
        CHECK(lightSamples(disc, 1, 9)[0] == disc.centre);
    }
    const DiscPatch point{{0.1, 2.3, -0.7, 1}, {0, 0, 1}, 0};
    for (const glm::dvec4& light : lightSamples(point, 25, 5)) CHECK(light == point.centre);
}

TEST_CASE("SamplesOfASphericalPatchHaveItsRadiusAndAngles") {
    SphericalPatch patch;
    patch.centre_m = {0.5, 0, 0};
    patch.radius_m = 4;
    patch.halfLongitude_rad = 0.3;
    patch.halfLatitude_rad = 0.1;
    for (const glm::dvec3& direction : {glm::dvec3(0, 2, 0), glm::dvec3(1, 1, 0), glm::dvec3(0, 0, -1)}) {
        patch.direction = direction;
        const double length =
            std::sqrt(direction.x * direction.x + direction.y * direction.y + direction.z * direction.z);
        double smallestCosine = 1;
        for (const glm::dvec4& light : lightSamples(patch, 400, 2)) {
            const glm::dvec3 d((light.x - 0.5) / 4, light.y / 4, light.z / 4);
            CHECK(std::abs(d.x * d.x + d.y * d.y + d.z * d.z - 1) < 1e-14);
            const double cosine = (d.x * direction.x + d.y * direction.y + d.z * direction.z) / length;
            CHECK(cosine >= std::cos(0.3) * std::cos(0.1) - 1e-14);
            smallestCosine = std::min(smallestCosine, cosine);
        }
        CHECK(smallestCosine < std::cos(0.29));
    }
}

// 400 samples are 20 x 20 cells, so that each quarter of the longitudes has as many, and each half of the
// latitudes' sines.
TEST_CASE("SamplesOfASphericalPatchFillItsLongitudesAndLatitudesEvenly") {
    SphericalPatch patch;
    patch.radius_m = std::numeric_limits<double>::infinity();
    patch.direction = {0, 0, 1};
    for (const auto& [halfLongitude_rad, halfLatitude_rad] :
         {std::pair(0.3, 0.1), std::pair(1.0, 0.7), std::pair(kPi, kPi / 2)}) {
        patch.halfLongitude_rad = halfLongitude_rad;
        patch.halfLatitude_rad = halfLatitude_rad;
        int inQuarter[4] = {}, above = 0;
        glm::dvec3 mean(0);
        for (const glm::dvec4& light : lightSamples(patch, 400, 2)) {
            const double longitude_rad = std::atan2(light.x, light.z);
            const int quarter = static_cast<int>((longitude_rad / halfLongitude_rad + 1) * 2);
            REQUIRE(quarter >= 0);
            REQUIRE(quarter < 4);
            inQuarter[quarter]++;
            above += light.y > 0 ? 1 : 0;
            for (int c = 0; c < 3; c++) mean[c] += light[c] / 400;
        }
        CAPTURE(halfLongitude_rad);
        for (const int count : inQuarter) CHECK(count == 100);
        CHECK(above == 200);
        // Across the middle the directions cancel, to a twentieth of a cell's extent; along it their mean is the
        // integral of cos(latitude) cos(longitude).
        CHECK(std::abs(mean.x) < 0.05 * 2 * halfLongitude_rad / 20);
        CHECK(std::abs(mean.y) < 0.05 * 2 * std::sin(halfLatitude_rad) / 20);
        const double s = std::sin(halfLatitude_rad);
        const double meanCosLatitude = 0.5 * (std::sqrt(1 - s * s) + std::asin(s) / s);
        CHECK(std::abs(mean.z - meanCosLatitude * std::sin(halfLongitude_rad) / halfLongitude_rad) < 2e-3);
    }
}
