// Preconditions and typed errors.
#pragma once

#include <stdexcept>
#include <string>

#include "numeric/text.h"

namespace etalon {

// A caller broke a documented precondition: a defect in the calling program, not bad user input.
class PreconditionError : public std::logic_error {
  public:
    using std::logic_error::logic_error;
};

// Bad input from outside (a file, an option). what() is one line: "file:line: reason" or "file: reason".
class InputError : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

// Where a check stands and what it asks for.
struct CheckPlace {
    const char* condition;
    const char* file;
    int line;
};
[[noreturn, gnu::cold]] void failCheck(const CheckPlace& place, const char* format, const TextValue* values,
                                       size_t count);
template <class... Values>
[[noreturn, gnu::cold, gnu::noinline]] void failCheckWith(const CheckPlace& place,
                                                          TextFormat<sizeof...(Values)> format,
                                                          const Values&... values) {
    const TextValue all[sizeof...(Values) + 1] = {TextValue(values)..., TextValue(false)};
    failCheck(place, format.text, all, sizeof...(Values));
}

}  // namespace etalon

// Throws PreconditionError with the formatted values (numeric/text.h) unless the condition holds.
#define ETALON_CHECK(condition, ...)                                                                    \
    do {                                                                                                \
        if (!(condition))                                                                               \
            ::etalon::failCheckWith(::etalon::CheckPlace{#condition, __FILE__, __LINE__}, __VA_ARGS__); \
    } while (false)
