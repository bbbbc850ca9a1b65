// What determinism costs: the shading loop with 64 lights and coverage, exact and in arithmetics that give up
// the same bits everywhere. `differing` counts the values that differ from the exact ones, `error` is the
// largest relative difference. All on one thread.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "bench/exactness/coverage_variant.h"
#include "bench/exactness/shading_variant.h"
#include "bench/measure.h"
#include "bench/passes.h"

namespace etalon::bench {
namespace {

using Shade = void (*)(const ShadingInput*);

// 65536 pixels with unit normals and directions to the viewer of the upper hemisphere, and the lights and the
// material of the workloads.
class ShadingProblem {
  public:
    ShadingProblem() {
        const Workload& w = workload("1k", kMaxLights);
        std::mt19937 random(1);
        const auto between = [&](double low, double high) { return low + (high - low) * random() * 0x1p-32; };
        for (auto* direction : {&normal_, &toEye_})
            for (size_t i = 0; i < kPixels; i++) {
                const double y = between(0.1, 1), r = std::sqrt(1 - y * y);
                const double angle_rad = between(0, 2 * std::numbers::pi);
                push(*direction, {r * std::cos(angle_rad), y, r * std::sin(angle_rad)});
            }
        for (const SurfaceLight& light : w.scene.lights) {
            push(toLight_, light.toLight);
            push(irradiance_, light.irradiance);
        }
        const SurfaceMaterial& m = w.scene.materials[0];
        input_.count = kPixels;
        input_.lights = w.scene.lights.size();
        input_.exponent = m.exponent;
        input_.scale = (m.exponent + 8) / (8 * std::numbers::pi);
        for (int c = 0; c < 3; c++) {
            radiance_[c].resize(kPixels);
            input_.normal[c] = normal_[c].data();
            input_.toEye[c] = toEye_[c].data();
            input_.toLight[c] = toLight_[c].data();
            input_.irradiance[c] = irradiance_[c].data();
            input_.radiance[c] = radiance_[c].data();
            input_.diffuse[c] = m.diffuse[c];
            input_.specular[c] = m.specular[c];
        }
    }

    static constexpr size_t kPixels = 65536;
    const ShadingInput& input() const { return input_; }
    std::vector<float> radianceOf(Shade shade) {
        shade(&input_);
        std::vector<float> all;
        for (const auto& channel : radiance_) all.insert(all.end(), channel.begin(), channel.end());
        return all;
    }

