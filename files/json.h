// JSON values to write. The library that turns them into text is compiled in json.cpp alone; what stands here
// costs its users no compile time.
#pragma once

#include <concepts>
#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

namespace etalon {

// A value: null, a boolean, a number, a string, a list, or an object whose keys are in the order of their
// arrival. An object is written in braces, {{"key", value}, {"key", value}}, each key once.
class Json {
  public:
    struct Member;

    Json() : Json(nullptr) {}
    Json(std::nullptr_t) : kind_(Kind::null), unsigned_(0) {}
    Json(bool value) : kind_(Kind::boolean), boolean_(value) {}
    Json(std::signed_integral auto value) : kind_(Kind::signedInteger), signed_(value) {}
    Json(std::unsigned_integral auto value) : kind_(Kind::unsignedInteger), unsigned_(value) {}
    // NaN and infinities become null; numberOf keeps them.
    Json(double value) : kind_(Kind::real), real_(value) {}
    Json(std::string_view value);
    Json(const std::string& value) : Json(std::string_view(value)) {}
    Json(const char* value) : Json(std::string_view(value)) {}
    Json(std::initializer_list<Member> members);
    template <class Value>
    Json(const std::vector<Value>& values) : Json(list()) {
        for (const Value& value : values) append(value);
    }
    static Json list(std::initializer_list<Json> values = {});

    // The number, or one of the strings "nan", "inf" and "-inf": JSON has no such numbers.
    static Json numberOf(double value);

    Json(const Json&);
    Json(Json&&) noexcept;
    Json& operator=(const Json&);
    Json& operator=(Json&&) noexcept;
    ~Json();

    // The value at a key; null under a new key. A null becomes an object.
    Json& operator[](std::string_view key);
    // To a list.
    void append(Json value);
    Json& back() { return values_.back(); }

  private:
    enum class Kind : uint8_t { null, boolean, signedInteger, unsignedInteger, real, string, list, object };
    friend struct JsonConversion;

    Kind kind_;
    union {
        bool boolean_;
        int64_t signed_;
        uint64_t unsigned_;
        double real_;
    };
    std::string string_;
    std::vector<std::string> keys_;  // of an object
    std::vector<Json> values_;       // of a list or an object
};

struct Json::Member {
    std::string_view key;
    Json value;
};

// The text, indented by two spaces, one value a line, with a line break at its end. Bytes that are no UTF-8
// become U+FFFD.
std::string jsonText(const Json& json);

}  // namespace etalon
