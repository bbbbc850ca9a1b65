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
#include "shadows/ambient_occlusion.h"
#include "shadows/volume_shadows.h"

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

// Touches the mesh's positions and indices, depth, id and stencil of each texel, and the texels once more.
void addShadowMap(const std::string& name, const Way& way) {
    add("shadow-map/" + name, way, [=](benchmark::State& state) {
        const Workload& w = workload(name, 1);
        const PlacedWorkload work = place(w, way.profile);
        const size_t texels = size_t{kShadowMapSize} * kShadowMapSize;
        const Amount amount{.triangles = static_cast<double>(w.triangles()),
                            .pixels = static_cast<double>(texels),
                            .bytes_touched = meshBytes(w) + texels * (kSample_bytes + sizeof(float))};
        const RasterOptions options{.threads = way.threads};
        measure(state, amount,
                [&] { return readyForLookUp(work, drawShadowMap(work, options), options).casts(0); });
    });
}

// 4 x 4 taps at each visible point. Touches position and two normals of a point (double), its visibility, and
// a texel.
void addPcf(const std::string& name, const Way& way) {
    add("pcf/" + name, way, [=](benchmark::State& state) {
        const Workload& w = workload(name, 1);
        const PlacedWorkload work = place(w, way.profile);
        const RasterOptions options{.threads = way.threads};
        const ShadowMaps maps = readyForLookUp(work, drawShadowMap(work, options), options);
        const LitPoints points = visiblePoints(work, drawDepth(work, 1, options));
        const Amount amount{.pixels = static_cast<double>(points.size()),
                            .bytes_touched = points.size() * (10 * sizeof(double) + sizeof(float))};
        std::vector<double> visibility(points.size());
        measure(state, amount, [&] {
            maps.find(0, points, visibility);
            return visibility.data();
        });
    });
}

// Map, look-ups and shading with one light: a frame.
void addShadowedFrame(const std::string& name, const Way& way) {
    add("lights1-pcf/" + name, way, [=](benchmark::State& state) {
        const Workload& w = workload(name, 1);
        const PlacedWorkload work = place(w, way.profile);
        const RasterOptions options{.threads = way.threads};
        VisibleScene visible = drawDepth(work, 1, options);
        const Amount amount{.triangles = static_cast<double>(w.triangles()),
                            .pixels = coveredPixels(visible),
                            .bytes_touched = 2 * meshBytes(w) + normalBytes(w) +
                                             pixelsOf(w.view) * (kSample_bytes + kRadiance_bytes)};
        measure(state, amount, [&] {
            drawDepth(visible, work, 1, options);
            const ShadowMaps maps = readyForLookUp(work, drawShadowMap(work, options), options);
            return shadeVisible(work, visible, maps, options);
        });
    });
}

// Topology, silhouette and the stencil of one light with z-fail; the depths of the view are drawn first.
// Touches the mesh, and depth, id and stencil of each pixel once for the depths and once for the volumes.
void addVolumes(const std::string& name, const Way& way) {
    add("shadow-volumes/" + name, way, [=](benchmark::State& state) {
        const Workload& w = workload(name, 1);
        const PlacedWorkload work = place(w, way.profile);
        const RasterOptions options{.threads = way.threads};
        const Amount amount{.triangles = static_cast<double>(w.triangles()),
                            .pixels = static_cast<double>(pixelsOf(w.view)),
                            .bytes_touched = 2 * (meshBytes(w) + pixelsOf(w.view) * kSample_bytes)};
        measure(state, amount, [&] {
            return VolumeShadows(w.scene, work.placed, w.view, *work.profile, {}, options).casts(0);
        });
    });
}

// Pixels count points: the vertices of the mesh, each looked up from half of the directions.
constexpr int kOcclusionDirections = 64, kOcclusionMapSize = 512, kHemicubePoints = 64, kHemicubeSize = 64;
void addDirectionalOcclusion(const std::string& name, const Way& way) {
    add("occlusion-directions64/" + name, way, [=](benchmark::State& state) {
        const PlacedWorkload work = place(workload(name, 1), way.profile);
        const auto points = occlusionPointsOf(work.placed[0]);
        DirectionalOptions options;
        options.directions = kOcclusionDirections;
        options.mapSize = kOcclusionMapSize;
        options.raster.threads = way.threads;
        const Amount amount{.pixels = static_cast<double>(points.size()),
                            .bytes_touched = points.size() * sizeof(OcclusionPoint)};
        measure(state, amount, [&] { return directionalOcclusion(work.placed, points, options)[0].open; });
    });
}
void addHemicubeOcclusion(const std::string& name, const Way& way) {
    add("occlusion-hemicube64/" + name, way, [=](benchmark::State& state) {
        const PlacedWorkload work = place(workload(name, 1), way.profile);
        auto points = occlusionPointsOf(work.placed[0]);
        points.resize(kHemicubePoints);
        HemicubeOptions options;
        options.size = kHemicubeSize;
        options.threads = way.threads;
        const Amount amount{.pixels = static_cast<double>(points.size()),
                            .bytes_touched = points.size() * sizeof(OcclusionPoint)};
        measure(state, amount, [&] { return hemicubeOcclusion(work.placed, points, options)[0].open; });
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
        for (const char* name : {"70k", "870k"}) {
            addShadowMap(name, way);
            addShadowedFrame(name, way);
        }
        addPcf("70k", way);
        addVolumes("70k", way);
        addDirectionalOcclusion("70k", way);
        addHemicubeOcclusion("1k", way);
        addFill(way);
        addCube(way);
        addBlur(way);
        addCubeFromLatLong(way);
    }
    for (const IsaLevel level : usableIsaLevels()) {
        const Way way{.level = level};
        addDepth("70k", way);
        addPcf("70k", way);
        addShaded("1k-small", 64, way);
        addBlur(way);
        addCubeFromLatLong(way);
    }
    addShaded("1k-small", 64, {});
    for (const char* profile : {"f64", "r300-fp24", "nv40-fp16", "fp16", "bf16"}) {
        addShaded("70k", 1, {.profile = profile});
        addPcf("70k", {.profile = profile});
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
