// What a scene file may hold, as data: the reader checks keys, types and ranges with it (scene/toml_reader.h), and
// docs/scene_format.md shows it.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace etalon {

// Numbers that a key may have: from lo (excluded when loOpen) to hi (excluded when hiOpen).
struct NumberRange {
    double lo, hi;
    bool loOpen = false, hiOpen = false;
};
// "(0, 1]".
std::string rangeText(const NumberRange& range);

enum class KeyType : uint8_t {
    number,
    integer,
    text,
    choice,  // one of some names
    boolean,
    triple,    // three numbers in the range
    pair,      // two
    factors,   // a number or three
    matrix,    // affine
    list,      // of texts
    table,     // these three are read as their own tables say
    tables,    // [[key]]
    material,  // [key.NAME]
};

// A key, or several that are alike.
struct SchemaKey {
    std::vector<std::string_view> names;
    KeyType type = KeyType::text;
    NumberRange range{0, 0};                // number, pair, triple; integers: both included
    std::vector<std::string_view> choices;  // of choice
    // As Markdown: the range where numbers and names do not tell it, what the key is where it is absent, and what it
    // means; and which kinds of the table's thing have it, if not all.
    std::string rangeText, absent, meaning;
    std::string kinds;
};

struct TableSchema {
    std::string_view name;  // "[camera]", as messages call it
    std::vector<SchemaKey> keys;

    // Null if the table has no such key.
    const SchemaKey* find(std::string_view key) const;
    std::vector<std::string_view> keyNames() const;
};

// The tables of a scene file, in the order of docs/scene_format.md.
enum class SceneTable : uint8_t {
    scene,
    camera,
    environment,
    material,
    mesh,
    transform,  // keys of a mesh and of its instances
    plane,
    light,
    shadowMap,          // of a light, and of those of the environment, with shadow = "map"
    planarShadow,       // with shadow = "planar"
    environmentShadow,  // of the environment alone
    output,
    render,
};
const TableSchema& schemaOf(SceneTable table);

// All of them but transform, which mesh has, as Markdown, each between a line <!-- schema: NAME --> and a line <!-- end -->.
std::string schemaText();

}  // namespace etalon
