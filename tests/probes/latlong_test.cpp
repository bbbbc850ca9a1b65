#include "probes/latlong.h"

#include <ImathBox.h>
#include <ImathVec.h>
#include <OpenEXR/ImfEnvmap.h>
#include <doctest/doctest.h>

#include <bit>
#include <cmath>
#include <limits>
#include <vector>

#include "numeric/format.h"
#include "numeric/rounded.h"
#include "numeric/truth.h"
#include "numeric/truth_elementary.h"
#include "tests/support/random_numbers.h"

namespace etalon {
namespace {

// OpenEXR computes in float, with asin and acos.
constexpr double kOpenExrTolerance = 2e-6;

// A data window of one step, over which OpenEXR's pixel positions are u and v.
const Imath::Box2i kUnitWindow(Imath::V2i(0, 0), Imath::V2i(1, 1));

glm::vec<3, double> randomDirection(RandomNumbers& random) {
    for (;;) {
        const glm::vec<3, double> d(random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0),
                                    random.uniform(-1.0, 1.0));
        const double square = d.x * d.x + d.y * d.y + d.z * d.z;
        if (square > 1e-4 && square < 1.0) return d / std::sqrt(square);
    }
}

Image<float> randomLatLong(int width, int height, uint64_t seed) {
    RandomNumbers random(seed);
    Image<float> image(width, height, 3);
    for (float& v : image.values()) v = static_cast<float>(random.uniform(0.0, 10.0));
    return image;
}

template <class T>
glm::vec<3, T> sampled(const Image<float>& image, const glm::vec<3, T>& d,
                       const SamplerSettings& settings = {}) {
    using Kernel = LatLongKernel<T>;
    return Kernel{}.sampleLatLong(TextureView(image), d,
                                  samplingOf<Kernel>(settings, image.width(), image.height()));
}

double distanceModuloOne(double a, double b) {
    const double d = std::abs(a - b);
    return std::min(d, std::abs(1.0 - d));
}

}  // namespace

TEST_CASE("LatLongDirectionsAgreeWithOpenExr") {
    RandomNumbers random(1);
    LatLongKernel<double> kernel;
    for (int i = 0; i < 20000; i++) {
        const glm::vec<3, double> d = randomDirection(random);
        const Imath::V3f direction(static_cast<float>(d.x), static_cast<float>(d.y), static_cast<float>(d.z));
        const Imath::V2f position = Imf::LatLongMap::pixelPosition(kUnitWindow, direction);
        const auto c = kernel.latLongCoordinates(d);
        REQUIRE(std::abs(c.v - position.y) <= kOpenExrTolerance);
        // Longitude blurs near the poles.
        const double ring = std::sqrt(d.x * d.x + d.z * d.z);
        REQUIRE(distanceModuloOne(c.u, position.x) * ring <= kOpenExrTolerance);
    }
}

TEST_CASE("TexelDirectionsAgreeWithOpenExr") {
    for (auto [width, height] : {std::pair{8, 4}, {37, 19}, {1, 1}}) {
        const LatLongGrid grid(width, height);
        for (int y = 0; y < height; y++)
            for (int x = 0; x < width; x++) {
                const Imath::V3f theirs = Imf::LatLongMap::direction(
                    kUnitWindow, Imath::V2f((static_cast<float>(x) + 0.5f) / static_cast<float>(width),
                                            (static_cast<float>(y) + 0.5f) / static_cast<float>(height)));
                const glm::dvec3 ours = grid.direction(x, y);
                REQUIRE(std::abs(ours.x - theirs.x) <= kOpenExrTolerance);
                REQUIRE(std::abs(ours.y - theirs.y) <= kOpenExrTolerance);
                REQUIRE(std::abs(ours.z - theirs.z) <= kOpenExrTolerance);
            }
    }
}

TEST_CASE("LatLongAxesAreWhereTheConventionPutsThem") {
    LatLongKernel<float> kernel;
    struct Row {
        float x, y, z, u, v;
    };
    constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
    const Row rows[] = {{0, 0, 1, 0.5f, 0.5f},   {1, 0, 0, 0.25f, 0.5f},        {-1, 0, 0, 0.75f, 0.5f},
                        {0, 1, 0, 0.5f, 0.0f},   {0, -1, 0, 0.5f, 1.0f},        {0, 1, -0.0f, 0.5f, 0.0f},
                        {0, 0, -1, 0.0f, 0.5f},  {-0.0f, 0, -1, 0.0f, 0.5f},    {0, 0, 0, 0.5f, 0.5f},
                        {1, 0, 1, 0.375f, 0.5f}, {kNan, kNan, kNan, 0.0f, 0.0f}};
    for (const Row& row : rows) {
        const auto c = kernel.latLongCoordinates({row.x, row.y, row.z});
        CHECK(c.u == row.u);
        CHECK(c.v == row.v);
    }
}

