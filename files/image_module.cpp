// The module etalon_image_io.so: nothing of Etalon is linked into it.
#include "files/image_module.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cstdint>
#include <memory>

namespace etalon {
namespace {

using OIIO::TypeDesc;

// The first line of the library's message; some have several.
std::string firstLine(const std::string& text) { return text.substr(0, text.find('\n')); }

SampleType sampleTypeOf(const TypeDesc& type) {
    if (type == TypeDesc::UINT8) return SampleType::uint8;
    if (type == TypeDesc::UINT16) return SampleType::uint16;
    if (type == TypeDesc::UINT32) return SampleType::uint32;
    if (type == TypeDesc::HALF) return SampleType::float16;
    if (type == TypeDesc::FLOAT) return SampleType::float32;
    return SampleType::other;
}

ImageHeader headerOf(const OIIO::ImageSpec& spec) {
    ImageHeader header{
        spec.width, spec.height, spec.deep || spec.depth > 1, spec.get_int_attribute("Orientation", 1),
        {},         {}};
    for (int c = 0; c < spec.nchannels; ++c) {
        const TypeDesc type = spec.channelformat(c);
        header.channels.push_back({spec.channel_name(c), sampleTypeOf(type), type.c_str(), type.size()});
    }
    for (const OIIO::ParamValue& attribute : spec.extra_attribs)
        if (attribute.type() == TypeDesc::STRING)
            header.texts[attribute.name().string()] = attribute.get_string();
    return header;
}

std::string readImage(const std::string& path, const std::function<void(const ImageHeader&)>& accept,
                      const std::function<void(double)>& progress, StoredImage& image) {
    OIIO::ImageSpec hints;
    hints.attribute("oiio:UnassociatedAlpha", 1);
    const auto input = OIIO::ImageInput::open(path, &hints);
    if (!input) return "not a readable image: " + firstLine(OIIO::geterror());
    image.header = headerOf(input->spec());
    accept(image.header);
    if (input->seek_subimage(1, 0)) return "holds several images; only files of one image are read";
    input->geterror();
    if (!input->seek_subimage(0, 0)) return "not a readable image: " + firstLine(input->geterror());

    const OIIO::ImageSpec spec = input->spec();
    image.pixelBytes = spec.pixel_bytes(true);
    image.samples.resize(static_cast<size_t>(spec.width) * static_cast<size_t>(spec.height) *
                         image.pixelBytes);
    // Some readers report success and leave an error behind (a truncated TIFF), others fail without one
    // (PFM).
    const auto report = [](void* to, float part) {
        (*static_cast<const std::function<void(double)>*>(to))(double{part});
        return false;  // go on
    };
    const bool complete = input->read_image(0, 0, 0, spec.nchannels, TypeDesc::UNKNOWN, image.samples.data(),
                                            OIIO::AutoStride, OIIO::AutoStride, OIIO::AutoStride, report,
                                            const_cast<std::function<void(double)>*>(&progress));
    const std::string error = firstLine(input->geterror());
    if (!error.empty()) return "truncated or damaged: " + error;
    return complete ? "" : "the file is truncated or damaged";
}

std::string encodePng(int width, int height, std::span<const std::byte> pixels,
                      std::vector<std::byte>& bytes) {
    // The library's remarks on standard error.
    OIIO::attribute("debug", 0);
    OIIO::Filesystem::IOVecOutput memory;
    const auto output = OIIO::ImageOutput::create("image.png", &memory);
    if (!output) return "no encoder: " + OIIO::geterror();
    OIIO::ImageSpec spec(width, height, 3, TypeDesc::UINT8);
    spec.attribute("oiio:ColorSpace", "sRGB");
    const bool good = output->open("image.png", spec) &&
                      output->write_image(TypeDesc::UINT8, pixels.data()) && output->close();
    if (!good) return output->geterror();
    const auto encoded = std::as_bytes(std::span(memory.buffer()));
    bytes.assign(encoded.begin(), encoded.end());
    return "";
}

}  // namespace
}  // namespace etalon

extern "C" __attribute__((visibility("default"))) const etalon::ImageModule* etalonImageModule() {
    static constexpr etalon::ImageModule kModule = {etalon::readImage, etalon::encodePng};
    return &kModule;
}
