#include "files/ply_check.h"

#include <charconv>
#include <cstdint>
#include <optional>
#include <vector>

#include "numeric/text.h"

namespace etalon {

namespace {

struct Property {
    std::string_view name;
    size_t size = 0;       // bytes of a value (of a list: of an item)
    size_t countSize = 0;  // bytes of a list's length; 0: not a list
};
struct Element {
    std::string_view name;
    uint64_t count = 0;
    std::vector<Property> properties;
};
enum class Encoding : uint8_t { none, ascii, littleEndian, bigEndian };
struct Header {
    Encoding encoding = Encoding::none;
    std::vector<Element> elements;
    size_t bodyStart = 0;
};

bool isBlank(char c) { return c == ' ' || c == '\t' || c == '\r'; }

// Takes the next word off the front of `rest`; "" at the end.
std::string_view takeWord(std::string_view& rest) {
    size_t begin = 0;
    while (begin < rest.size() && isBlank(rest[begin])) begin++;
    size_t end = begin;
    while (end < rest.size() && !isBlank(rest[end])) end++;
    const std::string_view word = rest.substr(begin, end - begin);
    rest.remove_prefix(end);
    return word;
}

// Takes the next line off the front of text at `position`; nothing when the text has ended.
std::optional<std::string_view> takeLine(std::string_view text, size_t& position) {
    if (position >= text.size()) return std::nullopt;
    const size_t end = text.find('\n', position);
    const std::string_view line = text.substr(position, end - position);
    position = end == std::string_view::npos ? text.size() : end + 1;
    return line;
}

std::optional<uint64_t> parseCount(std::string_view word) {
    uint64_t count = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), count);
    if (error != std::errc() || end != word.data() + word.size()) return std::nullopt;
    return count;
}

// Bytes of a PLY type; 0: no such type.
size_t typeSize(std::string_view type) {
    for (const char* name : {"char", "uchar", "int8", "uint8"})
        if (type == name) return 1;
    for (const char* name : {"short", "ushort", "int16", "uint16"})
        if (type == name) return 2;
    for (const char* name : {"int", "uint", "int32", "uint32", "float", "float32"})
        if (type == name) return 4;
    for (const char* name : {"double", "float64"})
        if (type == name) return 8;
    return 0;
}

std::string parseProperty(std::string_view rest, Element& element) {
    Property property;
    std::string_view type = takeWord(rest);
    if (type == "list") {
        const std::string_view countType = takeWord(rest);
        property.countSize = typeSize(countType);
        if (property.countSize == 0 || property.countSize > 4 || countType.starts_with("float"))
            return "a list length is not of an integer type";
        type = takeWord(rest);
    }
    property.size = typeSize(type);
    property.name = takeWord(rest);
    if (property.size == 0 || property.name.empty()) return "a property line is not understood";
    element.properties.push_back(property);
    return "";
}

std::string parseHeader(std::string_view text, Header& header) {
    size_t position = 0;
    const auto first = takeLine(text, position);
    std::string_view magic = first.value_or("");
    if (takeWord(magic) != "ply") return "does not begin with 'ply'";
    while (const auto line = takeLine(text, position)) {
        std::string_view rest = *line;
        const std::string_view keyword = takeWord(rest);
        if (keyword == "comment" || keyword == "obj_info" || keyword.empty()) continue;
        if (keyword == "end_header") {
            header.bodyStart = position;
            return "";
        }
        if (keyword == "format") {
            const std::string_view format = takeWord(rest);
            header.encoding = format == "ascii"                  ? Encoding::ascii
                              : format == "binary_little_endian" ? Encoding::littleEndian
                              : format == "binary_big_endian"    ? Encoding::bigEndian
                                                                 : Encoding::none;
            if (takeWord(rest) != "1.0") return "is not of PLY version 1.0";
        } else if (keyword == "element") {
            const std::string_view name = takeWord(rest);
            const auto count = parseCount(takeWord(rest));
            if (name.empty() || !count) return "an element line is not understood";
            header.elements.push_back({name, *count, {}});
        } else if (keyword == "property" && !header.elements.empty()) {
            const std::string defect = parseProperty(rest, header.elements.back());
            if (!defect.empty()) return defect;
        } else {
            return "a header line is not understood";
        }
    }
    return "the header is cut off (no 'end_header')";
}

