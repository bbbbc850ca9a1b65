#include "scene/outputs.h"

#include <memory>

#include "app/command_line.h"
#include "app/output.h"
#include "app/verbs.h"
#include "files/json.h"
#include "numeric/text.h"

namespace etalon {
namespace {

struct OutputsVerb {
    bool json = false;
};

// A row of a Markdown table for each part of each output.
std::string outputsText() {
    std::string text =
        "| output | channels | unit | range | a pixel is | background | meaning "
        "|\n|---|---|---|---|---|---|---|\n";
    for (const OutputDescription& output : outputDescriptions())
        for (const OutputPart& part : output.parts)
            text += formatText("| `{}` | {}`{}` | {} | {} | {} | {} | {} |\n", output.name,
                               output.file.empty() ? "" : formatText("of `*.{}.exr`: ", output.file),
                               joinText(part.channels, "`, `"), part.unit, part.range, part.pixel,
                               part.background, &part == &output.parts.front() ? output.meaning : "");
    return text;
}

Json outputsJson() {
    Json outputs = Json::list();
    for (const OutputDescription& output : outputDescriptions()) {
        Json parts = Json::list();
        for (const OutputPart& part : output.parts)
            parts.append({{"channels", part.channels},
                          {"unit", part.unit},
                          {"range", part.range},
                          {"pixel", part.pixel},
                          {"background", part.background}});
        outputs.append(
            {{"name", output.name}, {"meaning", output.meaning}, {"file", output.file}, {"parts", parts}});
    }
    return outputs;
}

}  // namespace

void addOutputs(Verb& command) {
    const auto options = std::make_shared<OutputsVerb>();
    Verb& verb = command.addVerb("outputs", "List what a render can write, channel by channel");
    verb.addFlag("--json", options->json, "As JSON; else a Markdown table");
    verb.onRun([options] {
        printOut(options->json ? jsonText(outputsJson()) : outputsText());
        return ExitCode::done;
    });
}

}  // namespace etalon
