#include "golden/golden.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cstring>
#include <fstream>
#include <iterator>

#include "files/image_io.h"
#include "golden/hash.h"
#include "tests/support/scratch_folder.h"

namespace etalon {
namespace {

using test::ScratchFolder;

std::string readBytes(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

void writeText(const std::filesystem::path& path, const std::string& text) { std::ofstream(path) << text; }

Frame renderOf(float red) {
    Image<float> r(2, 1), z(2, 1);
    r.at(0, 0) = red;
    z.at(1, 0) = 2;
    return {2, 1, {{"R", r}, {"Z", z}, {"id", Image<uint32_t>(2, 1)}}, {}};
}

// A manifest of the cases "one" and "two", of which the second reads probe.exr; nothing accepted yet.
struct Fixture {
    Fixture() {
        writeText(file, R"({"cases": [
            {"name": "one", "scene": "one.toml", "profile": "f32", "outputs": ["beauty", "depth"]},
            {"name": "two", "scene": "two.toml", "profile": "f32", "outputs": ["beauty"], "inputs": ["probe.exr"]}
        ]})");
        writeExr(renderOf(7), folder / "probe.exr");
    }
    std::vector<GoldenAcceptance> accept(const std::string& pattern, const std::string& reason = "first") {
        GoldenManifest manifest = readManifest(file);
        return acceptGolden(manifest, pattern, reason, "1", render);
    }
    std::vector<GoldenResult> check(const std::string& pattern = "*") const {
        return checkGolden(readManifest(file), pattern, "1", render);
    }
    std::string files() const {
        std::string all;
        for (const char* name : {"manifest.json", "one.exr", "two.exr"})
            all += readBytes(folder / name) + "|";
        return all;
    }

    ScratchFolder folder;
    std::filesystem::path file = folder / "manifest.json";
    float red = 1;
    GoldenRenderer render = [this](const GoldenManifest&, const GoldenCase&) { return renderOf(red); };
};

std::string manifestError(const std::string& text) {
    const ScratchFolder folder;
    writeText(folder / "m.json", text);
    try {
        readManifest(folder / "m.json");
    } catch (const InputError& error) {
        const std::string what = error.what();
        CHECK(what.starts_with((folder / "m.json").string() + ": "));
        CHECK(what.find('\n') == std::string::npos);
        return what;
    }
    FAIL_CHECK("no InputError for ", text);
    return {};
}

}  // namespace

TEST_CASE("PixelHashSeesEveryBitNameTypeAndSize") {
    const Frame frame = renderOf(1);
    const std::string hash = hashFrame(frame);
    CHECK(hash.size() == 16);
    // Computed from the description in golden/hash.h by other code.
    CHECK(hash == "3a4b240982198c8c");
    Frame reordered = frame;
    std::swap(reordered.channels[0], reordered.channels[1]);
    reordered.metadata["scene"] = "other";
    CHECK(hashFrame(reordered) == hash);
    Frame zero = frame;
    std::get<Image<float>>(zero.channels[1].values).at(0, 0) = -0.0f;
    CHECK(hashFrame(zero) != hash);
    Frame renamed = frame;
    renamed.channels[0].name = "G";
    CHECK(hashFrame(renamed) != hash);
    Frame retyped = frame;
    retyped.channels[2].values = Image<float>(2, 1);
    CHECK(hashFrame(retyped) != hash);
    CHECK(hashFrame({1, 2, {{"R", Image<float>(1, 2)}}, {}}) !=
          hashFrame({2, 1, {{"R", Image<float>(2, 1)}}, {}}));
}

TEST_CASE("GroupsAreLayersColourAndSingles") {
    const Image<float> plane(1, 1);
    std::vector<std::string> names;
    Frame frame{1, 1, {}, {}};
    for (const char* name : {"R", "G", "B", "A", "Z", "N.X", "N.Y", "light.0.R", "id"})
        frame.channels.push_back({name, plane});
    for (const GoldenGroup& group : hashGroups(frame)) names.push_back(group.name);
    CHECK(names == std::vector<std::string>{"N", "RGBA", "Z", "id", "light.0"});
}

