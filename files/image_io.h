// Image files: EXR files are written by OpenEXR (exr_encoder.cpp), everything else is OpenImageIO's
// (image_module.h).
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <vector>

#include "files/frame.h"

namespace etalon {

// The most memory that the pixels of one file may take; a header that asks for more is refused unread.
inline constexpr uint64_t kMaxFrameBytes = uint64_t{8} << 30;

// Every channel of an EXR, HDR, TIFF, PFM or PNG file of one image. Half and float samples are read as they
// are; 8- and 16-bit samples become code / 255 and code / 65535 with no transfer function applied and alpha
// left as stored; uint32 samples stay uint32_t. Row 0 is the top row; the size is that of the data window.
// metadata: the file's text attributes but for those that describe its encoding; OpenEXR's envmap is "envmap"
// with "latlong" or "cube". Throws InputError "path: reason", one line: missing, empty, truncated or damaged
// file, no image format, zero or absurd size (the memory it would need is named), several or deep images,
// other sample types, more memory needed than can be had.
Frame readFrame(const std::filesystem::path& path);

// Three planes R, G, B; a single grey channel ("Y", or the only one besides "A") is replicated. Values as in
// readFrame. InputError as there, and for uint32 channels and files with neither R, G and B nor grey.
Image<float> readRgb(const std::filesystem::path& path);

// The planes R, G, B of a frame that was read from `path`, with the rules and errors of readRgb.
Image<float> rgbOf(const Frame& frame, const std::filesystem::path& path);

// The bytes of an EXR file: float32 and uint32 channels under their own names, lossless zip compression, the
// metadata as text attributes (but for the names of the format's own, such as "type"; "envmap" with "latlong" or
// "cube" becomes OpenEXR's own attribute). The same frame gives the same bytes for any number of threads (0: all of the
// machine); no more than that many compress it, and OpenEXR's pool of threads has then that many. The frame must pass
// checkFrame and be at least 1x1.
std::vector<std::byte> encodeExr(const Frame& frame, int threads = 0);

// The bytes of an 8-bit PNG of three planes R, G, B, marked as sRGB; at least 1x1.
std::vector<std::byte> encodePng(const Image<uint8_t>& image);

// Atomic (files/atomic_file.h). InputError "path: reason" when the file cannot be written; nothing is left then.
void writeExr(const Frame& frame, const std::filesystem::path& path);
void writePng(const Image<uint8_t>& image, const std::filesystem::path& path);

}  // namespace etalon
