#include "ar/image_io.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <fstream>
#include <functional>
#include <memory>
#include <new>
#include <span>
#include <string>
#include <string_view>
#include <system_error>

#include "ar/atomic_file.h"

namespace etalon {
namespace {

using OIIO::TypeDesc;

// Rows handed to the encoder at a time: one zip block of an EXR file is 16 rows.
constexpr int kRowsPerWrite = 64;

[[noreturn]] void fail(const std::filesystem::path& path, const std::string& reason) {
    throw InputError(fmt::format("{}: {}", path.string(), reason));
}

// The first line of a library's message; some have several.
std::string firstLine(const std::string& text) { return text.substr(0, text.find('\n')); }

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

float halfToFloat(uint16_t half) {
    const uint32_t sign = uint32_t{half & 0x8000u} << 16, exponent = (half >> 10) & 31u,
                   fraction = half & 0x3ffu;
    if (exponent == 31) return std::bit_cast<float>(sign | 0x7f800000u | fraction << 13);
    if (exponent != 0) return std::bit_cast<float>(sign | (exponent + 112) << 23 | fraction << 13);
    const float magnitude = static_cast<float>(fraction) * 0x1p-24f;  // subnormal or zero; exact
    return sign != 0 ? -magnitude : magnitude;
}

float sampleToFloat(const std::byte* bytes, TypeDesc::BASETYPE type) {
    if (type == TypeDesc::UINT8) return static_cast<float>(std::to_integer<int>(*bytes)) / 255.0f;
    if (type == TypeDesc::FLOAT) {
        float value;
        std::memcpy(&value, bytes, sizeof value);
        return value;
    }
    uint16_t code;
    std::memcpy(&code, bytes, sizeof code);
    return type == TypeDesc::HALF ? halfToFloat(code) : static_cast<float>(code) / 65535.0f;
}

std::unique_ptr<OIIO::ImageInput> openInput(const std::filesystem::path& path) {
    std::error_code error;
    const std::filesystem::file_status status = std::filesystem::status(path, error);
    if (!std::filesystem::exists(status)) fail(path, "no such file");
    if (std::filesystem::is_directory(status)) fail(path, "is a directory, not an image file");
    if (!std::filesystem::is_regular_file(status)) fail(path, "is a device or a pipe, not an image file");
    if (!std::ifstream(path, std::ios::binary)) fail(path, "cannot be opened for reading");
    if (std::filesystem::file_size(path, error) == 0) fail(path, "the file is empty");
    if (isDamagedPng(path)) fail(path, "the file is truncated or damaged");
    OIIO::ImageSpec hints;
    hints.attribute("oiio:UnassociatedAlpha", 1);
    auto input = OIIO::ImageInput::open(path.string(), &hints);
    if (!input) fail(path, "not a readable image: " + firstLine(OIIO::geterror()));
    return input;
}

// Refuses, before any pixel is read, what a Frame cannot hold.
void checkSpec(OIIO::ImageInput& input, const std::filesystem::path& path) {
    const OIIO::ImageSpec& spec = input.spec();
    if (spec.width <= 0 || spec.height <= 0 || spec.nchannels <= 0)
        fail(path, fmt::format("zero size: {}x{} with {} channels", spec.width, spec.height, spec.nchannels));
    if (spec.deep || spec.depth > 1) fail(path, "deep and volume images are not supported");
    const double bytes = 4.0 * spec.width * spec.height * spec.nchannels;
    if (spec.width > kMaxImageSize || spec.height > kMaxImageSize ||
        bytes > static_cast<double>(kMaxFrameBytes))
        fail(path,
             fmt::format("{}x{} with {} channels would need {:.1f} GiB of memory; the limit is {} GiB and "
                         "{} pixels a side",
                         spec.width, spec.height, spec.nchannels, bytes * 0x1p-30, kMaxFrameBytes >> 30,
                         kMaxImageSize));
    if (const int orientation = spec.get_int_attribute("Orientation", 1); orientation != 1)
        fail(path, fmt::format("orientation {} is not supported; the top row must come first", orientation));
    for (int c = 0; c < spec.nchannels; ++c) {
        const TypeDesc type = spec.channelformat(c);
        if (type != TypeDesc::UINT8 && type != TypeDesc::UINT16 && type != TypeDesc::UINT32 &&
            type != TypeDesc::HALF && type != TypeDesc::FLOAT)
            fail(path, fmt::format(
                           "channel {} holds {} samples; only float, half, uint8, uint16 and uint32 are read",
                           spec.channel_name(c), type.c_str()));
    }
    if (input.seek_subimage(1, 0)) fail(path, "holds several images; only files of one image are read");
    input.geterror();
    if (!input.seek_subimage(0, 0)) fail(path, "not a readable image: " + firstLine(input.geterror()));
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
Image<T> unpackPlane(const OIIO::ImageSpec& spec, const std::byte* samples, size_t pixelBytes,
                     TypeDesc::BASETYPE type) {
    Image<T> image(spec.width, spec.height);
    for (T& value : image.values()) {
        if constexpr (std::is_same_v<T, float>)
            value = sampleToFloat(samples, type);
        else
            std::memcpy(&value, samples, sizeof value);
        samples += pixelBytes;
    }
    return image;
}

// Text that says how the file is encoded, not what it shows.
bool describesEncoding(std::string_view name) {
    return name == "compression" || name == "planarconfig" || name == "ResolutionUnit" ||
           name.starts_with("oiio:");
}

std::vector<std::byte> encode(const std::string& formatName, const OIIO::ImageSpec& spec,
                              const std::function<void(int firstRow, int rows, std::byte*)>& packRows) {
    // The library's remarks on standard error.
    OIIO::attribute("debug", 0);
    OIIO::Filesystem::IOVecOutput memory;
    auto output = OIIO::ImageOutput::create(formatName, &memory);
    ETALON_CHECK(output != nullptr, "no encoder for {}: {}", formatName, OIIO::geterror());
    bool good = output->open(formatName, spec);
    const size_t rowBytes = static_cast<size_t>(spec.scanline_bytes(true));
    std::vector<std::byte> rows(rowBytes * static_cast<size_t>(std::min(kRowsPerWrite, spec.height)));
    for (int y = 0; good && y < spec.height; y += kRowsPerWrite) {
        const int count = std::min(kRowsPerWrite, spec.height - y);
        packRows(y, count, rows.data());
        good = output->write_scanlines(y, y + count, 0, TypeDesc::UNKNOWN, rows.data());
    }
    good = good && output->close();
    ETALON_CHECK(good, "encoding {}x{} as {}: {}", spec.width, spec.height, formatName, output->geterror());
    const auto bytes = std::as_bytes(std::span(memory.buffer()));
    return {bytes.begin(), bytes.end()};
}

Frame readWhole(const std::filesystem::path& path) {
    const auto input = openInput(path);
    checkSpec(*input, path);
    const OIIO::ImageSpec spec = input->spec();
    const size_t pixelBytes = spec.pixel_bytes(true);
    std::vector<std::byte> pixels(static_cast<size_t>(spec.width) * static_cast<size_t>(spec.height) *
                                  pixelBytes);
    // Some readers report success and leave an error behind (a truncated TIFF), others fail without one
    // (PFM).
    const bool complete = input->read_image(0, 0, 0, spec.nchannels, TypeDesc::UNKNOWN, pixels.data());
    const std::string error = firstLine(input->geterror());
    if (!complete || !error.empty())
        fail(path, error.empty() ? "the file is truncated or damaged" : "truncated or damaged: " + error);

    Frame frame{spec.width, spec.height, {}, {}};
    size_t offset = 0;
    for (int c = 0; c < spec.nchannels; ++c) {
        const TypeDesc type = spec.channelformat(c);
        const std::byte* samples = pixels.data() + offset;
        const auto base = static_cast<TypeDesc::BASETYPE>(type.basetype);
        if (frame.find(spec.channel_name(c)) != nullptr || spec.channel_name(c).empty())
            fail(path, fmt::format("channel name \"{}\" is empty or used twice", spec.channel_name(c)));
        if (type == TypeDesc::UINT32)
            frame.channels.push_back(
                {spec.channel_name(c), unpackPlane<uint32_t>(spec, samples, pixelBytes, base)});
        else
            frame.channels.push_back(
                {spec.channel_name(c), unpackPlane<float>(spec, samples, pixelBytes, base)});
        offset += type.size();
    }
    for (const OIIO::ParamValue& attribute : spec.extra_attribs)
        if (attribute.type() == TypeDesc::STRING && !describesEncoding(attribute.name().string()))
            frame.metadata[attribute.name().string()] = attribute.get_string();
    return frame;
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
        if (!image)
            fail(path, fmt::format("channel {} holds identifiers (uint32), not colours", source.name));
        std::ranges::copy(image->values(), rgb.plane(c).begin());
    }
    return rgb;
}

}  // namespace

Frame readFrame(const std::filesystem::path& path) {
    return withinMemory(path, [&] { return readWhole(path); });
}

Image<float> readRgb(const std::filesystem::path& path) {
    return withinMemory(path, [&] { return rgbOf(readWhole(path), path); });
}

std::vector<std::byte> encodeExr(const Frame& frame) {
    checkFrame(frame);
    ETALON_CHECK(frame.width > 0 && frame.height > 0, "a frame of {}x{}", frame.width, frame.height);
    static_assert(sizeof(float) == 4 && sizeof(uint32_t) == 4);
    OIIO::ImageSpec spec(frame.width, frame.height, static_cast<int>(frame.channels.size()), TypeDesc::FLOAT);
    spec.channelnames.clear();
    std::vector<const std::byte*> planes;
    for (const Channel& channel : frame.channels) {
        spec.channelnames.push_back(channel.name);
        spec.channelformats.push_back(
            std::holds_alternative<Image<float>>(channel.values) ? TypeDesc::FLOAT : TypeDesc::UINT32);
        std::visit([&](const auto& image) { planes.push_back(std::as_bytes(image.values()).data()); },
                   channel.values);
    }
    for (const auto& [name, text] : frame.metadata) spec.attribute(name, text);
    spec.attribute("compression", "zip");
    // The library adds the time of writing unless something of that name is there; a number is not written.
    if (!frame.metadata.contains("DateTime")) spec.attribute("DateTime", 0);
    return encode("frame.exr", spec, [&](int firstRow, int rows, std::byte* out) {
        const size_t first = static_cast<size_t>(firstRow) * static_cast<size_t>(frame.width);
        const size_t count = static_cast<size_t>(rows) * static_cast<size_t>(frame.width);
        for (size_t i = first; i < first + count; ++i)
            for (const std::byte* plane : planes) {
                std::memcpy(out, plane + 4 * i, 4);
                out += 4;
            }
    });
}

std::vector<std::byte> encodePng(const Image<uint8_t>& image) {
    ETALON_CHECK(image.channels() == 3 && !image.empty(), "an image of {}x{} with {} channels", image.width(),
                 image.height(), image.channels());
    OIIO::ImageSpec spec(image.width(), image.height(), 3, TypeDesc::UINT8);
    spec.attribute("oiio:ColorSpace", "sRGB");
    return encode("frame.png", spec, [&](int firstRow, int rows, std::byte* out) {
        for (int y = firstRow; y < firstRow + rows; ++y)
            for (int x = 0; x < image.width(); ++x)
                for (int c = 0; c < 3; ++c) *out++ = std::byte{image.at(x, y, c)};
    });
}

void writeExr(const Frame& frame, const std::filesystem::path& path) {
    writeFileAtomically(path, encodeExr(frame));
}

void writePng(const Image<uint8_t>& image, const std::filesystem::path& path) {
    writeFileAtomically(path, encodePng(image));
}

}  // namespace etalon
