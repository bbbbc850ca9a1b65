#include "golden/compare.h"

#include <memory>

#include "app/command_line.h"
#include "app/output.h"
#include "app/report.h"
#include "app/verbs.h"
#include "files/image_io.h"
#include "numeric/text.h"
#include "scene/toml_reader.h"

namespace etalon {
namespace {

struct CompareOptions {
    std::string a, b, errorImage;
    bool json = false, bits = false;
    int maxWorst = 5;
};

// The error image must not replace what was compared.
void checkErrorPath(const CompareOptions& options) {
    if (std::filesystem::path(options.errorImage).extension() != ".exr")
        throw InputError(formatText("{}: the error image is an EXR file; name it .exr", options.errorImage));
    for (const std::string& input : {options.a, options.b}) {
        std::error_code error;
        if (std::filesystem::equivalent(options.errorImage, input, error))
            throw InputError(
                formatText("{}: the error image would replace a compared image", options.errorImage));
    }
}

ExitCode runCompare(const CompareOptions& options) {
    const bool wantsError = !options.errorImage.empty();
    if (wantsError) checkErrorPath(options);
    ProgressLine progress;
    const auto read = [&](const std::string& file) {
        return progress.during("reading " + printable(file), [&] { return readFrame(file); });
    };
    const Frame a = read(options.a), b = read(options.b);
    const Comparison comparison =
        progress.during("comparing", [&] { return compareFrames(a, b, options.maxWorst); });
    if (wantsError && !comparison.channels.empty())
        progress.during("writing " + printable(options.errorImage),
                        [&] { writeExr(errorFrame(a, b), options.errorImage); });
    progress.finish();
    printOut(options.json ? jsonText(comparisonJson(comparison))
                          : comparisonText(comparison, options.a, options.b));
    if (wantsError && comparison.channels.empty())
        printText(stderr, "etalon: {}: not written: the images share no channel of one size and type\n",
                  options.errorImage);
    return (options.bits ? comparison.identical() : comparison.equal()) ? ExitCode::done
                                                                        : ExitCode::difference;
}

}  // namespace

void addCompare(Verb& command) {
    const auto options = std::make_shared<CompareOptions>();
    Verb& verb = command.addVerb(
        "compare",
        "Compare two images: shape, NaN and infinity positions, distances. Exit 1 if they differ.");
    verb.add("A", options->a, "Image file").required();
    verb.add("B", options->b, "Image file").required();
    verb.addFlag("--json", options->json, "Report as JSON");
    verb.addFlag("--bits", options->bits, "Signs of zeros and payloads of NaN count as differences");
    verb.add("--error-image", options->errorImage, "Write |B - A| of every channel to this EXR file");
    verb.add("--max-worst", options->maxWorst, "Worst samples to list per channel").range(0, 10000);
    verb.onRun([options] { return runCompare(*options); });
}

}  // namespace etalon