TEST_CASE("TexelDirectionsMapBackToTheirTexel") {
    for (auto [width, height] : {std::pair{1, 1}, {2, 1}, {16, 8}, {101, 50}, {1024, 512}}) {
        const LatLongGrid grid(width, height);
        LatLongKernel<float> kernel;
        for (int y = 0; y < height; y++)
            for (int x = 0; x < width; x++) {
                const auto c = kernel.latLongCoordinates(glm::vec<3, float>(grid.direction(x, y)));
                REQUIRE(kernel.nearestTexel(c.u, width, {}) == x);
                REQUIRE(kernel.nearestTexel(c.v, height, {}) == y);
            }
    }
}

TEST_CASE("LatLongGridTilesTheSphere") {
    for (auto [width, height] : {std::pair{1, 1}, {3, 2}, {64, 32}, {257, 129}}) {
        const LatLongGrid grid(width, height);
        double sum = 0.0;
        for (int y = 0; y < height; y++) {
            sum += width * grid.solidAngle_sr(y);
            for (int x = 0; x < width; x++) {
                const glm::dvec3 d = grid.direction(x, y);
                REQUIRE(std::abs(d.x * d.x + (d.y * d.y + d.z * d.z) - 1.0) <= 0x1p-49);
            }
            const double top = std::sin(M_PI * (0.5 - static_cast<double>(y) / height));
            const double bottom = std::sin(M_PI * (0.5 - (y + 1.0) / height));
            REQUIRE(std::abs(grid.solidAngle_sr(y) - 2.0 * M_PI / width * (top - bottom)) <= 1e-14);
        }
        CHECK(std::abs(sum / (4.0 * M_PI) - 1.0) <= 0x1p-48);
    }
}

TEST_CASE("LatLongCoordinatesInFloatStayBelowTheirErrorBound") {
    RandomNumbers random(2);
    double worst = 0.0;
    for (int i = 0; i < 20000; i++) {
        const glm::vec<3, float> d(randomDirection(random));
        const auto c = LatLongKernel<float>{}.latLongCoordinates(d);
        const auto truth = LatLongKernel<Truth>{}.latLongCoordinates({Truth(d.x), Truth(d.y), Truth(d.z)});
        worst = std::max(worst, distanceModuloOne(c.u, truth.u.toDouble()));
        worst = std::max(worst, std::abs(c.v - truth.v.toDouble()));
    }
    CHECK(worst <= kLatLongFloatError);
    CHECK(worst >= 0.25 * kLatLongFloatError);
}

TEST_CASE_TEMPLATE("ConstantEnvironmentSamplesToExactlyItsConstant", R, float, double, Rounded<kFp16>,
                   Rounded<kFp24R300>, Truth) {
    RandomNumbers random(3);
    for (auto [width, height] : {std::pair{1, 1}, {5, 3}, {64, 32}}) {
        Image<float> image(width, height, 3);
        image.fill(0.7f);
        for (int i = 0; i < 1000; i++) {
            auto coordinate = [&] {
                return R(random.below(3) == 0 ? random.below(3) - 1.0 : random.uniform(-1.0, 1.0));
            };
            const glm::vec<3, R> d(coordinate(), coordinate(), coordinate());
            for (Filter filter : {Filter::nearest, Filter::bilinear})
                REQUIRE(sampled(image, d, {filter}).x == R(0.7f));
        }
    }
}

TEST_CASE("EnvironmentIsContinuousAcrossTheSeamAndThePoles") {
    const Image<float> image = randomLatLong(16, 8, 4);
    const double epsilon = 1e-7;
    // Texels differ by at most 10, one texel is at least 1/16 of a turn: 10 * 16 / (2 pi) per radian of
    // longitude.
    const double bound = 10.0 * (16.0 / (2.0 * M_PI) + 8.0 / M_PI) * 2.0 * epsilon + 1e-12;
    RandomNumbers random(5);
    for (int i = 0; i < 2000; i++) {
        // The seam is at x = 0, z < 0.
        const double y = random.uniform(-0.9, 0.9), z = -std::sqrt(1.0 - y * y);
        const auto left = sampled(image, glm::dvec3(-epsilon * z, y, z)),
                   right = sampled(image, glm::dvec3(epsilon * z, y, z));
        for (int c = 0; c < 3; c++) REQUIRE(std::abs(left[c] - right[c]) <= bound);
        // Over a pole along a great circle.
        const double angle_rad = random.uniform(0.0, 2.0 * M_PI), pole = i % 2 == 0 ? 1.0 : -1.0;
        const glm::dvec3 side(epsilon * std::cos(angle_rad), pole, epsilon * std::sin(angle_rad));
        const auto before = sampled(image, side), after = sampled(image, glm::dvec3(-side.x, pole, -side.z));
        for (int c = 0; c < 3; c++) REQUIRE(std::abs(before[c] - after[c]) <= bound + 1e-9);
    }
}

