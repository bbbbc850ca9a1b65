#include "app/options.h"

#include <limits>

#include "numeric/isa.h"
#include "numeric/text.h"
#include "probes/mapping.h"
#include "scene/outputs.h"
#include "scene/profile_file.h"
#include "scene/toml_reader.h"

namespace etalon {
namespace {

template <class Integer>
Option addThreads(Verb& verb, Integer& threads) {
    return verb.add("--threads", threads, "Threads; 0: all. Changes no bit").range(0, 1024);
}
template <class Integer>
Option addTile(Verb& verb, Integer& tileSize) {
    return verb.add("--tile", tileSize, "Tile size in pixels, a multiple of 8. Changes no bit")
        .range(8, 256)
        .multipleOf(8, "tile size");
}

}  // namespace

Option addIsaOption(Verb& verb) {
    verb.beforeRun([] { activeIsa(); });
    std::vector<std::string> names;
    for (const IsaLevel level : usableIsaLevels()) names.push_back(isaName(level));
    return verb
        .addCall(
            "--isa", [](const std::string& name) { selectIsa(*findIsa(name)); },
            "Instruction set level of the inner loops; default: the widest. Changes no bit")
        .oneOf(names);
}

Option addThreadsOption(Verb& verb, int& threads) { return addThreads(verb, threads); }
Option addThreadsOption(Verb& verb, std::optional<int>& threads) { return addThreads(verb, threads); }
Option addTileOption(Verb& verb, int& tileSize) { return addTile(verb, tileSize); }
Option addTileOption(Verb& verb, std::optional<int>& tileSize) { return addTile(verb, tileSize); }

void ProbeInput::addTo(Verb& verb) {
    verb.add("FILE", file, "Image file of a probe (.exr, .hdr, .tif, .pfm)").required();
    verb.add("--mapping", mapping, "How the file lays out directions; default: told by the file")
        .oneOf(kNames<Mapping>);
    verb.add("--layout", layout, "How the file lays out cube faces; default: told by its shape")
        .oneOf(kNames<CubeLayout>);
    verb.add("--ball-distance", ballDistance_radii,
             "Of a mirror ball, from the eye to its middle in radii; default: the file's, or infinity")
        .range(kLeastBallDistance_radii, std::numeric_limits<double>::infinity());
}

Probe ProbeInput::load(ProgressLine& progress) const {
    ProbeFileOptions options;
    if (!mapping.empty()) options.mapping = *memberOf<Mapping>(mapping);
    if (!layout.empty()) options.layout = *memberOf<CubeLayout>(layout);
    if (ballDistance_radii > 0) options.ballDistance_radii = ballDistance_radii;
    return progress.during("reading " + printable(file), [&] { return loadProbe(file, options); });
}

void SceneOptions::addTo(Verb& verb) {
    verb.add("scene", scene, "Scene file (TOML)").required();
    verb.add("--profile", profile,
             "Arithmetic profile: a name (etalon profiles) or a TOML file; default: the scene's");
    verb.add("--outputs", outputs, "Outputs instead of the scene's").delimiter(',').oneOf(outputNames());
    verb.addFlag("--strict", strict, "Questionable input (negative or NaN radiance) is an error");
    addIsaOption(verb);
    addThreadsOption(verb, raster.threads);
    addTileOption(verb, raster.tileSize);
}

RenderOptions SceneOptions::renderOptions() const {
    RenderOptions options;
    options.request.outputs = outputs;
    if (!profile.empty()) options.profile = loadProfile(profile);
    options.raster = raster;
    options.strict = strict;
    return options;
}

std::string RenderProgressText::of(const RenderProgress& progress) {
    if (progress.pass != pass_) pass_ = progress.pass, left_ = {};
    const auto& passes = progress.plan->passes;
    size_t number = 0, count = 0;
    for (size_t i = 0; i < passes.size(); i++) {
        count += passes[i].runs ? 1 : 0;
        number += passes[i].runs && i <= progress.pass ? 1 : 0;
    }
    return formatText("{} ({} of {})", printable(passes[progress.pass].name()), number, count) +
           left_.of(progress.step, progress.part);
}

}  // namespace etalon
