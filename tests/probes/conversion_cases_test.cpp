// Hard cases of probes/convert.h: few texels, poles, seams, holes, non-finite texels, distances, orientation.
#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "numeric/check.h"
#include "probes/convert.h"
#include "probes/texel_grid.h"
#include "tests/support/random_numbers.h"

namespace etalon {
namespace {

Image<float> randomImage(int width, int height, uint64_t seed) {
    RandomNumbers random(seed);
    Image<float> image(width, height, 3);
    for (float& v : image.values()) v = static_cast<float>(random.uniform(0, 10));
    return image;
}

}  // namespace

TEST_CASE("ProbesOfOneTexelConvert") {
    for (const ProbeShape& shape : {ProbeShape{Mapping::latLong, 1, 1},
                                    {Mapping::latLong, 1, 8},
                                    {Mapping::latLong, 7, 1},
                                    {Mapping::cube, 1, 1},
                                    {Mapping::angular, 1, 1},
                                    {Mapping::mirrorBall, 1, 1},
                                    {Mapping::octahedral, 1, 1}})
        for (const ProbeShape& to : {ProbeShape{Mapping::latLong, 1, 1},
                                     {Mapping::latLong, 5, 3},
                                     {Mapping::cube, 1, 1},
                                     {Mapping::mirrorBall, 3, 3}})
            for (const Resampling resampling :
                 {Resampling::nearest, Resampling::bilinear, Resampling::area}) {
                Probe probe;
                probe.shape = shape;
                for (int layer = 0; layer < shape.layers(); layer++)
                    probe.radiance.push_back(randomImage(shape.width, shape.height, 1));
                const Probe result = convertProbe(probe, {to, glm::dmat3(1), resampling});
                for (const Image<float>& layer : result.radiance)
                    for (const float v : layer.values()) REQUIRE((v >= 0 && v <= 10));
                CHECK(result.valid.empty());
            }
}

TEST_CASE("NonFiniteTexelsReachOnlyTheirNeighbourhood") {
    for (const float bad :
         {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
        Image<float> image = randomImage(32, 16, 2);
        image.at(9, 8, 1) = bad;
        const Probe result = convertProbe(probeOf(image, Mapping::latLong),
                                          {{Mapping::cube, 16, 16}, glm::dmat3(1), Resampling::bilinear});
        int count = 0;
        const TexelGrid grid(result.shape);
        for (int layer = 0; layer < 6; layer++)
            for (int y = 0; y < 16; y++)
                for (int x = 0; x < 16; x++) {
                    const Image<float>& face = result.radiance[static_cast<size_t>(layer)];
                    REQUIRE(std::isfinite(face.at(x, y, 0)));
                    if (std::isfinite(face.at(x, y, 1))) continue;
                    count++;
                    const auto c = LatLongKernel<double>{}.latLongCoordinates(grid.direction(layer, x, y));
                    REQUIRE(std::abs(c.u * 32 - 9.5) < 1);
                    REQUIRE(std::abs(c.v * 16 - 8.5) < 1);
                }
        CHECK(count > 0);
    }
}

// Texels left of the seam, and above the pole over it, are as near as those beside them.
TEST_CASE("ConversionsHaveNoSeams") {
    // Smooth, and different on all sides.
    const auto smooth = [](const glm::dvec3& d) { return 1 + d.x + 0.5 * d.y * d.z + 0.3 * d.z; };
    for (const Mapping from : {Mapping::latLong, Mapping::cube, Mapping::octahedral}) {
        const ProbeShape shape{from, from == Mapping::latLong ? 64 : 32, 32};
        const TexelGrid texels(shape);
        Probe probe;
        probe.shape = shape;
        for (int layer = 0; layer < shape.layers(); layer++) {
            probe.radiance.emplace_back(shape.width, shape.height, 3);
            for (int y = 0; y < shape.height; y++)
                for (int x = 0; x < shape.width; x++)
                    probe.radiance.back().at(x, y) =
                        static_cast<float>(smooth(texels.direction(layer, x, y)));
        }
        // All texels, those over borders too, are within the error of bilinear blending.
        const Probe result =
            convertProbe(probe, {{Mapping::octahedral, 101, 101}, glm::dmat3(1), Resampling::bilinear});
        const TexelGrid grid(result.shape);
        double worst = 0;
        for (int y = 0; y < 101; y++)
            for (int x = 0; x < 101; x++)
                worst = std::max(worst, std::abs(static_cast<double>(result.radiance[0].at(x, y)) -
                                                 smooth(grid.direction(0, x, y))));
        CAPTURE(static_cast<int>(from));
        // A seam of one texel would show as 0.1.
        CHECK(worst <= (from == Mapping::octahedral ? 0.06 : 0.02));
    }
}

TEST_CASE("BlindSpotsBehindABallAreNotValid") {
    Probe ball = probeOf(randomImage(64, 64, 3), Mapping::mirrorBall);
    ball.shape.ballDistance_radii = 3;
    for (const Resampling resampling : {Resampling::nearest, Resampling::bilinear, Resampling::area}) {
        const Probe result = convertProbe(ball, {{Mapping::latLong, 64, 32}, glm::dmat3(1), resampling});
        REQUIRE(result.valid.size() == 1);
        const TexelGrid grid(result.shape);
        for (int y = 0; y < 32; y++)
            for (int x = 0; x < 64; x++) {
                // The cone of half angle asin(1 / 3) around -Z; by area a texel may be partly outside.
                const double cosine = -grid.direction(0, x, y).z, edge = std::sqrt(1 - 1.0 / 9), texel = 0.06;
                const bool isShown = result.valid[0].at(x, y) != 0;
                if (cosine < edge) REQUIRE(isShown);
                if (cosine > edge + (resampling == Resampling::area ? texel : 0)) REQUIRE(!isShown);
                if (!isShown) REQUIRE(result.radiance[0].at(x, y) == 0);
            }
    }
}

TEST_CASE("TexelsThatAreNotValidGiveNothing") {
    Probe probe = probeOf(randomImage(16, 8, 4), Mapping::latLong);
    probe.valid.emplace_back(16, 8, 1);
    // The upper half; NaN where nothing was seen.
    for (int y = 0; y < 8; y++)
        for (int x = 0; x < 16; x++) {
            probe.valid[0].at(x, y) = y < 4 ? 1 : 0;
            if (y >= 4) probe.radiance[0].at(x, y) = std::nanf("");
        }
    const Probe result = convertProbe(probe, {{Mapping::cube, 8, 8}, glm::dmat3(1), Resampling::bilinear});
    REQUIRE(result.valid.size() == 6);
    for (size_t face = 0; face < 6; face++)
        for (const float v : result.radiance[face].plane(0)) REQUIRE(std::isfinite(v));
    CHECK(result.valid[2].at(4, 4) == 1);
    CHECK(result.valid[3].at(4, 4) == 0);
    CHECK(result.radiance[3].at(4, 4) == 0);
}

TEST_CASE("DistancesAreThoseOfTheNearestTexel") {
    Probe probe = probeOf(randomImage(16, 8, 5), Mapping::latLong);
    probe.distance_m.emplace_back(16, 8, 1);
    for (int i = 0; i < 128; i++)
        probe.distance_m[0].values()[static_cast<size_t>(i)] = static_cast<float>(i + 1);
    probe.distance_m[0].at(3, 3) = std::numeric_limits<float>::infinity();
    const Probe result = convertProbe(probe, {{Mapping::cube, 9, 9}});
    REQUIRE(result.distance_m.size() == 6);
    const TexelGrid grid(result.shape);
    for (int face = 0; face < 6; face++)
        for (int y = 0; y < 9; y++)
            for (int x = 0; x < 9; x++) {
                const auto c =
                    LatLongKernel<float>{}.latLongCoordinates(glm::vec<3, float>(grid.direction(face, x, y)));
                const int column = std::min(15, static_cast<int>(c.u * 16)),
                          row = std::min(7, static_cast<int>(c.v * 8));
                // Not where the direction's rounding decides.
                const double du = std::abs(c.u * 16 - std::round(c.u * 16)),
                             dv = std::abs(c.v * 8 - std::round(c.v * 8));
                if (std::min(du, dv) < 1e-5) continue;
                REQUIRE(result.distance_m[static_cast<size_t>(face)].at(x, y) ==
                        probe.distance_m[0].at(column, row));
            }
}

// A probe seen from a turned frame, and turned back.
TEST_CASE("RotationsTakeDirectionsToTheWorld") {
    const Image<float> image = randomImage(16, 8, 6);
    Probe probe = probeOf(image, Mapping::latLong);
    // A quarter turn about +Y: the probe's own +Z is the world's +X.
    probe.rotation = glm::dmat3(glm::dvec3(0, 0, -1), glm::dvec3(0, 1, 0), glm::dvec3(1, 0, 0));
    const Probe world = convertProbe(probe, {probe.shape, glm::dmat3(1), Resampling::nearest});
    // The probe's middle column borders are at u = 1/2; +X of the world is at u = 1/4.
    for (int y = 0; y < 8; y++)
        for (int x = 0; x < 16; x++) REQUIRE(world.radiance[0].at(x, y) == image.at((x + 4) % 16, y));
    const Probe back = convertProbe(world, {probe.shape, probe.rotation, Resampling::nearest});
    CHECK(back.radiance[0] == image);
    CHECK(back.rotation == probe.rotation);
}

TEST_CASE("ListingPathIsOneLookupPerTexel") {
    CubeMap<float> cube(8, 3);
    for (size_t f = 0; f < 6; f++) cube.faces[f] = randomImage(8, 8, 7 + f);
    const Image<float> listing = latLongFromCube(cube, 20, 10);
    // The same convention by the other pass, whose sines come from tables.
    const Probe converted = convertProbe(
        probeOf(cube), {{Mapping::latLongPedersen, 20, 10}, glm::dmat3(1), Resampling::bilinear});
    double worst = 0;
    for (size_t i = 0; i < listing.values().size(); i++)
        worst = std::max(
            worst, std::abs(static_cast<double>(listing.values()[i] - converted.radiance[0].values()[i])));
    CHECK(worst <= 1e-4);
    // +X at the left border, +Y on top.
    const auto nearest = latLongFromCube(cube, 64, 32, {Filter::nearest});
    CHECK(nearest.at(0, 16) == cube.faces[0].at(4, 4));
    CHECK(nearest.at(16, 16) == cube.faces[5].at(4, 4));
    CHECK(nearest.at(5, 0, 2) == cube.faces[2].at(4, 3, 2));
    // Faces that clamp at their borders differ at the edges, and there only.
    const auto perFace =
        latLongFromCube(cube, 64, 32, {Filter::bilinear, kExactFraction, CubeEdges::perFace});
    CHECK(perFace != latLongFromCube(cube, 64, 32));
    CHECK(perFace.at(0, 16) == latLongFromCube(cube, 64, 32).at(0, 16));
    CHECK(latLongFromCube(cube, 20, 10, {}, Arithmetic::fp32, 3) == listing);
}

TEST_CASE("ProbesWithWrongImagesAreRefused") {
    Probe probe = probeOf(randomImage(4, 4, 8), Mapping::cube);
    CHECK_THROWS_AS(convertProbe(probe, {{Mapping::latLong, 4, 2}}), PreconditionError);
    probe.shape.mapping = Mapping::latLong;
    CHECK_THROWS_AS(convertProbe(probe, {{Mapping::cube, 4, 2}}), PreconditionError);
    CHECK_THROWS_AS(convertProbe(probe, probe, {{Mapping::cube, 4, 4}}), PreconditionError);
    probe.distance_m.emplace_back(3, 4, 1);
    CHECK_THROWS_AS(convertProbe(probe, {{Mapping::cube, 4, 4}}), PreconditionError);
}

}  // namespace etalon