  private:
    using Vectors = std::vector<float>[3];
    static void push(Vectors& to, const glm::dvec3& v) {
        for (int c = 0; c < 3; c++) to[c].push_back(static_cast<float>(v[c]));
    }
    Vectors normal_, toEye_, toLight_, irradiance_, radiance_;
    ShadingInput input_;
};

void addShading(const char* name, Shade shade) {
    benchmark::RegisterBenchmark(
        (std::string("shading64/") + name).c_str(),
        [=](benchmark::State& state) {
            static ShadingProblem problem;
            static const std::vector<float> exact = problem.radianceOf(etalonShadeExact);
            const std::vector<float> radiance = problem.radianceOf(shade);
            double differing = 0, error = 0;
            for (size_t i = 0; i < exact.size(); i++) {
                differing += radiance[i] != exact[i];
                error = std::max(error, std::fabs(static_cast<double>(radiance[i]) / exact[i] - 1));
            }
            state.counters["differing"] = differing;
            state.counters["error"] = error;
            measure(state, {.pixels = ShadingProblem::kPixels}, [&] {
                shade(&problem.input());
                return problem.input().radiance[0][0];
            });
        })
        ->Unit(benchmark::kMillisecond)
        ->MeasureProcessCPUTime()
        ->UseRealTime();
}

// The library's whole shading of a picture: the same loop, and finding, interpolating and storing the
// fragments.
void addLibrary() {
    benchmark::RegisterBenchmark(
        "shading64/library",
        [](benchmark::State& state) {
            const PlacedWorkload work = place(workload("70k", kMaxLights), "f32");
            const RasterOptions options{.threads = 1};
            const VisibleScene visible = drawDepth(work, 1, options);
            const auto ids = visible.target.id.plane(0);
            const auto background = std::count(ids.begin(), ids.end(), kNoTriangle);
            measure(state, {.pixels = static_cast<double>(ids.size()) - static_cast<double>(background)},
                    [&] { return shadeVisible(work, visible, options); });
        })
        ->Unit(benchmark::kMillisecond)
        ->MeasureProcessCPUTime()
        ->UseRealTime();
}

// The triangles of a workload, snapped to 1/256 pixel. None is clipped.
std::vector<SnappedTriangle> snapped(const Workload& w) {
    constexpr double kSubpixels = 256;
    const PlacedWorkload work = place(w, "f32");
    std::vector<int32_t> x, y;
    UninitializedVector<ClipVertex> vertices;
    toClipSpace(work.placed[0], w.view, RasterReal::fp32, 0, vertices);
    for (const ClipVertex& v : vertices) {
        x.push_back(static_cast<int32_t>(std::nearbyint((v.x / v.w + 1) / 2 * w.view.width * kSubpixels)));
        y.push_back(static_cast<int32_t>(std::nearbyint((1 - v.y / v.w) / 2 * w.view.height * kSubpixels)));
    }
    std::vector<SnappedTriangle> triangles;
    for (size_t i = 0; i < w.mesh().indices.size(); i += 3) {
        SnappedTriangle t;
        for (size_t k = 0; k < 3; k++) {
            t.x[k] = x[w.mesh().indices[i + k]];
            t.y[k] = y[w.mesh().indices[i + k]];
        }
        const int64_t area =
            int64_t{t.x[1] - t.x[0]} * (t.y[2] - t.y[0]) - int64_t{t.y[1] - t.y[0]} * (t.x[2] - t.x[0]);
        if (area < 0) std::swap(t.x[1], t.x[2]), std::swap(t.y[1], t.y[2]);
        if (area != 0) triangles.push_back(t);
    }
    return triangles;
}

void addCoverage(const std::string& workloadName, const char* name, EdgeArithmetic arithmetic) {
    benchmark::RegisterBenchmark(("coverage/" + workloadName + "/" + name).c_str(),
                                 [=](benchmark::State& state) {
                                     const Workload& w = workload(workloadName, 1);
                                     const std::vector<SnappedTriangle> triangles = snapped(w);
                                     std::vector<uint32_t> exact(triangles.size()), covered(triangles.size());
                                     const auto count = [&](EdgeArithmetic a, std::vector<uint32_t>& to) {
                                         etalonCountCovered(triangles.data(), triangles.size(), w.view.width,
                                                            w.view.height, a, to.data());
                                         return to[0];
                                     };
                                     count(EdgeArithmetic::integer64, exact);
                                     count(arithmetic, covered);
                                     double differing = 0, samples = 0;
                                     for (size_t i = 0; i < exact.size(); i++) {
                                         differing += covered[i] != exact[i];
                                         samples += exact[i];
                                     }
                                     state.counters["differing"] = differing;
                                     state.counters["samples"] = samples;
                                     measure(state, {.triangles = static_cast<double>(triangles.size())},
                                             [&] { return count(arithmetic, covered); });
                                 })
        ->Unit(benchmark::kMillisecond)
        ->MeasureProcessCPUTime()
        ->UseRealTime();
}

void addAll() {
    addShading("exact", etalonShadeExact);
    addShading("fused", etalonShadeFused);
    addShading("approximate", etalonShadeApproximate);
    addShading("fast", etalonShadeFast);
#if defined(ETALON_BENCH_BY_HAND)
    addShading("by-hand", etalonShadeByHand);
#endif
    addLibrary();
    for (const char* name : {"70k", "870k", "large"}) {
        addCoverage(name, "integer64", EdgeArithmetic::integer64);
        addCoverage(name, "integer32", EdgeArithmetic::integer32);
        addCoverage(name, "float", EdgeArithmetic::real32);
    }
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
