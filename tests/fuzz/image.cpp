// An image file of the kind that its first bytes say: refused with one line, or the frame is sound and can be
// written as an EXR that holds its bits.
#include "files/image_io.h"
#include "golden/compare.h"
#include "tests/fuzz/fuzz.h"

using namespace etalon;

namespace {

// Larger frames are read but not written.
constexpr size_t kMaxWrittenSamples = size_t{1} << 18;

const char* nameOf(std::string_view bytes) {
    if (bytes.starts_with("\x89PNG")) return "a.png";
    if (bytes.starts_with("#?")) return "a.hdr";
    if (bytes.starts_with("II") || bytes.starts_with("MM")) return "a.tif";
    if (bytes.starts_with("PF") || bytes.starts_with("Pf")) return "a.pfm";
    return "a.exr";
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    static const test::ScratchFolder folder;
    const std::string_view bytes = fuzz::textOf(data, size);
    const std::filesystem::path file = folder / nameOf(bytes);
    fuzz::writeFile(file, bytes);
    Frame frame;
    fuzz::isAccepted(file, [&] { readRgb(file); });
    if (!fuzz::isAccepted(file, [&] { frame = readFrame(file); })) return 0;
    checkFrame(frame);
    if (frame.channels.size() * static_cast<size_t>(frame.width) * static_cast<size_t>(frame.height) >
        kMaxWrittenSamples)
        return 0;
    const std::filesystem::path copy = folder / "copy.exr";
    writeExr(frame, copy);
    FUZZ_CHECK(compareFrames(frame, readFrame(copy)).identical());
    return 0;
}
