// Lights from probes: median cut, summed-area tables and irradiance in every arithmetic, dominant lights,
// filter.
#include <limits>

#include "bitcheck/bit_case.h"
#include "bitcheck/inputs.h"
#include "numeric/door.h"
#include "probes/dominant_lights.h"
#include "probes/light_filter.h"
#include "probes/light_passes.h"
#include "probes/median_cut.h"

namespace etalon {
namespace {

constexpr int kProbeWidth = 75, kProbeHeight = 41;

// The sky on texels that no number of lanes divides, with values that are no radiance.
Probe skyProbe() {
    Probe probe;
    probe.shape = {Mapping::latLong, kProbeWidth, kProbeHeight};
    probe.radiance.push_back(skyImage(kProbeWidth, kProbeHeight));
    Image<float>& radiance = probe.radiance[0];
    radiance.at(3, 30, 0) = -1.0f;
    radiance.at(7, 31, 1) = std::numeric_limits<float>::quiet_NaN();
    radiance.at(9, 32, 2) = std::numeric_limits<float>::infinity();
    probe.distance_m.assign(1, Image<float>(kProbeWidth, kProbeHeight));
    Random random(21);
    for (float& metres : probe.distance_m[0].values()) metres = static_cast<float>(random.uniform(1, 9));
    return probe;
}

// Rows of a light: direction, energy, solid angle, region, position.
constexpr int kNumbersPerLight = 14;
void addLight(std::vector<double>& numbers, const ProbeLight& light) {
    const glm::dvec3 position = light.position_m.value_or(glm::dvec3(0));
    const TexelRegion& r = light.region;
    for (const glm::dvec3& v : {light.direction, light.energy, position})
        for (int c = 0; c < 3; c++) numbers.push_back(v[c]);
    for (const int i : {r.x0, r.y0, r.x1, r.y1}) numbers.push_back(i);
    numbers.push_back(light.solidAngle_sr);
}

std::vector<BitPlane> medianCuts(int threads) {
    const Probe probe = skyProbe();
    std::vector<double> arc, angle;
    for (const ProbeLight& l : medianCutLights(probe, {.log2Count = 6}, threads).lights) addLight(arc, l);
    const MedianCut other = {.log2Count = 5,
                             .side = LongerSide::angle,
                             .place = LightPlace::median,
                             .weight = TexelWeight::midpoint,
                             .cutsSquaresInColumns = true};
    for (const ProbeLight& l : medianCutLights(probe, other, threads).lights) addLight(angle, l);
    return {planeOf("arc", std::span<const double>(arc), kNumbersPerLight),
            planeOf("angle", std::span<const double>(angle), kNumbersPerLight)};
}

std::vector<BitPlane> arithmeticOf(Arithmetic arithmetic, int threads) {
    const auto passes = passesIn<LightPasses>(arithmetic);
    Random random(22);
    Image<double> values(53, 37);
    for (double& v : values.values()) v = random.uniform(0, 2);
    const Image<double> table = passes->summedArea(values, threads),
                        boxes = passes->boxSums(table, 5, 3, threads);
    const std::vector<ProbeLight> lights = medianCutLights(skyProbe(), {.log2Count = 4}, 1).lights;
    const auto irradiance = passes->irradianceOfLights(lights, {Mapping::latLong, 21, 10}, threads);
    return {planeOf("rounded", passes->roundedValues(values, threads).values(), 53),
            planeOf("table", table.values(), 53), planeOf("boxes", boxes.values(), boxes.width()),
            planeOf("irradiance", irradiance[0].values(), 21)};
}

std::vector<BitPlane> dominant() {
    std::vector<double> numbers;
    for (const DominantLight& l : dominantLights(skyProbe(), {.width = 25, .threshold = 0.01})) {
        addLight(numbers, l.light);
        numbers.push_back(l.peakBrightness);
        numbers.push_back(l.angularRadius_rad);
    }
    return {planeOf("lights", std::span<const double>(numbers), kNumbersPerLight + 2)};
}

std::vector<BitPlane> filtered() {
    LightFilter filter(0.25);
    std::vector<double> numbers;
    Probe probe = skyProbe();
    Random random(23);
    for (int frame = 0; frame < 4; frame++) {
        for (float& v : probe.radiance[0].values()) v *= static_cast<float>(random.uniform(0.5, 1.5));
        for (const TrackedLight& l : filter.add(medianCutLights(probe, {.log2Count = 4}, 1).lights)) {
            numbers.push_back(static_cast<double>(l.id));
            addLight(numbers, l.light);
        }
    }
    return {planeOf("lights", std::span<const double>(numbers), kNumbersPerLight + 1)};
}

}  // namespace

void addLightCases(std::vector<BitCase>& cases) {
    const auto add = [&](std::string name, std::string what, bool hasThreads, auto run) {
        cases.push_back({"light/" + std::move(name), std::move(what), true, hasThreads, false,
                         [run](const RasterOptions& options) { return run(options.threads); }});
    };
    add("median-cut", "lights of a lat-long probe by median cut", true, medianCuts);
    for (const Profile& profile : profiles())
        if (profile.fragment != Arithmetic::truth)
            add("arithmetic-" + std::string(profile.name), "summed-area tables, irradiance of lights", true,
                [arithmetic = profile.fragment](int threads) { return arithmeticOf(arithmetic, threads); });
    add("dominant", "lights by brightness in a coarse image", false, [](int) { return dominant(); });
    add("filter", "lights over frames, matched and filtered", false, [](int) { return filtered(); });
}

}  // namespace etalon
