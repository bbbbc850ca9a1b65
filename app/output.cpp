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

ProgressScope::Report ProgressLine::reporter(const std::string& what) {
    show(what);
    if (!writer_.joinable()) return {};
    return
        [this, what, left = TimeLeft()](int step, double part) mutable { show(what + left.of(step, part)); };
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

std::string TimeLeft::of(int step, double part) {
    constexpr double kLeastPart = 0.02;
    const auto now = std::chrono::steady_clock::now();
    if (step != step_) step_ = step, start_ = now;
    if (part < kLeastPart) return "";
    const double seconds = std::chrono::duration<double>(now - start_).count();
    return formatText(": {}{:.0f} %, {:.0f} s left", step > 1 ? formatText("step {}, ", step) : "",
                      100 * part, seconds * (1 - part) / part);
}

}  // namespace etalon
