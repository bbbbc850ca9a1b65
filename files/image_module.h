// What the rest of ar/ asks of OpenImageIO. That library brings some 250 others, and loading them takes
// longer than drawing a small picture, so all calls into it are in a module of their own (image_module.cpp),
// which is loaded when the first image is read or the first PNG is written.
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace etalon {

// How a file stores the samples of a channel. `other` is not read.
enum class SampleType { uint8, uint16, uint32, float16, float32, other };

struct StoredChannel {
    std::string name;
    SampleType type;
    std::string typeName;  // for messages
    size_t bytes;          // of one sample
};

// What a file says about its first image before any pixel is read.
struct ImageHeader {
    int width, height;  // of the data window, pixels; not checked
    bool deep;          // deep samples, or slices of a volume
    int orientation;    // of TIFF and EXIF; 1: the top row first
    std::vector<StoredChannel> channels;
    std::map<std::string, std::string> texts;  // attributes
};

struct StoredImage {
    ImageHeader header;
    size_t pixelBytes;               // of all channels of one pixel
    std::vector<std::byte> samples;  // as stored, in native byte order: row by row, the channels interleaved
};

// The module's functions. They throw nothing of their own but std::bad_alloc.
struct ImageModule {
    // Opens a regular file of one image, calls `accept`, which throws to refuse it (it has seen no pixel and
    // no memory has been taken for any), and reads it, calling `progress` with the part that is read. Returns what is
    // wrong with the file, or "".
    std::string (*read)(const std::string& path, const std::function<void(const ImageHeader&)>& accept,
                        const std::function<void(double)>& progress, StoredImage& image);

    // The bytes of an 8-bit PNG marked as sRGB from width * height pixels R, G, B. Returns what went wrong,
    // or "".
    std::string (*encodePng)(int width, int height, std::span<const std::byte> pixels,
                             std::vector<std::byte>& bytes);
};

// Loads the module on the first call. InputError "path: reason" if it is missing or cannot be loaded.
const ImageModule& imageModule();

// The module's file and the one symbol that it exports, a function of the type ImageModuleEntry.
inline constexpr const char* kImageModuleFile = "etalon_image_io.so";
inline constexpr const char* kImageModuleEntry = "etalonImageModule";
using ImageModuleEntry = const ImageModule*();

}  // namespace etalon