TEST_CASE_TEMPLATE("EnvironmentInLanesGivesTheBitsOfScalars", L, Lanes<float, 4>, Lanes<float, 16>,
                   Lanes<double, 8>) {
    using S = typename L::Scalar;
    using Bits = std::conditional_t<sizeof(S) == 8, uint64_t, uint32_t>;
    const Image<float> image = randomLatLong(13, 6, 6);
    RandomNumbers random(7);
    for (int i = 0; i < 1000; i++) {
        S d[3][L::size];
        for (auto& row : d)
            for (S& x : row) {
                const int kind = random.below(8);
                x = static_cast<S>(kind == 0  ? std::nan("")
                                   : kind < 3 ? random.below(3) - 1.0
                                              : random.uniform(-1.0, 1.0));
            }
        const SamplerSettings settings{i % 2 == 0 ? Filter::nearest : Filter::bilinear, Wrap::clamp,
                                       Wrap::clamp, i % 3 == 0 ? 8 : kExactFraction};
        const auto lanes =
            sampled(image, glm::vec<3, L>(L::load(d[0]), L::load(d[1]), L::load(d[2])), settings);
        for (int k = 0; k < L::size; k++) {
            const auto scalar = sampled(image, glm::vec<3, S>(d[0][k], d[1][k], d[2][k]), settings);
            for (int c = 0; c < 3; c++)
                REQUIRE(std::bit_cast<Bits>(lanes[c][k]) == std::bit_cast<Bits>(scalar[c]));
        }
    }
}

TEST_CASE("CubeFromLatLongShowsTheEnvironment") {
    const Image<float> image = randomLatLong(32, 16, 8);
    for (int size : {1, 5, 8}) {
        const CubeMap<float> cube = cubeFromLatLong(image, size);
        for (int face = 0; face < kCubeFaces; face++)
            for (int y = 0; y < size; y++)
                for (int x = 0; x < size; x++) {
                    // By the face table: the direction of the texel's centre, sampled on its own.
                    const auto d = CubeFaceKernel<float>{}.cubeDirection(
                        face, (static_cast<float>(x) + 0.5f) / static_cast<float>(size),
                        (static_cast<float>(y) + 0.5f) / static_cast<float>(size));
                    const auto value = sampled(image, d);
                    for (int c = 0; c < 3; c++)
                        REQUIRE(cube.faces[static_cast<size_t>(face)].at(x, y, c) == value[c]);
                }
    }
}

TEST_CASE("CubeFromLatLongDependsNeitherOnThreadsNorOnLanes") {
    const Image<float> image = randomLatLong(24, 12, 9);
    for (int parts : {1, 3}) {
        const CubeFromLatLong options{Filter::bilinear, 8, parts};
        const CubeMap<float> scalar = cubeFromLatLong<float>(image, 7, options, 1);
        CHECK(cubeFromLatLong(image, 7, options, 1) == scalar);
        CHECK(cubeFromLatLong(image, 7, options, 3) == scalar);
        CHECK(cubeFromLatLong<Lanes<float, 32>>(image, 7, options, 2) == scalar);
        CHECK(cubeFromLatLong<Rounded<kFp32, Lanes<double, 4>>>(image, 7, options, 2) == scalar);
    }
}

TEST_CASE("SupersampledCubeTexelsAreMeansOfTheirParts") {
    const Image<float> image = randomLatLong(64, 32, 10);
    const CubeMap<float> fine = cubeFromLatLong<double>(image, 12),
                         coarse = cubeFromLatLong<double>(image, 4, {Filter::bilinear, kExactFraction, 3});
    for (size_t face = 0; face < kCubeFaces; face++)
        for (int y = 0; y < 4; y++)
            for (int x = 0; x < 4; x++) {
                double sum = 0.0;
                for (int k = 0; k < 9; k++) sum += fine.faces[face].at(3 * x + k % 3, 3 * y + k / 3);
                REQUIRE(std::abs(coarse.faces[face].at(x, y) - sum / 9.0) <= 2e-6);
            }
    CHECK_THROWS_AS(cubeFromLatLong(Image<float>(4, 2, 1), 4), PreconditionError);
    CHECK_THROWS_AS(cubeFromLatLong(image, 0), PreconditionError);
}

}  // namespace etalon
