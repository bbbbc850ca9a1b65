#include "scene/toml_reader.h"

#include <algorithm>

#include "numeric/check.h"
#include "numeric/text.h"
#include "numeric/transform.h"
#include "scene/scene.h"

namespace etalon {

namespace {

// Below this value of conditionOf() a transform counts as singular: its columns lie in a plane to within the
// rounding of numbers written with nine digits.
constexpr double kSingularCondition = 1e-9;

const char* kindName(TomlKind kind) {
    switch (kind) {
        case TomlKind::table:
            return "a table";
        case TomlKind::array:
            return "an array";
        case TomlKind::string:
            return "a string";
        case TomlKind::integer:
            return "an integer";
        case TomlKind::number:
            return "a number";
        case TomlKind::boolean:
            return "a boolean";
        case TomlKind::date:
            return "a date or time";
    }
    return "a value";
}

// Levenshtein distance: insertions, deletions and replacements that lead from a to b.
size_t editDistance(std::string_view a, std::string_view b) {
    std::vector<size_t> row(b.size() + 1);
    for (size_t j = 0; j <= b.size(); j++) row[j] = j;
    for (size_t i = 1; i <= a.size(); i++) {
        size_t diagonal = row[0];
        row[0] = i;
        for (size_t j = 1; j <= b.size(); j++) {
            const size_t above = row[j];
            row[j] = std::min({above + 1, row[j - 1] + 1, diagonal + (a[i - 1] == b[j - 1] ? 0 : 1)});
            diagonal = above;
        }
    }
    return row[b.size()];
}

}  // namespace

std::string joined(std::span<const std::string_view> names) { return joinText(names, ", "); }

std::string printable(std::string_view text) {
    constexpr size_t kMaxShown = 200;
    std::string shown;
    for (const char c : text.substr(0, kMaxShown)) shown += static_cast<unsigned char>(c) < 0x20 ? '?' : c;
    return text.size() > kMaxShown ? shown + "..." : shown;
}

std::string nearestHint(std::string_view given, std::span<const std::string_view> names) {
    // A hint helps when at most half of the letters differ, or when the given name is a part of the right
    // one; long keys are not worth the quadratic search.
    constexpr size_t kMaxSearched = 64, kMinPart = 3;
    if (given.size() > kMaxSearched) return "";
    size_t best = std::max<size_t>(1, given.size() / 2) + 1;
    std::string_view nearest;
    for (const std::string_view name : names) {
        const bool isPart = given.size() >= kMinPart && name.find(given) != std::string_view::npos;
        const size_t distance = isPart ? 1 : editDistance(given, name);
        if (distance < best) {
            best = distance;
            nearest = name;
        }
    }
    return nearest.empty() ? "" : formatText(" (did you mean '{}'?)", nearest);
}

TableReader::TableReader(const std::string& file, const TomlValue& value, std::string title,
                         const std::vector<std::string_view>& known)
    : file_(&file), table_(&value), title_(std::move(title)) {
    if (value.kind != TomlKind::table)
        fail(value.line, formatText("{} must be a table, not {}", title_, kindName(value.kind)));
    // The first unknown key in the file's order is the one to report.
    int firstLine = 0;
    std::string_view firstKey;
    for (size_t i = 0; i < value.keys.size(); i++) {
        const std::string& key = value.keys[i];
        if (std::find(known.begin(), known.end(), key) != known.end()) continue;
        if (firstLine != 0 && value.keyLines[i] >= firstLine) continue;
        firstLine = value.keyLines[i];
        firstKey = key;
    }
    if (firstLine == 0) return;
    fail(firstLine, formatText("unknown key '{}' in {}{}; known keys: {}", printable(firstKey), title_,
                               nearestHint(firstKey, known), joined(known)));
}

namespace {

std::vector<std::string_view> keyNamesOf(std::initializer_list<SceneTable> tables) {
    std::vector<std::string_view> names;
    for (const SceneTable table : tables)
        for (const std::string_view name : schemaOf(table).keyNames())
            if (std::ranges::find(names, name) == names.end()) names.push_back(name);
    return names;
}

}  // namespace

TableReader::TableReader(const std::string& file, const TomlValue& value,
                         std::initializer_list<SceneTable> tables, std::string title)
    : TableReader(file, value, title.empty() ? std::string(schemaOf(*tables.begin()).name) : std::move(title),
                  keyNamesOf(tables)) {
    for (const SceneTable table : tables) schema_.push_back(&schemaOf(table));
}

TableReader TableReader::in(SceneTable table) const {
    TableReader reader = *this;
    reader.schema_ = {&schemaOf(table)};
    return reader;
}

const SchemaKey& TableReader::schema(std::string_view key, KeyType type) const {
    const SchemaKey* found = nullptr;
    for (size_t i = 0; i < schema_.size() && !found; i++) found = schema_[i]->find(key);
    ETALON_CHECK(found && found->type == type, "the schema of {} has no such key {}", title_, key);
    return *found;
}

void TableReader::fail(int line, const std::string& reason) const {
    throw InputError(formatText("{}:{}: {}", *file_, line, reason));
}

void TableReader::failKey(std::string_view key, const std::string& reason) const {
    fail(lineOf(key), formatText("'{}' in {} {}", key, title_, reason));
}

const TomlValue* TableReader::find(std::string_view key) const {
    for (size_t i = 0; i < table_->keys.size(); i++)
        if (table_->keys[i] == key) return &table_->items[i];
    return nullptr;
}

int TableReader::lineOf(std::string_view key) const {
    for (size_t i = 0; i < table_->keys.size(); i++)
        if (table_->keys[i] == key) return table_->keyLines[i];
    return table_->line;
}

const TomlValue& TableReader::value(std::string_view key) const {
    const TomlValue* found = find(key);
    if (found == nullptr) fail(table_->line, formatText("missing key '{}' in {}", key, title_));
    return *found;
}

double TableReader::checkedNumber(const TomlValue& v, std::string_view key, NumberRange r) const {
    if (v.kind != TomlKind::number && v.kind != TomlKind::integer)
        fail(v.line, formatText("'{}' in {} must be a number in {}, not {}", key, title_, rangeText(r),
                                kindName(v.kind)));
    // Written so that NaN fails.
    const bool inside =
        (r.loOpen ? v.number > r.lo : v.number >= r.lo) && (r.hiOpen ? v.number < r.hi : v.number <= r.hi);
    if (!inside)
        fail(v.line,
             formatText("'{}' in {} must be a number in {}, not {}", key, title_, rangeText(r), v.number));
    return v.number + 0.0;  // -0 becomes +0
}

double TableReader::number(std::string_view key) const {
    return number(key, schema(key, KeyType::number).range);
}
int TableReader::integer(std::string_view key) const {
    const NumberRange& range = schema(key, KeyType::integer).range;
    return static_cast<int>(integer(key, static_cast<int64_t>(range.lo), static_cast<int64_t>(range.hi)));
}
std::string TableReader::choice(std::string_view key) const {
    return choice(key, schema(key, KeyType::choice).choices);
}
glm::dvec3 TableReader::triple(std::string_view key) const {
    return triple(key, schema(key, KeyType::triple).range);
}
glm::dvec2 TableReader::pair(std::string_view key) const {
    const std::vector<double> v = numbers(key, 2, schema(key, KeyType::pair).range);
    return {v[0], v[1]};
}

double TableReader::number(std::string_view key, NumberRange range) const {
    return checkedNumber(value(key), key, range);
}

int64_t TableReader::integer(std::string_view key, int64_t lo, int64_t hi) const {
    const TomlValue& v = value(key);
    if (v.kind != TomlKind::integer)
        failKey(key, formatText("must be an integer in [{}, {}], not {}", lo, hi, kindName(v.kind)));
    if (v.integer < lo || v.integer > hi)
        failKey(key, formatText("must be an integer in [{}, {}], not {}", lo, hi, v.integer));
    return v.integer;
}

std::string TableReader::text(std::string_view key) const {
    const TomlValue& v = value(key);
    if (v.kind != TomlKind::string) failKey(key, formatText("must be a string, not {}", kindName(v.kind)));
    if (v.text.empty() || v.text.find('\0') != std::string::npos)
        failKey(key, "must be a string that is not empty and has no zero character");
    return v.text;
}

bool TableReader::boolean(std::string_view key) const {
    const TomlValue& v = value(key);
    if (v.kind != TomlKind::boolean)
        failKey(key, formatText("must be true or false, not {}", kindName(v.kind)));
    return v.boolean;
}

std::string TableReader::choice(std::string_view key, std::span<const std::string_view> names) const {
    const std::string given = text(key);
    if (std::find(names.begin(), names.end(), given) == names.end())
        failKey(key, formatText("must be one of {}, not '{}'{}", joined(names), printable(given),
                                nearestHint(given, names)));
    return given;
}

std::vector<double> TableReader::numbers(std::string_view key, size_t count, NumberRange range) const {
    const TomlValue& v = value(key);
    if (v.kind != TomlKind::array || v.items.size() != count)
        failKey(key, formatText("must be an array of {} numbers in {}, not {}", count, rangeText(range),
                                v.kind == TomlKind::array ? formatText("{} of them", v.items.size())
                                                          : std::string(kindName(v.kind))));
    std::vector<double> result;
    for (const TomlValue& item : v.items) result.push_back(checkedNumber(item, key, range));
    return result;
}

glm::dvec3 TableReader::triple(std::string_view key, NumberRange range) const {
    const std::vector<double> v = numbers(key, 3, range);
    return {v[0], v[1], v[2]};
}

glm::dvec3 TableReader::direction(std::string_view key) const {
    const glm::dvec3 v = triple(key, {-kMaxSceneNumber, kMaxSceneNumber});
    if (lengthOf(v) < kMinDirectionLength)
        failKey(key, formatText("must not be zero (length at least {})", kMinDirectionLength));
    return v;
}

glm::dmat4 TableReader::matrix(std::string_view key) const {
    const TomlValue& v = value(key);
    if (v.kind != TomlKind::array || v.items.size() != 4) failKey(key, "must be 4 rows of 4 numbers");
    glm::dmat4 m{1.0};
    for (int row = 0; row < 4; row++) {
        const TomlValue& items = v.items[static_cast<size_t>(row)];
        if (items.kind != TomlKind::array || items.items.size() != 4)
            fail(items.line, formatText("'{}' in {} must be 4 rows of 4 numbers", key, title_));
        for (int c = 0; c < 4; c++)
            m[c][row] =
                checkedNumber(items.items[static_cast<size_t>(c)], key, {-kMaxSceneNumber, kMaxSceneNumber});
    }
    if (m[0][3] != 0 || m[1][3] != 0 || m[2][3] != 0 || m[3][3] != 1)
        failKey(key, "must have the last row 0 0 0 1 (rows of a matrix that transforms columns)");
    if (!(conditionOf(m) >= kSingularCondition)) failKey(key, "is singular: its columns lie in a plane");
    return m;
}

std::filesystem::path TableReader::existingFile(std::string_view key) const {
    const std::filesystem::path path = std::filesystem::path(*file_).parent_path() / text(key);
    std::error_code error;
    const std::filesystem::file_status status = std::filesystem::status(path, error);
    if (!std::filesystem::exists(status))
        failKey(key, formatText("names a file that does not exist: {}", printable(path.string())));
    if (!std::filesystem::is_regular_file(status))
        failKey(key, formatText("does not name a regular file: {}", printable(path.string())));
    return path;
}

std::span<const TomlValue> TableReader::tables(std::string_view key) const {
    const TomlValue* v = find(key);
    if (v == nullptr) return {};
    const bool good =
        v->kind == TomlKind::array &&
        std::all_of(v->items.begin(), v->items.end(), [](auto& i) { return i.kind == TomlKind::table; });
    if (!good) failKey(key, formatText("must be an array of tables: write [[{}]]", key));
    return v->items;
}

void TableReader::forbid(std::string_view key, std::string_view reason) const {
    if (has(key)) failKey(key, std::string(reason));
}

}  // namespace etalon
