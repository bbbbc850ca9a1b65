#include "probes/median_cut.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <set>

#include "numeric/door.h"
#include "numeric/rounded.h"
#include "numeric/truth.h"
#include "probes/latlong.h"
#include "probes/light_passes.h"
#include "probes/summed_area.h"
#include "tests/support/random_numbers.h"

namespace etalon {
namespace {

constexpr TexelWeight kWeights[] = {TexelWeight::exact, TexelWeight::midpoint, TexelWeight::edge,
                                    TexelWeight::uniform};
constexpr LongerSide kSides[] = {LongerSide::angle, LongerSide::arc};
constexpr LightPlace kPlaces[] = {LightPlace::centre, LightPlace::centroid, LightPlace::median,
                                  LightPlace::centroidTwice};

Probe constantProbe(int width, int height, float radiance) {
    Probe probe;
    probe.shape = {Mapping::latLong, width, height};
    probe.radiance.assign(1, Image<float>(width, height, 3));
    probe.radiance[0].fill(radiance);
    return probe;
}

Probe randomProbe(int width, int height, uint64_t seed) {
    RandomNumbers random(seed);
    Probe probe = constantProbe(width, height, 0.0f);
    for (float& v : probe.radiance[0].values())
        v = static_cast<float>(random.below(50) == 0 ? random.uniform(0.0, 1e3) : random.uniform(0.0, 1.0));
    return probe;
}

void setTexel(Probe& probe, int x, int y, float radiance) {
    for (int c = 0; c < 3; c++) probe.radiance[0].at(x, y, c) = radiance;
}

// Every texel is in exactly one region.
void checkRegionsTile(const std::vector<ProbeLight>& lights, int width, int height) {
    Image<uint8_t> owners(width, height);
    double solidAngle_sr = 0.0;
    for (const ProbeLight& light : lights) {
        REQUIRE(light.region.width() >= 1);
        REQUIRE(light.region.height() >= 1);
        for (int y = light.region.y0; y < light.region.y1; y++)
            for (int x = light.region.x0; x < light.region.x1; x++) owners.at(x, y)++;
        solidAngle_sr += light.solidAngle_sr;
    }
    for (const uint8_t count : owners.values()) REQUIRE(count == 1);
    REQUIRE(std::abs(solidAngle_sr - 4.0 * M_PI) <= 1e-12);
}

// Of the lights' irradiance against pi: the root mean square by solid angle, the mean with every texel alike.
struct Furnace {
    double rms, unweightedMean;
};
Furnace furnaceOf(const MedianCut& options) {
    const auto lights = medianCutLights(constantProbe(256, 128, 1.0f), options, 1).lights;
    const LatLongGrid grid(256, 128);
    Furnace f{};
    for (int y = 0; y < 128; y++)
        for (int x = 0; x < 256; x++) {
            const glm::dvec3 n = grid.direction(x, y);
            double irradiance = 0.0;
            for (const ProbeLight& l : lights)
                irradiance += l.energy.x *
                              std::max(0.0, n.x * l.direction.x + n.y * l.direction.y + n.z * l.direction.z);
            f.unweightedMean += irradiance / (256 * 128);
            f.rms += (irradiance - M_PI) * (irradiance - M_PI) * grid.solidAngle_sr(y) / (4.0 * M_PI);
        }
    f.rms = std::sqrt(f.rms);
    return f;
}

}  // namespace

// From an independent computation in double.
TEST_CASE("UnitRadianceHasTheKnownSpreadAndMeans") {
    struct Row {
        int log2Count;
        LightPlace place;
        double rms, unweightedMean;
    };
    for (const Row& row :
         {Row{4, LightPlace::centre, 0.254, 3.242}, Row{6, LightPlace::centre, 0.067, 3.167},
          Row{4, LightPlace::centroid, 0.166, 3.150}, Row{6, LightPlace::centroid, 0.024, 3.137}}) {
        const Furnace f = furnaceOf({row.log2Count, LongerSide::angle, row.place, TexelWeight::exact});
        CHECK(std::abs(f.rms - row.rms) <= 0.0006);
        CHECK(std::abs(f.unweightedMean - row.unweightedMean) <= 0.0007);
    }
}

TEST_CASE("AForgottenSineShowsInUnitRadiance") {
    for (LongerSide side : kSides)
        CHECK(furnaceOf({6, side, LightPlace::centre, TexelWeight::uniform}).rms >= 0.4);
}

TEST_CASE("WeightsSumToTheSphereAsStated") {
    for (auto [width, height] : {std::pair{256, 128}, {8, 4}, {3, 64}}) {
        const auto total = [&](TexelWeight weight) {
            double sum = 0.0;
            for (const double w : texelWeights(width, height, weight)) sum += width * w;
            return sum / (4.0 * M_PI) - 1.0;
        };
        const double square = M_PI * M_PI / (24.0 * height * height);
        CHECK(std::abs(total(TexelWeight::exact)) <= 1e-14);
        CHECK(std::abs(total(TexelWeight::uniform)) <= 1e-14);
        CHECK(std::abs(total(TexelWeight::midpoint) / square - 1.0) <= 0.72 * square + 1e-9);
        CHECK(std::abs(total(TexelWeight::edge) / (-2.0 * square) - 1.0) <= 2.0 * square + 1e-9);
        CHECK(texelWeights(width, height, TexelWeight::edge)[0] == 0.0);
    }
}

TEST_CASE("LightsTileTheImageAndKeepItsEnergy") {
    for (auto [width, height] : {std::pair{64, 32}, {37, 5}, {1, 9}, {13, 1}, {1, 1}, {256, 128}}) {
        const Probe probe = randomProbe(width, height, 1);
        for (int k : {0, 1, 3, 6, 9})
            for (LongerSide side : kSides)
                for (LightPlace place : kPlaces)
                    for (TexelWeight weight : kWeights) {
                        const auto lights = medianCutLights(probe, {k, side, place, weight}, 1).lights;
                        const int texels = width * height;
                        REQUIRE(static_cast<int>(lights.size()) <= std::min(1 << k, texels));
                        if (width == 256) REQUIRE(static_cast<int>(lights.size()) == 1 << k);
                        checkRegionsTile(lights, width, height);
                        const std::vector<double> weights = texelWeights(width, height, weight);
                        const glm::dvec3 sum = totalEnergy(lights);
                        for (int c = 0; c < 3; c++) {
                            Truth expected(0.0);
                            for (int y = 0; y < height; y++)
                                for (int x = 0; x < width; x++)
                                    expected = expected + Truth(weights[static_cast<size_t>(y)]) *
                                                              Truth(probe.radiance[0].at(x, y, c));
                            const double bound =
                                (width + height + static_cast<double>(lights.size())) * 0x1p-53;
                            REQUIRE(std::abs(sum[c] - expected.toDouble()) <= bound * expected.toDouble());
                        }
                        for (const ProbeLight& l : lights) {
                            const double length = l.direction.x * l.direction.x +
                                                  l.direction.y * l.direction.y +
                                                  l.direction.z * l.direction.z;
                            REQUIRE(std::abs(length - 1.0) <= 1e-14);
                        }
                    }
    }
}

TEST_CASE("CutsHalveTheEnergyAsWellAsTexelsAllow") {
    const Probe probe = randomProbe(64, 32, 2);
    const EnergyTable table(probe.radiance[0], texelWeights(64, 32, TexelWeight::exact), 1);
    const auto lights = medianCutLights(probe, {1, LongerSide::arc}, 1).lights;
    REQUIRE(lights.size() == 2);
    const int cut = lights[0].region.x1;
    const auto difference = [&](int x) { return std::abs(2.0 * table.sum({0, 0, x, 32}) - table.total()); };
    for (int x = 1; x < 64; x++) CHECK(difference(cut) <= difference(x));
    CHECK(lights[0].region == TexelRegion{0, 0, cut, 32});
    CHECK(lights[1].region == TexelRegion{cut, 0, 64, 32});
}

TEST_CASE("TheLongerSideIsCut") {
    // Lit are the eight rows at the pole, short parallels that span wide angles.
    Probe probe = constantProbe(128, 64, 0.0f);
    for (int x = 0; x < 128; x++)
        for (int y = 0; y < 8; y++) setTexel(probe, x, y, 1.0f);
    const auto narrowest = [&](LongerSide side) {
        int width = 128;
        for (const ProbeLight& l : medianCutLights(probe, {5, side}, 1).lights)
            width = std::min(width, l.region.width());
        return width;
    };
    CHECK(narrowest(LongerSide::angle) == 8);
    CHECK(narrowest(LongerSide::arc) == 16);
    // A region of equal sides is cut into an upper and a lower part.
    const auto lights =
        medianCutLights(constantProbe(8, 4, 1.0f), {2, LongerSide::angle, LightPlace::centre}, 1).lights;
    REQUIRE(lights.size() == 4);
    CHECK(lights[0].region == TexelRegion{0, 0, 4, 2});
    CHECK(lights[1].region == TexelRegion{0, 2, 4, 4});
}

TEST_CASE("BlackProbesAreCutInTheMiddle") {
    for (auto [width, height] : {std::pair{16, 8}, {5, 3}, {1, 4}}) {
        const auto lights = medianCutLights(constantProbe(width, height, 0.0f), {3}, 1).lights;
        checkRegionsTile(lights, width, height);
        for (const ProbeLight& l : lights) {
            CHECK(l.energy == glm::dvec3(0.0));
            CHECK(std::abs(l.direction.y -
                           std::sin(M_PI * (0.5 - 0.5 * (l.region.y0 + l.region.y1) / height))) <= 1e-15);
        }
        CHECK(medianCutLights(constantProbe(width, height, 0.0f), {30}, 1).lights.size() ==
              static_cast<size_t>(width * height));
    }
    const auto half = medianCutLights(constantProbe(16, 8, 0.0f), {1}, 1).lights;
    CHECK(half[0].region == TexelRegion{0, 0, 8, 8});
}

TEST_CASE("ImagesHaveNoMoreLightsThanTexels") {
    const Probe probe = randomProbe(6, 3, 3);
    for (int k : {5, 10, 32, 100}) {
        const auto lights = medianCutLights(probe, {k}, 1).lights;
        CHECK(lights.size() == 18);
        checkRegionsTile(lights, 6, 3);
    }
    CHECK(medianCutLights(probe, {0}, 1).lights.size() == 1);
    CHECK_THROWS_AS(medianCutLights(probe, {-1}), PreconditionError);
}

TEST_CASE("OneTexelOfAMillionInADarkWorldKeepsItsEnergy") {
    for (auto [x, y] : {std::pair{100, 40}, {0, 0}, {255, 127}, {0, 64}}) {
        Probe probe = constantProbe(256, 128, 1e-3f);
        setTexel(probe, x, y, 1e6f);
        const LatLongGrid grid(256, 128);
        const auto lights = medianCutLights(probe, {6}, 1).lights;
        checkRegionsTile(lights, 256, 128);
        // The sun is alone in the end, and the rest of the world is lit as before.
        const auto sun = std::max_element(lights.begin(), lights.end(), [](const auto& a, const auto& b) {
            return a.energy.x < b.energy.x;
        });
        const glm::dvec3 d = grid.direction(x, y);
        CHECK(sun->direction.x * d.x + sun->direction.y * d.y + sun->direction.z * d.z >= 0.999);
        CHECK(std::abs(sun->energy.x / (1e6 * grid.solidAngle_sr(y)) - 1.0) <= 1e-5);
        const double dark = static_cast<double>(1e-3f) * (4.0 * M_PI - grid.solidAngle_sr(y));
        CHECK(std::abs(totalEnergy(lights).x / (dark + 1e6 * grid.solidAngle_sr(y)) - 1.0) <= 1e-13);
        for (const ProbeLight& l : lights) CHECK(l.energy.x > 0.0);
    }
}

TEST_CASE("TheLargestRadiancesStayFinite") {
    for (const float radiance : {65504.0f, std::numeric_limits<float>::max()}) {
        const auto lights = medianCutLights(constantProbe(64, 32, radiance), {4}, 1).lights;
        CHECK(std::abs(totalEnergy(lights).y / (static_cast<double>(radiance) * 4.0 * M_PI) - 1.0) <= 1e-14);
        for (const ProbeLight& l : lights) CHECK(l.direction.x == l.direction.x);
    }
}

TEST_CASE("WhatIsNoRadianceIsCountedAndBlack") {
    Probe probe = constantProbe(16, 8, 1.0f), clean = probe;
    for (int x : {1, 5, 9}) setTexel(clean, x, 3, 0.0f);
    setTexel(probe, 1, 3, std::numeric_limits<float>::quiet_NaN());
    setTexel(probe, 5, 3, -1.0f);
    setTexel(probe, 9, 3, std::numeric_limits<float>::infinity());
    const LightsOfProbe with = medianCutLights(probe, {4}, 1), without = medianCutLights(clean, {4}, 1);
    CHECK(with.uncountedValues == 9);
    CHECK(without.uncountedValues == 0);
    REQUIRE(with.lights.size() == without.lights.size());
    for (size_t i = 0; i < with.lights.size(); i++) {
        CHECK(with.lights[i].energy == without.lights[i].energy);
        CHECK(with.lights[i].direction == without.lights[i].direction);
    }
    probe = constantProbe(16, 8, 1.0f);
    probe.valid.assign(1, Image<uint8_t>(16, 8));
    probe.valid[0].fill(1);
    for (int x : {1, 5, 9}) probe.valid[0].at(x, 3) = 0;
    CHECK(totalEnergy(medianCutLights(probe, {4}, 1).lights) == totalEnergy(without.lights));
}

TEST_CASE("LightsLieWhereTheProbeStoresDistances") {
    Probe probe = constantProbe(16, 8, 0.0f);
    setTexel(probe, 12, 2, 5.0f);
    probe.distance_m.assign(1, Image<float>(16, 8));
    probe.distance_m[0].fill(std::numeric_limits<float>::infinity());
    probe.distance_m[0].at(12, 2) = 3.0f;
    probe.position_m = {1.0, 2.0, -4.0};
    // A quarter of a turn around y: +Z becomes +X.
    probe.rotation = glm::dmat3(0, 0, -1, 0, 1, 0, 1, 0, 0);
    const auto lights = medianCutLights(probe, {0}, 1).lights;
    const glm::dvec3 local = LatLongGrid(16, 8).direction(12, 2), d = {local.z, local.y, -local.x};
    REQUIRE(lights[0].position_m.has_value());
    for (int c = 0; c < 3; c++) {
        CHECK(std::abs(lights[0].direction[c] - d[c]) <= 1e-15);
        CHECK(std::abs((*lights[0].position_m)[c] - (probe.position_m[c] + 3.0 * d[c])) <= 1e-14);
    }
    int located = 0;
    for (const ProbeLight& l : medianCutLights(probe, {7}, 1).lights) located += l.position_m ? 1 : 0;
    CHECK(located == 1);
}

// Column energies 1, 2, 6 and row weights w, so that centroid and median are known.
TEST_CASE("LightsLieAtTheirNamedPlaces") {
    Probe probe = constantProbe(4, 2, 0.0f);
    for (int y = 0; y < 2; y++)
        setTexel(probe, 0, y, 1.0f), setTexel(probe, 1, y, 2.0f), setTexel(probe, 3, y, 5.0f);
    const auto u = [&](LightPlace place) {
        const glm::dvec3 d = medianCutLights(probe, {0, LongerSide::arc, place}, 1).lights[0].direction;
        CHECK(std::abs(d.y) <= (place == LightPlace::median ? 0.8 : 1e-15));
        return 4.0 * (0.5 - std::atan2(d.x, d.z) / (2.0 * M_PI));
    };
    CHECK(u(LightPlace::centre) == doctest::Approx(2.0));
    CHECK(u(LightPlace::centroid) == doctest::Approx((0.5 + 2.0 * 1.5 + 5.0 * 3.5) / 8.0));
    CHECK(u(LightPlace::centroidTwice) == doctest::Approx((0.5 + 2.0 * 1.5 + 5.0 * 3.5) / 8.0));
    CHECK(u(LightPlace::median) == doctest::Approx(3.5));
    // Rows: weights w, of three rows w1 < w2; the lowest row is black.
    Probe rows = constantProbe(1, 3, 1.0f);
    setTexel(rows, 0, 2, 0.0f);
    const std::vector<double> w = texelWeights(1, 3, TexelWeight::exact);
    const auto v = [&](LightPlace place) {
        const glm::dvec3 d = medianCutLights(rows, {0, LongerSide::arc, place}, 1).lights[0].direction;
        return 3.0 * (0.5 - std::asin(d.y) / M_PI);
    };
    CHECK(v(LightPlace::centroid) == doctest::Approx((0.5 * w[0] + 1.5 * w[1]) / (w[0] + w[1])));
    CHECK(v(LightPlace::centroidTwice) ==
          doctest::Approx((0.5 * w[0] * w[0] + 1.5 * w[1] * w[1]) / (w[0] * w[0] + w[1] * w[1])));
    CHECK(v(LightPlace::median) == doctest::Approx(1.5));
}

TEST_CASE("TablesOfAnyArithmeticCanBeCut") {
    const Probe probe = randomProbe(64, 32, 5);
    const std::vector<double> weights = texelWeights(64, 32, TexelWeight::exact);
    Image<double> energy(64, 32);
    for (int y = 0; y < 32; y++)
        for (int x = 0; x < 64; x++) {
            const Image<float>& r = probe.radiance[0];
            energy.at(x, y) =
                weights[static_cast<size_t>(y)] * energyOf({r.at(x, y, 0), r.at(x, y, 1), r.at(x, y, 2)});
        }
    const auto regions = [&](auto number) {
        return medianCutRegions(EnergyTable(summedArea<decltype(number)>(energy, 1)), {5});
    };
    const auto expected = medianCutLights(probe, {5}, 1).lights;
    const auto wide = regions(double{});
    REQUIRE(wide.size() == expected.size());
    for (size_t i = 0; i < wide.size(); i++) CHECK(wide[i] == expected[i].region);
    CHECK(regions(Rounded<kBf16>(0.0)) != wide);
}

TEST_CASE("MedianCutRunsInAnyArithmetic") {
    const Probe probe = randomProbe(64, 32, 6);
    const MedianCut cut{5};
    const auto wide = medianCutLights(probe, cut, 1).lights;
    const std::vector<double> weights = texelWeights(64, 32, cut.weight);
    const auto difference = [&](const Arithmetic& arithmetic) {
        const auto lights = medianCutLights(probe, cut, arithmetic, 2).lights;
        REQUIRE(lights.size() == wide.size());
        double largest = 0.0;
        for (size_t i = 0; i < lights.size(); i++) {
            const RegionSums sums = passesIn<LightPasses>(arithmetic)
                                        ->regionSums(probe.radiance[0], lights[i].region, weights.data());
            CHECK(lights[i].energy == sums.energy);
            largest = std::max(largest, std::abs(energyOf(lights[i].energy) / energyOf(wide[i].energy) - 1));
        }
        return largest;
    };
    CHECK(difference(Arithmetic::fp64) == 0.0);
    // The energies are sums of up to 64 x 32 / 32 texels: no digits are lost to the table where the cuts agree.
    CHECK(difference(Arithmetic::truth) <= 1e-14);
    CHECK(difference(Arithmetic::fp16) > 1e-4);
    CHECK(difference(Arithmetic::fp16) < 1.0);
}

TEST_CASE("LightsDependOnNoThreads") {
    const Probe probe = randomProbe(93, 70, 4);
    const auto one = medianCutLights(probe, {7}, 1), three = medianCutLights(probe, {7}, 3);
    REQUIRE(one.lights.size() == three.lights.size());
    for (size_t i = 0; i < one.lights.size(); i++) {
        CHECK(one.lights[i].energy == three.lights[i].energy);
        CHECK(one.lights[i].direction == three.lights[i].direction);
    }
}

}  // namespace etalon
