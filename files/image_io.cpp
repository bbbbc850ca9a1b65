#include "files/image_io.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <fstream>
#include <new>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <system_error>

#include "files/atomic_file.h"
#include "files/image_module.h"
#include "numeric/progress.h"
#include "numeric/text.h"
#include "raster/stored_sample.h"

namespace etalon {
namespace {

[[noreturn]] void fail(const std::filesystem::path& path, const std::string& reason) {
    throw InputError(formatText("{}: {}", path.string(), reason));
}

// The checksum of PNG chunks, byte by byte with a table [PNG, Annex D].
class Crc32 {
  public:
    void add(std::span<const char> bytes) {
        static const std::array<uint32_t, 256> kTable = [] {
            std::array<uint32_t, 256> table{};
            for (uint32_t i = 0; i < table.size(); ++i) {
                uint32_t value = i;
                for (int bit = 0; bit < 8; ++bit)
                    value = (value & 1) != 0 ? 0xedb88320u ^ value >> 1 : value >> 1;
                table[i] = value;
            }
            return table;
        }();
        for (const char byte : bytes)
            remainder_ = kTable[(remainder_ ^ static_cast<unsigned char>(byte)) & 255u] ^ remainder_ >> 8;
    }
    uint32_t value() const { return ~remainder_; }

