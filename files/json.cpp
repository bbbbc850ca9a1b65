#include "files/json.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "numeric/check.h"

namespace etalon {

struct JsonConversion {
    static nlohmann::ordered_json convert(const Json& json) {
        switch (json.kind_) {
            case Json::Kind::null:
                return nullptr;
            case Json::Kind::boolean:
                return json.boolean_;
            case Json::Kind::signedInteger:
                return json.signed_;
            case Json::Kind::unsignedInteger:
                return json.unsigned_;
            case Json::Kind::real:
                return json.real_;
            case Json::Kind::string:
                return json.string_;
            case Json::Kind::list: {
                nlohmann::ordered_json list = nlohmann::ordered_json::array();
                for (const Json& value : json.values_) list.push_back(convert(value));
                return list;
            }
            case Json::Kind::object: {
                nlohmann::ordered_json object = nlohmann::ordered_json::object();
                for (size_t i = 0; i < json.keys_.size(); i++)
                    object[json.keys_[i]] = convert(json.values_[i]);
                return object;
            }
        }
        return nullptr;
    }
};

Json::Json(std::string_view value) : kind_(Kind::string), unsigned_(0), string_(value) {}

Json::Json(std::initializer_list<Member> members) : kind_(Kind::object), unsigned_(0) {
    for (const Member& member : members) (*this)[member.key] = member.value;
}

Json Json::list(std::initializer_list<Json> values) {
    Json json;
    json.kind_ = Kind::list;
    json.values_ = values;
    return json;
}

Json Json::numberOf(double value) {
    if (value != value) return "nan";
    if (value - value != 0) return value > 0 ? "inf" : "-inf";
    return value;
}

Json::Json(const Json&) = default;
Json::Json(Json&&) noexcept = default;
Json& Json::operator=(const Json&) = default;
Json& Json::operator=(Json&&) noexcept = default;
Json::~Json() = default;

Json& Json::operator[](std::string_view key) {
    if (kind_ == Kind::null) kind_ = Kind::object;
    ETALON_CHECK(kind_ == Kind::object, "a key \"{}\" of a value that is no object", key);
    const auto found = std::ranges::find(keys_, key);
    if (found != keys_.end()) return values_[static_cast<size_t>(found - keys_.begin())];
    keys_.emplace_back(key);
    return values_.emplace_back();
}

void Json::append(Json value) {
    ETALON_CHECK(kind_ == Kind::list, "appended to a value that is no list");
    values_.push_back(std::move(value));
}

std::string jsonText(const Json& json) {
    return JsonConversion::convert(json).dump(2, ' ', false,
                                              nlohmann::ordered_json::error_handler_t::replace) +
           "\n";
}

}  // namespace etalon
