#include "bitcheck/plane.h"

#include <algorithm>
#include <bit>
#include <utility>

#include "numeric/hash.h"
#include "numeric/text.h"

namespace etalon {
namespace {

uint64_t wordOf(float value) { return std::bit_cast<uint32_t>(value); }
uint64_t wordOf(double value) { return std::bit_cast<uint64_t>(value); }
uint64_t wordOf(uint32_t value) { return value; }
uint64_t wordOf(uint8_t value) { return value; }

template <class T>
BitPlane planeOfImage(WordKind kind, std::string name, const Image<T>& image, std::string layerName) {
    BitPlane plane{std::move(name),      kind, image.width(), image.height(), image.channels(),
                   std::move(layerName), {}};
    for (const T value : image.values()) plane.words.push_back(wordOf(value));
    return plane;
}

template <class T>
BitPlane planeOfList(WordKind kind, std::string name, std::span<const T> values, int width) {
    ETALON_CHECK(!values.empty() && width >= 1, "{} values in rows of {}", values.size(), width);
    const size_t rows = (values.size() + static_cast<size_t>(width) - 1) / static_cast<size_t>(width);
    BitPlane plane{std::move(name), kind, width, static_cast<int>(rows), 1, "layer", {}};
    for (const T value : values) plane.words.push_back(wordOf(value));
    plane.words.resize(rows * static_cast<size_t>(width));
    return plane;
}

}  // namespace

const char* wordKindName(WordKind kind) {
    switch (kind) {
        case WordKind::uint32:
            return "uint32";
        case WordKind::float32:
            return "float32";
        case WordKind::float64:
            return "float64";
    }
    return "?";
}

BitPlane planeOf(std::string name, const Image<float>& image, std::string layerName) {
    return planeOfImage(WordKind::float32, std::move(name), image, std::move(layerName));
}
BitPlane planeOf(std::string name, const Image<uint32_t>& image, std::string layerName) {
    return planeOfImage(WordKind::uint32, std::move(name), image, std::move(layerName));
}
BitPlane planeOf(std::string name, const Image<uint8_t>& image, std::string layerName) {
    return planeOfImage(WordKind::uint32, std::move(name), image, std::move(layerName));
}
BitPlane planeOf(std::string name, std::span<const float> values, int width) {
    return planeOfList(WordKind::float32, std::move(name), values, width);
}
BitPlane planeOf(std::string name, std::span<const double> values, int width) {
    return planeOfList(WordKind::float64, std::move(name), values, width);
}

std::string wordText(WordKind kind, uint64_t word) {
    switch (kind) {
        case WordKind::uint32:
            return formatText("{:08x} ({})", word, word);
        case WordKind::float32:
            return formatText("{:08x} ({:.9g})", word, std::bit_cast<float>(static_cast<uint32_t>(word)));
        case WordKind::float64:
            return formatText("{:016x} ({:.17g})", word, std::bit_cast<double>(word));
    }
    return "?";
}

PlaneHashes hashPlane(const BitPlane& plane) {
    PlaneHashes hashes{plane.name, plane.kind, plane.width, plane.height, plane.layers, {}};
    for (int top = 0; top < plane.height; top += kHashTile)
        for (int left = 0; left < plane.width; left += kHashTile) {
            Xxh64 hash;
            for (int layer = 0; layer < plane.layers; layer++)
                for (int y = top; y < std::min(top + kHashTile, plane.height); y++)
                    for (int x = left; x < std::min(left + kHashTile, plane.width); x++) {
                        const uint64_t word = plane.at(x, y, layer);
                        if (plane.kind == WordKind::float64)
                            hash.addNumber(word);
                        else
                            hash.addNumber(static_cast<uint32_t>(word));
                    }
            hashes.tiles.push_back(hash.digest());
        }
    return hashes;
}

}  // namespace etalon
