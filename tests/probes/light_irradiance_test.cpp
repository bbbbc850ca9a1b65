#include "probes/light_irradiance.h"

#include <doctest/doctest.h>

#include <cmath>

#include "numeric/door.h"
#include "numeric/rounded.h"
#include "numeric/truth.h"
#include "probes/light_passes.h"
#include "probes/median_cut.h"
#include "probes/probe_errors.h"
#include "tests/support/random_numbers.h"

namespace etalon {
namespace {

glm::dvec3 randomDirection(RandomNumbers& random) {
    for (;;) {
        const glm::dvec3 d(random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0));
        const double square = d.x * d.x + d.y * d.y + d.z * d.z;
        if (square > 0.01 && square < 1.0) return d / std::sqrt(square);
    }
}

// Lights anywhere, of total energy 4 pi in each channel.
std::vector<ProbeLight> furnaceLights(int count, uint64_t seed) {
    RandomNumbers random(seed);
    std::vector<ProbeLight> lights(static_cast<size_t>(count));
    glm::dvec3 total{0};
    for (ProbeLight& l : lights) {
        l.direction = randomDirection(random);
        for (int c = 0; c < 3; c++) l.energy[c] = random.uniform(0.0, 1.0);
        total += l.energy;
    }
    for (ProbeLight& l : lights) l.energy *= 4.0 * M_PI / total;
    return lights;
}

double weightedMean(const std::vector<Image<double>>& images, const ProbeShape& shape, int channel) {
    const TexelGrid grid(shape);
    double sum = 0.0, whole = 0.0;
    for (int layer = 0; layer < shape.layers(); layer++)
        for (int y = 0; y < shape.height; y++)
            for (int x = 0; x < shape.width; x++) {
                const double w = grid.solidAngle_sr(layer, x, y);
                sum += w * images[static_cast<size_t>(layer)].at(x, y, channel);
                whole += w;
            }
    return sum / whole;
}

const ProbeShape kShape = {Mapping::latLong, 128, 64};

}  // namespace

TEST_CASE("MeanIrradianceOfLightsIsPiWhereverTheyAre") {
    // The error falls with the square of the number of texels.
    for (const int width : {16, 64, 256}) {
        const ProbeShape shape = {Mapping::latLong, width, width / 2};
        double worst = 0.0;
        for (const int count : {2, 16, 64}) {
            const auto irradiance =
                irradianceOfLights<double>(furnaceLights(count, static_cast<uint64_t>(count)), shape, 1);
            for (int c = 0; c < 3; c++)
                worst = std::max(worst, std::abs(weightedMean(irradiance, shape, c) / M_PI - 1.0));
        }
        CHECK(worst <= kMeanOfTexelsError / (width * width));
        CHECK(worst >= 0.25 * kMeanOfTexelsError / (width * width));
    }
    const ProbeShape cube = {Mapping::cube, 32, 32};
    CHECK(std::abs(weightedMean(irradianceOfLights<double>(furnaceLights(16, 1), cube, 1), cube, 0) / M_PI -
                   1.0) <= 1e-4);
}

// Not the error of the midpoint rule but that of each arithmetic.
TEST_CASE("MeanIrradianceKeepsToTheBoundOfEachArithmetic") {
    for (const Arithmetic arithmetic :
         {Arithmetic::truth, Arithmetic::fp64, Arithmetic::fp32, Arithmetic::fp32Flush, Arithmetic::fp32Nv40,
          Arithmetic::fp24R300, Arithmetic::fp16, Arithmetic::fp16Nv40, Arithmetic::bf16}) {
        double worst = 0.0;
        for (const int count : {2, 16, 64}) {
            if (arithmetic == Arithmetic::truth && count > 2) continue;
            const auto lights = furnaceLights(count, static_cast<uint64_t>(count));
            const auto irradiance = passesIn<LightPasses>(arithmetic)->irradianceOfLights(lights, kShape, 1),
                       exact = irradianceOfLights<double>(lights, kShape, 1);
            for (int c = 0; c < 3; c++)
                worst = std::max(
                    worst,
                    std::abs(weightedMean(irradiance, kShape, c) / weightedMean(exact, kShape, c) - 1.0));
        }
        INFO(arithmeticName(arithmetic) << ": " << worst);
        CHECK(worst <= probeErrors(arithmetic).meanOfLights);
        if (arithmetic != Arithmetic::truth && arithmetic != Arithmetic::fp64)
            CHECK(worst >= 0.1 * probeErrors(arithmetic).meanOfLights);
    }
}

TEST_CASE("IrradianceOfLightsIsTheSumOfClampedCosines") {
    const auto lights = furnaceLights(5, 1);
    const ProbeShape shape = {Mapping::latLong, 24, 12};
    const TexelGrid grid(shape);
    const auto irradiance = irradianceOfLights<double>(lights, shape, 1);
    for (int y = 0; y < 12; y++)
        for (int x = 0; x < 24; x++) {
            const glm::dvec3 n = grid.direction(0, x, y);
            double sum = 0.0;
            for (const ProbeLight& l : lights)
                sum += l.energy.y *
                       std::max(0.0, n.x * l.direction.x + n.y * l.direction.y + n.z * l.direction.z);
            REQUIRE(std::abs(irradiance[0].at(x, y, 1) - sum) <= 1e-13);
        }
    CHECK(irradianceOfLights<double>({}, shape, 1)[0] == Image<double>(24, 12, 3));
}

TEST_CASE("IrradianceOfLightsInOtherThreadsAndLanesGivesTheSameBits") {
    const auto lights = furnaceLights(7, 2);
    for (const ProbeShape& shape : {ProbeShape{Mapping::latLong, 19, 7}, {Mapping::cube, 5, 5}}) {
        const auto scalar = irradianceOfLights<float>(lights, shape, 1);
        CHECK(irradianceOfLights<Lanes<float, 16>>(lights, shape, 3) == scalar);
        CHECK(irradianceOfLights<Rounded<kFp32, Lanes<double, 4>>>(lights, shape, 2) == scalar);
        CHECK(passesIn<LightPasses>(Arithmetic::fp32)->irradianceOfLights(lights, shape, 2) == scalar);
    }
}

// One more light is one more term of the sum, which the bits show: no sum over threads or lanes.
TEST_CASE("LightsAreAddedInTheirOrder") {
    const auto lights = furnaceLights(3, 3);
    const ProbeShape shape = {Mapping::latLong, 8, 4};
    const auto all = irradianceOfLights<float>(lights, shape, 1);
    const auto two = irradianceOfLights<float>(std::span(lights).first(2), shape, 1);
    const auto last = irradianceOfLights<float>(std::span(lights).last(1), shape, 1);
    for (size_t i = 0; i < all[0].values().size(); i++)
        REQUIRE(all[0].values()[i] == static_cast<double>(static_cast<float>(two[0].values()[i]) +
                                                          static_cast<float>(last[0].values()[i])));
}

}  // namespace etalon
