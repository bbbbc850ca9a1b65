#include "shadows/planar_shadow.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "numeric/check.h"
#include "tests/shadows/planar_scene.h"

using namespace etalon;
using namespace etalon::test;

namespace {

std::vector<glm::dvec4> pointLight(double x, double y, double z) { return {glm::dvec4(x, y, z, 1)}; }

std::vector<glm::dvec4> squareLight(double x, double y, double z, double half, int count, uint64_t seed = 1) {
    return lightSamples(RectangularPatch{{x, y, z}, {half, 0, 0}, {0, 0, half}}, count, seed);
}

uint64_t sumOf(const BlockedSamples& counts) {
    uint64_t sum = 0;
    for (const uint32_t count : counts.blocked.values()) sum += count;
    return sum;
}

// Whether the segment from p to a light meets a triangle, above the plane: by products in double, no
// rasterizer.
bool isBlocked(const glm::dvec3& p, const glm::dvec4& light, const PlanarCasters& casters) {
    const glm::dvec3 d =
        light.w == 0 ? glm::dvec3(light) : glm::dvec3(light.x - p.x, light.y - p.y, light.z - p.z);
    const auto cross = [](const glm::dvec3& a, const glm::dvec3& b) {
        return glm::dvec3(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
    };
    const auto dot = [](const glm::dvec3& a, const glm::dvec3& b) {
        return a.x * b.x + a.y * b.y + a.z * b.z;
    };
    for (size_t i = 0; i + 2 < casters.indices.size(); i += 3) {
        const glm::dvec3 a = casters.vertices[casters.indices[i]],
                         b = casters.vertices[casters.indices[i + 1]],
                         c = casters.vertices[casters.indices[i + 2]];
        const glm::dvec3 u(b.x - a.x, b.y - a.y, b.z - a.z), v(c.x - a.x, c.y - a.y, c.z - a.z),
            o(p.x - a.x, p.y - a.y, p.z - a.z);
        const glm::dvec3 h = cross(d, v);
        const double det = dot(u, h);
        if (det == 0) continue;
        const double alpha = dot(o, h) / det;
        const glm::dvec3 q = cross(o, u);
        const double beta = dot(d, q) / det, t = dot(v, q) / det;
        if (alpha >= 0 && beta >= 0 && alpha + beta <= 1 && t > 0 && (light.w == 0 || t < 1)) return true;
    }
    return false;
}

// Texels and samples at which the drawn shadow differs from the segments, where four points a 128th of a
// texel away agree with the centre (the rasterizer snaps to 256ths).
struct Disagreement {
    int texels = 0, clear = 0, different = 0;
};
Disagreement compareWithSegments(const PlanarReceiver& receiver, const PlanarCasters& uncut,
                                 const std::vector<glm::dvec4>& lights, const BlockedSamples& counts) {
    Disagreement result;
    const PlanarGrid& grid = counts.grid;
    for (int y = 0; y < grid.height; y++)
        for (int x = 0; x < grid.width; x++) {
            uint32_t blocked = 0;
            bool clear = true;
            for (const glm::dvec4& light : lights) {
                const glm::dvec4 l = receiver.frame.toFrame(light);
                std::array<bool, 5> is{};
                constexpr double kNear = 1.0 / 128;
                const std::array<glm::dvec2, 5> at = {
                    glm::dvec2(0, 0), {kNear, kNear}, {-kNear, kNear}, {kNear, -kNear}, {-kNear, -kNear}};
                for (size_t k = 0; k < 5; k++)
                    is[k] = isBlocked({grid.corner_m.x + (x + 0.5 + at[k].x) * grid.texel_m,
                                       grid.corner_m.y + (y + 0.5 + at[k].y) * grid.texel_m, 0},
                                      l, uncut);
                clear = clear && std::all_of(is.begin(), is.end(), [&](bool b) { return b == is[0]; });
                blocked += is[0] ? 1 : 0;
            }
            result.texels++;
            if (!clear) continue;
            result.clear++;
            if (blocked != counts.blocked.at(x, y)) result.different++;
        }
    return result;
}

}  // namespace

TEST_CASE("ShadowOfASquareHasItsPlace") {
    // Half as high as the light: twice as large.
    Casters casters;
    casters.addSquare(0, 1, 0, 0.25f);
    const PlanarShadow shadow = shadowOn(groundReceiver(), casters, pointLight(0, 2, 0));
    const double texel = shadow.grid.texel_m;
    CHECK(shadow.grid.width <= 1024);
    CHECK(shadow.grid.width * texel < 1.25 * 1.0 * 1.02);
    int wrong = 0;
    for (int y = 0; y < shadow.grid.height; y++)
        for (int x = 0; x < shadow.grid.width; x++) {
            const double s = shadow.grid.corner_m.x + (x + 0.5) * texel,
                         t = shadow.grid.corner_m.y + (y + 0.5) * texel;
            const double outside = std::max(std::abs(s), std::abs(t)) - 0.5;
            if (std::abs(outside) > texel / 128 && (shadow.shadow.at(x, y) == 1) != (outside < 0)) wrong++;
        }
    CHECK(wrong == 0);
}

TEST_CASE("CountsEqualSegmentsToTheLights") {
    // A box through the ground, a tall one that is higher than some lights, a free square, one below the
    // ground.
    Casters casters;
    casters.addBox({-0.5f, -0.3f, -0.4f}, {-0.1f, 0.5f, 0.1f})
        .addBox({0.3f, 0, -0.2f}, {0.4f, 3, 0.2f})
        .addSquare(0.1f, 0.8f, 0.6f, 0.2f)
        .addSquare(0, -0.5f, 0, 1);
    const PlanarReceiver receiver = groundReceiver(1);
    PlanarShadowOptions options;
    options.resolution = 40;
    const PlanarCasters above = casters.above(receiver.frame, 0);
    std::vector<glm::dvec4> lights = squareLight(0.2, 1.7, 0.1, 0.4, 16);
    for (const glm::dvec4& light : lightSamples(SphericalPatch{{0, 0, 0}, 3, {-1, 1, 0.3}, 0.4, 0.4}, 16, 2))
        lights.push_back(light);
    SphericalPatch sun{{0, 0, 0}, std::numeric_limits<double>::infinity(), {1, 2, 0.5}, 0.1, 0.1};
    for (const glm::dvec4& light : lightSamples(sun, 9, 3)) lights.push_back(light);
    for (const char* profile : {"f64", "f32"}) {
        const BlockedSamples counts = countOn(receiver, casters, lights, options, profile);
        CHECK(counts.samples == lights.size());
        const Disagreement d = compareWithSegments(receiver, above, lights, counts);
        CHECK(d.clear > d.texels / 2);
        CHECK(d.different == 0);
    }
}

TEST_CASE("AnyNumberOfSamplesIsCountedOncePerTexel") {
    // A closed box covers each texel several times.
    Casters casters;
    casters.addBox({-0.2f, 0.5f, -0.2f}, {0.2f, 0.9f, 0.2f});
    PlanarShadowOptions options;
    options.resolution = 32;
    for (const int count : {1, 254, 255, 256, 511, 1000}) {
        const BlockedSamples counts =
            countOn(groundReceiver(), casters, squareLight(0, 2, 0, 0, count), options);
        const uint32_t most =
            *std::max_element(counts.blocked.values().begin(), counts.blocked.values().end());
        CHECK(most == static_cast<uint32_t>(count));
        CHECK(sumOf(counts) % static_cast<uint64_t>(count) == 0);
    }
}

TEST_CASE("ALightWithoutAreaIsThePointLightToTheBit") {
    Casters casters;
    casters.addBox({-0.3f, 0.2f, -0.2f}, {0.25f, 0.9f, 0.3f});
    PlanarShadowOptions options;
    options.resolution = 200;
    const PlanarShadow one = shadowOn(groundReceiver(), casters, pointLight(0.3, 2.5, 0.1), options);
    CHECK(shadowOn(groundReceiver(), casters, squareLight(0.3, 2.5, 0.1, 0, 49), options).shadow ==
          one.shadow);
    CHECK(shadowOn(groundReceiver(), casters, squareLight(0.3, 2.5, 0.1, 0.5, 1), options).shadow ==
          one.shadow);
}

TEST_CASE("OrderThreadsAndTilesChangeNoBit") {
    Casters casters;
    casters.addBox({-0.3f, 0.2f, -0.2f}, {0.25f, 0.9f, 0.3f}).addBox({0.5f, -1, 0}, {0.6f, 2, 0.2f});
    PlanarShadowOptions options;
    options.resolution = 150;
    options.blurSigma_m = 0.02;
    std::vector<glm::dvec4> lights = squareLight(0.1, 1.9, 0.2, 0.4, 300);
    const PlanarShadow one = shadowOn(groundReceiver(), casters, lights, options);
    CHECK(shadowOn(groundReceiver(), casters, lights, options, "f32", {3, 16}).shadow == one.shadow);
    CHECK(shadowOn(groundReceiver(), casters, lights, options, "f32", {2, 256}).shadow == one.shadow);
    std::reverse(lights.begin(), lights.end());
    CHECK(shadowOn(groundReceiver(), casters, lights, options).shadow == one.shadow);
}

TEST_CASE("ThreadsChangeNoBitOfManySamples") {
    Casters casters;
    casters.addBox({-0.3f, 0.2f, -0.2f}, {0.25f, 0.9f, 0.3f});
    PlanarShadowOptions options;
    options.resolution = 64;
    const auto lights = squareLight(0.1, 1.9, 0.2, 0.4, 300);
    CHECK(shadowOn(groundReceiver(), casters, lights, options, "f32", {4, 16}).shadow ==
          shadowOn(groundReceiver(), casters, lights, options, "f32", {1, 64}).shadow);
}

TEST_CASE("WithoutCastersThereIsNoShadow") {
    CHECK(shadowOn(groundReceiver(), Casters(), pointLight(0, 1, 0)).shadow.empty());
    Casters casters;
    casters.addSquare(0, 1, 0, 0.5f);
    CHECK(shadowOn(groundReceiver(), casters, {}).shadow.empty());
    CHECK(shadowOn(PlanarReceiver(), casters, pointLight(0, 2, 0)).shadow.empty());
    // The shadow falls beside the receiver.
    CHECK(shadowOn(groundReceiver(0.2), casters, pointLight(-3, 1.5, 0)).shadow.empty());
}

TEST_CASE("LightsInThePlaneAndBelowItLightNothing") {
    Casters casters;
    casters.addBox({-0.3f, -0.5f, -0.3f}, {0.3f, 0.5f, 0.3f});
    CHECK(shadowOn(groundReceiver(), casters, pointLight(1, 0, 0)).shadow.empty());
    CHECK(shadowOn(groundReceiver(), casters, pointLight(1, -2, 0)).shadow.empty());
    CHECK(shadowOn(groundReceiver(), casters, {glm::dvec4(1, 0, 0, 0)}).shadow.empty());
    CHECK(shadowOn(groundReceiver(), casters, {glm::dvec4(0, -1, 0, 0)}).shadow.empty());
    // Those that are above count alone.
    std::vector<glm::dvec4> lights = pointLight(1, 2, 0);
    const PlanarShadow one = shadowOn(groundReceiver(), casters, lights);
    for (const double y : {0.0, -1.0}) lights.emplace_back(1, y, 0, 1);
    CHECK(shadowOn(groundReceiver(), casters, lights).shadow == one.shadow);
}

TEST_CASE("CastersBehindTheLightCastNothing") {
    Casters casters;
    casters.addSquare(0, 3, 0, 0.5f);
    CHECK(sumOf(countOn(groundReceiver(), casters, pointLight(0, 2, 0))) == 0);
    // At the light's height, and through the light itself.
    CHECK(sumOf(countOn(groundReceiver(), casters, pointLight(0.2, 3, 0.1))) == 0);
    casters.addBox({1, 2, -0.1f}, {1.1f, 4, 0.1f});
    CHECK(sumOf(countOn(groundReceiver(), casters, pointLight(0, 2, 0))) == 0);
}

TEST_CASE("CastersThroughTheLightsPlaneCastWhatIsBelow") {
    // A wall that is cut at the light's height: its shadow goes on to the receiver's border.
    Casters tall, high;
    tall.add(rectangle({0.5f, 1, 0}, {0, 1, 0}, {0, 0, 0.25f}));
    high.add(rectangle({0.5f, 10, 0}, {0, 10, 0}, {0, 0, 0.25f}));
    const auto light = pointLight(0, 1, 0);
    const BlockedSamples counts = countOn(groundReceiver(), tall, light);
    CHECK(counts.blocked == countOn(groundReceiver(), high, light).blocked);
    PlanarShadow shadow = shadowOn(groundReceiver(), tall, light);
    CHECK(shadowAt(shadow, 0.49, 0) == 0);
    CHECK(shadowAt(shadow, 0.51, 0) == 1);
    CHECK(shadowAt(shadow, 1.99, 0.98) == 1);
    CHECK(shadowAt(shadow, 1.99, 1.01) == 0);
    CHECK(shadowAt(shadow, -1, 0) == 0);
}

TEST_CASE("CastersBehindThePlaneCastNothing") {
    Casters casters;
    casters.addSquare(0, -0.5f, 0, 0.5f).addBox({0.5f, -2, 0.5f}, {0.8f, -0.1f, 0.8f});
    CHECK(shadowOn(groundReceiver(), casters, pointLight(0, 2, 0)).shadow.empty());
}

TEST_CASE("ACasterThroughThePlaneCastsItsUpperPart") {
    // Corners are multiples of 1/8: the cut is exact.
    Casters through, onTop;
    through.addBox({-0.25f, -0.5f, -0.25f}, {0.25f, 0.5f, 0.25f});
    onTop.addBox({-0.25f, 0, -0.25f}, {0.25f, 0.5f, 0.25f});
    const auto lights = squareLight(0.5, 2, 0.25, 0.5, 64);
    PlanarShadowOptions options;
    options.resolution = 300;
    const BlockedSamples a = countOn(groundReceiver(), through, lights, options);
    CHECK(a.blocked == countOn(groundReceiver(), onTop, lights, options).blocked);
    // No light leaks in where it stands: every texel inside is dark for every sample.
    int lit = 0;
    for (int y = 0; y < a.grid.height; y++)
        for (int x = 0; x < a.grid.width; x++) {
            const double s = a.grid.corner_m.x + (x + 0.5) * a.grid.texel_m,
                         t = a.grid.corner_m.y + (y + 0.5) * a.grid.texel_m;
            if (std::max(std::abs(s), std::abs(t)) < 0.25 - a.grid.texel_m / 128 && a.blocked.at(x, y) != 64)
                lit++;
        }
    CHECK(lit == 0);
}

TEST_CASE("CoplanarCastersCastNothing") {
    Casters casters;
    casters.addSquare(0, 0, 0, 0.5f);
    CHECK(shadowOn(groundReceiver(), casters, pointLight(0, 2, 0)).shadow.empty());
    casters.addSquare(0, 0.9e-5f, 0, 0.5f);
    CHECK(shadowOn(groundReceiver(), casters, pointLight(0, 2, 0)).shadow.empty());
    Casters above;
    above.addSquare(0, 1.1e-5f, 0, 0.5f);
    CHECK(shadowAt(shadowOn(groundReceiver(), above, pointLight(0, 2, 0)), 0.2, 0.2) == 1);
    PlanarShadowOptions exact;
    exact.contact_m = 0;
    CHECK(!shadowOn(groundReceiver(), casters, pointLight(0, 2, 0), exact).shadow.empty());
}

TEST_CASE("NonFiniteLightsAreRefusedAndNonFiniteCastersAreDropped") {
    Casters casters;
    casters.addSquare(0, 1, 0, 0.5f);
    constexpr double kNan = std::numeric_limits<double>::quiet_NaN(),
                     kInfinity = std::numeric_limits<double>::infinity();
    for (const double bad : {kNan, kInfinity, -kInfinity}) {
        CHECK_THROWS_AS(shadowOn(groundReceiver(), casters, pointLight(bad, 2, 0)), PreconditionError);
        CHECK_THROWS_AS(shadowOn(groundReceiver(), casters, pointLight(0, bad, 0)), PreconditionError);
        CHECK_THROWS_AS(shadowOn(groundReceiver(), casters, {glm::dvec4(0, 1, 0, bad)}), PreconditionError);
    }
    SurfaceMesh broken = rectangle({0, 1, 0}, {0.5f, 0, 0}, {0, 0, 0.5f});
    broken.positions[1].y = std::numeric_limits<float>::quiet_NaN();  // of the first triangle only
    Casters half;
    half.add(broken);
    const BlockedSamples whole = countOn(groundReceiver(), casters, pointLight(0, 2, 0));
    const double part = static_cast<double>(sumOf(countOn(groundReceiver(), half, pointLight(0, 2, 0)))) /
                        static_cast<double>(sumOf(whole));
    CHECK(std::abs(part - 0.5) < 0.01);
}

TEST_CASE("AVeryFarLightIsADirection") {
    // 1e8 m away: seen from 4 m apart its direction changes by 4e-8, less than a hundredth of a texel. In
    // single precision the light's coordinates and the products round: some texels on edges may change.
    Casters casters;
    casters.addBox({-0.3f, 0.2f, -0.2f}, {0.25f, 0.9f, 0.3f});
    const glm::dvec3 d(0.48, 0.6, 0.64);
    const std::vector<glm::dvec4> direction = {glm::dvec4(d, 0)};
    const auto far = pointLight(d.x * 1e8, d.y * 1e8, d.z * 1e8);
    for (const char* profile : {"f64", "f32"}) {
        const BlockedSamples a = countOn(groundReceiver(), casters, direction, {}, profile),
                             b = countOn(groundReceiver(), casters, far, {}, profile);
        REQUIRE(a.grid.width == b.grid.width);
        REQUIRE(a.grid.corner_m == b.grid.corner_m);
        int different = 0;
        for (size_t i = 0; i < a.blocked.values().size(); i++)
            if (a.blocked.values()[i] != b.blocked.values()[i]) different++;
        CHECK(sumOf(a) > 100000);
        CHECK(different <= 16);
        // And the arithmetics agree up to edges: their length in texels, times 2^-23 of a texture in
        // subpixels, rounded.
        const BlockedSamples exact = countOn(groundReceiver(), casters, direction, {}, "f64");
        different = 0;
        for (size_t i = 0; i < a.blocked.values().size(); i++)
            if (a.blocked.values()[i] != exact.blocked.values()[i]) different++;
        CHECK(different <= 16);
    }
}

TEST_CASE("AGrazingLightCastsToTheReceiversBorder") {
    // 89.9 degrees from the normal: the shadow of a box of 10 cm is 57 m long; the receiver ends after 2 m.
    Casters casters;
    casters.addBox({-0.05f, 0, -0.05f}, {0.05f, 0.1f, 0.05f});
    const double angle = 89.9 * 3.14159265358979 / 180;
    const PlanarShadow shadow =
        shadowOn(groundReceiver(), casters, {glm::dvec4(-std::sin(angle), std::cos(angle), 0, 0)});
    for (const double s : {0.0, 0.5, 1.0, 1.9})
        for (const double t : {-0.045, 0.0, 0.045}) CHECK(shadowAt(shadow, s, t) == 1);
    for (const double s : {-1.0, -0.06, 1.0}) CHECK(shadowAt(shadow, s, s < 0 ? 0.0 : 0.06) == 0);
}

TEST_CASE("BlurKeepsLitTexelsExactlyLitAndTheSum") {
    Casters casters;
    casters.addSquare(0, 1, 0, 0.2f);
    PlanarShadowOptions options;
    options.resolution = 256;
    const PlanarShadow sharp = shadowOn(groundReceiver(), casters, pointLight(0, 2, 0), options);
    options.blurSigma_m = 0.03;
    for (const char* profile : {"f32", "f64", "nv40-fp16", "r300-fp24"}) {
        const PlanarShadow soft = shadowOn(groundReceiver(), casters, pointLight(0, 2, 0), options, profile);
        CHECK(shadowAt(soft, 0, 0) > 0.99);
        CHECK(shadowAt(soft, 0.4, 0) == doctest::Approx(0.5).epsilon(0.1));
        CHECK(shadowAt(soft, 0.4 + 0.1, 0) == 0);
        float largest = 0, border = 0;
        double sumSoft = 0, sumSharp = 0;
        for (const float v : soft.shadow.values())
            largest = std::max(largest, v), sumSoft += static_cast<double>(v);
        for (const float v : sharp.shadow.values()) sumSharp += static_cast<double>(v);
        for (int i = 0; i < soft.grid.width; i++)
            border = std::max({border, soft.shadow.at(i, 0), soft.shadow.at(i, soft.grid.height - 1)});
        CHECK(largest <= 1);
        CHECK(border == 0);
        const double scale =
            soft.grid.texel_m * soft.grid.texel_m / (sharp.grid.texel_m * sharp.grid.texel_m);
        CHECK(std::abs(sumSoft * scale / sumSharp - 1) < 0.02);
    }
}

TEST_CASE("PenumbraOfAnEdgeIsTheLightsVisiblePart") {
    // A half plane 1 m high under a square light of 2 a = 0.4 m that is 2 m high: across the edge the shadow
    // rises linearly over 0.4 m. A straight edge cuts one column of the grid of samples: error below 1 /
    // columns, and half a texel's rise.
    Casters casters;
    casters.add(rectangle({-2, 1, 0}, {2, 0, 0}, {0, 0, 4}));
    for (const int columns : {5, 16, 64}) {
        PlanarShadowOptions options;
        options.resolution = 512;
        const PlanarShadow shadow =
            shadowOn(groundReceiver(1), casters, squareLight(0, 2, 0, 0.2, columns * columns), options);
        const double rise = shadow.grid.texel_m / 0.4;
        double worst = 0;
        for (double s = -0.4; s < 0.4; s += 0.01) {
            const int x = static_cast<int>(std::floor((s - shadow.grid.corner_m.x) / shadow.grid.texel_m));
            if (x < 0 || x >= shadow.grid.width) continue;
            const double centre = shadow.grid.corner_m.x + (x + 0.5) * shadow.grid.texel_m;
            const double expected = std::clamp(0.5 - centre / 0.4, 0.0, 1.0);
            worst = std::max(worst, std::abs(shadowAt(shadow, centre, 0) - expected));
        }
        CHECK(worst < 1.0 / columns + rise);
        CHECK(worst > 0);
    }
}

TEST_CASE("ALightThatMovesLessThanATexelChangesLittle") {
    // The penumbra is some 60 texels wide; a step of the light moves it by a sixteenth of a texel. Nothing
    // may jump: the texels stay where they are, and each changes by few of its 256 samples.
    Casters casters;
    casters.addBox({-0.3f, 0.2f, -0.2f}, {0.25f, 0.6f, 0.3f});
    PlanarShadowOptions options;
    options.resolution = 256;
    PlanarShadow before;
    double worst = 0, mean = 0;
    for (int step = 0; step <= 16; step++) {
        const double x = 0.2 + step * 0.0006;
        PlanarShadow now = shadowOn(groundReceiver(1), casters, squareLight(x, 2, 0, 0.4, 256), options);
        if (step > 0) {
            REQUIRE(now.grid.texel_m == before.grid.texel_m);
            double sum = 0;
            for (double s = -0.9; s < 0.9; s += 0.005)
                for (double t = -0.9; t < 0.9; t += 0.005) {
                    const double change = std::abs(shadowAt(now, s, t) - shadowAt(before, s, t));
                    worst = std::max(worst, change);
                    sum += change;
                }
            mean = std::max(mean, sum / (360 * 360));
        }
        before = std::move(now);
    }
    CHECK(worst > 0);
    CHECK(worst <= 6.0 / 256);
    CHECK(mean < 0.25 / 256);
}

TEST_CASE("SeveralPositionsInATexelAverageTheShadow") {
    Casters casters;
    casters.addSquare(0, 1, 0, 0.2f);
    PlanarShadowOptions options;
    options.resolution = 64;
    for (const int positions : {1, 4, 16}) {
        options.samplesPerTexel = positions;
        const BlockedSamples counts = countOn(groundReceiver(), casters, pointLight(0, 2, 0), options);
        CHECK(counts.samples == static_cast<uint32_t>(positions));
        const double area =
            static_cast<double>(sumOf(counts)) / positions * counts.grid.texel_m * counts.grid.texel_m;
        CHECK(std::abs(area - 0.64) < 4 * 0.8 * counts.grid.texel_m / positions);
    }
}

TEST_CASE("TheSizeOfATexelCanBeGiven") {
    Casters casters;
    casters.addSquare(0, 1, 0, 0.2f);
    PlanarShadowOptions options;
    options.texel_m = 0.01;
    const PlanarShadow shadow = shadowOn(groundReceiver(), casters, pointLight(0, 2, 0), options);
    CHECK(shadow.grid.texel_m == 0.01);
    CHECK(shadow.grid.width < 90);
    options.resolution = 64;
    const PlanarShadow coarse = shadowOn(groundReceiver(), casters, pointLight(0, 2, 0), options);
    CHECK(coarse.grid.texel_m == 0.02);
    CHECK(coarse.grid.width <= 64);
}

TEST_CASE("OptionsOutOfRangeAreRefused") {
    Casters casters;
    casters.addSquare(0, 1, 0, 0.2f);
    for (const int resolution : {0, kMinPlanarResolution - 1, kMaxPlanarResolution + 1}) {
        PlanarShadowOptions options;
        options.resolution = resolution;
        CHECK_THROWS_AS(shadowOn(groundReceiver(), casters, pointLight(0, 2, 0), options), PreconditionError);
    }
    PlanarShadowOptions options;
    options.blurSigma_m = -1;
    CHECK_THROWS_AS(shadowOn(groundReceiver(), casters, pointLight(0, 2, 0), options), PreconditionError);
    options.blurSigma_m = 0;
    options.contact_m = std::numeric_limits<double>::quiet_NaN();
    CHECK_THROWS_AS(shadowOn(groundReceiver(), casters, pointLight(0, 2, 0), options), PreconditionError);
}
