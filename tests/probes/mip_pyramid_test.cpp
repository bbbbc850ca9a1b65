#include "probes/mip_pyramid.h"

#include <doctest/doctest.h>

#include <cmath>

#include "numeric/check.h"
#include "numeric/sum.h"
#include "probes/texel_grid.h"
#include "tests/support/random_numbers.h"

namespace etalon {
namespace {

Probe randomProbe(const ProbeShape& shape) {
    RandomNumbers random(1);
    Probe probe;
    probe.shape = shape;
    for (int layer = 0; layer < shape.layers(); layer++) {
        probe.radiance.emplace_back(shape.width, shape.height, 3);
        for (float& v : probe.radiance.back().values()) v = static_cast<float>(random.uniform(0, 10));
    }
    return probe;
}

// W/m^2 over all directions, first channel.
double energyOf(const Probe& probe) {
    const TexelGrid grid(probe.shape);
    std::vector<double> terms;
    for (int layer = 0; layer < probe.shape.layers(); layer++)
        for (int y = 0; y < probe.shape.height; y++)
            for (int x = 0; x < probe.shape.width; x++)
                terms.push_back(grid.solidAngle_sr(layer, x, y) *
                                static_cast<double>(probe.radiance[static_cast<size_t>(layer)].at(x, y)));
    return fixedSum(terms);
}

const ProbeShape kShapes[] = {{Mapping::latLong, 64, 32}, {Mapping::latLong, 37, 19},
                              {Mapping::latLong, 1, 9},   {Mapping::latLongPedersen, 5, 3},
                              {Mapping::cube, 16, 16},    {Mapping::cube, 11, 11}};

}  // namespace

TEST_CASE("EveryLevelKeepsTheEnergy") {
    for (const ProbeShape& shape : kShapes) {
        CAPTURE(shape.width);
        const Probe probe = randomProbe(shape);
        const std::vector<Probe> levels = mipPyramid(probe, 2);
        const double energy = energyOf(probe);
        for (size_t i = 0; i < levels.size(); i++) {
            CHECK(levels[i].shape.width == std::max(1, shape.width >> i));
            CHECK(levels[i].shape.height == std::max(1, shape.height >> i));
            // Each level rounds its texels to float once.
            CHECK(std::abs(energyOf(levels[i]) / energy - 1) <= static_cast<double>(i) * 0x1p-24);
        }
        CHECK(levels.back().radiance[0].pixelCount() == 1);
        CHECK(mipPyramid(probe, 1).back().radiance == levels.back().radiance);
    }
}

TEST_CASE("MipTexelsAreWeightedMeansOfTheTexelsTheyCover") {
    const Probe probe = randomProbe({Mapping::cube, 8, 8});
    const TexelGrid grid(probe.shape);
    const std::vector<Probe> levels = mipPyramid(probe);
    double sum = 0, weight = 0;
    for (int k = 0; k < 4; k++) {
        const int x = 2 + k % 2, y = 6 + k / 2;
        sum += grid.solidAngle_sr(3, x, y) * static_cast<double>(probe.radiance[3].at(x, y, 1));
        weight += grid.solidAngle_sr(3, x, y);
    }
    CHECK(levels[1].radiance[3].at(1, 3, 1) == static_cast<float>(sum / weight));
    // A constant stays.
    Probe constant = probe;
    for (Image<float>& layer : constant.radiance) layer.fill(0.7f);
    for (const Probe& level : mipPyramid(constant))
        for (const float v : level.radiance[2].values()) REQUIRE(v == 0.7f);
}

TEST_CASE("MipTexelsLeaveOutWhatIsNotValid") {
    Probe probe = randomProbe({Mapping::latLong, 4, 2});
    probe.valid.emplace_back(4, 2, 1);
    probe.valid[0].fill(1);
    probe.valid[0].at(0, 0) = 0;
    probe.radiance[0].at(0, 0) = std::nanf("");
    for (int y = 0; y < 2; y++)
        for (int x = 2; x < 4; x++) probe.valid[0].at(x, y) = 0;
    const Probe level = mipPyramid(probe)[1];
    CHECK(level.valid[0].at(0, 0) == 1);
    CHECK(level.valid[0].at(1, 0) == 0);
    CHECK(level.radiance[0].at(1, 0) == 0);
    const float lo =
        std::min({probe.radiance[0].at(1, 0), probe.radiance[0].at(0, 1), probe.radiance[0].at(1, 1)});
    CHECK(level.radiance[0].at(0, 0) >= lo);
    CHECK_THROWS_AS(mipPyramid(randomProbe({Mapping::angular, 4, 4})), PreconditionError);
}

}  // namespace etalon
