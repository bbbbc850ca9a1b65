// Measures Etalon's passes. Names are pass/workload/profile/threads:N; bench/table joins them with the peers'
// pass/workload.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <functional>
#include <optional>
#include <string>

#include "bench/measure.h"
#include "bench/passes.h"
#include "bench/rows.h"
#include "numeric/isa.h"
#include "raster/blur.h"

namespace etalon::bench {

void add(const std::string& name, const Way& way, std::function<void(benchmark::State&)> body) {
    const std::string level = way.level ? std::string("-") + isaName(*way.level) : "";
    const std::string full = name + "/" + way.profile + level + "/threads:" + std::to_string(way.threads);
    benchmark::RegisterBenchmark(full.c_str(),
                                 [=](benchmark::State& state) {
                                     const IsaLevel before = activeIsa();
                                     if (way.level) selectIsa(*way.level);
                                     body(state);
                                     selectIsa(before);
                                 })
        ->Unit(benchmark::kMillisecond)
        ->MeasureProcessCPUTime()
        ->UseRealTime();
}

namespace {

std::string shadedPass(int lights, int samples) {
    return "lights" + std::to_string(lights) + (samples == 4 ? "-msaa4" : "");
}

// Touches the mesh, and depth, id and stencil of each sample.
void addDepth(const std::string& name, const Way& way, int samples = 1) {
    add((samples == 4 ? "depth-msaa4/" : "depth/") + name, way, [=](benchmark::State& state) {
        const Workload& w = workload(name, 1);
        const PlacedWorkload work = place(w, way.profile);
        const Amount amount{
            .triangles = static_cast<double>(w.triangles()),
            .bytes_touched = meshBytes(w) + pixelsOf(w.view) * static_cast<size_t>(samples) * kSample_bytes};
        VisibleScene visible = drawDepth(work, samples, {.threads = way.threads});
        measure(state, amount, [&] {
            drawDepth(visible, work, samples, {.threads = way.threads});
            return visible.target.depth.values().data();
        });
    });
}

// Touches the mesh with its normals, the samples, and three channels of radiance per pixel. Pixels count
// where something is drawn.
void addShaded(const std::string& name, int lights, const Way& way, int samples = 1) {
    add(shadedPass(lights, samples) + "/" + name, way, [=](benchmark::State& state) {
        const Workload& w = workload(name, lights);
        const PlacedWorkload work = place(w, way.profile);
        const Amount amount{
            .triangles = static_cast<double>(w.triangles()),
            .pixels = coveredPixels(drawDepth(work, 1, {})),
            .bytes_touched =
                meshBytes(w) + normalBytes(w) +
                pixelsOf(w.view) * (static_cast<size_t>(samples) * kSample_bytes + kRadiance_bytes)};
        const RasterOptions options{.threads = way.threads};
        VisibleScene visible = drawDepth(work, samples, options);
        measure(state, amount, [&] {
            drawDepth(visible, work, samples, options);
            return shadeVisible(work, visible, options);
        });
    });
}

// Pixels count once per layer; the bytes are those of one layer, as tiles stay in the cache.
void addFill(const Way& way) {
    add("fill/layers", way, [=](benchmark::State& state) {
        const Workload& w = workload("layers", 1);
        const PlacedWorkload work = place(w, way.profile);
        const Amount amount{.pixels = static_cast<double>(kLayers) * static_cast<double>(pixelsOf(w.view)),
                            .bytes_touched = pixelsOf(w.view) * kSample_bytes};
        VisibleScene visible = drawDepth(work, 1, {.threads = way.threads});
        measure(state, amount, [&] {
            drawDepth(visible, work, 1, {.threads = way.threads});
            return visible.target.depth.values().data();
        });
    });
}

// Touches the mesh with its normals once, and per texel the sample, radiance and distance.
void addCube(const Way& way) {
    add("cube/70k", way, [=](benchmark::State& state) {
        const Workload& w = workload("70k", 1);
        const PlacedWorkload work = place(w, way.profile);
        constexpr size_t kTexels = size_t{kCubeFaces} * kCubeSize * kCubeSize;
        const Amount amount{.pixels = static_cast<double>(kTexels),
                            .bytes_touched = meshBytes(w) + normalBytes(w) +
                                             kTexels * (kSample_bytes + kRadiance_bytes + kDistance_bytes)};
        measure(state, amount, [&] { return drawCube(work, {.threads = way.threads}); });
    });
}

// Touches the image before and after.
void addBlur(const Way& way) {
    add("blur/1024", way, [=](benchmark::State& state) {
        const Image<float> image = blurInput();
        const Amount amount{.pixels = static_cast<double>(image.pixelCount()),
                            .bytes_touched = 2 * image.pixelCount() * sizeof(float)};
        measure(state, amount, [&] { return blurGaussian(image, kBlurRadius, kBlurSigma, way.threads); });
    });
}

void addAll() {
    for (const int threads : {1, 2}) {
        const Way way{.threads = threads};
        for (const char* name : {"1k", "70k", "870k", "large", "sub-pixel"}) {
            addDepth(name, way);
            addShaded(name, 1, way);
        }
        for (const char* name : {"1k", "70k", "870k"}) addShaded(name, 64, way);
        addDepth("70k", way, 4);
        addShaded("70k", 1, way, 4);
        addShadowRows(way);
        addFill(way);
        addCube(way);
        addBlur(way);
        addProbeRows(way);
    }
    for (const IsaLevel level : usableIsaLevels()) {
        const Way way{.level = level};
        addDepth("70k", way);
        addShadowRowsOfLevel(way);
        addShaded("1k-small", 64, way);
        addBlur(way);
        addProbeRowsOfLevel(way);
    }
    addShaded("1k-small", 64, {});
    for (const char* profile : {"f64", "r300-fp24", "nv40-fp16", "fp16", "bf16"}) {
        addShaded("70k", 1, {.profile = profile});
        addShadowRowsOfLevel({.profile = profile});
        addShaded("1k-small", 1, {.profile = profile});
        addProbeRowsOfProfile({.profile = profile});
    }
    addShaded("1k-small", 1, {});
    addShaded("1k-small", 1, {.profile = "truth"});
}

}  // namespace
}  // namespace etalon::bench

int main(int argc, char** argv) {
    benchmark::Initialize(&argc, argv);
    if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
    etalon::bench::addAll();
    benchmark::RunSpecifiedBenchmarks();
    benchmark::Shutdown();
    return 0;
}
