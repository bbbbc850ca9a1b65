// Planes of words: what a case computed, as bits.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "raster/image.h"

namespace etalon {

// What a word of a plane is.
enum class WordKind : uint8_t { uint32, float32, float64 };
const char* wordKindName(WordKind kind);

// width x height pixels, each with a word in every layer. The words are stored layer by layer in rows, as in
// Image; those of 32 bits in the lower half.
struct BitPlane {
    std::string name;
    WordKind kind = WordKind::uint32;
    int width = 0, height = 0, layers = 0;
    std::string layerName;  // what one layer is: "sample"
    std::vector<uint64_t> words;

    uint64_t at(int x, int y, int layer) const {
        return words[(static_cast<size_t>(layer) * static_cast<size_t>(height) + static_cast<size_t>(y)) *
                         static_cast<size_t>(width) +
                     static_cast<size_t>(x)];
    }
};

BitPlane planeOf(std::string name, const Image<float>& image, std::string layerName = "channel");
BitPlane planeOf(std::string name, const Image<uint32_t>& image, std::string layerName = "sample");
BitPlane planeOf(std::string name, const Image<uint8_t>& image, std::string layerName = "sample");
// Rows of `width` numbers; the last row is filled up with zeros. values must not be empty.
BitPlane planeOf(std::string name, std::span<const float> values, int width);
BitPlane planeOf(std::string name, std::span<const double> values, int width);

// A word as hexadecimal digits and, for floats, as a number.
std::string wordText(WordKind kind, uint64_t word);

// The squares that are hashed; those at the right and lower border may be smaller.
inline constexpr int kHashTile = 32;

// A plane's shape and the hash (XXH64) of each tile: the words of the tile, layer by layer and row by row, in
// their own size, little-endian. Tiles in rows.
struct PlaneHashes {
    std::string name;
    WordKind kind = WordKind::uint32;
    int width = 0, height = 0, layers = 0;
    std::vector<uint64_t> tiles;

    int columns() const { return (width + kHashTile - 1) / kHashTile; }
    int rows() const { return (height + kHashTile - 1) / kHashTile; }
    bool sameShape(const PlaneHashes& other) const {
        return name == other.name && kind == other.kind && width == other.width && height == other.height &&
               layers == other.layers;
    }
    friend bool operator==(const PlaneHashes&, const PlaneHashes&) = default;
};
PlaneHashes hashPlane(const BitPlane& plane);

}  // namespace etalon