std::string cutOff(const Element& element, uint64_t index) {
    return formatText("is cut off: {} '{}' elements announced, the data end in number {}", element.count,
                      element.name, index + 1);
}

// The mesh library ends the program for some faces of fewer corners.
constexpr uint64_t kFewestCorners = 3;
bool isTooShortFace(const Element& element, const Property& property, uint64_t length) {
    return element.name == "face" && property.name.starts_with("vertex_ind") && length < kFewestCorners;
}
std::string tooShortFace(uint64_t index, uint64_t length) {
    return formatText("face {} has {} corners, not at least {}", index, length, kFewestCorners);
}

// Length of a list in a binary file; signed lengths below zero come out huge and fail the size check.
uint64_t readCount(std::string_view bytes, Encoding encoding) {
    uint64_t value = 0;
    for (size_t i = 0; i < bytes.size(); i++) {
        const size_t from = encoding == Encoding::bigEndian ? i : bytes.size() - 1 - i;
        value = value << 8 | static_cast<unsigned char>(bytes[from]);
    }
    return value;
}

std::string binaryDefect(std::string_view body, const Header& header) {
    size_t position = 0;
    for (const Element& element : header.elements) {
        if (element.properties.empty()) continue;
        for (uint64_t i = 0; i < element.count; i++) {
            for (const Property& property : element.properties) {
                uint64_t count = 1;
                if (property.countSize > 0) {
                    if (body.size() - position < property.countSize) return cutOff(element, i);
                    count = readCount(body.substr(position, property.countSize), header.encoding);
                    position += property.countSize;
                    if (isTooShortFace(element, property, count)) return tooShortFace(i, count);
                }
                if (count > (body.size() - position) / property.size) return cutOff(element, i);
                position += count * property.size;
            }
        }
    }
    return "";
}

std::string asciiDefect(std::string_view body, const Header& header) {
    size_t position = 0;
    for (const Element& element : header.elements) {
        for (uint64_t i = 0; i < element.count; i++) {
            std::string_view rest, word;
            // Blank lines do not count.
            while (word.empty()) {
                const auto line = takeLine(body, position);
                if (!line) return cutOff(element, i);
                rest = *line;
                word = takeWord(rest);
            }
            for (const Property& property : element.properties) {
                uint64_t count = 1;
                if (property.countSize > 0) {
                    const auto length = parseCount(word);
                    if (!length) return formatText("'{}' element {} has no list length", element.name, i + 1);
                    word = takeWord(rest);
                    count = *length;
                    if (isTooShortFace(element, property, count)) return tooShortFace(i, count);
                }
                for (uint64_t k = 0; k < count; k++) {
                    if (word.empty()) return cutOff(element, i);
                    word = takeWord(rest);
                }
            }
        }
    }
    return "";
}

}  // namespace

std::string plyDefect(std::string_view text) {
    Header header;
    const std::string defect = parseHeader(text, header);
    if (!defect.empty()) return defect;
    if (header.encoding == Encoding::none) return "has no format line that is understood";
    int coordinates = 0;
    for (const Element& element : header.elements)
        for (const Property& property : element.properties)
            if (element.name == "vertex" && property.countSize == 0 &&
                (property.name == "x" || property.name == "y" || property.name == "z"))
                coordinates++;
    if (coordinates != 3) return "has no vertex element with the properties x, y, z";
    const std::string_view body = text.substr(header.bodyStart);
    return header.encoding == Encoding::ascii ? asciiDefect(body, header) : binaryDefect(body, header);
}

}  // namespace etalon
