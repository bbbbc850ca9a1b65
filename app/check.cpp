#include <memory>

#include "app/options.h"
#include "app/output.h"
#include "app/report.h"
#include "app/verbs.h"
#include "golden/golden.h"
#include "numeric/text.h"

namespace etalon {
namespace {

struct CheckOptions {
    std::string pattern = "*", manifest = "golden/manifest.json";
    bool json = false;
};

std::string resultText(const GoldenManifest& manifest, const GoldenResult& result) {
    std::string text = formatText("{}: {}", verdictName(result.verdict), result.name);
    if (!result.message.empty()) text += ": " + result.message;
    text += '\n';
    if (result.comparison)
        text +=
            comparisonText(*result.comparison, manifest.resolve(result.name + ".exr").string(), "the render");
    return text;
}

Json resultJson(const GoldenResult& result) {
    Json json = {
        {"name", result.name}, {"verdict", verdictName(result.verdict)}, {"message", result.message}};
    if (result.comparison) json["comparison"] = comparisonJson(*result.comparison);
    return json;
}

ExitCode runCheck(const CheckOptions& options, const GoldenSupport& support) {
    const GoldenManifest manifest = readManifest(options.manifest);
    ProgressLine progress;
    TimeLeft left;
    const auto results =
        checkGolden(manifest, options.pattern, support.rulesVersion, support.render,
                    [&](const std::string& name, size_t index, size_t count) {
                        progress.show(formatText("[{}/{}] {}", index + 1, count, name) +
                                      left.of(1, static_cast<double>(index) / static_cast<double>(count)));
                    });
    progress.finish();
    size_t same = 0;
    bool failed = false;
    std::string text;
    Json list = Json::list();
    for (const GoldenResult& result : results) {
        same += result.verdict == GoldenVerdict::same ? 1 : 0;
        failed = failed || result.verdict == GoldenVerdict::failed;
        text += resultText(manifest, result);
        list.append(resultJson(result));
    }
    text += formatText("{} of {} golden images are the same\n", same, results.size());
    printOut(options.json ? jsonText({{"checked", results.size()}, {"same", same}, {"results", list}})
                          : text);
    if (results.empty()) {
        printText(stderr, "etalon: {}: nothing to check: no case matches \"{}\"\n", options.manifest,
                  options.pattern);
        return ExitCode::nothingToCheck;
    }
    if (failed) return ExitCode::badInput;
    return same == results.size() ? ExitCode::done : ExitCode::difference;
}

}  // namespace

void addCheck(Verb& command, const GoldenSupport& support) {
    const auto options = std::make_shared<CheckOptions>();
    Verb& verb = command.addVerb(
        "check",
        "Render the golden cases and compare them to the bit; writes nothing. Exit 1 if one differs.");
    verb.add("PATTERN", options->pattern, "Names of cases: * ? [...]");
    verb.add("--manifest", options->manifest, "Manifest of the golden images");
    verb.addFlag("--json", options->json, "Report as JSON");
    addIsaOption(verb);
    verb.onRun([options, &support] { return runCheck(*options, support); });
}

}  // namespace etalon
