#include <memory>

#include "app/options.h"
#include "app/output.h"
#include "app/verbs.h"
#include "files/json.h"
#include "numeric/text.h"
#include "probes/irradiance.h"
#include "probes/probe_statistics.h"
#include "raster/names.h"

namespace etalon {
namespace {

struct ProbeInfoVerb {
    ProbeInput input;
    int threads = 0;
    bool json = false;
};

Json jsonOf(const glm::dvec3& v) {
    return Json::list({Json::numberOf(v.x), Json::numberOf(v.y), Json::numberOf(v.z)});
}
std::string textOf(const glm::dvec3& v) { return formatText("{:.6g} {:.6g} {:.6g}", v.x, v.y, v.z); }

ExitCode runProbeInfo(const ProbeInfoVerb& verb) {
    ProgressLine progress;
    const Probe probe = verb.input.load(progress);
    const ProbeStatistics s = progress.during("measuring", [&] { return statisticsOf(probe, verb.threads); });
    const std::vector<glm::dvec3> axes = {{1, 0, 0},  {-1, 0, 0}, {0, 1, 0},
                                          {0, -1, 0}, {0, 0, 1},  {0, 0, -1}};
    const auto irradiance = progress.during(
        "adding up", [&] { return irradianceAt(probe, axes, Arithmetic::fp64, verb.threads); });
    progress.finish();
    const std::string_view mapping = nameOf(probe.shape.mapping);
    if (verb.json) {
        Json json = {{"file", verb.input.file},
                     {"mapping", mapping},
                     {"width", probe.shape.width},
                     {"height", probe.shape.height}};
        if (probe.shape.mapping == Mapping::mirrorBall)
            json["ball_distance_radii"] = Json::numberOf(probe.shape.ballDistance_radii);
        json["has_distance"] = !probe.distance_m.empty();
        json["has_valid"] = !probe.valid.empty();
        json["smallest"] = Json::numberOf(s.smallest);
        json["largest"] = Json::numberOf(s.largest);
        json["dynamic_range_stops"] = Json::numberOf(s.dynamicRange_stops);
        json["mean_radiance"] = jsonOf(s.mean);
        json["solid_angle_sr"] = s.solidAngle_sr;
        json["negative"] = s.negative;
        json["infinite"] = s.infinite;
        json["nan"] = s.notANumber;
        for (size_t i = 0; i < axes.size(); i++)
            json["irradiance"][nameOf(static_cast<CubeFace>(i))] = jsonOf(irradiance[i]);
        printOut(jsonText(json));
        return ExitCode::done;
    }
    std::string text =
        formatText("{}: {} {}x{}{}{}\n", verb.input.file, mapping, probe.shape.width, probe.shape.height,
                   probe.distance_m.empty() ? "" : ", distances", probe.valid.empty() ? "" : ", valid");
    text += formatText(
        "radiance       {:.6g} to {:.6g}, {:.1f} stops between the smallest above 0 and the largest\n",
        s.smallest, s.largest, s.dynamicRange_stops);
    text += formatText("mean           {}  over {:.6f} sr\n", textOf(s.mean), s.solidAngle_sr);
    text +=
        formatText("no radiance    {} negative, {} infinite, {} NaN\n", s.negative, s.infinite, s.notANumber);
    for (size_t i = 0; i < axes.size(); i++)
        text += formatText("irradiance {}  {}\n", nameOf(static_cast<CubeFace>(i)), textOf(irradiance[i]));
    printOut(text);
    return ExitCode::done;
}

}  // namespace

void addProbeInfo(Verb& probe) {
    const auto options = std::make_shared<ProbeInfoVerb>();
    Verb& verb = probe.addVerb("info", "What a probe holds: mapping, range, mean, irradiance");
    options->input.addTo(verb);
    addIsaOption(verb);
    addThreadsOption(verb, options->threads);
    verb.addFlag("--json", options->json, "Report as JSON");
    verb.onRun([options] { return runProbeInfo(*options); });
}

}  // namespace etalon
