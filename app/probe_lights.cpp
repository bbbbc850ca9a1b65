#include <algorithm>
#include <bit>
#include <memory>

#include "app/options.h"
#include "app/output.h"
#include "app/verbs.h"
#include "files/json.h"
#include "numeric/text.h"
#include "probes/dominant_lights.h"
#include "probes/median_cut.h"

namespace etalon {
namespace {

struct ProbeLightsVerb {
    ProbeInput input;
    std::string method = "median-cut", cut = "arc", position = "centroid", weights = "exact";
    uint64_t count = 64;
    int log2Count = 6, threads = 0, maxLights = 8, width = 32;
    double threshold = 0.5;
    bool countIsGiven = false, upperHalf = false, json = false;
};

constexpr std::string_view kMethods[] = {"median-cut", "dominant"};

Json jsonOf(const glm::dvec3& v) { return Json::list({v.x, v.y, v.z}); }

Json jsonOf(const ProbeLight& light) {
    Json json = {
        {"direction", jsonOf(light.direction)},
        {"energy", jsonOf(light.energy)},
        {"solid_angle_sr", light.solidAngle_sr},
        {"region", Json::list({light.region.x0, light.region.y0, light.region.x1, light.region.y1})}};
    if (light.position_m) json["position_m"] = jsonOf(*light.position_m);
    return json;
}

std::string textOf(const ProbeLight& light) {
    const std::string position = light.position_m
                                     ? formatText("  at {:.6g} {:.6g} {:.6g}", light.position_m->x,
                                                  light.position_m->y, light.position_m->z)
                                     : "";
    return formatText("{:9.6f} {:9.6f} {:9.6f}  {:12.6g} {:12.6g} {:12.6g}  {:10.4g}  {},{} {},{}{}",
                      light.direction.x, light.direction.y, light.direction.z, light.energy.x, light.energy.y,
                      light.energy.z, light.solidAngle_sr, light.region.x0, light.region.y0, light.region.x1,
                      light.region.y1, position);
}

void warnUncounted(const std::string& file, size_t count) {
    if (count > 0)
        printText(stderr, "etalon: warning: {}: {} negative, infinite or NaN values count as 0\n", file,
                  count);
}

ExitCode runProbeLights(const ProbeLightsVerb& verb) {
    if (verb.countIsGiven && !std::has_single_bit(verb.count))
        throw InputError(formatText("--count {}: not a power of two", verb.count));
    const bool isMedianCut = verb.method == "median-cut";
    ProgressLine progress;
    const Probe probe = verb.input.load(progress);
    if (isMedianCut && probe.shape.mapping != Mapping::latLong)
        throw InputError(formatText("{}: a {} probe; median cut needs a lat-long one", verb.input.file,
                                    nameOf(probe.shape.mapping)));
    if (!isMedianCut && probe.shape.mapping == Mapping::cube)
        throw InputError(
            formatText("{}: a cube map; dominant lights are searched in one image", verb.input.file));

    std::vector<ProbeLight> lights;
    Json list = Json::list();
    std::string text = "# direction (towards the light), energy R G B (W/m^2), solid angle (sr), texels\n";
    if (isMedianCut) {
        const MedianCut cut = {.log2Count = verb.countIsGiven ? std::countr_zero(verb.count) : verb.log2Count,
                               .side = *memberOf<LongerSide>(verb.cut),
                               .place = *memberOf<LightPlace>(verb.position),
                               .weight = *memberOf<TexelWeight>(verb.weights)};
        LightsOfProbe found =
            progress.during("cutting", [&] { return medianCutLights(probe, cut, verb.threads); });
        progress.finish();
        warnUncounted(verb.input.file, found.uncountedValues);
        lights = std::move(found.lights);
        const uint64_t asked = uint64_t{1} << cut.log2Count;
        if (lights.size() < asked)
            printText(stderr,
                      "etalon: warning: {}: {} of {} lights, because regions of one texel stay whole\n",
                      verb.input.file, lights.size(), asked);
        for (const ProbeLight& light : lights) {
            list.append(jsonOf(light));
            text += textOf(light) + "\n";
        }
    } else {
        for (const DominantLight& found : dominantLights(probe, {.width = verb.width,
                                                                .threshold = verb.threshold,
                                                                .upperHalf = verb.upperHalf,
                                                                .maxLights = verb.maxLights})) {
            lights.push_back(found.light);
            list.append(jsonOf(found.light));
            list.back()["peak_brightness"] = found.peakBrightness;
            list.back()["angular_radius_rad"] = found.angularRadius_rad;
            text += formatText("{}  radius {:.4g} rad\n", textOf(found.light), found.angularRadius_rad);
        }
    }
    progress.finish();
    const glm::dvec3 total = totalEnergy(lights);
    if (verb.json) {
        printOut(jsonText({{"file", verb.input.file},
                           {"method", verb.method},
                           {"width", probe.shape.width},
                           {"height", probe.shape.height},
                           {"total_energy", jsonOf(total)},
                           {"lights", list}}));
    } else {
        printOut(text + formatText("# {} lights, energy {:.6g} {:.6g} {:.6g} W/m^2\n", lights.size(), total.x,
                                   total.y, total.z));
    }
    return ExitCode::done;
}

}  // namespace

void addProbeLights(Verb& probe) {
    const auto options = std::make_shared<ProbeLightsVerb>();
    Verb& verb = probe.addVerb("lights", "Lights that stand for a probe, by median cut or by brightness.");
    options->input.addTo(verb);
    verb.add("--method", options->method,
             "median-cut: lights of about equal energy that add up to the probe; dominant: what is "
             "brighter than a threshold in a coarse image")
        .oneOf(kMethods);
    const Option log2 =
        verb.add("--log2", options->log2Count, "Median cut: 2^K lights").range(0, kMaxLog2Lights);
    const Option count = verb.add("--count", options->count, "Median cut: number of lights, a power of two")
                             .range(uint64_t{1}, uint64_t{1} << kMaxLog2Lights)
                             .excludes(log2);
    verb.add("--cut", options->cut, "Longer side by angles, or by the length of the parallel")
        .oneOf(kNames<LongerSide>);
    verb.add("--position", options->position, "Where in its region a light lies").oneOf(kNames<LightPlace>);
    verb.add("--weights", options->weights, "Weights of the rows (probes/median_cut.h)")
        .oneOf(kNames<TexelWeight>);
    verb.add("--threshold", options->threshold, "Dominant: fraction of the brightest texel").range(1e-6, 1.0);
    verb.add("--width", options->width, "Dominant: texels along the coarse image").range(1, kMaxImageSize);
    verb.add("--max-lights", options->maxLights, "Dominant: the most lights").range(1, 1 << 20);
    verb.addFlag("--upper-half", options->upperHalf, "Dominant: only lights above the horizon");
    addIsaOption(verb);
    addThreadsOption(verb, options->threads);
    verb.addFlag("--json", options->json, "Report as JSON");
    verb.onRun([options, count] {
        options->countIsGiven = count.isGiven();
        return runProbeLights(*options);
    });
}

}  // namespace etalon