TEST_CASE("NothingAcceptedIsAFailure") {
    const Fixture fixture;
    const auto results = fixture.check();
    REQUIRE(results.size() == 2);
    for (const GoldenResult& result : results) CHECK(result.verdict == GoldenVerdict::missing);
}

TEST_CASE("AcceptedRenderIsTheSame") {
    Fixture fixture;
    const auto accepted = fixture.accept("*");
    REQUIRE(accepted.size() == 2);
    CHECK(accepted[0].changed);
    for (const GoldenResult& result : fixture.check()) CHECK(result.verdict == GoldenVerdict::same);
    // manifest, probe and two images.
    CHECK(fixture.folder.entries() == 4);
    const GoldenManifest manifest = readManifest(fixture.file);
    CHECK(manifest.cases[1].accepted->reason == "first");
    CHECK(manifest.cases[1].accepted->inputs.size() == 1);
    CHECK(manifestText(manifest) == readBytes(fixture.file));
}

TEST_CASE("AcceptingTheSameAgainWritesNothing") {
    Fixture fixture;
    fixture.accept("*");
    const std::string before = fixture.files();
    for (const GoldenAcceptance& acceptance : fixture.accept("*", "again")) CHECK_FALSE(acceptance.changed);
    CHECK(fixture.files() == before);
}

TEST_CASE("DifferentRenderFailsIsExplainedAndWritesNothing") {
    Fixture fixture;
    fixture.accept("*");
    const std::string before = fixture.files();
    fixture.red = 1.5f;
    const auto results = fixture.check("o*");
    REQUIRE(results.size() == 1);
    CHECK(results[0].verdict == GoldenVerdict::different);
    CHECK(results[0].message.starts_with("RGBA differs"));
    CHECK(results[0].message.find("Z") == std::string::npos);
    REQUIRE(results[0].comparison);
    CHECK(results[0].comparison->channels[0].maxAbsolute == 0.5);
    CHECK(fixture.files() == before);
}

TEST_CASE("SignOfZeroFailsTheCheck") {
    Fixture fixture;
    fixture.red = 0.0f;
    fixture.accept("one");
    fixture.red = -0.0f;
    CHECK(fixture.check("one")[0].verdict == GoldenVerdict::different);
}

TEST_CASE("AcceptChangesOnlyTheNamedCases") {
    Fixture fixture;
    fixture.accept("*");
    fixture.red = 3;
    const auto accepted = fixture.accept("tw?", "redder");
    REQUIRE(accepted.size() == 1);
    CHECK(accepted[0].name == "two");
    const auto results = fixture.check();
    CHECK(results[0].verdict == GoldenVerdict::different);
    CHECK(results[1].verdict == GoldenVerdict::same);
    CHECK(readManifest(fixture.file).cases[0].accepted->reason == "first");
}

TEST_CASE("UnknownPatternMatchesNothing") {
    Fixture fixture;
    CHECK(fixture.check("three").empty());
    CHECK(fixture.accept("three").empty());
}

TEST_CASE("AcceptNeedsAReason") {
    Fixture fixture;
    const std::string before = fixture.files();
    CHECK_THROWS_AS(fixture.accept("*", ""), InputError);
    CHECK_THROWS_AS(fixture.accept("*", " \n"), InputError);
    CHECK(fixture.files() == before);
}

TEST_CASE("MissingOrForeignImageIsAFailure") {
    Fixture fixture;
    fixture.accept("*");
    writeExr(renderOf(99), fixture.folder / "one.exr");
    std::filesystem::remove(fixture.folder / "two.exr");
    for (const GoldenResult& result : fixture.check()) CHECK(result.verdict == GoldenVerdict::missing);
    // Accepting puts it right although the hashes have not changed.
    for (const GoldenAcceptance& acceptance : fixture.accept("*", "restored")) CHECK(acceptance.changed);
    for (const GoldenResult& result : fixture.check()) CHECK(result.verdict == GoldenVerdict::same);
}

