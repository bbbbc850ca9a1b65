#include <algorithm>
#include <chrono>
#include <filesystem>
#include <memory>

#include "app/command_line.h"
#include "app/options.h"
#include "app/output.h"
#include "app/verbs.h"
#include "files/atomic_file.h"
#include "files/image_io.h"
#include "files/json.h"
#include "numeric/text.h"
#include "scene/scene.h"
#include "scene/toml_reader.h"

namespace etalon {
namespace {

// From this size on the memory is announced before it is taken.
constexpr uint64_t kAnnouncedMemory_bytes = uint64_t{1} << 30;

struct RenderVerb {
    SceneOptions scene;
    std::vector<std::string> files;
    bool json = false, timings = false, everything = false;
};

bool isPng(const std::filesystem::path& file) { return file.extension() == ".png"; }

void requireKnownExtension(const std::filesystem::path& file) {
    if (file.extension() != ".exr" && !isPng(file))
        throw InputError(formatText("{}: unknown kind of image \"{}\"; known: .exr .png", file.string(),
                                    file.extension().string()));
}

// A line for each pass that ran: its time, what its result held, its name.
std::string timingsText(const Plan& plan) {
    std::string text;
    for (const Pass& pass : plan.passes)
        if (pass.runs)
            text +=
                formatText("{:9.3f} s {:9.1f} MiB  {}\n", pass.seconds,
                           static_cast<double>(pass.held.all_bytes()) / (1 << 20), printable(pass.name()));
    return text;
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
    options.everything = verb.everything;
    ProgressLine progress;
    RenderProgressText progressText;
    options.progress = [&](const RenderProgress& at) { progress.show(progressText.of(at)); };
    options.announceMemory = [](uint64_t bytes) {
        if (bytes >= kAnnouncedMemory_bytes)
            printText(stderr, "etalon: needs up to {:.1f} GiB for targets and images\n",
                      static_cast<double>(bytes) / static_cast<double>(kAnnouncedMemory_bytes));
    };
    const auto start = std::chrono::steady_clock::now();
    const RenderResult result = renderScene(scene, options);
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    for (size_t i = 0; i < files.size(); i++) {
        const bool isToned = isPng(verb.files[i]);
        files[i]->write(progress.during("writing " + printable(verb.files[i]), [&] {
            return isToned ? encodePng(result.toned) : encodeExr(result.frame, options.raster.threads);
        }));
    }
    // Outputs that are files of their own lie beside each EXR file.
    std::vector<std::string> written = verb.files;
    for (const std::string& file : verb.files)
        for (const OutputFile& beside : result.files) {
            if (isPng(file)) continue;
            std::filesystem::path path = file;
            written.push_back(path.replace_extension(beside.name + ".exr").string());
            files.push_back(std::make_unique<AtomicFile>(written.back()));
            files.back()->write(progress.during("writing " + printable(written.back()), [&] {
                return encodeExr(beside.frame, options.raster.threads);
            }));
        }
    for (const auto& file : files) file->commit();
    progress.finish();

    for (const std::string& warning : result.warnings) printText(stderr, "etalon: warning: {}\n", warning);
    if (verb.json) {
        printOut(jsonText({{"files", written},
                           {"width", result.frame.width},
                           {"height", result.frame.height},
                           {"seconds", seconds},
                           {"triangles", result.raster.triangles},
                           {"droppedNonFinite", result.raster.droppedNonFinite},
                           {"clipped", result.raster.clipped},
                           {"surfaceFragments", result.shading.surfaceFragments},
                           {"backgroundFragments", result.shading.backgroundFragments},
                           {"memory_bytes", result.plan.memory_bytes()},
                           {"passes", planPassesJson(result.plan)},
                           {"warnings", result.warnings}}));
    } else {
        std::string text;
        for (size_t i = 0; i < verb.files.size(); i++)
            text += formatText("{}: {}x{} in {:.2f} s\n", written[i], result.frame.width, result.frame.height,
                               seconds);
        for (size_t i = verb.files.size(); i < written.size(); i++) text += written[i] + "\n";
        if (verb.timings) text += timingsText(result.plan);
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
    const Option json =
        verb.addFlag("--json", options->json, "Report as JSON on standard output, pass by pass");
    verb.addFlag("--timings", options->timings,
                 "Say what time each pass took and what memory its result held")
        .excludes(json);
    verb.addFlag("--everything", options->everything, "Run every pass, needed or not. Changes no bit");
    verb.onRun([options] { return runRender(*options); });
}

}  // namespace etalon
