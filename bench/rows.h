// How the rows of etalon_bench are registered.
#pragma once

#include <benchmark/benchmark.h>

#include <functional>
#include <optional>
#include <string>

#include "numeric/isa.h"

namespace etalon::bench {

// Bytes of three floats per pixel.
inline constexpr size_t kRadiance_bytes = 12;

// How a pass runs: the profile, the threads, and an instruction set level other than the widest.
struct Way {
    std::string profile = "f32";
    int threads = 1;
    std::optional<IsaLevel> level = {};
};

// Registers a row, pass/workload.
void add(const std::string& name, const Way& way, std::function<void(benchmark::State&)> body);

// Conversions, harmonics, irradiance and lights of probes: all ways with one way's threads; the rows of each
// level; those of each profile (probe_rows.cpp).
void addProbeRows(const Way& way);
void addProbeRowsOfLevel(const Way& way);
void addProbeRowsOfProfile(const Way& way);

}  // namespace etalon::bench
