#include "shadows/casting_lights.h"

#include <doctest/doctest.h>

#include <limits>

using namespace etalon;

namespace {

ProbeLight lightOf(double solidAngle_sr, double grey) {
    ProbeLight light;
    light.solidAngle_sr = solidAngle_sr;
    light.energy = glm::dvec3(grey);
    return light;
}

using Indices = std::vector<size_t>;

}  // namespace

TEST_CASE("TheSmallestRegionsCastFirst") {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const std::vector<ProbeLight> lights{lightOf(2, 1),      lightOf(1, 1), lightOf(0.5, 0), lightOf(1, 3),
                                         lightOf(0.25, nan), lightOf(3, 1), lightOf(1, 1)};
    CHECK(lightsOfSmallestRegion(lights, 0).empty());
    CHECK(lightsOfSmallestRegion(lights, 1) == Indices{3});
    CHECK(lightsOfSmallestRegion(lights, 4) == Indices{3, 1, 6, 0});
    CHECK(lightsOfSmallestRegion(lights, 100) == Indices{3, 1, 6, 0, 5});
    CHECK(lightsOfSmallestRegion({}, 3).empty());
}

TEST_CASE("LargeSharesOfTheEnergyCast") {
    const std::vector<ProbeLight> lights{lightOf(1, 1), lightOf(1, 5), lightOf(1, 0), lightOf(1, 2),
                                         lightOf(1, 2)};
    CHECK(lightsOfLargestShare(lights, 0.51).empty());
    CHECK(lightsOfLargestShare(lights, 0.5) == Indices{1});
    CHECK(lightsOfLargestShare(lights, 0.15) == Indices{1, 3, 4});
    CHECK(lightsOfLargestShare(lights, 1e-9) == Indices{1, 3, 4, 0});
    CHECK(lightsOfLargestShare({}, 0.5).empty());
    CHECK(lightsOfLargestShare(std::vector{lightOf(1, 0)}, 0.5).empty());
}
