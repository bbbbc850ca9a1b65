// What every benchmark program reports beside its time.
#pragma once

#include <benchmark/benchmark.h>

#include <chrono>
#include <cstddef>

namespace etalon::bench {

// What one iteration works on. bytes_touched: input read once and output written once, what no implementation
// can do without; see the benchmark for what is counted.
struct Amount {
    double triangles = 0, pixels = 0;
    size_t bytes_touched = 0;
};

// Seconds that memcpy takes to touch as many bytes, on one thread: it copies half of them, so that it reads
// one half and writes the other. The shortest of several runs, measured once per amount and kept.
double copyTime_s(size_t bytes_touched);

// Adds the counters to a finished state: triangles and pixels of an iteration and their rates, where they are
// not 0; copy_ms, the time of copyTime_s; and x_copy, the time of an iteration in units of it. elapsed_s is
// the time of all iterations.
void report(benchmark::State& state, const Amount& amount, double elapsed_s);

// Runs the iterations of a benchmark and reports them. The body returns what it made.
template <class Body>
void measure(benchmark::State& state, const Amount& amount, Body&& body) {
    const auto start = std::chrono::steady_clock::now();
    for (auto _ : state) benchmark::DoNotOptimize(body());
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
    report(state, amount, elapsed.count());
}

}  // namespace etalon::bench
