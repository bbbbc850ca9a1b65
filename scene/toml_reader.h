// Typed, checked access to the keys of one TOML table. Every method throws InputError "file:line: reason"
// that names the key and what it may be.
#pragma once

#include <array>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <initializer_list>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "numeric/names.h"
#include "scene/schema.h"
#include "scene/toml_document.h"

namespace etalon {

// "did you mean 'x'?" with a space in front when one of the names is near `given` (by edit distance), else
// "".
std::string nearestHint(std::string_view given, std::span<const std::string_view> names);

// The names with commas between them.
std::string joined(std::span<const std::string_view> names);

// The text with control characters replaced by '?' and cut to 200 characters, so that a message stays one
// line.
std::string printable(std::string_view text);

class TableReader {
  public:
    // file and value are kept by reference and must outlive the reader; title is what messages call the
    // table, such as "[camera]". Rejects a value that is not a table, and keys that are not known.
    TableReader(const std::string& file, const TomlValue& value, std::string title,
                const std::vector<std::string_view>& known);
    // Of a scene file: knows the keys of the tables of its schema, and for each the type and range of the first
    // table that has it. Without a title: the name of the first.
    TableReader(const std::string& file, const TomlValue& value, std::initializer_list<SceneTable> tables,
                std::string title = "");

    // The same with the types and ranges of one table.
    TableReader in(SceneTable table) const;

    int line() const { return table_->line; }
    const std::string& file() const { return *file_; }
    const std::string& title() const { return title_; }

    bool has(std::string_view key) const { return find(key) != nullptr; }
    // Line of a key, or of the table when it is absent.
    int lineOf(std::string_view key) const;

    // Required keys. Without a range or names: those of the schema.
    double number(std::string_view key) const;
    int integer(std::string_view key) const;
    std::string choice(std::string_view key) const;
    glm::dvec3 triple(std::string_view key) const;
    glm::dvec2 pair(std::string_view key) const;
    double number(std::string_view key, NumberRange range) const;
    int64_t integer(std::string_view key, int64_t lo, int64_t hi) const;
    std::string text(std::string_view key) const;
    bool boolean(std::string_view key) const;
    // One of `names`.
    std::string choice(std::string_view key, std::span<const std::string_view> names) const;
    // The member of an enumeration that has the name (numeric/names.h).
    template <Named E>
    E member(std::string_view key) const {
        return *memberOf<E>(choice(key, kNames<E>));
    }
    // The same; `absent` where the key is not there.
    template <Named E>
    E member(std::string_view key, E absent) const {
        return has(key) ? member<E>(key) : absent;
    }
    // Three numbers, each in the range.
    glm::dvec3 triple(std::string_view key, NumberRange range) const;
    std::vector<double> numbers(std::string_view key, size_t count, NumberRange range) const;
    // Three numbers, each in +-kMaxSceneNumber, of length at least kMinDirectionLength.
    glm::dvec3 direction(std::string_view key) const;
    // Four rows of four numbers, the last one 0 0 0 1, the upper 3x3 part not singular.
    glm::dmat4 matrix(std::string_view key) const;
    // A path to an existing regular file, relative to the folder of the scene file.
    std::filesystem::path existingFile(std::string_view key) const;
    const TomlValue& value(std::string_view key) const;
    // The tables of an array of tables; empty when the key is absent.
    std::span<const TomlValue> tables(std::string_view key) const;

    // InputError when `key` is present; reason says why it must not be.
    void forbid(std::string_view key, std::string_view reason) const;
    [[noreturn]] void fail(int line, const std::string& reason) const;
    [[noreturn]] void failKey(std::string_view key, const std::string& reason) const;

  private:
    const TomlValue* find(std::string_view key) const;
    const SchemaKey& schema(std::string_view key, KeyType type) const;
    double checkedNumber(const TomlValue& value, std::string_view key, NumberRange range) const;

    const std::string* file_;
    const TomlValue* table_;
    std::string title_;
    std::vector<const TableSchema*> schema_;
};

}  // namespace etalon
