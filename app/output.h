// What verbs write besides their files.
#pragma once

#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>

namespace etalon {

// Writes to standard output; InputError if that fails (a full disk behind a redirection).
void printOut(const std::string& text);

// Shows on standard error what is done, if that is a terminal and the work takes longer than a second; a later
// call or finish() replaces it. The line is written by a thread of its own, so that one long step shows too.
class ProgressLine {
  public:
    ProgressLine();
    ~ProgressLine() { finish(); }
    ProgressLine(const ProgressLine&) = delete;
    ProgressLine& operator=(const ProgressLine&) = delete;
    void show(const std::string& text);  // from any thread
    void finish();

  private:
    void write();

    std::mutex mutex_;
    std::condition_variable changed_;
    std::string text_, written_;
    bool finished_ = false;
    std::thread writer_;
};

}  // namespace etalon
