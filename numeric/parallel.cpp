#include "numeric/parallel.h"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <thread>

#include "numeric/check.h"
#include "numeric/fp_environment.h"

namespace etalon {

int hardwareThreads() { return std::max(1, static_cast<int>(std::thread::hardware_concurrency())); }

void parallelFor(size_t count, int threads, const std::function<void(size_t)>& body) {
    ETALON_CHECK(threads >= 0, "threads = {}", threads);
    requireDefaultFpEnvironment();
    if (threads == 1 || count <= 1) {
        for (size_t i = 0; i < count; i++) body(i);
        return;
    }
    // More threads than the hardware has must be allowed explicitly.
    const int wanted = threads == 0 ? hardwareThreads() : threads;
    const tbb::global_control allowed(tbb::global_control::max_allowed_parallelism,
                                      static_cast<size_t>(std::max(wanted, hardwareThreads())));
    tbb::task_arena arena(wanted);
    arena.execute([&] {
        tbb::parallel_for(tbb::blocked_range<size_t>(0, count, 1),
                          [&](const tbb::blocked_range<size_t>& range) {
                              requireDefaultFpEnvironment();
                              for (size_t i = range.begin(); i != range.end(); i++) body(i);
                          });
    });
}

}  // namespace etalon
