#include "bench/measure.h"

#include <algorithm>
#include <chrono>
#include <cstring>
#include <map>
#include <vector>

namespace etalon::bench {

double copyTime_s(size_t bytes_touched) {
    constexpr int kRuns = 20;
    static std::map<size_t, double> measured;
    const auto found = measured.find(bytes_touched);
    if (found != measured.end()) return found->second;
    const std::vector<char> from(bytes_touched / 2 + 1, 1);
    std::vector<char> to(from.size());
    double shortest_s = 1e9;
    for (int run = 0; run < kRuns; run++) {
        const auto start = std::chrono::steady_clock::now();
        std::memcpy(to.data(), from.data(), from.size());
        benchmark::DoNotOptimize(to.data());
        benchmark::ClobberMemory();
        const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
        shortest_s = std::min(shortest_s, elapsed.count());
    }
    return measured[bytes_touched] = shortest_s;
}

void report(benchmark::State& state, const Amount& amount, double elapsed_s) {
    constexpr double kMillisecondsPerSecond = 1e3;
    const double iteration_s = elapsed_s / static_cast<double>(state.iterations());
    const auto add = [&](const char* name, const char* rate, double value) {
        if (value == 0) return;
        state.counters[name] = value;
        state.counters[rate] = value / iteration_s;
    };
    add("triangles", "triangles/s", amount.triangles);
    add("pixels", "pixels/s", amount.pixels);
    if (amount.bytes_touched == 0) return;
    const double copy_s = copyTime_s(amount.bytes_touched);
    state.counters["copy_ms"] = kMillisecondsPerSecond * copy_s;
    state.counters["x_copy"] = iteration_s / copy_s;
}

}  // namespace etalon::bench