  private:
    uint32_t remainder_ = 0xffffffffu;
};

uint32_t bigEndian(const char* bytes) {
    uint32_t value = 0;
    for (int i = 0; i < 4; ++i) value = value << 8 | static_cast<unsigned char>(bytes[i]);
    return value;
}

// libpng prints to standard error what it finds damaged, so a damaged PNG is found first: every chunk up to
// IEND must be there and have the right checksum [PNG, 5.3]. False for files that do not begin as one.
bool isDamagedPng(const std::filesystem::path& path) {
    constexpr std::string_view kSignature = "\x89PNG\r\n\x1a\n";
    std::ifstream file(path, std::ios::binary);
    std::array<char, 8> head;  // the signature; then length and type of each chunk
    file.read(head.data(), head.size());
    const std::string_view start(head.data(), static_cast<size_t>(file.gcount()));
    if (!start.starts_with(kSignature.substr(0, 4))) return false;
    if (start != kSignature) return true;
    std::vector<char> block(size_t{1} << 16);
    while (file.read(head.data(), head.size())) {
        const std::string_view type(head.data() + 4, 4);
        Crc32 crc;
        crc.add(type);
        for (size_t left = bigEndian(head.data()); left > 0;) {
            const size_t count = std::min(left, block.size());
            if (!file.read(block.data(), static_cast<std::streamsize>(count))) return true;
            crc.add(std::span(block).first(count));
            left -= count;
        }
        if (!file.read(block.data(), 4) || bigEndian(block.data()) != crc.value()) return true;
        if (type == "IEND") return false;
    }
    return true;
}

float sampleToFloat(const std::byte* bytes, SampleType type) {
    if (type == SampleType::uint8) return floatOfCode(std::to_integer<uint8_t>(*bytes));
    if (type == SampleType::float32) {
        float value;
        std::memcpy(&value, bytes, sizeof value);
        return value;
    }
    uint16_t code;
    std::memcpy(&code, bytes, sizeof code);
    return type == SampleType::float16 ? floatOfHalf(code) : floatOfCode(code);
}

// Everything that can be told before the library opens the file.
void checkFile(const std::filesystem::path& path) {
    std::error_code error;
    const std::filesystem::file_status status = std::filesystem::status(path, error);
    if (!std::filesystem::exists(status)) fail(path, "no such file");
    if (std::filesystem::is_directory(status)) fail(path, "is a directory, not an image file");
    if (!std::filesystem::is_regular_file(status)) fail(path, "is a device or a pipe, not an image file");
    if (!std::ifstream(path, std::ios::binary)) fail(path, "cannot be opened for reading");
    if (std::filesystem::file_size(path, error) == 0) fail(path, "the file is empty");
    if (isDamagedPng(path)) fail(path, "the file is truncated or damaged");
}

// Refuses, before any pixel is read, what a Frame cannot hold.
void checkHeader(const ImageHeader& header, const std::filesystem::path& path) {
    const int width = header.width, height = header.height;
    const size_t channels = header.channels.size();
    if (width <= 0 || height <= 0 || channels == 0)
        fail(path, formatText("zero size: {}x{} with {} channels", width, height, channels));
    if (header.deep) fail(path, "deep and volume images are not supported");
    const double bytes = 4.0 * width * height * static_cast<double>(channels);
    if (width > kMaxImageSize || height > kMaxImageSize || bytes > static_cast<double>(kMaxFrameBytes))
        fail(path,
             formatText("{}x{} with {} channels would need {:.1f} GiB of memory; the limit is {} GiB and "
                        "{} pixels a side",
                        width, height, channels, bytes * 0x1p-30, kMaxFrameBytes >> 30, kMaxImageSize));
    if (header.orientation != 1)
        fail(path,
             formatText("orientation {} is not supported; the top row must come first", header.orientation));
    for (const StoredChannel& channel : header.channels)
        if (channel.type == SampleType::other)
            fail(path, formatText(
                           "channel {} holds {} samples; only float, half, uint8, uint16 and uint32 are read",
                           channel.name, channel.typeName));
}

// What read() returns; InputError when the memory for it cannot be had.
template <class Read>
auto withinMemory(const std::filesystem::path& path, Read read) {
    try {
        return read();
    } catch (const std::bad_alloc&) {
        fail(path, "there is not enough memory to read it");
    }
}

// One plane out of interleaved pixels of pixelBytes each.
template <class T>
Image<T> unpackPlane(const StoredImage& stored, const std::byte* samples, SampleType type) {
    Image<T> image(stored.header.width, stored.header.height);
    for (T& value : image.values()) {
        if constexpr (std::is_same_v<T, float>)
            value = sampleToFloat(samples, type);
        else
            std::memcpy(&value, samples, sizeof value);
        samples += stored.pixelBytes;
    }
    return image;
}

// Text that says how the file is encoded, not what it shows.
bool describesEncoding(std::string_view name) {
    return name == "compression" || name == "planarconfig" || name == "ResolutionUnit" ||
           name.starts_with("oiio:");
}

Frame readWhole(const std::filesystem::path& path) {
    checkFile(path);
    StoredImage stored;
    constexpr size_t kRounds = 100;
    std::optional<ProgressLoop> progress(kRounds);
    size_t done = 0;
    const auto report = [&](double part) {
        for (; static_cast<double>(done) < kRounds * part; done++) progress->next();
    };
    const std::string defect = imageModule().read(
        path.string(), [&](const ImageHeader& header) { checkHeader(header, path); }, report, stored);
    progress.reset();
    if (!defect.empty()) fail(path, defect);

    const ImageHeader& header = stored.header;
    Frame frame{header.width, header.height, {}, {}};
    const std::byte* samples = stored.samples.data();
    for (const StoredChannel& channel : header.channels) {
        if (frame.find(channel.name) != nullptr || channel.name.empty())
            fail(path, formatText("channel name \"{}\" is empty or used twice", channel.name));
        if (channel.type == SampleType::uint32)
            frame.channels.push_back({channel.name, unpackPlane<uint32_t>(stored, samples, channel.type)});
        else
            frame.channels.push_back({channel.name, unpackPlane<float>(stored, samples, channel.type)});
        samples += channel.bytes;
    }
    for (const auto& [name, text] : header.texts)
        if (name == "textureformat")
            frame.metadata["envmap"] = text.starts_with("CubeFace") ? "cube" : "latlong";
        else if (!describesEncoding(name))
            frame.metadata[name] = text;
    return frame;
}

}  // namespace

Frame readFrame(const std::filesystem::path& path) {
    return withinMemory(path, [&] { return readWhole(path); });
}

Image<float> readRgb(const std::filesystem::path& path) {
    return withinMemory(path, [&] { return rgbOf(readWhole(path), path); });
}

Image<float> rgbOf(const Frame& frame, const std::filesystem::path& path) {
    std::array<const Channel*, 3> sources = {frame.find("R"), frame.find("G"), frame.find("B")};
    if (!sources[0] || !sources[1] || !sources[2]) {
        const Channel* grey = frame.find("Y");
        if (frame.channels.size() == 1) grey = &frame.channels[0];
        if (!grey) fail(path, "has neither channels R, G and B nor a single grey channel");
        sources.fill(grey);
    }
    Image<float> rgb(frame.width, frame.height, 3);
    for (int c = 0; c < 3; ++c) {
        const Channel& source = *sources[static_cast<size_t>(c)];
        const auto* image = std::get_if<Image<float>>(&source.values);
        if (!image) fail(path, formatText("channel {} holds identifiers (uint32), not colours", source.name));
        std::ranges::copy(image->values(), rgb.plane(c).begin());
    }
    return rgb;
}

std::vector<std::byte> encodePng(const Image<uint8_t>& image) {
    ETALON_CHECK(image.channels() == 3 && !image.empty(), "an image of {}x{} with {} channels", image.width(),
                 image.height(), image.channels());
    std::vector<std::byte> pixels(image.values().size()), bytes;
    std::byte* out = pixels.data();
    for (int y = 0; y < image.height(); ++y)
        for (int x = 0; x < image.width(); ++x)
            for (int c = 0; c < 3; ++c) *out++ = std::byte{image.at(x, y, c)};
    const std::string defect = imageModule().encodePng(image.width(), image.height(), pixels, bytes);
    ETALON_CHECK(defect.empty(), "encoding {}x{} as PNG: {}", image.width(), image.height(), defect);
    return bytes;
}

void writeExr(const Frame& frame, const std::filesystem::path& path) {
    writeFileAtomically(path, encodeExr(frame));
}

void writePng(const Image<uint8_t>& image, const std::filesystem::path& path) {
    writeFileAtomically(path, encodePng(image));
}

}  // namespace etalon
