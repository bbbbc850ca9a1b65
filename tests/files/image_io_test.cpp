#include "files/image_io.h"

#include <doctest/doctest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <bit>
#include <chrono>
#include <csignal>
#include <cstring>
#include <fstream>
#include <iterator>
#include <limits>
#include <thread>

#include "files/atomic_file.h"
#include "golden/compare.h"
#include "numeric/parallel.h"
#include "tests/support/scratch_folder.h"

namespace etalon {
namespace {

using test::ScratchFolder;

std::string readBytes(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

void writeBytes(const std::filesystem::path& path, const std::string& bytes) {
    std::ofstream(path, std::ios::binary) << bytes;
}

// The message of the InputError that the call throws; fails if it throws none or several lines.
template <class Call>
std::string inputErrorOf(Call call) {
    try {
        call();
    } catch (const InputError& error) {
        const std::string text = error.what();
        CHECK(text.find('\n') == std::string::npos);
        return text;
    }
    FAIL_CHECK("no InputError");
    return {};
}

bool contains(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

// Floats of every kind and identifiers, taller than one block of rows of the encoder.
Frame sampleFrame() {
    const int width = 37, height = 130;
    Frame frame{width, height, {}, {{"etalon:scene", "demo.toml"}, {"etalon:profile", "f32"}}};
    uint32_t state = 1;
    for (const char* name : {"R", "G", "B", "A", "Z", "N.X", "N.Y", "N.Z"}) {
        Image<float> image(width, height);
        for (float& value : image.values())
            value = std::bit_cast<float>(state = state * 1664525u + 1013904223u);
        image.at(0, 0) = -0.0f;
        image.at(1, 0) = std::numeric_limits<float>::denorm_min();
        image.at(2, 0) = -std::numeric_limits<float>::infinity();
        image.at(3, 0) = std::bit_cast<float>(0x7fc12345u);
        frame.channels.push_back({name, std::move(image)});
    }
    Image<uint32_t> ids(width, height);
    for (uint32_t& id : ids.values()) id = state = state * 1664525u + 1013904223u;
    ids.at(0, 0) = 0xffffffffu;
    frame.channels.push_back({"id", std::move(ids)});
    return frame;
}

// A Radiance file without run lengths.
std::string radianceFile(const std::string& resolution, size_t pixels) {
    std::string text = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n" + resolution + "\n";
    for (size_t i = 0; i < pixels; ++i) text += std::string{'\x80', '\x40', '\x20', '\x81'};
    return text;
}

std::string pfmFile(const std::string& type, int width, int height, const std::vector<float>& values) {
    std::string text = type + "\n" + std::to_string(width) + " " + std::to_string(height) + "\n-1.0\n";
    for (const float value : values) {
        const uint32_t bits = std::bit_cast<uint32_t>(value);
        for (int shift = 0; shift < 32; shift += 8) text += static_cast<char>(bits >> shift & 255u);
    }
    return text;
}

}  // namespace

TEST_CASE("ExrKeepsEveryBitOfFloatsAndIdentifiers") {
    const ScratchFolder folder;
    const Frame frame = sampleFrame();
    writeExr(frame, folder / "a.exr");
    const Frame back = readFrame(folder / "a.exr");
    CHECK(compareFrames(frame, back).identical());
    CHECK(back.channels.size() == frame.channels.size());
    CHECK(back.metadata == frame.metadata);
    CHECK(folder.entries() == 1);
}

TEST_CASE("ExrOfIdentifiersAloneKeepsThem") {
    const ScratchFolder folder;
    Image<uint32_t> ids(2, 1);
    ids.at(1, 0) = 0xfffffffeu;
    const Frame frame{2, 1, {{"id", ids}}, {}};
    writeExr(frame, folder / "a.exr");
    CHECK(compareFrames(frame, readFrame(folder / "a.exr")).identical());
}

// The helpers stay in the library's pool, where they can be counted; those that leave it take a moment to be gone. (Not
// under the thread sanitizer: the library is not instrumented.)
TEST_CASE("TheExrEncoderHasTheWorkersThatItIsGiven") {
    const auto threadsNow = [] {
        const std::filesystem::directory_iterator tasks("/proc/self/task");
        return static_cast<int>(std::distance(begin(tasks), end(tasks)));
    };
    const auto becomes = [&](int count) {
        for (int i = 0; i < 1000 && threadsNow() != count; i++)
            std::this_thread::sleep_for(std::chrono::milliseconds(10));
        return threadsNow() == count;
    };
    const Frame frame = sampleFrame();
    const int blocks = (frame.height + 15) / 16;
    const std::vector<std::byte> bytes = encodeExr(frame, 1);
    // A pool that was there before is gone.
    int alone = threadsNow();
    for (int i = 0; i < 20; i++) {
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
        alone = std::min(alone, threadsNow());
    }
    for (const int threads : {2, 7, 3, 1, 5, 1000, 0}) {
        CAPTURE(threads);
        CHECK(encodeExr(frame, threads) == bytes);
        const int helpers = std::min(threads == 0 ? hardwareThreads() : threads, blocks);
        CHECK(becomes(alone + (helpers > 1 ? helpers : 0)));
    }
}

TEST_CASE("SameFrameGivesTheSameFile") { CHECK(encodeExr(sampleFrame()) == encodeExr(sampleFrame())); }

TEST_CASE("ExrMetadataUnderNamesOfTheFormatIsLeftOut") {
    const ScratchFolder folder;
    const std::map<std::string, std::string> kept = {
        {"owner", "someone"}, {"etalon.scene", "demo.toml"}, {std::string(255, 'n'), "x"}};
    Frame frame{1, 1, {{"R", Image<float>(1, 1)}}, kept};
    for (const char* name : {"", "channels", "chunkCount", "compression", "dataWindow", "lineOrder", "name",
                             "preview", "screenWindowWidth", "tiles", "type", "version", "view"})
        frame.metadata[name] = "deeptile";
    writeExr(frame, folder / "a.exr");
    const auto back = readFrame(folder / "a.exr").metadata;
    // The library reads "owner" as what TIFF calls it.
    CHECK(back.at("Copyright") == "someone");
    CHECK(back.at("etalon.scene") == "demo.toml");
    CHECK(back.size() == kept.size());
}

TEST_CASE("TruncatedExrIsRefusedAtEveryLength") {
    const ScratchFolder folder;
    const auto encoded = encodeExr(sampleFrame());
    const std::string bytes(reinterpret_cast<const char*>(encoded.data()), encoded.size());
    const std::filesystem::path path = folder / "cut.exr";
    std::vector<size_t> lengths = {0, 1, 4, 100, bytes.size() - 1, bytes.size() - 2};
    for (size_t length = 200; length < bytes.size(); length += bytes.size() / 40) lengths.push_back(length);
    for (const size_t length : lengths) {
        CAPTURE(length);
        writeBytes(path, bytes.substr(0, length));
        CHECK(contains(inputErrorOf([&] { readFrame(path); }), path.string() + ": "));
    }
    writeBytes(path, bytes);
    CHECK_NOTHROW(readFrame(path));
}

TEST_CASE("PngCodesBecomeFractions") {
    const ScratchFolder folder;
    Image<uint8_t> image(16, 16, 3);
    for (size_t i = 0; i < image.values().size(); ++i) image.values()[i] = static_cast<uint8_t>(i);
    writePng(image, folder / "a.png");
    CHECK(encodePng(image) == encodePng(image));
    const Image<float> back = readRgb(folder / "a.png");
    for (size_t i = 0; i < image.values().size(); ++i)
        CHECK(back.values()[i] == static_cast<float>(image.values()[i]) / 255.0f);
}

TEST_CASE("TruncatedPngIsRefusedAtEveryLengthAndDamageAtEveryByte") {
    const ScratchFolder folder;
    const auto encoded = encodePng(Image<uint8_t>(40, 40, 3));
    const std::string bytes(reinterpret_cast<const char*>(encoded.data()), encoded.size());
    for (size_t length = 0; length < bytes.size(); ++length) {
        CAPTURE(length);
        writeBytes(folder / "a.png", bytes.substr(0, length));
        inputErrorOf([&] { readFrame(folder / "a.png"); });
        std::string damaged = bytes;
        damaged[length] = static_cast<char>(damaged[length] ^ 0x10);
        writeBytes(folder / "a.png", damaged);
        inputErrorOf([&] { readFrame(folder / "a.png"); });
    }
    writeBytes(folder / "a.png", bytes);
    CHECK_NOTHROW(readFrame(folder / "a.png"));
}

TEST_CASE("RadianceFilesAreReadAndTruncationIsFound") {
    const ScratchFolder folder;
    const std::string bytes = radianceFile("-Y 3 +X 4", 12);
    writeBytes(folder / "a.hdr", bytes);
    const Image<float> image = readRgb(folder / "a.hdr");
    CHECK(image.width() == 4);
    CHECK(image.height() == 3);
    // Mantissa 0x80 with exponent 0x81 = 129: 128/256 * 2^(129-128).
    CHECK(image.at(3, 2, 0) == 1.0f);
    CHECK(image.at(0, 0, 1) == 0.5f);
    CHECK(image.at(0, 0, 2) == 0.25f);
    for (size_t length = 0; length < bytes.size(); length += 3) {
        writeBytes(folder / "cut.hdr", bytes.substr(0, length));
        inputErrorOf([&] { readFrame(folder / "cut.hdr"); });
    }
}

TEST_CASE("PortableFloatMapsPutTheTopRowFirst") {
    const ScratchFolder folder;
    // The file stores the bottom row first.
    writeBytes(folder / "grey.pfm", pfmFile("Pf", 2, 2, {3, 4, 1, 2}));
    const Image<float> grey = readRgb(folder / "grey.pfm");
    for (int c = 0; c < 3; ++c) {
        CHECK(grey.at(0, 0, c) == 1.0f);
        CHECK(grey.at(1, 1, c) == 4.0f);
    }
    const std::string colour = pfmFile("PF", 1, 2, {4, 5, 6, 1, 2, 3});
    writeBytes(folder / "colour.pfm", colour);
    CHECK(readRgb(folder / "colour.pfm").at(0, 0, 2) == 3.0f);
    writeBytes(folder / "cut.pfm", colour.substr(0, colour.size() - 1));
    CHECK(contains(inputErrorOf([&] { readFrame(folder / "cut.pfm"); }), "truncated"));
}

TEST_CASE("FilesThatAreNoImagesAreRefused") {
    const ScratchFolder folder;
    writeBytes(folder / "empty.exr", "");
    writeBytes(folder / "text.exr", "not an image");
    writeBytes(folder / "text.txt", "not an image");
    CHECK(contains(inputErrorOf([&] { readFrame(folder / "missing.exr"); }), "no such file"));
    CHECK(contains(inputErrorOf([&] { readFrame(folder.path()); }), "directory"));
    CHECK(contains(inputErrorOf([&] { readFrame("/dev/zero"); }), "device"));
    CHECK(contains(inputErrorOf([&] { readFrame(folder / "empty.exr"); }), "empty"));
    CHECK(contains(inputErrorOf([&] { readFrame(folder / "text.exr"); }), "not a readable image"));
    CHECK(contains(inputErrorOf([&] { readFrame(folder / "text.txt"); }), "not a readable image"));
    CHECK(contains(inputErrorOf([&] { readFrame(folder / "text.exr" / "below.exr"); }), "no such file"));
}

TEST_CASE("ZeroAndAbsurdSizesAreRefusedBeforeMemoryIsTaken") {
    const ScratchFolder folder;
    writeBytes(folder / "zero.hdr", radianceFile("-Y 0 +X 0", 0));
    CHECK(contains(inputErrorOf([&] { readFrame(folder / "zero.hdr"); }), "zero size"));
    writeBytes(folder / "large.hdr", radianceFile("-Y 40000 +X 40000", 10));
    // 40000 * 40000 pixels of three floats.
    CHECK(contains(inputErrorOf([&] { readFrame(folder / "large.hdr"); }), "17.9 GiB"));
    writeBytes(folder / "wide.hdr", radianceFile("-Y 1 +X 100000", 10));
    CHECK(contains(inputErrorOf([&] { readFrame(folder / "wide.hdr"); }), "65536 pixels a side"));
}

TEST_CASE("TurnedImagesAreRefused") {
    const ScratchFolder folder;
    writeBytes(folder / "turned.hdr", radianceFile("+Y 3 +X 4", 12));
    CHECK(contains(inputErrorOf([&] { readFrame(folder / "turned.hdr"); }), "orientation"));
}

TEST_CASE("RgbNeedsColourOrGrey") {
    const ScratchFolder folder;
    const Image<float> plane(1, 1);
    writeExr({1, 1, {{"U", plane}, {"V", plane}}, {}}, folder / "uv.exr");
    CHECK(contains(inputErrorOf([&] { readRgb(folder / "uv.exr"); }), "neither"));
    writeExr({1, 1, {{"id", Image<uint32_t>(1, 1)}}, {}}, folder / "id.exr");
    CHECK(contains(inputErrorOf([&] { readRgb(folder / "id.exr"); }), "identifiers"));
    writeExr({1, 1, {{"Y", plane}, {"A", plane}}, {}}, folder / "grey.exr");
    CHECK(readRgb(folder / "grey.exr").channels() == 3);
}

TEST_CASE("FramesThatContradictThemselvesAreNotWritten") {
    const Image<float> plane(1, 1);
    CHECK_THROWS_AS(encodeExr({2, 1, {{"R", plane}}, {}}), PreconditionError);
    CHECK_THROWS_AS(encodeExr({1, 1, {{"R", plane}, {"R", plane}}, {}}), PreconditionError);
    CHECK_THROWS_AS(encodeExr({1, 1, {{"", plane}}, {}}), PreconditionError);
    CHECK_THROWS_AS(encodeExr({1, 1, {}, {}}), PreconditionError);
    CHECK_THROWS_AS(encodePng(Image<uint8_t>(1, 1, 4)), PreconditionError);
}

TEST_CASE("FailedWriteLeavesTheOldFileAndNothingElse") {
    const ScratchFolder folder;
    writeBytes(folder / "a.exr", "old");
    {
        AtomicFile file(folder / "a.exr");
        file.write(std::as_bytes(std::span("half", 4)));
        CHECK(folder.entries() == 2);
        CHECK(readBytes(folder / "a.exr") == "old");
    }
    CHECK(folder.entries() == 1);
    CHECK(readBytes(folder / "a.exr") == "old");
}

TEST_CASE("CommitReplacesAndKeepsThePermissions") {
    const ScratchFolder folder;
    writeBytes(folder / "a", "old");
    std::filesystem::permissions(folder / "a",
                                 std::filesystem::perms::owner_read | std::filesystem::perms::owner_write);
    writeFileAtomically(folder / "a", std::as_bytes(std::span("new", 3)));
    CHECK(readBytes(folder / "a") == "new");
    CHECK((std::filesystem::status(folder / "a").permissions() & std::filesystem::perms::group_all) ==
          std::filesystem::perms::none);
    std::filesystem::create_symlink(folder / "a", folder / "link");
    writeFileAtomically(folder / "link", std::as_bytes(std::span("newer", 5)));
    CHECK(std::filesystem::is_symlink(folder / "link"));
    CHECK(readBytes(folder / "a") == "newer");
    CHECK(folder.entries() == 2);
}

TEST_CASE("UnwritableTargetsAreRefused") {
    const ScratchFolder folder;
    writeBytes(folder / "file", "");
    const Frame frame = sampleFrame();
    CHECK(contains(inputErrorOf([&] { writeExr(frame, folder / "missing" / "a.exr"); }), "No such file"));
    CHECK(contains(inputErrorOf([&] { writeExr(frame, folder.path()); }), "Is a directory"));
    CHECK(contains(inputErrorOf([&] { writeExr(frame, folder / "file" / "a.exr"); }), "Not a directory"));
    CHECK(folder.entries() == 1);
}

TEST_CASE("FullDiskIsAnErrorAndDevicesStayDevices") {
    CHECK(contains(inputErrorOf([] { writeExr(sampleFrame(), "/dev/full"); }), "No space left"));
    CHECK_NOTHROW(writeExr(sampleFrame(), "/dev/null"));
    CHECK(std::filesystem::is_character_file("/dev/full"));
    CHECK(std::filesystem::is_character_file("/dev/null"));
}

TEST_CASE("WriteBeyondTheFileSizeLimitLeavesNothing") {
    const ScratchFolder folder;
    const std::vector<std::byte> encoded = encodeExr(sampleFrame());
    // In a process of its own: the limit and the signal handlers are the process's.
    const pid_t child = fork();
    REQUIRE(child >= 0);
    if (child == 0) {
        installSignalCleanup();
        const rlimit limit{4096, 4096};
        setrlimit(RLIMIT_FSIZE, &limit);
        try {
            writeFileAtomically(folder / "a.exr", encoded);
        } catch (const InputError& error) {
            _exit(contains(error.what(), "File too large") ? 42 : 43);
        }
        _exit(44);
    }
    int status = 0;
    REQUIRE(waitpid(child, &status, 0) == child);
    REQUIRE(WIFEXITED(status));
    CHECK(WEXITSTATUS(status) == 42);
    CHECK(folder.entries() == 0);
}

TEST_CASE("SignalRemovesPendingFiles") {
    for (const int signalNumber : {SIGINT, SIGTERM}) {
        const ScratchFolder folder;
        writeBytes(folder / "a", "old");
        int ready[2];
        REQUIRE(pipe(ready) == 0);
        const pid_t child = fork();
        REQUIRE(child >= 0);
        if (child == 0) {
            installSignalCleanup();
            AtomicFile first(folder / "a"), second(folder / "b");
            first.write(std::as_bytes(std::span("half", 4)));
            const char pending = folder.entries() == 3 ? 'y' : 'n';
            if (write(ready[1], &pending, 1) != 1) _exit(1);
            while (true) pause();
        }
        char pending = 0;
        REQUIRE(read(ready[0], &pending, 1) == 1);
        CHECK(pending == 'y');
        kill(child, signalNumber);
        int status = 0;
        REQUIRE(waitpid(child, &status, 0) == child);
        REQUIRE(WIFEXITED(status));
        CHECK(WEXITSTATUS(status) == 128 + signalNumber);
        CHECK(folder.entries() == 1);
        CHECK(readBytes(folder / "a") == "old");
        close(ready[0]);
        close(ready[1]);
    }
}

}  // namespace etalon
