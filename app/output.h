// What verbs write besides their files.
#pragma once

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>

#include "numeric/progress.h"

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
    // Returns what work() returns; shows meanwhile what is done, and how far the work of the calling thread is.
    template <class Work>
    auto during(const std::string& what, const Work& work) {
        const ProgressScope watched(reporter(what));
        return work();
    }
    void finish();

  private:
    ProgressScope::Report reporter(const std::string& what);
    void write();

    std::mutex mutex_;
    std::condition_variable changed_;
    std::string text_, written_;
    bool finished_ = false;
    std::thread writer_;
};

// ": 40 %, 3 s left", or ": step 2, 40 %, 3 s left" behind the first step of several; "" as long as too little of the
// step is done to tell.
class TimeLeft {
  public:
    std::string of(int step, double part);

  private:
    int step_ = -1;
    std::chrono::steady_clock::time_point start_;
};

}  // namespace etalon
