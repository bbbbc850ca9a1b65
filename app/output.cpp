#include "app/output.h"

#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <system_error>

#include "numeric/check.h"
#include "numeric/text.h"

namespace etalon {

void printOut(const std::string& text) {
    const bool good =
        std::fwrite(text.data(), 1, text.size(), stdout) == text.size() && std::fflush(stdout) == 0;
    if (!good)
        throw InputError(
            formatText("standard output: cannot write: {}", std::generic_category().message(errno)));
}

ProgressLine::ProgressLine() : terminal_(isatty(STDERR_FILENO) != 0) {}

void ProgressLine::show(const std::string& text) {
    if (!terminal_) return;
    finish();
    printText(stderr, "{}", text);
    std::fflush(stderr);
    shown_ = true;
}

void ProgressLine::finish() {
    // Back to the first column, erase to the end of the line [ECMA-48].
    if (shown_) printText(stderr, "\r\x1b[K");
    shown_ = false;
}

}  // namespace etalon
