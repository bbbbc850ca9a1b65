#include "app/scene_options.h"

#include "app/machine_options.h"
#include "scene/outputs.h"
#include "scene/profile_file.h"

namespace etalon {

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

}  // namespace etalon
