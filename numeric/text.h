// Text with values in it. Format strings are those of the library {fmt}: "{}", "{:.3g}", "{:08x}", "{:>{}}", "{{". The
// library itself is compiled in text.cpp alone; what stands here costs its users no compile time.
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <string>
#include <string_view>

namespace etalon {

// A value of a text: what it holds outlives the call that formats it.
class TextValue {
  public:
    enum class Kind : uint8_t { boolean, character, signedInteger, unsignedInteger, single, real, string };

    TextValue(bool value) : kind(Kind::boolean), boolean(value) {}
    TextValue(char value) : kind(Kind::character), character(value) {}
    TextValue(std::signed_integral auto value) : kind(Kind::signedInteger), signedInteger(value) {}
    TextValue(std::unsigned_integral auto value) : kind(Kind::unsignedInteger), unsignedInteger(value) {}
    TextValue(float value) : kind(Kind::single), single(value) {}
    TextValue(double value) : kind(Kind::real), real(value) {}
    TextValue(std::string_view value) : kind(Kind::string), string(value) {}
    TextValue(const std::string& value) : TextValue(std::string_view(value)) {}
    TextValue(const char* value) : TextValue(std::string_view(value)) {}

    Kind kind;
    union {
        bool boolean;
        char character;
        int64_t signedInteger;
        uint64_t unsignedInteger;
        float single;
        double real;
        std::string_view string;
    };
};

// A format string whose values are counted when it is compiled.
template <size_t values>
struct TextFormat {
    template <size_t length>
    consteval TextFormat(const char (&format)[length]) : text(format) {
        size_t count = 0;
        for (size_t i = 0; i + 1 < length; i++) {
            if (format[i] != '{') continue;
            if (format[i + 1] == '{')
                i++;
            else
                count++;
        }
        if (count != values) throw "the format string asks for another number of values";
    }
    const char* text;
};

std::string formatValues(const char* format, const TextValue* values, size_t count);

// Throws std::runtime_error where a value does not fit its place ("{:d}" of a string).
template <class... Values>
std::string formatText(TextFormat<sizeof...(Values)> format, const Values&... values) {
    const TextValue all[sizeof...(Values) + 1] = {TextValue(values)..., TextValue(false)};
    return formatValues(format.text, all, sizeof...(Values));
}

// The same to a stream; what cannot be written is lost.
template <class... Values>
void printText(std::FILE* to, TextFormat<sizeof...(Values)> format, const Values&... values) {
    std::fputs(formatText<Values...>(format, values...).c_str(), to);
}
template <class... Values>
void printText(TextFormat<sizeof...(Values)> format, const Values&... values) {
    printText<Values...>(stdout, format, values...);
}

// The parts with the separator between them.
template <class Parts>
std::string joinText(const Parts& parts, std::string_view separator) {
    std::string text;
    for (const auto& part : parts) {
        if (&part != &*std::begin(parts)) text += separator;
        text += part;
    }
    return text;
}

}  // namespace etalon
