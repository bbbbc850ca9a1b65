// Preconditions and typed errors.
#pragma once

#include <fmt/format.h>

#include <stdexcept>
#include <string>

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

[[noreturn]] inline void failPrecondition(const char* expression, const char* file, int line,
                                          const std::string& values) {
    throw PreconditionError(
        fmt::format("{}:{}: precondition failed: {} ({})", file, line, expression, values));
}

}  // namespace etalon

// Throws PreconditionError with the formatted values unless the condition holds.
#define ETALON_CHECK(condition, ...)                                                              \
    do {                                                                                          \
        if (!(condition))                                                                         \
            ::etalon::failPrecondition(#condition, __FILE__, __LINE__, fmt::format(__VA_ARGS__)); \
    } while (false)
