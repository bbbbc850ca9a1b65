#include "numeric/parallel.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <stdexcept>
#include <thread>
#include <utility>
#include <vector>

#include "numeric/check.h"
#include "numeric/fp_environment.h"
#include "numeric/progress.h"

using namespace etalon;

TEST_CASE("EveryItemRunsOnceWhateverTheThreads") {
    for (int threads : {0, 1, 2, 7}) {
        std::vector<std::atomic<int>> runs(1000);
        parallelFor(runs.size(), threads, [&](size_t i) { runs[i]++; });
        for (const auto& count : runs) CHECK(count == 1);
    }
}

// Each item waits for the other, so that a call ends only if two threads are at work.
TEST_CASE("EveryCallHasItsThreads") {
    for (int call = 0; call < 5; call++) {
        std::atomic<int> arrived{0};
        parallelFor(2, 2, [&](size_t) {
            arrived++;
            const auto start = std::chrono::steady_clock::now();
            while (arrived < 2 && std::chrono::steady_clock::now() - start < std::chrono::seconds(20))
                std::this_thread::yield();
            CHECK_MESSAGE(arrived == 2, "call ", call);
        });
    }
}

TEST_CASE("AnExceptionOnAThreadReachesTheCaller") {
    CHECK_THROWS_AS(parallelFor(100, 2,
                                [](size_t i) {
                                    if (i == 57) throw std::runtime_error("57");
                                }),
                    std::runtime_error);
}

TEST_CASE("AThreadThatFlushesSubnormalsIsRefused") {
    CHECK(fpEnvironmentIsDefault());
    {
        const FlushToZeroScope flush;
        CHECK_FALSE(fpEnvironmentIsDefault());
        CHECK_THROWS_AS(parallelFor(1, 1, [](size_t) {}), PreconditionError);
    }
    CHECK(fpEnvironmentIsDefault());
    // A worker thread whose control word an item has changed is refused at its next item, or by the next
    // call.
    volatile float tiny = 1e-38f;
    {
        const FlushToZeroScope flush;
        CHECK(tiny * 0.5f == 0.0f);
    }
    CHECK(tiny * 0.5f != 0.0f);
}

TEST_CASE("LoopsOfAThreadAreTheStepsOfItsProgressWhateverTheThreads") {
    for (const int threads : {1, 4}) {
        std::vector<std::pair<int, double>> reports;
        const auto work = [&] {
            parallelFor(100, threads, [](size_t) {
                // A part of the first step, on whatever thread.
                parallelFor(3, 1, [](size_t) {});
            });
            const ProgressLoop once(1);
            ProgressLoop faces(6);
            for (int i = 0; i < 6; i++, faces.next()) parallelFor(10, threads, [](size_t) {});
        };
        work();
        CHECK(reports.empty());
        {
            const ProgressScope watched([&](int step, double part) { reports.emplace_back(step, part); });
            work();
            {
                const ProgressScope nobody({});
                work();
            }
        }
        work();
        CAPTURE(threads);
        REQUIRE(!reports.empty());
        CHECK(reports.front() == std::pair(1, 0.0));
        CHECK(reports.back() == std::pair(2, 1.0));
        CHECK(std::ranges::is_sorted(reports));
        CHECK(std::ranges::count(reports, 2, &std::pair<int, double>::first) == 7);
        CHECK(std::ranges::find(reports, std::pair(1, 1.0)) != reports.end());
    }
}
