// The bytes of EXR files, through OpenEXR alone: a render without input images needs no other image library.
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <OpenEXR/ImfThreading.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <string_view>

#include "files/image_io.h"
#include "numeric/parallel.h"
#include "numeric/progress.h"

namespace etalon {
namespace {

// Collects what the library writes; it goes back once, to fill in where each block of rows begins.
class MemoryStream : public Imf::OStream {
  public:
    MemoryStream() : OStream("memory") {}

    void write(const char text[], int count) override {
        const size_t end = position_ + static_cast<size_t>(count);
        if (end > bytes_.size()) bytes_.resize(end);
        std::memcpy(bytes_.data() + position_, text, static_cast<size_t>(count));
        position_ = end;
    }
    uint64_t tellp() override { return position_; }
    void seekp(uint64_t position) override { position_ = position; }

    std::vector<std::byte> take() { return std::move(bytes_); }

  private:
    std::vector<std::byte> bytes_;
    size_t position_ = 0;
};

// Whether a text attribute of that name would be taken for one of the format's own [OpenEXR, "Predefined
// and Header Attributes"] or be refused.
bool isReserved(const Imf::Header& header, const std::string& name) {
    constexpr std::array<std::string_view, 7> kReserved = {"chunkCount", "name",    "preview", "tiles",
                                                           "type",       "version", "view"};
    return name.empty() || header.find(name) != header.end() ||
           std::ranges::find(kReserved, name) != kReserved.end();
}

}  // namespace

std::vector<std::byte> encodeExr(const Frame& frame, int threads) {
    checkFrame(frame);
    ETALON_CHECK(frame.width > 0 && frame.height > 0, "a frame of {}x{}", frame.width, frame.height);
    static_assert(sizeof(float) == 4 && sizeof(uint32_t) == 4);
    Imf::Header header(frame.width, frame.height);
    header.compression() = Imf::ZIP_COMPRESSION;
    for (const auto& [name, text] : frame.metadata)
        if (name == "envmap")
            Imf::addEnvmap(header, text == "cube" ? Imf::ENVMAP_CUBE : Imf::ENVMAP_LATLONG);
        else if (!isReserved(header, name))
            header.insert(name, Imf::StringAttribute(text));
    Imf::FrameBuffer planes;
    for (const Channel& channel : frame.channels) {
        const auto type = std::holds_alternative<Image<float>>(channel.values) ? Imf::FLOAT : Imf::UINT;
        header.channels().insert(channel.name, Imf::Channel(type));
        // The library only reads through the pointer.
        const std::byte* const values = std::visit(
            [](const auto& image) { return std::as_bytes(image.values()).data(); }, channel.values);
        planes.insert(channel.name, Imf::Slice(type, reinterpret_cast<char*>(const_cast<std::byte*>(values)),
                                               4, 4 * static_cast<size_t>(frame.width)));
    }
    // Blocks of rows are compressed side by side; the bytes are the same for any number of threads.
    constexpr int kRowsPerBlock = 16;  // of this compression
    const int blocks = (frame.height - 1) / kRowsPerBlock + 1;
    // The library counts helpers: with 0 the calling thread does the work. Its pool is one for the process, and may
    // have more of them than are asked for: from an earlier file, or from what read one.
    const int helpers = std::min(threads == 0 ? hardwareThreads() : threads, blocks);
    const int pool = helpers > 1 ? helpers : 0;
    if (Imf::globalThreadCount() != pool) Imf::setGlobalThreadCount(pool);
    MemoryStream stream;
    {
        Imf::OutputFile file(stream, header, pool);
        file.setFrameBuffer(planes);
        // Some blocks for each helper at a time; the bytes are those of all at once.
        const int rows = 4 * kRowsPerBlock * std::max(pool, 1);
        ProgressLoop progress(static_cast<size_t>((frame.height - 1) / rows + 1));
        for (int y = 0; y < frame.height; y += rows, progress.next())
            file.writePixels(std::min(rows, frame.height - y));
    }
    return stream.take();
}

}  // namespace etalon
