// A TOML file as a plain tree with line numbers. The TOML library stays behind this header.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace etalon {

enum class TomlKind : uint8_t { table, array, string, integer, number, boolean, date };

// One value. line: where it (for a table: its header or first brace) stands in the file, from 1.
struct TomlValue {
    TomlKind kind = TomlKind::table;
    int line = 1;
    std::string text;     // string
    int64_t integer = 0;  // integer
    double number = 0;    // number (may be infinite or NaN) and integer, rounded once
    bool boolean = false;
    std::vector<TomlValue> items;   // array; table: the values, sorted by key
    std::vector<std::string> keys;  // table: keys[i] belongs to items[i]
    std::vector<int> keyLines;      // table: where keys[i] stands
};

// The largest file that is read, in bytes.
inline constexpr uintmax_t kMaxTomlBytes = 64u << 20;

// Reads a TOML 1.0 file; messages call it `kind`. InputError when it is missing, not a regular file, too large or not
// valid TOML; the message has the line of the error.
TomlValue readToml(const std::filesystem::path& path, std::string_view kind = "scene file");

}  // namespace etalon
