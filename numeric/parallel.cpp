#include "numeric/parallel.h"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

#include "numeric/check.h"
#include "numeric/emulated_format.h"
#include "numeric/fp_environment.h"
#include "numeric/progress.h"

namespace etalon {
namespace {

// The thread sanitizer does not see the synchronisation inside oneTBB, which is not instrumented: under it,
// plain threads take the items, so that what it reports are races between items.
#if defined(__SANITIZE_THREAD__)
#define ETALON_PLAIN_THREADS 1
#elif defined(__has_feature)
#if __has_feature(thread_sanitizer)
#define ETALON_PLAIN_THREADS 1
#endif
#endif
#if defined(ETALON_PLAIN_THREADS)
constexpr bool kOnlyPlainThreads = true;
#else
constexpr bool kOnlyPlainThreads = false;
#endif

// Nothing of another item shows in this one.
void runItem(const std::function<void(size_t)>& body, size_t i, ProgressLoop& progress) {
    {
        const EmulatedItemsScope items;
        body(i);
    }
    progress.next();
}

void runOnPlainThreads(size_t count, int threads, const std::function<void(size_t)>& body,
                       ProgressLoop& progress) {
    std::atomic<size_t> next{0};
    std::mutex mutex;
    std::exception_ptr failure;
    const EmulatedFormat format = emulatedFormat;
    const auto work = [&] {
        try {
            requireDefaultFpEnvironment();
            const EmulatedScope scope(format);
            for (size_t i = next++; i < count; i = next++) runItem(body, i, progress);
        } catch (...) {
            const std::lock_guard lock(mutex);
            if (!failure) failure = std::current_exception();
            next = count;
        }
    };
    std::vector<std::jthread> workers;
    for (size_t t = 0; t < std::min(static_cast<size_t>(threads), count); t++) workers.emplace_back(work);
    workers.clear();  // joins
    if (failure) std::rethrow_exception(failure);
}

void runOnPool(size_t count, int threads, const std::function<void(size_t)>& body, ProgressLoop& progress) {
    const EmulatedFormat format = emulatedFormat;
    tbb::task_arena arena(threads);
    arena.execute([&] {
        tbb::parallel_for(tbb::blocked_range<size_t>(0, count, 1),
                          [&](const tbb::blocked_range<size_t>& range) {
                              requireDefaultFpEnvironment();
                              const EmulatedScope scope(format);
                              for (size_t i = range.begin(); i != range.end(); i++)
                                  runItem(body, i, progress);
                          });
    });
}

}  // namespace

int hardwareThreads() { return std::max(1, static_cast<int>(std::thread::hardware_concurrency())); }

void parallelFor(size_t count, int threads, const std::function<void(size_t)>& body) {
    ETALON_CHECK(threads >= 0, "threads = {}", threads);
    requireDefaultFpEnvironment();
    ProgressLoop progress(count);
    if (threads == 1 || count <= 1) {
        for (size_t i = 0; i < count; i++) runItem(body, i, progress);
        return;
    }
    // More threads than the hardware has are a test of what they change: oneTBB's would spend most of the time waiting
    // for each other (on two processors the test of all bits, 1 to 7 threads, took 17 times as long).
    if (kOnlyPlainThreads || threads > hardwareThreads())
        runOnPlainThreads(count, threads == 0 ? hardwareThreads() : threads, body, progress);
    else
        runOnPool(count, threads == 0 ? hardwareThreads() : threads, body, progress);
}

}  // namespace etalon
