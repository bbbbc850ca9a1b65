#include "probes/dominant_lights.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "probes/latlong.h"

namespace etalon {
namespace {

Probe darkProbe(int width, int height) {
    Probe probe;
    probe.shape = {Mapping::latLong, width, height};
    probe.radiance.assign(1, Image<float>(width, height, 3));
    probe.radiance[0].fill(0.01f);
    return probe;
}

double dot(const glm::dvec3& a, const glm::dvec3& b) { return a.x * b.x + (a.y * b.y + a.z * b.z); }

// Radiance r within an angle around a direction, over what is there; supersampling is left to the caller.
void addDisc(Probe& probe, const glm::dvec3& direction, double radius_rad, float r) {
    const LatLongGrid grid(probe.shape.width, probe.shape.height);
    for (int y = 0; y < probe.shape.height; y++)
        for (int x = 0; x < probe.shape.width; x++)
            if (dot(grid.direction(x, y), direction) >= std::cos(radius_rad))
                for (int c = 0; c < 3; c++) probe.radiance[0].at(x, y, c) = r;
}

const DominantLightSearch kFine = {.width = 256, .threshold = 0.25};

}  // namespace

TEST_CASE("DiscsAreFoundWhereTheyAreWithTheirSizeAndEnergy") {
    const glm::dvec3 places[] = {{0.6, 0.64, 0.48}, {0.0, 1.0, 0.0}, {0.0, 0.6, -0.8}, {0.28, -0.96, 0.0}};
    for (const glm::dvec3& place : places) {
        Probe probe = darkProbe(256, 128);
        addDisc(probe, place, 0.2, 100.0f);
        const auto lights = dominantLights(probe, kFine);
        REQUIRE(lights.size() == 1);
        const DominantLight& found = lights[0];
        // Half a texel is 0.012 rad.
        CHECK(dot(found.light.direction, place) >= std::cos(0.006));
        CHECK(std::abs(found.angularRadius_rad - 0.2) <= 0.006);
        CHECK(std::abs(found.light.energy.y / (100.0 * found.light.solidAngle_sr) - 1.0) <= 1e-6);
        CHECK(std::abs(found.peakBrightness - 300.0) <= 1e-3);
    }
}

TEST_CASE("LightsOverASeamOrAPoleAreOne") {
    // At the seam, over a pole, and both borders of the image at once.
    for (const glm::dvec3& place : {glm::dvec3{0, 0, -1}, {0, 1, 0}, {0, -0.8, -0.6}}) {
        Probe probe = darkProbe(64, 32);
        addDisc(probe, place, 0.3, 10.0f);
        CHECK(dominantLights(probe, {.width = 64}).size() == 1);
    }
    // Half a turn apart at the pole's row: neighbours only across the pole.
    Probe probe = darkProbe(64, 32);
    probe.radiance[0].at(5, 0, 0) = 50.0f, probe.radiance[0].at(37, 0, 0) = 50.0f;
    CHECK(dominantLights(probe, {.width = 64}).size() == 1);
    probe.radiance[0].at(37, 0, 0) = 0.0f, probe.radiance[0].at(21, 0, 0) = 50.0f;
    CHECK(dominantLights(probe, {.width = 64}).size() == 2);
}

TEST_CASE("LightsComeInTheOrderOfTheirEnergy") {
    Probe probe = darkProbe(128, 64);
    const glm::dvec3 a{0.6, 0.8, 0.0}, b{0.0, 0.6, 0.8}, c{-0.8, -0.6, 0.0};
    addDisc(probe, a, 0.1, 10.0f), addDisc(probe, b, 0.3, 8.0f), addDisc(probe, c, 0.2, 9.0f);
    const auto lights = dominantLights(probe, {.width = 128, .threshold = 0.5});
    REQUIRE(lights.size() == 3);
    CHECK(dot(lights[0].light.direction, b) >= 0.999);
    CHECK(dot(lights[1].light.direction, c) >= 0.999);
    CHECK(dot(lights[2].light.direction, a) >= 0.999);
    CHECK(dominantLights(probe, {.width = 128, .threshold = 0.5, .maxLights = 2}).size() == 2);
    // What is darker than the threshold, or below, is none.
    CHECK(dominantLights(probe, {.width = 128, .threshold = 0.95}).size() == 1);
    CHECK(dominantLights(probe, {.width = 128, .threshold = 0.5, .minBrightness = 26.0}).size() == 2);
    CHECK(dominantLights(probe, {.width = 128, .threshold = 0.5, .upperHalf = true}).size() == 2);
}

TEST_CASE("CoarseImagesJoinWhatIsClose") {
    Probe probe = darkProbe(256, 128);
    for (int i = 0; i < 4; i++)
        addDisc(probe, LatLongGrid(256, 128).direction(100 + 4 * i, 50), 0.02, 100.0f);
    CHECK(dominantLights(probe, kFine).size() == 4);
    CHECK(dominantLights(probe, {.width = 16, .threshold = 0.25}).size() == 1);
    // A width beyond the probe's is the probe's.
    CHECK(dominantLights(probe, {.width = 10000, .threshold = 0.25}).size() == 4);
}

// The reflection at the ball of [Karlsson2005, sec. 3.1], with x to the right and y upwards.
TEST_CASE("LightsInAMirrorBallLieWhereItReflects") {
    constexpr int kSize = 32;
    for (auto [x, y] : {std::pair{16, 16}, {20, 9}, {4, 12}, {15, 29}}) {
        Probe ball;
        ball.shape = {Mapping::mirrorBall, kSize, kSize};
        ball.radiance.assign(1, Image<float>(kSize, kSize, 3));
        for (int c = 0; c < 3; c++) ball.radiance[0].at(x, y, c) = 10.0f;
        const auto lights = dominantLights(ball, {.width = kSize});
        REQUIRE(lights.size() == 1);
        const double i = (x + 0.5) / kSize, j = (y + 0.5) / kSize;
        const double nz = std::sqrt(-4 * i * i + 4 * i - 1 - 4 * j * j + 4 * j);
        const glm::dvec3 r{2 * nz * (2 * i - 1), -2 * nz * (2 * j - 1),
                           -8 * i * i + 8 * i - 8 * j * j + 8 * j - 3};
        CHECK(dot(lights[0].light.direction, r) >= 1.0 - 1e-12);
        // Every texel of a ball far away shows the same solid angle.
        CHECK(lights[0].light.solidAngle_sr == doctest::Approx(4.0 * 4.0 / (kSize * kSize)).epsilon(1e-9));
    }
}

TEST_CASE("DominantLightsOfDegenerateProbes") {
    Probe probe = darkProbe(16, 8);
    probe.radiance[0].fill(0.0f);
    CHECK(dominantLights(probe).empty());
    probe.radiance[0].fill(-1.0f);
    probe.radiance[0].at(3, 4, 1) = std::numeric_limits<float>::quiet_NaN();
    CHECK(dominantLights(probe).empty());
    // Everywhere alike: one light, of the brightest texel's direction as all cancel.
    probe.radiance[0].fill(2.0f);
    const auto whole = dominantLights(probe);
    REQUIRE(whole.size() == 1);
    CHECK(std::abs(whole[0].light.solidAngle_sr - 4.0 * M_PI) <= 1e-12);
    CHECK(whole[0].texels == 128);
    CHECK(whole[0].light.direction == LatLongGrid(16, 8).direction(0, 0));
    CHECK(std::abs(whole[0].angularRadius_rad - M_PI) <= 1e-6);
    Probe line = darkProbe(1, 5);
    CHECK(dominantLights(line).size() == 1);
    line.shape.mapping = Mapping::cube;
    CHECK_THROWS_AS(dominantLights(line), PreconditionError);
    CHECK_THROWS_AS(dominantLights(probe, {.threshold = 0.0}), PreconditionError);
}

TEST_CASE("DominantLightsAreInTheWorldAndAtTheirDistance") {
    Probe probe = darkProbe(32, 16);
    probe.radiance[0].at(8, 7, 0) = 90.0f;
    probe.distance_m.assign(1, Image<float>(32, 16));
    probe.distance_m[0].fill(2.0f);
    probe.position_m = {1, 1, 1};
    probe.rotation = glm::dmat3(0, 0, -1, 0, 1, 0, 1, 0, 0);
    const auto lights = dominantLights(probe);
    REQUIRE(lights.size() == 1);
    const glm::dvec3 d = LatLongGrid(32, 16).direction(8, 7), world = {d.z, d.y, -d.x};
    CHECK(dot(lights[0].light.direction, world) >= 1.0 - 1e-14);
    REQUIRE(lights[0].light.position_m.has_value());
    CHECK(dot(*lights[0].light.position_m - probe.position_m, world) == doctest::Approx(2.0));
}

}  // namespace etalon
