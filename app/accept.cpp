#include <memory>

#include "app/options.h"
#include "app/output.h"
#include "app/verbs.h"
#include "golden/golden.h"
#include "numeric/text.h"

namespace etalon {
namespace {

struct AcceptOptions {
    std::string pattern, reason, manifest = "golden/manifest.json";
};

ExitCode runAccept(const AcceptOptions& options, const GoldenSupport& support) {
    GoldenManifest manifest = readManifest(options.manifest);
    ProgressLine progress;
    TimeLeft left;
    const auto accepted =
        acceptGolden(manifest, options.pattern, options.reason, support.rulesVersion, support.render,
                     [&](const std::string& name, size_t index, size_t count) {
                         progress.show(formatText("[{}/{}] {}", index + 1, count, name) +
                                       left.of(1, static_cast<double>(index) / static_cast<double>(count)));
                     });
    progress.finish();
    if (accepted.empty()) {
        printText(stderr, "etalon: {}: nothing to check: no case matches \"{}\"\n", options.manifest,
                  options.pattern);
        return ExitCode::nothingToCheck;
    }
    std::string text;
    for (const GoldenAcceptance& acceptance : accepted)
        text += formatText("{}: {}\n", acceptance.changed ? "accepted" : "unchanged", acceptance.name);
    printOut(text);
    return ExitCode::done;
}

}  // namespace

void addAccept(Verb& command, const GoldenSupport& support) {
    const auto options = std::make_shared<AcceptOptions>();
    Verb& verb = command.addVerb("accept", "Render golden cases and make the result the accepted one.");
    verb.add("PATTERN", options->pattern, "Names of cases: * ? [...]").required();
    verb.add("--reason", options->reason, "Why the images change; kept in the manifest").required();
    verb.add("--manifest", options->manifest, "Manifest of the golden images");
    addIsaOption(verb);
    verb.onRun([options, &support] { return runAccept(*options, support); });
}

}  // namespace etalon
