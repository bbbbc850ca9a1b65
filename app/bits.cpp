#include <fnmatch.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <optional>
#include <span>

#include "app/options.h"
#include "app/output.h"
#include "app/verbs.h"
#include "bitcheck/dump.h"
#include "files/atomic_file.h"
#include "files/json.h"
#include "numeric/parallel.h"
#include "numeric/text.h"
#include "raster/rules.h"

namespace etalon {
namespace {

struct BitsOptions {
    std::string pattern = "*", reference = "golden/bits.txt", against, dump, reason;
    WaySelection ways;
    bool accept = false, json = false;
};

std::string readFile(const std::string& file) {
    std::ifstream stream(file, std::ios::binary);
    if (!stream || std::filesystem::is_directory(file))
        throw InputError(formatText("{}: no such file, or it cannot be read", file));
    return {std::istreambuf_iterator<char>(stream), {}};
}

bool matches(const std::string& pattern, const std::string& name) {
    return fnmatch(pattern.c_str(), name.c_str(), 0) == 0;
}

std::span<const std::byte> bytesOf(const std::string& text) { return std::as_bytes(std::span(text)); }

// The levels and threads of this machine.
std::string machineText() {
    std::string text = "levels";
    for (const IsaLevel level : usableIsaLevels()) text += formatText(" {}", isaName(level));
    return text + formatText("; {} hardware threads", hardwareThreads());
}

// What the bits are compared with.
struct Expectation {
    BitReference reference;
    std::optional<BitDump> words;
};

Expectation readExpectation(const BitsOptions& options) {
    if (options.against.empty())
        return {readReference(readFile(options.reference), options.reference), std::nullopt};
    BitDump dump = decodeDump(bytesOf(readFile(options.against)), options.against);
    BitReference reference = referenceOf(dump, "words of another machine");
    return {std::move(reference), std::move(dump)};
}

// "[12/135] shading/f32: 9 %, 20 s left".
std::string caseText(const BitCase& c, size_t done, size_t count, TimeLeft& left) {
    return formatText("[{}/{}] {}", done + 1, count, c.name) +
           left.of(1, static_cast<double>(done) / static_cast<double>(count));
}

// Each case in one way.
BitDump computeAll(const std::vector<BitCase>& cases, const WaySelection& ways, ProgressLine& progress) {
    BitDump dump{kRulesVersion, {}};
    TimeLeft left;
    for (const BitCase& c : cases) {
        progress.show(caseText(c, dump.cases.size(), cases.size(), left));
        dump.cases.push_back({c.name, runCase(c, waysOf(ways, c).front())});
    }
    return dump;
}

std::string resultText(const BitResult& result) {
    std::string text = formatText("{}: {}: ", verdictName(result.verdict), result.name);
    if (result.verdict != BitVerdict::same) return text + result.message + "\n";
    return text +
           formatText("{}; {} way{}\n", result.what, result.ways.size(), result.ways.size() == 1 ? "" : "s");
}

Json wayJson(const BitWay& way) {
    return {{"isa", isaName(way.level)}, {"threads", way.threads}, {"tile", way.tileSize}};
}

Json resultJson(const BitResult& result) {
    Json json = {
        {"name", result.name},       {"what", result.what},        {"verdict", verdictName(result.verdict)},
        {"message", result.message}, {"ways", result.ways.size()}, {"differing", Json::list()}};
    for (const BitWay& way : result.differing) json["differing"].append(wayJson(way));
    if (!result.difference) return json;
    const BitDifference& d = *result.difference;
    json["difference"] = {
        {"way", wayJson(d.way)}, {"plane", d.plane}, {"tile", Json::list({d.tileX, d.tileY})}};
    if (d.pixel)
        json["difference"]["pixel"] = {{"x", d.pixel->x},
                                       {"y", d.pixel->y},
                                       {d.layerName, d.pixel->layer},
                                       {"expected", wordText(d.kind, d.pixel->expected)},
                                       {"found", wordText(d.kind, d.pixel->found)}};
    if (d.agreeingWay) json["difference"]["agreeing_way"] = wayJson(*d.agreeingWay);
    return json;
}

// The results of all cases, and of those that only the reference has.
std::vector<BitResult> checkAll(const BitsOptions& options, const std::vector<BitCase>& cases,
                                const std::vector<BitCase>& allCases, const Expectation& expected,
                                ProgressLine& progress) {
    std::vector<BitResult> results;
    TimeLeft left;
    for (const BitCase& c : cases) {
        progress.show(caseText(c, results.size(), cases.size(), left));
        results.push_back(checkCase(c, waysOf(options.ways, c), expected.reference,
                                    expected.words ? &expected.words->cases : nullptr));
    }
    for (const BitResult& obsolete : findObsolete(expected.reference, allCases))
        if (matches(options.pattern, obsolete.name)) results.push_back(obsolete);
    return results;
}

// The reference as it is on the disk, if it can be read.
std::optional<BitReference> oldReference(const std::string& file) {
    try {
        return readReference(readFile(file), file);
    } catch (const InputError&) {
        return std::nullopt;
    }
}

// Writes the reference anew, if all ways of this machine agree.
ExitCode runAccept(const BitsOptions& options, const std::vector<BitCase>& cases) {
    if (options.reason.find_first_not_of(" \t\r\n") == std::string::npos)
        throw InputError("the reason for accepting is empty: say why the bits change");
    if (options.reason.find_first_of("\r\n") != std::string::npos)
        throw InputError("the reason for accepting must be one line");
    ProgressLine progress;
    const BitReference reference = referenceOf(computeAll(cases, options.ways, progress), options.reason);
    const auto results = checkAll(options, cases, cases, {reference, std::nullopt}, progress);
    progress.finish();
    std::string text;
    for (const BitResult& result : results)
        if (result.verdict != BitVerdict::same) text += resultText(result);
    if (!text.empty()) {
        printOut(text + "the ways of this machine do not agree: nothing was written\n");
        return ExitCode::difference;
    }
    const auto old = oldReference(options.reference);
    const bool changed = !old || old->rulesVersion != reference.rulesVersion || old->cases != reference.cases;
    if (changed) writeFileAtomically(options.reference, bytesOf(referenceText(reference)));
    printOut(formatText("{}: {}: {} cases, bits {:016x}\n", changed ? "accepted" : "unchanged",
                        options.reference, cases.size(), hashOfAll(reference.cases)));
    return ExitCode::done;
}

ExitCode runDump(const BitsOptions& options, const std::vector<BitCase>& cases) {
    ProgressLine progress;
    const BitDump dump = computeAll(cases, options.ways, progress);
    progress.finish();
    writeFileAtomically(options.dump, encodeDump(dump));
    printOut(formatText("{}: the words of {} cases, bits {:016x}\n", options.dump, cases.size(),
                        hashOfAll(referenceOf(dump, "").cases)));
    return ExitCode::done;
}

ExitCode runCheckBits(const BitsOptions& options, const std::vector<BitCase>& cases,
                      const std::vector<BitCase>& allCases) {
    const Expectation expected = readExpectation(options);
    ProgressLine progress;
    const auto results = checkAll(options, cases, allCases, expected, progress);
    progress.finish();
    const auto same = static_cast<size_t>(std::ranges::count(results, BitVerdict::same, &BitResult::verdict));
    std::string text;
    Json list = Json::list();
    for (const BitResult& result : results) {
        text += resultText(result);
        list.append(resultJson(result));
    }
    const uint64_t hash = hashOfAll(expected.reference.cases);
    const int rules = expected.reference.rulesVersion;
    text += formatText("{} of {} cases have the bits of {} ({:016x}, rules {}) on this machine: {}\n", same,
                       results.size(), options.against.empty() ? options.reference : options.against, hash,
                       rules, machineText());
    if (rules != kRulesVersion)
        text += formatText("the reference was made under rules {}, this program follows rules {}\n", rules,
                           kRulesVersion);
    printOut(options.json ? jsonText({{"machine", machineText()},
                                      {"rules", kRulesVersion},
                                      {"reference_rules", rules},
                                      {"reference_bits", formatText("{:016x}", hash)},
                                      {"checked", results.size()},
                                      {"same", same},
                                      {"results", list}})
                          : text);
    return same == results.size() && rules == kRulesVersion ? ExitCode::done : ExitCode::difference;
}

ExitCode runBits(const BitsOptions& options, const std::vector<BitCase>& allCases) {
    std::vector<BitCase> cases = allCases;
    std::erase_if(cases, [&](const BitCase& c) { return !matches(options.pattern, c.name); });
    if (cases.empty()) {
        printText(stderr, "etalon: nothing to check: no case matches \"{}\"\n", options.pattern);
        return ExitCode::nothingToCheck;
    }
    if (options.accept) return runAccept(options, cases);
    if (!options.dump.empty()) return runDump(options, cases);
    return runCheckBits(options, cases, allCases);
}

}  // namespace

void addBits(Verb& command, const std::vector<BitCase>& cases) {
    const auto options = std::make_shared<BitsOptions>();
    Verb& verb = command.addVerb(
        "bits",
        "Compute every pass in every way of this machine (levels, threads, tiles) and compare each bit with "
        "the reference; names the first pass, tile and pixel that differ. Exit 1 if one does.");
    const Option pattern = verb.add("--case", options->pattern, "Names of cases: * ? [...]");
    verb.add("--reference", options->reference, "Reference hashes");
    const Option level = addIsaOption(verb);
    addThreadsOption(verb, options->ways.threads);
    addTileOption(verb, options->ways.tileSize);
    verb.addFlag("--all", options->ways.everyCombination,
                 "Every combination of level, threads and tile size");
    verb.addFlag("--json", options->json, "Report as JSON");
    const Option dump = verb.add("--dump", options->dump, "Write the words of this machine to a file");
    const Option against = verb.add("--against", options->against,
                                    "Compare with the words that another machine wrote with --dump");
    const Option accept =
        verb.addFlag("--accept", options->accept, "Make the bits of this machine the reference");
    const Option reason = verb.add("--reason", options->reason, "Why the bits change; kept in the reference");
    accept.needs(reason).excludes(pattern).excludes(dump).excludes(against);
    reason.needs(accept);
    dump.excludes(against);
    verb.onRun([options, level, &cases] {
        if (level.isGiven()) options->ways.level = activeIsa();
        return runBits(*options, cases);
    });
}

}  // namespace etalon
