#include "bitcheck/dump.h"

#include <string_view>

#include "numeric/text.h"

namespace etalon {
namespace {

constexpr std::string_view kEndOfText = "\n\n";

size_t wordBytes(WordKind kind) { return kind == WordKind::float64 ? 8 : 4; }

}  // namespace

BitReference referenceOf(const BitDump& dump, const std::string& reason) {
    BitReference reference{dump.rulesVersion, reason, {}};
    for (const CasePlanes& c : dump.cases) reference.cases.push_back(hashCase(c.name, c.planes));
    return reference;
}

std::vector<std::byte> encodeDump(const BitDump& dump) {
    const std::string text = referenceText(referenceOf(dump, "words of one machine")) + "\n";
    std::vector<std::byte> bytes;
    for (const char character : text) bytes.push_back(static_cast<std::byte>(character));
    for (const CasePlanes& c : dump.cases)
        for (const BitPlane& plane : c.planes)
            for (const uint64_t word : plane.words)
                for (size_t i = 0; i < wordBytes(plane.kind); i++)
                    bytes.push_back(static_cast<std::byte>(word >> (8 * i) & 255u));
    return bytes;
}

BitDump decodeDump(std::span<const std::byte> bytes, const std::string& file) {
    const std::string_view all(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    const size_t textEnd = std::min(all.find(kEndOfText), all.size());
    const BitReference reference = readReference(all.substr(0, textEnd + 1), file);
    bytes = bytes.subspan(std::min(textEnd + kEndOfText.size(), bytes.size()));
    BitDump dump{reference.rulesVersion, {}};
    for (const CaseHashes& c : reference.cases) {
        CasePlanes planes{c.name, {}};
        for (const PlaneHashes& shape : c.planes) {
            const size_t count = static_cast<size_t>(shape.width) * static_cast<size_t>(shape.height) *
                                 static_cast<size_t>(shape.layers);
            const size_t size = wordBytes(shape.kind);
            if (bytes.size() / size < count)
                throw InputError(formatText("{}: the words of {}, plane {} are missing: the file was cut",
                                            file, c.name, shape.name));
            BitPlane plane{shape.name, shape.kind, shape.width, shape.height, shape.layers, {}, {}};
            for (size_t w = 0; w < count; w++) {
                uint64_t word = 0;
                for (size_t i = 0; i < size; i++)
                    word |= std::to_integer<uint64_t>(bytes[w * size + i]) << (8 * i);
                plane.words.push_back(word);
            }
            bytes = bytes.subspan(count * size);
            if (hashPlane(plane).tiles != shape.tiles)
                throw InputError(
                    formatText("{}: the words of {}, plane {} are damaged", file, c.name, shape.name));
            planes.planes.push_back(std::move(plane));
        }
        dump.cases.push_back(std::move(planes));
    }
    if (!bytes.empty()) throw InputError(formatText("{}: {} bytes too many", file, bytes.size()));
    return dump;
}

}  // namespace etalon
