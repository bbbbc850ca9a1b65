// Threads. Work is split into items that do not share results, so that the number of threads changes no bit.
#pragma once

#include <cstddef>
#include <functional>

namespace etalon {

// Number of hardware threads; at least 1.
int hardwareThreads();

// Calls body(i) once for every i in [0, count), on `threads` threads (0: all hardware threads; 1: the calling
// thread, in order). Every thread that takes part first asserts the default floating-point control word, and
// computes in the emulated format of the calling thread, with the keys of stochastic rounding 0 at the start of each
// body (numeric/emulated_format.h).
// It is a step of the calling thread's work (numeric/progress.h).
// The first exception that a body throws is rethrown here after the others have stopped.
void parallelFor(size_t count, int threads, const std::function<void(size_t)>& body);

}  // namespace etalon
