#include "app/output.h"

#include <unistd.h>

#include <cerrno>
#include <chrono>
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

ProgressLine::ProgressLine() {
    if (isatty(STDERR_FILENO) != 0) writer_ = std::thread([this] { write(); });
}

void ProgressLine::show(const std::string& text) {
    if (!writer_.joinable()) return;
    const std::lock_guard lock(mutex_);
    text_ = text;
}

void ProgressLine::write() {
    constexpr std::chrono::milliseconds kFirst{1000}, kNext{200};
    std::unique_lock lock(mutex_);
    auto pause = kFirst;
    while (!changed_.wait_for(lock, pause, [this] { return finished_; })) {
        pause = kNext;
        if (text_ == written_) continue;
        // Back to the first column, erase to the end of the line [ECMA-48].
        printText(stderr, "\r\x1b[K{}", text_);
        std::fflush(stderr);
        written_ = text_;
    }
    if (!written_.empty()) printText(stderr, "\r\x1b[K");
    std::fflush(stderr);
}

void ProgressLine::finish() {
    if (!writer_.joinable()) return;
    {
        const std::lock_guard lock(mutex_);
        finished_ = true;
    }
    changed_.notify_one();
    writer_.join();
}

}  // namespace etalon
