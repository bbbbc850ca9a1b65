#include <algorithm>
#include <fstream>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <string_view>

#include "golden/golden.h"
#include "numeric/text.h"

namespace etalon {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::string_view kHexDigits = "0123456789abcdef";
constexpr std::string_view kNameCharacters =
    "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-_";

// A value of the manifest and where it stands, for messages.
struct Node {
    const Json& json;
    std::string place;  // "golden/manifest.json: cases[2].accepted"

    [[noreturn]] void fail(const std::string& reason) const { throw InputError(place + ": " + reason); }
    const Json* find(const char* key) const {
        const auto found = json.find(key);
        return found == json.end() ? nullptr : &*found;
    }
    Node child(const char* key) const {
        const Json* found = find(key);
        if (!found) fail(formatText("\"{}\" is missing", key));
        return {*found, formatText("{}.{}", place, key)};
    }
    void checkKeys(std::initializer_list<std::string_view> known) const {
        if (!json.is_object()) fail("must be an object");
        for (const auto& item : json.items())
            if (std::ranges::find(known, item.key()) == known.end())
                fail(formatText("unknown key {}", Json(item.key()).dump()));
    }
    std::string text() const {
        if (!json.is_string() || json.get_ref<const std::string&>().empty())
            fail("must be a text that is not empty");
        return json.get<std::string>();
    }
    int size() const {
        if (!json.is_number_integer() || json < 1 || json > kMaxImageSize)
            fail(formatText("must be an integer from 1 to {}", kMaxImageSize));
        return json.get<int>();
    }
    template <class Read>
    auto list(Read read) const {
        if (!json.is_array()) fail("must be a list");
        std::vector<decltype(read(*this))> values;
        for (const Json& element : json)
            values.push_back(read(Node{element, formatText("{}[{}]", place, values.size())}));
        return values;
    }
};

std::string readHash(const Node& node) {
    const std::string hash = node.text();
    if (hash.size() != 16 || hash.find_first_not_of(kHexDigits) != std::string::npos)
        node.fail("must be 16 hexadecimal digits");
    return hash;
}

GoldenRecord readRecord(const Node& node) {
    node.checkKeys({"reason", "rules", "inputs", "groups"});
    GoldenRecord record{node.child("reason").text(), node.child("rules").text(), {}, {}};
    record.inputs = node.child("inputs").list([](const Node& input) {
        input.checkKeys({"path", "hash"});
        return GoldenInput{input.child("path").text(), readHash(input.child("hash"))};
    });
    record.groups = node.child("groups").list([](const Node& group) {
        group.checkKeys({"name", "width", "height", "hash"});
        return GoldenGroup{group.child("name").text(), group.child("width").size(),
                           group.child("height").size(), readHash(group.child("hash"))};
    });
    if (record.groups.empty()) node.fail("\"groups\" is empty: nothing would be checked");
    return record;
}

GoldenCase readCase(const Node& node) {
    node.checkKeys({"name", "scene", "profile", "outputs", "inputs", "accepted"});
    const auto text = [](const Node& element) { return element.text(); };
    GoldenCase c;
    c.name = node.child("name").text();
    if (c.name.find_first_not_of(kNameCharacters) != std::string::npos)
        node.child("name").fail("may hold letters, digits, - and _ only");
    c.scene = node.child("scene").text();
    c.profile = node.child("profile").text();
    c.outputs = node.child("outputs").list(text);
    if (c.outputs.empty()) node.child("outputs").fail("is empty");
    if (node.find("inputs")) c.inputs = node.child("inputs").list(text);
    if (node.find("accepted")) c.accepted = readRecord(node.child("accepted"));
    return c;
}

Json jsonOf(const GoldenRecord& record) {
    Json inputs = Json::array(), groups = Json::array();
    for (const GoldenInput& input : record.inputs)
        inputs.push_back({{"path", input.path}, {"hash", input.hash}});
    for (const GoldenGroup& group : record.groups)
        groups.push_back(
            {{"name", group.name}, {"width", group.width}, {"height", group.height}, {"hash", group.hash}});
    return {
        {"reason", record.reason}, {"rules", record.rulesVersion}, {"inputs", inputs}, {"groups", groups}};
}

}  // namespace

GoldenManifest readManifest(const std::filesystem::path& file) {
    std::ifstream stream(file);
    if (!stream || std::filesystem::is_directory(file))
        throw InputError(formatText("{}: no such file, or it cannot be read", file.string()));
    Json json;
    try {
        json = Json::parse(stream);
    } catch (const Json::exception& error) {
        // A syntax error, or a number beyond the range of double. what() begins with a number of the library
        // in brackets; for a syntax error the rest names line and column.
        const std::string_view what = error.what();
        throw InputError(
            formatText("{}: not valid JSON: {}", file.string(), what.substr(what.find(']') + 2)));
    }
    const Node root{json, file.string()};
    root.checkKeys({"cases"});
    GoldenManifest manifest{file, Node{root.child("cases").json, file.string() + ": cases"}.list(readCase)};
    for (size_t i = 0; i < manifest.cases.size(); ++i)
        for (size_t j = 0; j < i; ++j)
            if (manifest.cases[i].name == manifest.cases[j].name)
                root.fail(formatText("the case \"{}\" stands there twice", manifest.cases[i].name));
    return manifest;
}

std::string manifestText(const GoldenManifest& manifest) {
    Json cases = Json::array();
    for (const GoldenCase& c : manifest.cases) {
        Json json = {{"name", c.name}, {"scene", c.scene}, {"profile", c.profile}, {"outputs", c.outputs}};
        if (!c.inputs.empty()) json["inputs"] = c.inputs;
        if (c.accepted) json["accepted"] = jsonOf(*c.accepted);
        cases.push_back(json);
    }
    // A reason from the command line need not be valid UTF-8.
    return Json{{"cases", cases}}.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace etalon
