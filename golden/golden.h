// Golden images: bits, not tolerances. The manifest holds the cases and the hashes of their accepted pixels;
// the accepted images lie beside it as <case>.exr and explain a failure.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "files/frame.h"
#include "golden/compare.h"

namespace etalon {

// The hash (hashChannels) of the channels of one group: those of one layer ("N" for N.X, N.Y, N.Z), the
// colour "RGBA" (R, G, B and A), or a channel alone ("Z").
struct GoldenGroup {
    std::string name;
    int width = 0, height = 0;
    std::string hash;
    friend bool operator==(const GoldenGroup&, const GoldenGroup&) = default;
};

// The hash (hashFrame) of an image that the case reads, as decoded: a lossy file may decode to other pixels
// with another version of a library, and then the input is to blame, not the render.
struct GoldenInput {
    std::string path;  // as in GoldenCase::inputs
    std::string hash;
    friend bool operator==(const GoldenInput&, const GoldenInput&) = default;
};

// What was accepted, why, and under which version of the rules.
struct GoldenRecord {
    std::string reason, rulesVersion;
    std::vector<GoldenInput> inputs;
    std::vector<GoldenGroup> groups;
};

// Paths are relative to the folder of the manifest.
struct GoldenCase {
    std::string name;  // letters, digits, - and _
    std::string scene, profile;
    std::vector<std::string> outputs;  // what the scene is rendered for, as the renderer names it
    std::vector<std::string> inputs;   // image files whose pixels the render depends on
    std::optional<GoldenRecord> accepted;
};

struct GoldenManifest {
    std::filesystem::path file;
    std::vector<GoldenCase> cases;

    // A path of a case, and the accepted image of a case, relative to the working folder.
    std::filesystem::path resolve(const std::string& path) const { return file.parent_path() / path; }
    std::filesystem::path imageOf(const GoldenCase& c) const { return resolve(c.name + ".exr"); }
};

// Reads golden/manifest.json: {"cases": [{"name", "scene", "profile", "outputs", "inputs", "accepted":
// {"reason", "rules", "inputs": [{"path", "hash"}], "groups": [{"name", "width", "height", "hash"}]}}]};
// "inputs" and "accepted" may be absent. InputError: missing file, bad JSON, missing or unknown keys, wrong
// types, names twice.
GoldenManifest readManifest(const std::filesystem::path& file);

// The text that readManifest reads; indented, one key a line, ends with a line break.
std::string manifestText(const GoldenManifest& manifest);

// The groups of a frame, sorted by name.
std::vector<GoldenGroup> hashGroups(const Frame& frame);

// Renders a case; the scene is at manifest.resolve(case.scene). Bad input is an InputError.
using GoldenRenderer = std::function<Frame(const GoldenManifest&, const GoldenCase&)>;

// How a program renders its cases, and under which version of the rules.
struct GoldenSupport {
    GoldenRenderer render;
    std::string rulesVersion;
};

enum class GoldenVerdict {
    same,          // every bit is as accepted
    different,     // the render differs
    missing,       // nothing was accepted, or the accepted image is missing or is not what the manifest says
    inputDiffers,  // an input does not decode to the pixels it had; not rendered
    failed,        // the scene or an input could not be read; not rendered
};
const char* verdictName(GoldenVerdict verdict);

struct GoldenResult {
    std::string name;
    GoldenVerdict verdict = GoldenVerdict::failed;
    std::string message;                   // one line; empty for Same
    std::optional<Comparison> comparison;  // a: the accepted image, b: the render; for Different
};

// Called before each case with its name, its index and the number of cases.
using GoldenProgress = std::function<void(const std::string& name, size_t index, size_t count)>;

// Renders every case whose name matches the pattern (fnmatch: * ? [...]) and compares it with what was
// accepted. Writes nothing. Empty when no name matches.
std::vector<GoldenResult> checkGolden(const GoldenManifest& manifest, const std::string& pattern,
                                      const std::string& rulesVersion, const GoldenRenderer& render,
                                      const GoldenProgress& progress = {});

struct GoldenAcceptance {
    std::string name;
    bool changed = false;  // false: the render, its inputs and the rules are as accepted; nothing was written
};

// Renders every case whose name matches, and makes the result the accepted one: writes the image, then the
// manifest, each atomically, case by case. InputError for a reason without a visible character, and for what
// the renderer or the disk refuses; cases before it stay accepted. Empty when no name matches.
std::vector<GoldenAcceptance> acceptGolden(GoldenManifest& manifest, const std::string& pattern,
                                           const std::string& reason, const std::string& rulesVersion,
                                           const GoldenRenderer& render, const GoldenProgress& progress = {});

}  // namespace etalon
