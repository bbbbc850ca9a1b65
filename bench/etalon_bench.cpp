// Measures Etalon's passes. Names are pass/workload/profile/threads:N; bench/table joins them with the peers'
// pass/workload.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <functional>
#include <string>

#include "bench/measure.h"
#include "bench/passes.h"
#include "raster/blur.h"

namespace etalon::bench {
namespace {

// Bytes of a position or normal, an index, and what visibility stores per sample: depth, id and stencil.
constexpr size_t kVector_bytes = 12, kIndex_bytes = 4, kSample_bytes = 9;
constexpr size_t kRadiance_bytes = 12, kDistance_bytes = 4;

// Positions and indices read.
size_t meshBytes(const Workload& w) {
    return w.mesh().positions.size() * kVector_bytes + w.mesh().indices.size() * kIndex_bytes;
}
size_t normalBytes(const Workload& w) { return w.mesh().normals.size() * kVector_bytes; }
size_t pixelsOf(const View& view) {
    return static_cast<size_t>(view.width) * static_cast<size_t>(view.height);
}

std::string shadedPass(int lights, int samples) {
    return "lights" + std::to_string(lights) + (samples == 4 ? "-msaa4" : "");
}

double coveredPixels(const VisibleScene& visible) {
    const auto ids = visible.target.id.plane(0);
    return static_cast<double>(ids.size()) -
           static_cast<double>(std::count(ids.begin(), ids.end(), kNoTriangle));
}

void add(const std::string& name, int threads, std::function<void(benchmark::State&)> body) {
    benchmark::RegisterBenchmark((name + "/threads:" + std::to_string(threads)).c_str(), std::move(body))
        ->Unit(benchmark::kMillisecond)
        ->UseRealTime();
}

// Touches the mesh, and depth, id and stencil of each sample.
void addDepth(const std::string& name, const std::string& profile, int threads, int samples = 1) {
    add((samples == 4 ? "depth-msaa4/" : "depth/") + name + "/" + profile, threads,
        [=](benchmark::State& state) {
            const Workload& w = workload(name, 1);
            const PlacedWorkload work = place(w, profile);
            const Amount amount{
                .triangles = static_cast<double>(w.triangles()),
                .bytes_touched =
                    meshBytes(w) + pixelsOf(w.view) * static_cast<size_t>(samples) * kSample_bytes};
            measure(state, amount, [&] { return drawDepth(work, samples, {.threads = threads}); });
        });
}

// Touches the mesh with its normals, the samples, and three channels of radiance per pixel. Pixels count
// where something is drawn.
void addShaded(const std::string& name, int lights, const std::string& profile, int threads,
               int samples = 1) {
    add(shadedPass(lights, samples) + "/" + name + "/" + profile, threads, [=](benchmark::State& state) {
        const Workload& w = workload(name, lights);
        const PlacedWorkload work = place(w, profile);
        const Amount amount{
            .triangles = static_cast<double>(w.triangles()),
            .pixels = coveredPixels(drawDepth(work, 1, {})),
            .bytes_touched =
                meshBytes(w) + normalBytes(w) +
                pixelsOf(w.view) * (static_cast<size_t>(samples) * kSample_bytes + kRadiance_bytes)};
        measure(state, amount, [&] { return drawShaded(work, samples, {.threads = threads}); });
    });
}

// Pixels count once per layer; the bytes are those of one layer, as tiles stay in the cache.
void addFill(int threads) {
    add("fill/layers/f32", threads, [=](benchmark::State& state) {
        const Workload& w = workload("layers", 1);
        const PlacedWorkload work = place(w, "f32");
        const Amount amount{.pixels = static_cast<double>(kLayers) * static_cast<double>(pixelsOf(w.view)),
                            .bytes_touched = pixelsOf(w.view) * kSample_bytes};
        measure(state, amount, [&] { return drawDepth(work, 1, {.threads = threads}); });
    });
}

// Touches the mesh with its normals once, and per texel the sample, radiance and distance.
void addCube(int threads) {
    add("cube/70k/f32", threads, [=](benchmark::State& state) {
        const Workload& w = workload("70k", 1);
        const PlacedWorkload work = place(w, "f32");
        constexpr size_t kTexels = size_t{kCubeFaces} * kCubeSize * kCubeSize;
        const Amount amount{.pixels = static_cast<double>(kTexels),
                            .bytes_touched = meshBytes(w) + normalBytes(w) +
                                             kTexels * (kSample_bytes + kRadiance_bytes + kDistance_bytes)};
        measure(state, amount, [&] { return drawCube(work, {.threads = threads}); });
    });
}

// Touches the image before and after.
void addBlur(int threads) {
    add("blur/1024/f32", threads, [=](benchmark::State& state) {
        const Image<float> image = blurInput();
        const Amount amount{.pixels = static_cast<double>(image.pixelCount()),
                            .bytes_touched = 2 * image.pixelCount() * sizeof(float)};
        measure(state, amount, [&] { return blurGaussian(image, kBlurRadius, kBlurSigma, threads); });
    });
}

// Touches the texels of the lat-long image and of the cube map.
void addCubeFromLatLong(const std::string& profile, int threads) {
    add("latlong-to-cube/1024/" + profile, threads, [=](benchmark::State& state) {
        SurfaceEnvironment environment;
        environment.latLong = latLongInput();
        const Profile& found = *findProfile(profile);
        constexpr size_t kTexels = size_t{kCubeFaces} * kLatLongCubeSize * kLatLongCubeSize;
        const Amount amount{.pixels = static_cast<double>(kTexels),
                            .bytes_touched = (environment.latLong.pixelCount() + kTexels) * kRadiance_bytes};
        measure(state, amount, [&] { return environmentCube(environment, found, threads); });
    });
}

void addAll() {
    for (const int threads : {1, 2}) {
        for (const char* name : {"1k", "70k", "870k", "large", "sub-pixel"}) {
            addDepth(name, "f32", threads);
            addShaded(name, 1, "f32", threads);
        }
        for (const char* name : {"1k", "70k", "870k"}) addShaded(name, 64, "f32", threads);
        addDepth("70k", "f32", threads, 4);
        addShaded("70k", 1, "f32", threads, 4);
        addFill(threads);
        addCube(threads);
        addBlur(threads);
        addCubeFromLatLong("f32", threads);
    }
    for (const char* profile : {"f64", "r300-fp24", "nv40-fp16", "fp16", "bf16"}) {
        addShaded("70k", 1, profile, 1);
        addShaded("1k-small", 1, profile, 1);
        addCubeFromLatLong(profile, 1);
    }
    addShaded("1k-small", 1, "f32", 1);
    addShaded("1k-small", 1, "truth", 1);
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
