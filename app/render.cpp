#include <algorithm>
#include <chrono>
#include <filesystem>
#include <memory>

#include "app/command_line.h"
#include "app/output.h"
#include "app/scene_options.h"
#include "app/verbs.h"
#include "ar/atomic_file.h"
#include "ar/image_io.h"
#include "ar/json.h"
#include "ar/scene_loader.h"
#include "lighting/tone_map.h"
#include "numeric/text.h"

namespace etalon {
namespace {

// From this size on the memory is announced before it is taken.
constexpr uint64_t kAnnouncedMemory_bytes = uint64_t{1} << 30;

struct RenderVerb {
    SceneOptions scene;
    std::vector<std::string> files;
    bool json = false;
};

bool isPng(const std::filesystem::path& file) { return file.extension() == ".png"; }

void requireKnownExtension(const std::filesystem::path& file) {
    if (file.extension() != ".exr" && !isPng(file))
        throw InputError(formatText("{}: unknown kind of image \"{}\"; known: .exr .png", file.string(),
                                    file.extension().string()));
}

ToneMap toneMapOf(std::string_view name) {
    if (name == "reinhard") return ToneMap::reinhard;
    if (name == "filmic") return ToneMap::filmic;
    return ToneMap::linear;
}

ExitCode runRender(const RenderVerb& verb) {
    const Scene scene = loadScene(verb.scene.scene);
    RenderOptions options = verb.scene.renderOptions();

    // Open the files first, so that a folder that refuses them does so before the work.
    std::vector<std::unique_ptr<AtomicFile>> files;
    for (const std::string& file : verb.files) {
        requireKnownExtension(file);
        options.request.png = options.request.png || isPng(file);
        files.push_back(std::make_unique<AtomicFile>(file));
    }
    ProgressLine progress;
    options.progress = [&](const std::string& pass) { progress.show(pass); };
    options.announceMemory = [](uint64_t bytes) {
        if (bytes >= kAnnouncedMemory_bytes)
            printText(stderr, "etalon: needs up to {:.1f} GiB for targets and images\n",
                      static_cast<double>(bytes) / static_cast<double>(kAnnouncedMemory_bytes));
    };
    const auto start = std::chrono::steady_clock::now();
    const RenderResult result = renderScene(scene, options);
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    progress.show("writing");
    for (size_t i = 0; i < files.size(); i++) {
        files[i]->write(
            isPng(verb.files[i])
                ? encodePng(toneMap(result.beauty, toneMapOf(scene.output.toneMap), scene.output.exposure))
                : encodeExr(result.frame));
    }
    for (const auto& file : files) file->commit();
    progress.finish();

    for (const std::string& warning : result.warnings) printText(stderr, "etalon: warning: {}\n", warning);
    if (verb.json) {
        Json passes = Json::list();
        for (const PlanPass& pass : result.plan.passes)
            if (pass.runs) passes.append(pass.name);
        printOut(jsonText({{"files", verb.files},
                           {"width", result.frame.width},
                           {"height", result.frame.height},
                           {"seconds", seconds},
                           {"triangles", result.raster.triangles},
                           {"droppedNonFinite", result.raster.droppedNonFinite},
                           {"clipped", result.raster.clipped},
                           {"surfaceFragments", result.shading.surfaceFragments},
                           {"backgroundFragments", result.shading.backgroundFragments},
                           {"passes", passes},
                           {"warnings", result.warnings}}));
    } else {
        std::string text;
        for (const std::string& file : verb.files)
            text +=
                formatText("{}: {}x{} in {:.2f} s\n", file, result.frame.width, result.frame.height, seconds);
        printOut(text);
    }
    return ExitCode::done;
}

}  // namespace

void addRender(Verb& command) {
    auto options = std::make_shared<RenderVerb>();
    Verb& verb = command.addVerb("render", "Render a scene file to images");
    options->scene.addTo(verb);
    verb.add("-o,--output", options->files, "Image to write: .exr (all outputs) or .png (tone mapped beauty)")
        .required()
        .repeated();
    verb.addFlag("--json", options->json, "Report as JSON on standard output");
    verb.onRun([options] { return runRender(*options); });
}

}  // namespace etalon
