// A golden manifest: refused with one line, or what is read is written as text that reads as the same.
#include "golden/golden.h"
#include "tests/fuzz/fuzz.h"

using namespace etalon;

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    static const test::ScratchFolder folder;
    const std::filesystem::path file = folder / "manifest.json";
    fuzz::writeFile(file, fuzz::textOf(data, size));
    GoldenManifest manifest;
    if (!fuzz::isAccepted(file, [&] { manifest = readManifest(file); })) return 0;
    for (const GoldenCase& c : manifest.cases) {
        FUZZ_CHECK(!c.name.empty() && c.name.find('/') == std::string::npos && !c.outputs.empty());
        FUZZ_CHECK(!c.accepted || !c.accepted->groups.empty());
    }
    const std::string text = manifestText(manifest);
    fuzz::writeFile(file, text);
    FUZZ_CHECK(manifestText(readManifest(file)) == text);
    return 0;
}
