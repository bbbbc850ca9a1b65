#include "golden/golden.h"

#include <fnmatch.h>

#include <algorithm>
#include <map>
#include <span>

#include "files/atomic_file.h"
#include "files/image_io.h"
#include "golden/hash.h"
#include "numeric/text.h"

namespace etalon {
namespace {

std::string groupOf(const std::string& channel) {
    const size_t dot = channel.rfind('.');
    if (dot != std::string::npos) return channel.substr(0, dot);
    return channel == "R" || channel == "G" || channel == "B" || channel == "A" ? "RGBA" : channel;
}

std::vector<size_t> matchingCases(const GoldenManifest& manifest, const std::string& pattern) {
    std::vector<size_t> found;
    for (size_t i = 0; i < manifest.cases.size(); ++i)
        if (fnmatch(pattern.c_str(), manifest.cases[i].name.c_str(), 0) == 0) found.push_back(i);
    return found;
}

std::vector<GoldenInput> hashInputs(const GoldenManifest& manifest, const GoldenCase& c) {
    std::vector<GoldenInput> inputs;
    for (const std::string& path : c.inputs)
        inputs.push_back({path, hashFrame(readFrame(manifest.resolve(path)))});
    return inputs;
}

// Which inputs are not as accepted; empty if all are.
std::string inputDifference(const std::vector<GoldenInput>& accepted, const std::vector<GoldenInput>& now) {
    for (const GoldenInput& input : now) {
        const auto before = std::ranges::find(accepted, input.path, &GoldenInput::path);
        if (before == accepted.end())
            return formatText("{} was not an input of the accepted render", input.path);
        if (before->hash != input.hash)
            return formatText("the input differs: {} decodes to pixels {}, accepted were {}", input.path,
                              input.hash, before->hash);
    }
    for (const GoldenInput& input : accepted)
        if (std::ranges::find(now, input.path, &GoldenInput::path) == now.end())
            return formatText("{} was an input of the accepted render and is none now", input.path);
    return {};
}

// Which groups differ and how; empty if none does.
std::string groupDifference(const std::vector<GoldenGroup>& accepted, const std::vector<GoldenGroup>& now) {
    std::string text;
    const auto append = [&](const std::string& part) { text += (text.empty() ? "" : "; ") + part; };
    for (const GoldenGroup& group : accepted) {
        const auto found = std::ranges::find(now, group.name, &GoldenGroup::name);
        if (found == now.end())
            append(formatText("{} is not rendered any more", group.name));
        else if (found->width != group.width || found->height != group.height)
            append(formatText("{} is {}x{}, accepted was {}x{}", group.name, found->width, found->height,
                              group.width, group.height));
        else if (found->hash != group.hash)
            append(formatText("{} differs ({}, accepted was {})", group.name, found->hash, group.hash));
    }
    for (const GoldenGroup& group : now)
        if (std::ranges::find(accepted, group.name, &GoldenGroup::name) == accepted.end())
            append(formatText("{} was not accepted", group.name));
    return text;
}

// Why the accepted image cannot stand for the manifest; empty if it can, and then it is in `image`.
std::string imageDefect(const GoldenManifest& manifest, const GoldenCase& c, std::optional<Frame>& image) {
    try {
        image = readFrame(manifest.imageOf(c));
    } catch (const InputError& error) {
        return error.what();
    }
    const std::string difference = groupDifference(c.accepted->groups, hashGroups(*image));
    if (difference.empty()) return {};
    return formatText("{}: the image is not the one in the manifest: {}", manifest.imageOf(c).string(),
                      difference);
}

GoldenResult checkCase(const GoldenManifest& manifest, const GoldenCase& c, const std::string& rulesVersion,
                       const GoldenRenderer& render) {
    if (!c.accepted) return {c.name, GoldenVerdict::missing, "nothing was accepted yet", {}};
    std::optional<Frame> image;
    if (const std::string defect = imageDefect(manifest, c, image); !defect.empty())
        return {c.name, GoldenVerdict::missing, defect, {}};
    Frame frame;
    try {
        const std::string difference = inputDifference(c.accepted->inputs, hashInputs(manifest, c));
        if (!difference.empty()) return {c.name, GoldenVerdict::inputDiffers, difference, {}};
        frame = render(manifest, c);
    } catch (const InputError& error) {
        return {c.name, GoldenVerdict::failed, error.what(), {}};
    }
    std::string difference = groupDifference(c.accepted->groups, hashGroups(frame));
    if (difference.empty()) return {c.name, GoldenVerdict::same, {}, {}};
    if (c.accepted->rulesVersion != rulesVersion)
        difference += formatText("; accepted under rules {}, these are rules {}", c.accepted->rulesVersion,
                                 rulesVersion);
    return {c.name, GoldenVerdict::different, difference, compareFrames(*image, frame)};
}

}  // namespace

std::vector<GoldenGroup> hashGroups(const Frame& frame) {
    checkFrame(frame);
    std::map<std::string, std::vector<const Channel*>> members;
    for (const Channel& channel : frame.channels) members[groupOf(channel.name)].push_back(&channel);
    std::vector<GoldenGroup> groups;
    for (const auto& [name, channels] : members)
        groups.push_back(
            {name, frame.width, frame.height, hashChannels(frame.width, frame.height, channels)});
    return groups;
}

const char* verdictName(GoldenVerdict verdict) {
    switch (verdict) {
        case GoldenVerdict::same:
            return "same";
        case GoldenVerdict::different:
            return "different";
        case GoldenVerdict::missing:
            return "missing";
        case GoldenVerdict::inputDiffers:
            return "input differs";
        case GoldenVerdict::failed:
            return "failed";
    }
    return "";
}

std::vector<GoldenResult> checkGolden(const GoldenManifest& manifest, const std::string& pattern,
                                      const std::string& rulesVersion, const GoldenRenderer& render,
                                      const GoldenProgress& progress) {
    const std::vector<size_t> chosen = matchingCases(manifest, pattern);
    std::vector<GoldenResult> results;
    for (size_t i = 0; i < chosen.size(); ++i) {
        const GoldenCase& c = manifest.cases[chosen[i]];
        if (progress) progress(c.name, i, chosen.size());
        results.push_back(checkCase(manifest, c, rulesVersion, render));
    }
    return results;
}

std::vector<GoldenAcceptance> acceptGolden(GoldenManifest& manifest, const std::string& pattern,
                                           const std::string& reason, const std::string& rulesVersion,
                                           const GoldenRenderer& render, const GoldenProgress& progress) {
    if (reason.find_first_not_of(" \t\r\n") == std::string::npos)
        throw InputError("the reason for accepting is empty: say why the images change");
    const std::vector<size_t> chosen = matchingCases(manifest, pattern);
    std::vector<GoldenAcceptance> results;
    for (size_t i = 0; i < chosen.size(); ++i) {
        GoldenCase& c = manifest.cases[chosen[i]];
        if (progress) progress(c.name, i, chosen.size());
        const std::vector<GoldenInput> inputs = hashInputs(manifest, c);
        const Frame frame = render(manifest, c);
        const std::vector<GoldenGroup> groups = hashGroups(frame);
        std::optional<Frame> image;
        const bool changed = !c.accepted || c.accepted->inputs != inputs || c.accepted->groups != groups ||
                             c.accepted->rulesVersion != rulesVersion ||
                             !imageDefect(manifest, c, image).empty();
        results.push_back({c.name, changed});
        if (!changed) continue;
        // Both are on the disk under temporary names before either takes its place.
        GoldenManifest updated = manifest;
        updated.cases[chosen[i]].accepted = GoldenRecord{reason, rulesVersion, inputs, groups};
        AtomicFile imageFile(manifest.imageOf(c)), manifestFile(manifest.file);
        imageFile.write(encodeExr(frame));
        const std::string text = manifestText(updated);
        manifestFile.write(std::as_bytes(std::span(text)));
        imageFile.commit();
        manifestFile.commit();
        manifest = std::move(updated);
    }
    return results;
}

}  // namespace etalon
