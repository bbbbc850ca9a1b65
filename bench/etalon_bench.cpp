// Measures Etalon's passes. Names are pass/workload/profile/threads:N; bench/table joins them with the peers'
// pass/workload.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <functional>
#include <optional>
#include <string>

#include "bench/measure.h"
#include "bench/passes.h"
#include "numeric/isa.h"
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

// How a pass runs: the profile, the threads, and an instruction set level other than the widest.
struct Way {
    std::string profile = "f32";
    int threads = 1;
    std::optional<IsaLevel> level = {};
};

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

// Touches the texels of the lat-long image and of the cube map.
void addCubeFromLatLong(const Way& way) {
    add("latlong-to-cube/1024", way, [=](benchmark::State& state) {
        SurfaceEnvironment environment;
        environment.latLong = latLongInput();
        const Profile& found = *findProfile(way.profile);
        constexpr size_t kTexels = size_t{kCubeFaces} * kLatLongCubeSize * kLatLongCubeSize;
        const Amount amount{.pixels = static_cast<double>(kTexels),
                            .bytes_touched = (environment.latLong.pixelCount() + kTexels) * kRadiance_bytes};
        measure(state, amount, [&] { return environmentCube(environment, found, way.threads); });
    });
}

// Triangles count once per sample of the light. Touches the casters, and counts and shadow of each texel,
// once.
void addPlanar(const std::string& name, int samples, double blur_m, const Way& way) {
    const std::string pass = "planar" + std::to_string(samples) + (blur_m > 0 ? "-blur" : "");
    add(pass + "/" + name, way, [=](benchmark::State& state) {
        const Workload& w = workload(name, 1);
        const PlanarWork work = planarWork(place(w, way.profile), samples);
        const RasterOptions options{.threads = way.threads};
        const size_t texels = drawPlanarShadow(work, blur_m, options).shadow.pixelCount();
        const Amount amount{.triangles = static_cast<double>(work.casters.indices.size() / 3) * samples,
                            .pixels = static_cast<double>(texels),
                            .bytes_touched = meshBytes(w) + texels * (sizeof(uint32_t) + sizeof(float))};
        measure(state, amount, [&] { return drawPlanarShadow(work, blur_m, options); });
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
        addFill(way);
        addCube(way);
        addBlur(way);
        addCubeFromLatLong(way);
        for (const char* name : {"1k", "70k"}) {
            addPlanar(name, 256, 0, way);
            addPlanar(name, 25, 0, way);
            addPlanar(name, 25, kPlanarBlur_m, way);
        }
    }
    for (const IsaLevel level : usableIsaLevels()) {
        const Way way{.level = level};
        addDepth("70k", way);
        addShaded("1k-small", 64, way);
        addBlur(way);
        addCubeFromLatLong(way);
    }
    addShaded("1k-small", 64, {});
    for (const char* profile : {"f64", "r300-fp24", "nv40-fp16", "fp16", "bf16"}) {
        addShaded("70k", 1, {.profile = profile});
        addShaded("1k-small", 1, {.profile = profile});
        addCubeFromLatLong({.profile = profile});
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
