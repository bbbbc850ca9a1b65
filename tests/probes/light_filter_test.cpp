#include "probes/light_filter.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "numeric/check.h"
#include "probes/median_cut.h"
#include "tests/support/random_numbers.h"

namespace etalon {
namespace {

ProbeLight lightAt(double longitude_rad, double energy) {
    ProbeLight light;
    light.direction = {std::sin(longitude_rad), 0.0, std::cos(longitude_rad)};
    light.energy = glm::dvec3(energy);
    return light;
}

std::vector<ProbeLight> randomLights(int count, RandomNumbers& random) {
    std::vector<ProbeLight> lights;
    for (int i = 0; i < count; i++)
        lights.push_back(lightAt(random.uniform(-3.0, 3.0), random.uniform(0.1, 2.0)));
    return lights;
}

double energyIn(std::span<const TrackedLight> lights) {
    double sum = 0.0;
    for (const TrackedLight& l : lights) sum += energyOf(l.light.energy);
    return sum;
}

// What an assignment saves against no pairs at all.
double savedBy(const std::vector<ProbeLight>& a, const std::vector<ProbeLight>& b,
               const std::vector<std::pair<size_t, size_t>>& pairs, double maxMotion_rad) {
    double sum = 0.0;
    for (const auto& [i, j] : pairs) {
        const glm::dvec3 d = a[i].direction - b[j].direction;
        const double limit = 4.0 * std::pow(std::sin(0.5 * maxMotion_rad), 2.0);
        sum += std::min(energyOf(a[i].energy), energyOf(b[j].energy)) *
               std::max(0.0, limit - (d.x * d.x + d.y * d.y + d.z * d.z));
    }
    return sum;
}

// A lat-long probe with a sun at a longitude above a plain sky; every frame has noise of its own.
Probe frameProbe(int frame, double sunX, bool isNoisy) {
    RandomNumbers random(static_cast<uint64_t>(frame) + 1);
    Probe probe;
    probe.shape = {Mapping::latLong, 64, 32};
    probe.radiance.assign(1, Image<float>(64, 32, 3));
    for (int y = 0; y < 32; y++)
        for (int x = 0; x < 64; x++) {
            const double square = std::pow(x + 0.5 - sunX, 2.0) + std::pow(y + 0.5 - 9.3, 2.0);
            const double noise = isNoisy ? random.uniform(0.8, 1.2) : 1.0;
            for (int c = 0; c < 3; c++)
                probe.radiance[0].at(x, y, c) = static_cast<float>(noise * (0.5 + 20.0 / (1.0 + square)));
        }
    return probe;
}

}  // namespace

TEST_CASE("LightsInOtherOrderArePairedWithThemselves") {
    RandomNumbers random(1);
    for (const int count : {1, 2, 7, 40}) {
        const std::vector<ProbeLight> a = randomLights(count, random);
        std::vector<size_t> order(a.size());
        std::iota(order.begin(), order.end(), size_t{0});
        for (size_t i = order.size(); i > 1; i--)
            std::swap(order[i - 1], order[static_cast<size_t>(random.below(static_cast<int>(i)))]);
        std::vector<ProbeLight> b;
        for (const size_t i : order) b.push_back(a[i]);
        const auto pairs = matchLights(a, b);
        REQUIRE(pairs.size() == a.size());
        for (const auto& pair : pairs) CHECK(order[pair.second] == pair.first);
        const Flicker flicker = flickerBetween(a, b);
        CHECK(flicker.angle_rad == 0.0);
        CHECK(flicker.intensity <= 1e-15);
    }
}

TEST_CASE("PairsAreTheCheapestOfAllAssignments") {
    RandomNumbers random(2);
    for (int trial = 0; trial < 60; trial++) {
        const auto a = randomLights(1 + random.below(5), random), b = randomLights(5, random);
        const double motion_rad = trial % 2 == 0 ? kMaxLightMotion_rad : 2.0;
        std::vector<size_t> order = {0, 1, 2, 3, 4};
        double best = 0.0;
        do {
            std::vector<std::pair<size_t, size_t>> pairs;
            for (size_t i = 0; i < a.size(); i++) pairs.emplace_back(i, order[i]);
            best = std::max(best, savedBy(a, b, pairs, motion_rad));
        } while (std::next_permutation(order.begin(), order.end()));
        const auto pairs = matchLights(a, b, motion_rad), back = matchLights(b, a, motion_rad);
        CHECK(savedBy(a, b, pairs, motion_rad) == doctest::Approx(best).epsilon(1e-12));
        CHECK(savedBy(b, a, back, motion_rad) == doctest::Approx(best).epsilon(1e-12));
        CHECK(std::is_sorted(back.begin(), back.end()));
    }
}

TEST_CASE("LightsFarApartAreNotTheSame") {
    const std::vector<ProbeLight> a = {lightAt(0.0, 1.0)}, b = {lightAt(0.8, 1.0)}, none;
    CHECK(matchLights(a, b).empty());
    CHECK(matchLights(a, b, 0.9).size() == 1);
    CHECK(flickerBetween(a, b).intensity == 2.0);
    CHECK(matchLights(a, none).empty());
    CHECK(matchLights(none, none).empty());
    CHECK(flickerBetween(none, none).intensity == 0.0);
    const std::vector<ProbeLight> black = {lightAt(0.0, 0.0)};
    CHECK(matchLights(a, black).empty());
    CHECK_THROWS_AS(matchLights(a, b, 0.0), PreconditionError);
}

TEST_CASE("FlickerIsAngleAndRelativeChange") {
    const std::vector<ProbeLight> a = {lightAt(0.0, 1.0), lightAt(2.0, 3.0)},
                                  b = {lightAt(0.1, 1.0), lightAt(2.0, 2.0)};
    const Flicker flicker = flickerBetween(a, b);
    CHECK(flicker.angle_rad == doctest::Approx(0.1 * 1.0 / 3.0).epsilon(1e-12));
    CHECK(flicker.intensity == doctest::Approx(1.0 / 3.5).epsilon(1e-12));
    CHECK(flickerBetween({&a[0], 1}, {&b[0], 1}).angle_rad == doctest::Approx(0.1).epsilon(1e-12));
}

TEST_CASE("AStepIsFollowedExponentially") {
    LightFilter filter(0.25);
    filter.add(std::vector{lightAt(0.0, 1.0)});
    for (int n = 1; n <= 10; n++) {
        const auto& lights = filter.add(std::vector{lightAt(0.0, 3.0)});
        REQUIRE(lights.size() == 1);
        CHECK(lights[0].id == 0);
        CHECK(lights[0].light.energy.x == doctest::Approx(3.0 - 2.0 * std::pow(0.75, n)).epsilon(1e-12));
    }
}

TEST_CASE("LightsAppearFromAndFadeToNothing") {
    LightFilter filter(0.5);
    filter.add(std::vector{lightAt(0.0, 4.0)});
    const auto& both = filter.add(std::vector{lightAt(2.0, 8.0)});
    REQUIRE(both.size() == 2);
    CHECK(both[0].light.energy.x == 2.0);
    CHECK(both[0].light.direction == lightAt(0.0, 1.0).direction);
    CHECK(both[1].light.energy.x == 4.0);
    CHECK(both[1].id == 1);
    size_t frames = 0;
    while (filter.add(std::vector{lightAt(2.0, 8.0)}).size() == 2) REQUIRE(++frames < 40);
    // 2 / 2^n falls below 2^-20 of 8.
    CHECK(frames == 17);
    // An id is not used again.
    CHECK(filter.add(std::vector{lightAt(2.0, 8.0), lightAt(0.0, 4.0)}).back().id == 2);
}

TEST_CASE("TheTotalEnergyIsLowPassedAsAWhole") {
    RandomNumbers random(3);
    LightFilter filter(0.2);
    double expected = 0.0, frameEnergy = 0.0;
    for (int frame = 0; frame < 30; frame++) {
        const auto lights = randomLights(3 + random.below(4), random);
        frameEnergy = 0.0;
        for (const ProbeLight& l : lights) frameEnergy += energyOf(l.energy);
        expected = frame == 0 ? frameEnergy : 0.8 * expected + 0.2 * frameEnergy;
        const double actual = energyIn(filter.add(lights));
        CHECK(std::abs(actual - expected) <= 30 * 2.0 * LightFilter::kFadedLight * frameEnergy + 1e-12);
    }
}

TEST_CASE("BlendOneOfSteadyLightsPassesThemOn") {
    RandomNumbers random(4);
    LightFilter filter(1.0);
    filter.add(std::vector{lightAt(0.0, 1.0), lightAt(1.5, 2.0)});
    const std::vector<ProbeLight> moved = {lightAt(1.6, 3.0), lightAt(0.1, 1.0)};
    const auto& lights = filter.add(moved);
    REQUIRE(lights.size() == 2);
    CHECK(lights[0].light.energy == moved[1].energy);
    CHECK(std::abs(lights[1].light.direction.x - moved[0].direction.x) <= 1e-15);
    CHECK_THROWS_AS(LightFilter(0.0), PreconditionError);
}

TEST_CASE("FilteredLightsOfNoisyFramesFlickerLess") {
    for (const double speed_px : {0.0, 0.2}) {
        LightFilter filter(0.2);
        std::vector<std::vector<ProbeLight>> raw, filtered;
        for (int frame = 0; frame < 40; frame++) {
            raw.push_back(medianCutLights(frameProbe(frame, 20.0 + speed_px * frame, true), {4}, 1).lights);
            filtered.emplace_back();
            for (const TrackedLight& l : filter.add(raw.back())) filtered.back().push_back(l.light);
        }
        const Flicker before = meanFlicker(raw), after = meanFlicker(filtered);
        CHECK(after.angle_rad <= 0.5 * before.angle_rad);
        CHECK(after.intensity <= 0.5 * before.intensity);
    }
    // Without noise or motion nothing flickers.
    std::vector<std::vector<ProbeLight>> steady(3,
                                                medianCutLights(frameProbe(0, 20.0, false), {4}, 1).lights);
    CHECK(meanFlicker(steady).angle_rad == 0.0);
    CHECK(meanFlicker(steady).intensity <= 1e-15);
}

}  // namespace etalon
