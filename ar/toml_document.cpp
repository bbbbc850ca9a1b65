#define TOML_HEADER_ONLY 1
#define TOML_EXCEPTIONS 1
#include "ar/toml_document.h"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <fstream>
#include <iterator>

#include "numeric/check.h"

namespace etalon {

namespace {

int lineOf(const toml::source_region& source) { return std::max(1, static_cast<int>(source.begin.line)); }

// The tree without the library's types. The library limits the depth of nesting, so the recursion is bounded.
TomlValue converted(const toml::node& node) {
    TomlValue value;
    value.line = lineOf(node.source());
    if (const toml::table* table = node.as_table()) {
        value.kind = TomlKind::table;
        for (const auto& [key, member] : *table) {
            value.keys.emplace_back(key.str());
            value.keyLines.push_back(lineOf(key.source()));
            value.items.push_back(converted(member));
        }
    } else if (const toml::array* array = node.as_array()) {
        value.kind = TomlKind::array;
        for (const toml::node& item : *array) value.items.push_back(converted(item));
    } else if (const auto* text = node.as_string()) {
        value.kind = TomlKind::string;
        value.text = text->get();
    } else if (const auto* integer = node.as_integer()) {
        value.kind = TomlKind::integer;
        value.integer = integer->get();
        value.number = static_cast<double>(value.integer);
    } else if (const auto* number = node.as_floating_point()) {
        value.kind = TomlKind::number;
        value.number = number->get();
    } else if (const auto* boolean = node.as_boolean()) {
        value.kind = TomlKind::boolean;
        value.boolean = boolean->get();
    } else {
        value.kind = TomlKind::date;
    }
    return value;
}

std::string readText(const std::filesystem::path& path) {
    std::error_code error;
    const std::filesystem::file_status status = std::filesystem::status(path, error);
    if (!std::filesystem::exists(status))
        throw InputError(fmt::format("{}: no such scene file", path.string()));
    if (!std::filesystem::is_regular_file(status))
        throw InputError(fmt::format("{}: not a regular file", path.string()));
    const uintmax_t size = std::filesystem::file_size(path, error);
    if (!error && size > kMaxTomlBytes)
        throw InputError(
            fmt::format("{}: {} bytes; a scene file has at most {}", path.string(), size, kMaxTomlBytes));
    std::ifstream stream(path, std::ios::binary);
    std::string text{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
    if (!stream) throw InputError(fmt::format("{}: cannot be read", path.string()));
    return text;
}

// Line of the first character outside ASCII that stands neither in a comment nor in a one-line string; 0:
// none. toml++ 3.3 runs into undefined behaviour where it asks whether such a character is white space (found
// with UBSan), so that it must not see one. TOML itself allows them in multi-line strings too.
int lineOfStrayCharacter(std::string_view text) {
    constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";
    size_t i = text.starts_with(kByteOrderMark) ? kByteOrderMark.size() : 0;
    int line = 1;
    // What the current position is in: nothing (0), a comment (#) or a one-line string (its quote).
    char inside = 0;
    for (; i < text.size(); i++) {
        const char c = text[i];
        if (c == '\n') {
            line++;
            inside = 0;
        } else if (inside == 0) {
            if (static_cast<unsigned char>(c) >= 0x80) return line;
            // Three quotes open or close a multi-line string, whose text is then checked like everything
            // outside.
            const bool isTriple = (c == '"' || c == '\'') && text.substr(i, 3) == std::string(3, c);
            if (isTriple)
                i += 2;
            else if (c == '#' || c == '"' || c == '\'')
                inside = c;
        } else if (inside == '"' && c == '\\') {
            i++;
        } else if (inside != '#' && c == inside) {
            inside = 0;
        }
    }
    return 0;
}

}  // namespace

TomlValue readToml(const std::filesystem::path& path) {
    const std::string text = readText(path);
    try {
        return converted(toml::parse(text, path.string()));
    } catch (const toml::parse_error& error) {
        std::string reason(error.description());
        std::replace(reason.begin(), reason.end(), '\n', ' ');
        throw InputError(
            fmt::format("{}:{}: not valid TOML: {}", path.string(), lineOf(error.source()), reason));
    }
}

}  // namespace etalon
