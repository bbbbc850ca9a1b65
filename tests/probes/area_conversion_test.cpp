// Conversion by area (probes/convert.h): the flux of every texel arrives, constants stay, nothing is where it was not.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "probes/convert.h"
#include "probes/texel_grid.h"
#include "probes/texel_overlaps.h"
#include "tests/probes/made_probes.h"

namespace etalon {
namespace {

constexpr double kSphere_sr = 4 * 3.14159265358979323846;
const Mapping kMappings[] = {Mapping::latLong,    Mapping::cube,       Mapping::angular,
                             Mapping::mirrorBall, Mapping::octahedral, Mapping::latLongPedersen};

ProbeShape shapeOf(Mapping mapping, int size) {
    return {mapping, isLatLong(mapping) ? 2 * size : size, size};
}
glm::dmat3 turned() {
    RandomNumbers random(11);
    return randomRotation(random);
}

// Of each texel of the source in order, what it gives to all texels of the result: the sum of their means' weights times
// their solid angles.
std::vector<double> givenSolidAngles_sr(const ProbeShape& source, const ProbeShape& target,
                                        const glm::dmat3& turn) {
    const TexelOverlaps overlaps(source, target, turn);
    const TexelGrid grid(target);
    std::vector<double> given(static_cast<size_t>(source.layers() * source.width * source.height));
    for (int layer = 0; layer < target.layers(); layer++)
        for (int y = 0; y < target.height; y++) {
            const RowOverlaps row = overlaps.ofRow(layer, y);
            for (int x = 0; x < target.width; x++) {
                const auto i = static_cast<size_t>(x);
                double all = 0;
                for (size_t k = row.first[i]; k < row.first[i + 1]; k++) all += row.overlaps[k].weight;
                for (size_t k = row.first[i]; k < row.first[i + 1]; k++) {
                    const TexelOverlap& one = row.overlaps[k];
                    REQUIRE(one.weight > 0);
                    given[static_cast<size_t>((one.layer * source.height + one.y) * source.width + one.x)] +=
                        one.weight / all * grid.solidAngle_sr(layer, x, y);
                }
            }
        }
    return given;
}

// As the bounds count it, as a part of kAreaEnergyError: relative to a texel's own flux, or where a rim may cut it, by
// kRimEnergyError, to that of a texel of the mean size.
double worstFluxError(const ProbeShape& source, const ProbeShape& target, const glm::dmat3& turn) {
    const TexelGrid grid(source);
    const std::vector<double> given = givenSolidAngles_sr(source, target, turn);
    const double whole_sr = kSphere_sr / (source.width * source.height);
    double worst = 0;
    size_t i = 0;
    for (int layer = 0; layer < source.layers(); layer++)
        for (int y = 0; y < source.height; y++)
            for (int x = 0; x < source.width; x++, i++) {
                const double own_sr = grid.solidAngle_sr(layer, x, y);
                if (own_sr == 0) REQUIRE(given[i] == 0);
                if (!(own_sr > 0)) continue;
                const double s = (2.0 * x + 1) / source.width - 1, t = (2.0 * y + 1) / source.height - 1;
                const bool isAtRim =
                    isDisc(source.mapping) && std::sqrt(s * s + t * t) > 1 - 2.0 / source.width;
                const double error = std::abs(given[i] - own_sr);
                worst = std::max(worst, isAtRim ? error / whole_sr * (kAreaEnergyError / kRimEnergyError)
                                                : error / own_sr);
            }
    return worst;
}

// Radiance times solid angle over all texels of a channel.
double fluxOf(const Probe& probe, int channel = 0) {
    const TexelGrid grid(probe.shape);
    double sum = 0;
    for (int layer = 0; layer < probe.shape.layers(); layer++)
        for (int y = 0; y < probe.shape.height; y++)
            for (int x = 0; x < probe.shape.width; x++)
                sum += grid.solidAngle_sr(layer, x, y) *
                       static_cast<double>(probe.radiance[static_cast<size_t>(layer)].at(x, y, channel));
    return sum;
}

}  // namespace

// For all pairs of mappings, smaller and larger, of odd and even sizes, in the same frame and turned.
TEST_CASE("EveryTexelGivesItsFluxToEveryMapping") {
    double worst = 0;
    for (const Mapping from : kMappings)
        for (const Mapping to : kMappings)
            for (const auto& [source, target, turn] : {std::tuple(16, 12, turned()),
                                                       {5, 9, glm::dmat3(1)},
                                                       {33, 7, turned()},
                                                       {1, 3, glm::dmat3(1)}}) {
                CAPTURE(static_cast<int>(from));
                CAPTURE(static_cast<int>(to));
                CAPTURE(source);
                const double error = worstFluxError(shapeOf(from, source), shapeOf(to, target), turn);
                CHECK(error <= kAreaEnergyError);
                worst = std::max(worst, error);
            }
    MESSAGE("largest error ", worst);
}

// A near ball shows less than the sphere; what it shows of a constant world or a sun in front of it arrives.
TEST_CASE("NearBallsGiveAndTakeTheirFlux") {
    double worst = 0;
    for (const double distance_radii : {1.5, 4.0})
        for (const Mapping other : kMappings) {
            CAPTURE(distance_radii);
            CAPTURE(static_cast<int>(other));
            ProbeShape ball = shapeOf(Mapping::mirrorBall, 32);
            ball.ballDistance_radii = distance_radii;
            // Texels of the ball that the result's texels see whole: those within 0.9 of its middle.
            const TexelGrid grid(ball);
            const std::vector<double> given = givenSolidAngles_sr(ball, shapeOf(other, 48), turned());
            for (int y = 0; y < 32; y++)
                for (int x = 0; x < 32; x++) {
                    const double s = (x + 0.5) / 16 - 1, t = (y + 0.5) / 16 - 1;
                    if (s * s + t * t > 0.81) continue;
                    const double own_sr = grid.solidAngle_sr(0, x, y);
                    const double error = std::abs(given[static_cast<size_t>(32 * y + x)] / own_sr - 1);
                    CHECK(error <= kAreaEnergyError);
                    worst = std::max(worst, error);
                }
        }
    MESSAGE("largest error ", worst);
}

TEST_CASE("ASmallSunKeepsItsFlux") {
    // One texel of 1024 x 512, in f32.
    for (const auto& [x, y] : {std::pair(337, 141), {512, 511}}) {
        Image<float> image(1024, 512, 3);
        image.fill(1e-3f);
        image.at(x, y) = 1e6f;
        const Probe sun = probeOf(image, Mapping::latLong);
        for (const Mapping to : kMappings)
            for (const int size : {7, 32}) {
                CAPTURE(static_cast<int>(to));
                CAPTURE(y);
                const Probe result = convertProbe(sun, {shapeOf(to, size)});
                CHECK(std::abs(fluxOf(result) / fluxOf(sun) - 1) <= kAreaEnergyError);
            }
    }
}

TEST_CASE("RandomProbesKeepTheirFluxThereAndBack") {
    for (const Mapping from : kMappings)
        for (const Mapping to : kMappings) {
            CAPTURE(static_cast<int>(from));
            CAPTURE(static_cast<int>(to));
            const Probe probe = randomProbe(shapeOf(from, 24), 5);
            ProbeConversion conversion{shapeOf(to, 31), turned()};
            const Probe there = convertProbe(probe, conversion);
            CHECK(std::abs(fluxOf(there, 1) / fluxOf(probe, 1) - 1) <= kAreaEnergyError);
            const Probe back = convertProbe(there, {probe.shape, probe.rotation});
            CHECK(std::abs(fluxOf(back, 1) / fluxOf(probe, 1) - 1) <= 2 * kAreaEnergyError);
        }
}

TEST_CASE("ProbesOfTheSameGridStayAsTheyAre") {
    for (const Mapping mapping : kMappings) {
        CAPTURE(static_cast<int>(mapping));
        const Probe probe = randomProbe(shapeOf(mapping, 21), 6);
        const Probe same = convertProbe(probe, {probe.shape});
        double worst = 0;
        for (size_t layer = 0; layer < same.radiance.size(); layer++)
            for (int y = 0; y < same.shape.height; y++)
                for (int x = 0; x < same.shape.width; x++)
                    if (showsDirection(same.shape, x, y))
                        worst =
                            std::max(worst, std::abs(static_cast<double>(same.radiance[layer].at(x, y)) -
                                                     static_cast<double>(probe.radiance[layer].at(x, y))));
        CHECK(worst <= 1e-6);
    }
}

// Four texels become one whose rows weigh by their solid angles.
TEST_CASE("HalvedLatLongTexelsAreWeightedMeans") {
    const Probe probe = randomProbe(shapeOf(Mapping::latLong, 8), 7);
    const Probe half = convertProbe(probe, {shapeOf(Mapping::latLong, 4)}, Arithmetic::fp64);
    const TexelGrid grid(probe.shape);
    for (int y = 0; y < 4; y++)
        for (int x = 0; x < 8; x++) {
            double sum = 0, weight_sr = 0;
            for (int j = 2 * y; j < 2 * y + 2; j++)
                for (int i = 2 * x; i < 2 * x + 2; i++) {
                    sum += grid.solidAngle_sr(0, i, j) * static_cast<double>(probe.radiance[0].at(i, j));
                    weight_sr += grid.solidAngle_sr(0, i, j);
                }
            CHECK(std::abs(static_cast<double>(half.radiance[0].at(x, y)) - sum / weight_sr) <= 1e-7);
        }
}

// Light reaches no texel farther from it than the two texels are large.
TEST_CASE("LightStaysWhereItIs") {
    for (const Mapping from : kMappings)
        for (const Mapping to : kMappings) {
            CAPTURE(static_cast<int>(from));
            CAPTURE(static_cast<int>(to));
            const ProbeShape source = shapeOf(from, 24), target = shapeOf(to, 24);
            const TexelOverlaps overlaps(source, target, glm::dmat3(1));
            const TexelGrid sources(source), targets(target);
            double farthest = 0;
            for (int layer = 0; layer < target.layers(); layer++)
                for (int y = 0; y < target.height; y++) {
                    const RowOverlaps row = overlaps.ofRow(layer, y);
                    for (int x = 0; x < target.width; x++)
                        for (size_t k = row.first[static_cast<size_t>(x)];
                             k < row.first[static_cast<size_t>(x) + 1]; k++) {
                            const TexelOverlap& one = row.overlaps[k];
                            const glm::dvec3 d =
                                targets.direction(layer, x, y) - sources.direction(one.layer, one.x, one.y);
                            farthest = std::max(farthest, std::sqrt(d.x * d.x + d.y * d.y + d.z * d.z));
                        }
                }
            // Texels of discs are long near -Z.
            CHECK(farthest <= (isDisc(from) || isDisc(to) ? 1.2 : 0.45));
        }
}

TEST_CASE("PointSamplesOfFinerTexelsAreToldByTheirSize") {
    const Probe probe = randomProbe({Mapping::octahedral, 32, 32}, 8);
    const auto ratio = [&](const ProbeShape& shape) { return minificationOf(probe, {shape}); };
    CHECK(ratio({Mapping::octahedral, 32, 32}) == doctest::Approx(1));
    CHECK(ratio({Mapping::octahedral, 16, 16}) == doctest::Approx(4));
    CHECK(ratio({Mapping::octahedral, 64, 64}) == doctest::Approx(0.25));
    // Of a cube the middle of a face is coarsest: 4 / size^2.
    CHECK(ratio({Mapping::cube, 31, 31}) ==
          doctest::Approx(4.0 / (31 * 31) / (kSphere_sr / 1024)).epsilon(0.01));
    // Of a lat-long source the poles are finest; texels that a rim cuts count for nothing.
    const Probe latLong = randomProbe({Mapping::latLong, 64, 32}, 9);
    CHECK(minificationOf(latLong, {{Mapping::octahedral, 32, 32}}) > 10);
    CHECK(minificationOf(randomProbe({Mapping::mirrorBall, 32, 32}, 10), {{Mapping::mirrorBall, 32, 32}}) ==
          doctest::Approx(1));
}

}  // namespace etalon
