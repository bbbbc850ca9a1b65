// How the rows of etalon_bench are registered.
#pragma once

#include <benchmark/benchmark.h>

#include <algorithm>
#include <functional>
#include <optional>
#include <string>

#include "bench/passes.h"
#include "numeric/isa.h"

namespace etalon::bench {

// Bytes of a position or normal, an index, and what visibility stores per sample: depth, id and stencil.
inline constexpr size_t kVector_bytes = 12, kIndex_bytes = 4, kSample_bytes = 9;
inline constexpr size_t kDistance_bytes = 4;

// Positions and indices read.
inline size_t meshBytes(const Workload& w) {
    return w.mesh().positions.size() * kVector_bytes + w.mesh().indices.size() * kIndex_bytes;
}
inline size_t normalBytes(const Workload& w) { return w.mesh().normals.size() * kVector_bytes; }
inline size_t pixelsOf(const View& view) {
    return static_cast<size_t>(view.width) * static_cast<size_t>(view.height);
}

inline constexpr size_t kRadiance_bytes = 12;

// Pixels that show a triangle.
inline double coveredPixels(const VisibleScene& visible) {
    const auto ids = visible.target.id.plane(0);
    return static_cast<double>(ids.size()) -
           static_cast<double>(std::count(ids.begin(), ids.end(), kNoTriangle));
}

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

// Shadow maps and their look-up, frames with them, volumes, occlusion, planar shadows (shadow_rows.cpp).
void addShadowRows(const Way& way);
void addShadowRowsOfLevel(const Way& way);

}  // namespace etalon::bench
