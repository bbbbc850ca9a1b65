#include "probes/summed_area.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <type_traits>

#include "numeric/door.h"
#include "numeric/rounded.h"
#include "numeric/truth.h"
#include "probes/energy_lanes.h"
#include "probes/light_passes.h"
#include "probes/median_cut.h"
#include "tests/support/random_numbers.h"

namespace etalon {
namespace {

Image<float> randomRadiance(int width, int height, uint64_t seed) {
    RandomNumbers random(seed);
    Image<float> image(width, height, 3);
    for (float& v : image.values())
        v = static_cast<float>(random.below(20) == 0 ? random.uniform(0.0, 1e4) : random.uniform(0.0, 1.0));
    return image;
}

Image<double> randomTexels(int size, uint64_t seed) {
    RandomNumbers random(seed);
    Image<double> image(size, size);
    for (double& v : image.values()) v = static_cast<double>(static_cast<float>(random.uniform(0.0, 1.0)));
    return image;
}

// What is left of the texels in the differences of a table's entries, in dB; the largest texel is 1.
double signalToNoise_db(Arithmetic arithmetic, const Image<double>& texels) {
    const auto passes = passesIn<LightPasses>(arithmetic);
    const Image<double> boxes = passes->boxSums(passes->summedArea(texels, 1), 1, 1, 1);
    double square = 0.0;
    for (size_t i = 0; i < boxes.values().size(); i++)
        square += std::pow(boxes.values()[i] - texels.values()[i], 2.0);
    return -10.0 * std::log10(square / static_cast<double>(boxes.values().size()));
}

}  // namespace

TEST_CASE("EnergyTableSumsRectanglesWithinItsBound") {
    for (auto [width, height] : {std::pair{1, 1}, {7, 1}, {1, 9}, {37, 70}, {300, 33}}) {
        const Image<float> image = randomRadiance(width, height, 1);
        const std::vector<double> weights = texelWeights(width, height, TexelWeight::exact);
        const EnergyTable table(image, weights, 1);
        RandomNumbers random(2);
        for (int i = 0; i < 50; i++) {
            TexelRegion r{random.below(width + 1), random.below(height + 1), random.below(width + 1),
                          random.below(height + 1)};
            if (r.x1 < r.x0) std::swap(r.x0, r.x1);
            if (r.y1 < r.y0) std::swap(r.y0, r.y1);
            Truth sum(0.0);
            for (int y = r.y0; y < r.y1; y++)
                for (int x = r.x0; x < r.x1; x++)
                    sum = sum + Truth(weights[static_cast<size_t>(y)]) *
                                    (Truth(0.2125) * Truth(image.at(x, y, 0)) +
                                     (Truth(0.7154) * Truth(image.at(x, y, 1)) +
                                      Truth(0.0721) * Truth(image.at(x, y, 2))));
            REQUIRE(std::abs((Truth(table.sum(r)) - sum).toDouble()) <= table.noise());
        }
    }
}

TEST_CASE("EnergyTableDependsOnNeitherThreadsNorLanes") {
    const Image<float> image = randomRadiance(61, 131, 3);
    const std::vector<double> weights = texelWeights(61, 131, TexelWeight::exact);
    const EnergyTable one(image, weights, 1), three(image, weights, 3);
    // The documented order, one value at a time.
    std::vector<double> above(61, 0.0), start(61, 0.0);
    for (int y = 0; y < 131; y++) {
        if (y % EnergyTable::kBandRows == 0)
            for (size_t x = 0; x < 61; x++) start[x] = y == 0 ? 0.0 : start[x] + above[x], above[x] = 0.0;
        double sum = 0.0;
        for (int x = 0; x < 61; x++) {
            sum += weights[static_cast<size_t>(y)] *
                   energyOf({image.at(x, y, 0), image.at(x, y, 1), image.at(x, y, 2)});
            above[static_cast<size_t>(x)] += sum;
            const double expected = start[static_cast<size_t>(x)] + above[static_cast<size_t>(x)];
            REQUIRE(one.sum({0, 0, x + 1, y + 1}) == expected);
            REQUIRE(three.sum({0, 0, x + 1, y + 1}) == expected);
        }
    }
}

TEST_CASE_TEMPLATE("EnergySumsInOtherLanesGiveTheSameBits", N, std::integral_constant<int, 2>,
                   std::integral_constant<int, 4>, std::integral_constant<int, 8>) {
    Image<float> image = randomRadiance(61, 45, 7);
    image.at(5, 5, 0) = -1.0f, image.at(60, 44, 2) = std::numeric_limits<float>::quiet_NaN();
    const std::vector<double> weights = texelWeights(61, 45, TexelWeight::exact);
    std::vector<double> scalar(61 * 45), lanes(61 * 45);
    bandOfTable<1>(image, 0, 45, weights.data(), scalar.data());
    bandOfTable<N::value>(image, 0, 45, weights.data(), lanes.data());
    CHECK(lanes == scalar);
    for (const TexelRegion& r : {TexelRegion{0, 0, 61, 45}, {3, 2, 4, 3}, {1, 5, 12, 6}, {7, 0, 31, 44}}) {
        const RegionSums a = regionSums<double>(image, r, weights.data()),
                         b = regionSums<Lanes<double, N::value>>(image, r, weights.data());
        CHECK(a.energy == b.energy);
        CHECK(a.uncountedValues == b.uncountedValues);
        const RegionSums narrow = regionSums<float>(image, r, weights.data()),
                         wide = regionSums<Lanes<float, 2 * N::value>>(image, r, weights.data());
        CHECK(narrow.energy == wide.energy);
        CHECK(narrow.uncountedValues == a.uncountedValues);
        CHECK(wide.uncountedValues == a.uncountedValues);
        // Of energies that are not negative, each addition and product errs by 2^-24 at most.
        for (int c = 0; c < 3; c++)
            CHECK(std::abs(narrow.energy[c] - a.energy[c]) <=
                  (r.width() / 8 + 1 + r.height() + 6) * 0x1p-24 * a.energy[c]);
    }
}

// Radiance beyond the largest number of an arithmetic counts as that number.
TEST_CASE("EnergiesInFewDigitsStayFinite") {
    Image<float> image(3, 1, 3);
    image.fill(1e5f);
    image.at(2, 0, 1) = image.at(2, 0, 2) = 0.0f;
    const double weight = 0x1p-2;
    for (const Arithmetic& arithmetic : {Arithmetic::fp16, Arithmetic::fp16Nv40}) {
        const auto passes = passesIn<LightPasses>(arithmetic);
        const RegionSums sums = passes->regionSums(image, {0, 0, 2, 1}, &weight);
        CHECK(sums.energy == glm::dvec3(2 * 65504 * weight));
        CHECK(sums.uncountedValues == 0);
        CHECK(passes->texelEnergies(image, &weight, 1).at(2, 0) ==
              doctest::Approx(0.2125 * 65504 * weight).epsilon(0x1p-9));
    }
}

TEST_CASE("EnergyTableTakesWhatIsNoRadianceAsBlack") {
    constexpr float kInf = std::numeric_limits<float>::infinity(),
                    kNan = std::numeric_limits<float>::quiet_NaN();
    Image<float> image(17, 3, 3), clean(17, 3, 3);
    image.fill(2.0f), clean.fill(2.0f);
    for (int x : {0, 9, 16}) clean.at(x, 1, 1) = 0.0f;
    image.at(0, 1, 1) = kNan, image.at(9, 1, 1) = kInf, image.at(16, 1, 1) = -3.0f;
    const std::vector<double> weights(3, 1.0);
    const EnergyTable table(image, weights, 1), expected(clean, weights, 1);
    CHECK(table.total() == expected.total());
    const RegionSums sums = regionSums<double>(image, {0, 0, 17, 3}, weights.data());
    CHECK(sums.uncountedValues == 3);
    CHECK(sums.energy == glm::dvec3(102.0, 96.0, 102.0));
    CHECK(regionSums<double>(image, {1, 0, 9, 3}, weights.data()).uncountedValues == 0);
}

// The figures of probes/summed_area.h.
TEST_CASE("TablesOfFewDigitsLoseTheTexels") {
    const Image<double> small = randomTexels(256, 4), large = randomTexels(1024, 5);
    const auto isAbout = [](double value, double expected) { return std::abs(value - expected) <= 0.7; };
    CHECK(isAbout(signalToNoise_db(Arithmetic::fp32, small), 68.0));
    CHECK(isAbout(signalToNoise_db(Arithmetic::fp32, large), 44.0));
    CHECK(isAbout(signalToNoise_db(Arithmetic::fp24R300, small), 26.0));
    CHECK(isAbout(signalToNoise_db(Arithmetic::fp24R300, large), 3.0));
    CHECK(signalToNoise_db(Arithmetic::fp64, large) >= 230.0);
    // Half floats cannot hold the sums at all.
    CHECK(signalToNoise_db(Arithmetic::fp16, small) < 0.0);

    Image<double> centred = large, ramp(1024, 1024);
    for (double& v : centred.values()) v -= 0.5;
    for (int y = 0; y < 1024; y++)
        for (int x = 0; x < 1024; x++) ramp.at(x, y) = (x + 0.5) / 1024 - 0.5;
    CHECK(signalToNoise_db(Arithmetic::fp32, centred) >= 100.0);
    CHECK(isAbout(signalToNoise_db(Arithmetic::fp32, ramp), 55.0));
}

TEST_CASE("SummedAreaInOtherThreadsAndLanesGivesTheSameBits") {
    const Image<double> texels = randomTexels(67, 6);
    const Image<double> table = summedArea<float>(texels, 1);
    CHECK(summedArea<Lanes<float, 16>>(texels, 3) == table);
    CHECK(summedArea<Rounded<kFp32, Lanes<double, 4>>>(texels, 2) == table);
    CHECK(passesIn<LightPasses>(Arithmetic::fp32)->summedArea(texels, 2) == table);
    const Image<double> boxes = boxSums<float>(table, 5, 3, 1);
    CHECK(boxes.width() == 63);
    CHECK(boxes.height() == 65);
    CHECK(boxSums<Lanes<float, 8>>(table, 5, 3, 2) == boxes);
    CHECK(boxes.at(2, 4) == ((static_cast<float>(table.at(6, 6)) - static_cast<float>(table.at(6, 3))) -
                             static_cast<float>(table.at(1, 6))) +
                                static_cast<float>(table.at(1, 3)));
}

}  // namespace etalon
