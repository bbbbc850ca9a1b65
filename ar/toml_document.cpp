#include "ar/toml_document.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <string_view>

#include "numeric/check.h"

// toml++ 3.3 meets some bad input (a closing bracket in place of a value) with an assertion only, which ends
// the program or, under NDEBUG, tells clang to assume that it cannot happen. Here its assertions throw,
// always.
namespace etalon {
namespace {
struct ParserAssertion {};
[[noreturn]] void failAssertion() { throw ParserAssertion(); }
}  // namespace
}  // namespace etalon
#undef NDEBUG
#define TOML_ASSERT(condition) ((condition) ? void() : ::etalon::failAssertion())
#define TOML_HEADER_ONLY 1
#define TOML_EXCEPTIONS 1
#include <toml++/toml.h>

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
// with UBSan), so it must not see one. TOML itself allows them in multi-line strings too.
int lineOfStrayCharacter(std::string_view text) {
    constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";
    if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
    std::string_view inside;  // what opened the comment or string that we are in; empty: neither
    int line = 1;
    for (size_t i = 0; i < text.size(); i++) {
        const char c = text[i];
        const bool isMultiLine = inside.size() == 3;
        if (c == '\n') {
            line++;
            if (!isMultiLine) inside = {};
        } else if (static_cast<unsigned char>(c) >= 0x80) {
            if (inside.empty() || isMultiLine) return line;
        } else if (inside.empty()) {
            for (const std::string_view opening : {"\"\"\"", "'''", "\"", "'", "#"})
                if (inside.empty() && text.substr(i).starts_with(opening)) inside = opening;
            i += inside.empty() ? 0 : inside.size() - 1;
        } else if (c == '\\' && inside[0] == '"') {
            // The escaped character does not close the string; escapes are ASCII.
            if (i + 1 < text.size() && static_cast<unsigned char>(text[i + 1]) >= 0x80) return line;
            if (i + 1 < text.size() && text[i + 1] != '\n') i++;
        } else if (inside != "#" && text.substr(i).starts_with(inside)) {
            i += inside.size() - 1;
            // Up to two quotes more belong to the text of a multi-line string.
            for (int extra = 0; isMultiLine && extra < 2 && i + 1 < text.size() && text[i + 1] == c; extra++)
                i++;
            inside = {};
        }
    }
    return 0;
}

bool meetsAssertion(std::string_view text) {
    try {
        static_cast<void>(toml::parse(text));
    } catch (const ParserAssertion&) {
        return true;
    } catch (const toml::parse_error&) {
    }
    return false;
}

// The line on which the parser meets an assertion, for a text in which it does: the smallest number of lines
// that are enough, by bisection.
int lineOfAssertion(std::string_view text) {
    std::vector<size_t> lineEnds;
    for (size_t i = 0; i < text.size(); i++)
        if (text[i] == '\n') lineEnds.push_back(i + 1);
    const auto first = std::partition_point(lineEnds.begin(), lineEnds.end(),
                                            [&](size_t end) { return !meetsAssertion(text.substr(0, end)); });
    return static_cast<int>(first - lineEnds.begin()) + 1;
}

}  // namespace

TomlValue readToml(const std::filesystem::path& path) {
    const std::string text = readText(path);
    if (const int line = lineOfStrayCharacter(text); line > 0)
        throw InputError(
            fmt::format("{}:{}: not valid TOML: characters outside ASCII may stand only in comments "
                        "and in one-line strings",
                        path.string(), line));
    try {
        return converted(toml::parse(text, path.string()));
    } catch (const toml::parse_error& error) {
        std::string reason(error.description());
        std::replace(reason.begin(), reason.end(), '\n', ' ');
        throw InputError(
            fmt::format("{}:{}: not valid TOML: {}", path.string(), lineOf(error.source()), reason));
    } catch (const ParserAssertion&) {
        throw InputError(fmt::format("{}:{}: not valid TOML: a value is missing or misplaced", path.string(),
                                     lineOfAssertion(text)));
    }
}

}  // namespace etalon
