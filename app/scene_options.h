// The options that every verb with a scene shares.
#pragma once

#include <string>
#include <vector>

#include "ar/render_scene.h"

namespace etalon {

class Verb;

struct SceneOptions {
    std::string scene, profile;  // the profile as a name or a file; empty: the scene's
    std::vector<std::string> outputs;
    bool strict = false;
    RasterOptions raster;

    void addTo(Verb& verb);
    RenderOptions renderOptions() const;
};

}  // namespace etalon
