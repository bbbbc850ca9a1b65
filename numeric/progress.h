// How far the work of a thread is, without a word from what works: parallelFor (numeric/parallel.h) and the loops that
// say so with ProgressLoop tell whoever watches the thread. Changes no bit.
#pragma once

#include <atomic>
#include <cstddef>
#include <functional>
#include <mutex>

namespace etalon {

// Watches the calling thread while it lives. Its loops, one after the other, are steps; a loop within a loop is a part
// of it, and one of a single round is none.
class ProgressScope {
  public:
    // Takes the step, 1 for the first, and the part of it that is done: from any thread, one call at a time. Empty:
    // nobody watches.
    using Report = std::function<void(int step, double part)>;
    explicit ProgressScope(Report report);
    ~ProgressScope();
    ProgressScope(const ProgressScope&) = delete;
    ProgressScope& operator=(const ProgressScope&) = delete;

  private:
    friend class ProgressLoop;
    Report report_;
    int step_ = 0;
    ProgressScope* before_;
};

// A loop of the calling thread, while it lives.
class ProgressLoop {
  public:
    explicit ProgressLoop(size_t rounds);
    ~ProgressLoop();
    ProgressLoop(const ProgressLoop&) = delete;
    ProgressLoop& operator=(const ProgressLoop&) = delete;
    // One more round is done; from any thread.
    void next();

  private:
    ProgressScope* scope_;  // null: nobody watches
    size_t rounds_;
    std::atomic<size_t> done_{0};
    std::mutex mutex_;
    size_t reported_ = 0;
};

}  // namespace etalon
