// The options that every verb with a scene shares.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "ar/render_scene.h"
#include "ar/scene_loader.h"
#include "numeric/isa.h"
#include "raster/profile.h"

namespace etalon {

// --isa for a verb that renders: selects the level when it is parsed.
inline CLI::Option* addIsaOption(CLI::App& verb) {
    std::vector<std::string> names;
    for (const IsaLevel level : usableIsaLevels()) names.push_back(isaName(level));
    return verb
        .add_option_function<std::string>(
            "--isa", [](const std::string& name) { selectIsa(*findIsa(name)); },
            "Instruction set level of the inner loops; default: the widest. Changes no bit")
        ->check(CLI::IsMember(names));
}

// --threads and --tile, into an int or an optional one.
template <class Integer>
void addThreadsOption(CLI::App& verb, Integer& threads) {
    verb.add_option("--threads", threads, "Threads; 0: all. Changes no bit")->check(CLI::Range(0, 1024));
}
template <class Integer>
void addTileOption(CLI::App& verb, Integer& tileSize) {
    verb.add_option("--tile", tileSize, "Tile size in pixels, a multiple of 8. Changes no bit")
        ->check(CLI::Range(8, 256))
        ->check([](const std::string& text) {
            return std::stoi(text) % 8 == 0 ? std::string() : "tile size " + text + " is not a multiple of 8";
        });
}

struct SceneOptions {
    std::string scene, profile;
    std::vector<std::string> outputs;
    bool strict = false;
    RasterOptions raster;

    void addTo(CLI::App& verb) {
        const auto names = [](const auto& list) {
            return CLI::IsMember(std::vector<std::string>(list.begin(), list.end()));
        };
        verb.add_option("scene", scene, "Scene file (TOML)")->required();
        verb.add_option("--profile", profile, "Arithmetic profile; default: the scene's")
            ->check(names(profileNames()));
        verb.add_option("--outputs", outputs, "Outputs instead of the scene's")
            ->delimiter(',')
            ->check(names(kOutputNames));
        verb.add_flag("--strict", strict, "Questionable input (negative or NaN radiance) is an error");
        addIsaOption(verb);
        addThreadsOption(verb, raster.threads);
        addTileOption(verb, raster.tileSize);
    }

    RenderOptions renderOptions() const {
        RenderOptions options;
        options.request.outputs = outputs;
        options.profile = profile;
        options.raster = raster;
        options.strict = strict;
        return options;
    }
};

}  // namespace etalon