TEST_CASE("DifferentInputIsNotBlamedOnTheRender") {
    Fixture fixture;
    fixture.accept("*");
    writeExr(renderOf(8), fixture.folder / "probe.exr");
    fixture.render = [&fixture](const GoldenManifest&, const GoldenCase& c) {
        CHECK(c.name == "one");
        return renderOf(fixture.red);
    };
    const auto results = fixture.check();
    CHECK(results[0].verdict == GoldenVerdict::same);
    CHECK(results[1].verdict == GoldenVerdict::inputDiffers);
    CHECK(results[1].message.find("probe.exr") != std::string::npos);
    std::filesystem::remove(fixture.folder / "probe.exr");
    CHECK(fixture.check()[1].verdict == GoldenVerdict::failed);
}

TEST_CASE("BadSceneFailsItsCaseOnly") {
    Fixture fixture;
    fixture.accept("*");
    fixture.render = [](const GoldenManifest& manifest, const GoldenCase& c) {
        if (c.name == "one") throw InputError(manifest.resolve(c.scene).string() + ":3: unknown key");
        return renderOf(1);
    };
    const auto results = fixture.check();
    CHECK(results[0].verdict == GoldenVerdict::failed);
    CHECK(results[0].message == (fixture.folder / "one.toml").string() + ":3: unknown key");
    CHECK(results[1].verdict == GoldenVerdict::same);
}

TEST_CASE("MoreOrFewerOutputsFail") {
    Fixture fixture;
    fixture.accept("one");
    fixture.render = [](const GoldenManifest&, const GoldenCase&) {
        Frame frame = renderOf(1);
        frame.channels[1].name = "depth.Z";
        return frame;
    };
    const GoldenResult result = fixture.check("one")[0];
    CHECK(result.verdict == GoldenVerdict::different);
    CHECK(result.message == "Z is not rendered any more; depth was not accepted");
}

TEST_CASE("OtherRulesAreNamedWhenTheRenderDiffers") {
    Fixture fixture;
    fixture.accept("one");
    fixture.red = 2;
    const auto results = checkGolden(readManifest(fixture.file), "one", "2", fixture.render);
    CHECK(results[0].message.find("accepted under rules 1, these are rules 2") != std::string::npos);
}

TEST_CASE("FailedAcceptLeavesEverythingAsItWas") {
    Fixture fixture;
    fixture.accept("*");
    const std::string before = fixture.files();
    fixture.red = 2;
    fixture.render = [](const GoldenManifest&, const GoldenCase&) -> Frame {
        throw InputError("scene:1: bad");
    };
    CHECK_THROWS_AS(fixture.accept("*"), InputError);
    CHECK(fixture.files() == before);
    CHECK(fixture.folder.entries() == 4);
}

TEST_CASE("ManifestDefectsAreNamed") {
    CHECK(manifestError("{").find("line 1") != std::string::npos);
    CHECK(manifestError("[]").find("must be an object") != std::string::npos);
    CHECK(manifestError(R"({"case": []})").find("unknown key \"case\"") != std::string::npos);
    CHECK(manifestError("{\"a\\nb\": 0}").find(R"(unknown key "a\nb")") != std::string::npos);
    CHECK(manifestError("1e999").find("not valid JSON: number overflow") != std::string::npos);
    CHECK(manifestError(R"({})").find("\"cases\" is missing") != std::string::npos);
    CHECK(manifestError(R"({"cases": [{"name": "../up"}]})").find("cases[0].name") != std::string::npos);
    CHECK(manifestError(R"({"cases": [{"name": "a", "scene": 3}]})").find("cases[0].scene") !=
          std::string::npos);
    const std::string good = R"({"name": "a", "scene": "s", "profile": "f32", "outputs": ["beauty"])";
    CHECK(manifestError(R"({"cases": [)" + good + "}, " + good + "}]}").find("twice") != std::string::npos);
    const std::string record =
        good + R"(, "accepted": {"reason": "r", "rules": "1", "inputs": [], "groups": [)";
    CHECK(manifestError(R"({"cases": [)" + record + "]}}]}").find("nothing would be checked") !=
          std::string::npos);
    CHECK(manifestError(R"({"cases": [)" + record + R"({"name": "Z", "width": 0}]}}]})").find("width") !=
          std::string::npos);
    CHECK_THROWS_AS(readManifest("/nonexistent/manifest.json"), InputError);
}

}  // namespace etalon
