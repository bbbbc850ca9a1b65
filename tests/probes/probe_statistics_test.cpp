#include "probes/probe_statistics.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "tests/probes/made_probes.h"

namespace etalon {

TEST_CASE("MeanRadianceIsWeightedBySolidAngle") {
    for (const ProbeShape& shape : kSmallShapes) {
        const Probe probe = randomProbe(shape, 1);
        const TexelGrid grid(shape);
        Truth sum(0.0), whole(0.0);
        for (int layer = 0; layer < shape.layers(); layer++)
            for (int y = 0; y < shape.height; y++)
                for (int x = 0; x < shape.width; x++) {
                    const Truth weight(grid.solidAngle_sr(layer, x, y));
                    const Image<float>& image = probe.radiance[static_cast<size_t>(layer)];
                    sum = sum + weight * Truth(static_cast<double>(image.at(x, y, 1)));
                    whole = whole + weight;
                }
        const ProbeStatistics s = statisticsOf(probe);
        CHECK(std::abs(s.solidAngle_sr / whole.toDouble() - 1) <= 1e-15);
        CHECK(std::abs(s.mean[1] / (sum / whole).toDouble() - 1) <= 1e-15);
    }
}

TEST_CASE("StatisticsDependOnNoThreads") {
    // Values whose sum shows the order of its terms.
    RandomNumbers random(2);
    const Probe probe = madeProbe({Mapping::latLong, 211, 97}, [&](int, int, int, int) {
        return std::ldexp(random.uniform(0, 1), random.below(24));
    });
    const ProbeStatistics one = statisticsOf(probe, 1);
    for (const int threads : {2, 3, 7}) {
        const ProbeStatistics many = statisticsOf(probe, threads);
        CHECK(many.mean == one.mean);
        CHECK(many.solidAngle_sr == one.solidAngle_sr);
    }
}

TEST_CASE("StatisticsCountWhatIsNoRadiance") {
    Probe probe = constantProbe({Mapping::latLong, 8, 4}, 2);
    probe.radiance[0].at(1, 1, 0) = std::numeric_limits<float>::quiet_NaN();
    probe.radiance[0].at(2, 1, 1) = std::numeric_limits<float>::infinity();
    probe.radiance[0].at(3, 1, 2) = -0.5f;
    probe.radiance[0].at(4, 1, 2) = 16;
    probe.radiance[0].at(5, 1, 2) = 0.25f;
    const ProbeStatistics s = statisticsOf(probe);
    CHECK(s.notANumber == 1);
    CHECK(s.infinite == 1);
    CHECK(s.negative == 1);
    CHECK(s.smallest == -0.5);
    CHECK(s.largest == 16);
    CHECK(s.dynamicRange_stops == 6);
    // Texels that are not valid are left out.
    probe.valid.emplace_back(8, 4);
    probe.valid[0].fill(0);
    probe.valid[0].at(0, 0) = 1;
    const ProbeStatistics of = statisticsOf(probe);
    CHECK(of.notANumber == 0);
    CHECK(of.mean == glm::dvec3(2));
    CHECK(of.solidAngle_sr == TexelGrid(probe.shape).solidAngle_sr(0, 0, 0));
    CHECK(of.dynamicRange_stops == 0);
}

}  // namespace etalon
