#include <cmath>
#include <memory>

#include "app/options.h"
#include "app/output.h"
#include "app/verbs.h"
#include "files/json.h"
#include "numeric/text.h"
#include "probes/harmonics_layout.h"
#include "probes/harmonics_lobes.h"

namespace etalon {
namespace {

struct ProbeShVerb {
    ProbeInput input;
    std::string of = "radiance", window = "none", layout;
    int degree = 2, threads = 0;
    double width = 0;
    bool json = false;
};

constexpr std::string_view kFunctions[] = {"radiance", "irradiance"};
constexpr std::string_view kWindows[] = {"none", "hanning", "lanczos", "minimal"};

struct Windowed {
    SphericalHarmonics harmonics;
    std::vector<double> factors;
    double strength = 0;  // of the minimal window
};
Windowed windowOf(const ProbeShVerb& verb, const SphericalHarmonics& f) {
    Windowed w{f, mirrorLobe(f.degree)};
    const double width = verb.width > 0 ? verb.width : f.degree + 1.0;
    if (verb.window == "hanning") w.factors = hanningWindow(f.degree, width);
    if (verb.window == "lanczos") w.factors = lanczosWindow(f.degree, width);
    if (verb.window == "minimal") {
        MinimalWindow minimal = minimalWindow(f);
        w.factors = std::move(minimal.factors);
        w.strength = minimal.strength;
    }
    w.harmonics = scaleBands(f, w.factors);
    return w;
}

CoefficientLayout layoutOf(const ProbeShVerb& verb) {
    return memberOf<CoefficientLayout>(verb.layout).value_or(CoefficientLayout::interleaved);
}

std::string tableOf(const SphericalHarmonics& f) {
    std::string text;
    for (int l = 0; l <= f.degree; l++)
        for (int m = -l; m <= l; m++)
            text += formatText("{:2} {:3}  {:16.9g} {:16.9g} {:16.9g}\n", l, m, f.at(l, m).x, f.at(l, m).y,
                               f.at(l, m).z);
    return text;
}

ExitCode runProbeSh(const ProbeShVerb& verb) {
    ProgressLine progress;
    const Probe probe = verb.input.load(progress);
    SphericalHarmonics f =
        progress.during("projecting", [&] { return projectHarmonics(probe, verb.degree, verb.threads); });
    progress.finish();
    for (const glm::dvec3& c : f.coefficients)
        if (!std::isfinite(c.x) || !std::isfinite(c.y) || !std::isfinite(c.z))
            throw InputError(formatText("{}: NaN or infinite radiance has no harmonics", verb.input.file));
    if (verb.of == "irradiance") f = irradianceOfHarmonics(f);
    const Windowed w = windowOf(verb, f);
    const double smallest = smallestValue(w.harmonics);
    if (verb.json) {
        Json json = {{"file", verb.input.file},
                     {"of", verb.of},
                     {"degree", verb.degree},
                     {"window", verb.window},
                     {"window_factors", w.factors}};
        if (verb.window == "minimal") json["window_strength"] = Json::numberOf(w.strength);
        json["smallest_value"] = smallest;
        json["layout"] = nameOf(layoutOf(verb));
        json["coefficients"] = layOut(w.harmonics, layoutOf(verb));
        printOut(jsonText(json));
    } else if (!verb.layout.empty()) {
        std::string text;
        for (const double value : layOut(w.harmonics, layoutOf(verb))) text += formatText("{:.9g}\n", value);
        printOut(text);
    } else {
        printOut(formatText("# {} of degree {}, window {}, smallest value {:.6g}\n#  l   m  R G B\n", verb.of,
                            verb.degree, verb.window, smallest) +
                 tableOf(w.harmonics));
    }
    return ExitCode::done;
}

}  // namespace

void addProbeSh(Verb& probe) {
    const auto options = std::make_shared<ProbeShVerb>();
    Verb& verb =
        probe.addVerb("sh", "Spherical harmonics of a probe: world axes, +Y up, with Condon-Shortley phase.");
    options->input.addTo(verb);
    verb.add("--degree", options->degree, "Bands 0 .. degree").range(0, kMaxHarmonicDegree);
    verb.add("--of", options->of, "The function: radiance, or irradiance over normals").oneOf(kFunctions);
    verb.add("--window", options->window,
             "Against ringing; minimal: only as much as removes what is negative")
        .oneOf(kWindows);
    verb.add("--window-width", options->width,
             "hanning, lanczos: the band where the window is 0; default degree + 1")
        .range(1e-3, 1e6);
    verb.add("--coefficients", options->layout,
             "Only the numbers, one per line: interleaved (R G B of each coefficient, as ARCore) or "
             "planar (all of red first, as ARKit)")
        .oneOf(kNames<CoefficientLayout>);
    addIsaOption(verb);
    addThreadsOption(verb, options->threads);
    verb.addFlag("--json", options->json, "Report as JSON");
    verb.onRun([options] { return runProbeSh(*options); });
}

}  // namespace etalon
