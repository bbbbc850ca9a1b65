// A cube map of 1024 texels along a face from a lat-long image of 4096 x 2048, by Etalon and by other
// libraries, in one run. The image stores its own directions, so that each result shows where its samples
// were taken.
#include "bench/probe_peers/probe_peers.h"

#include <algorithm>
#include <cmath>

#include "bench/measure.h"
#include "bench/passes.h"
#include "probes/convert.h"
#include "probes/texel_grid.h"

namespace etalon::bench {
namespace {

Probe directionsOf(const ProbeShape& shape) {
    const TexelGrid grid(shape);
    Probe probe;
    probe.shape = shape;
    Image<float>& image = probe.radiance.emplace_back(shape.width, shape.height, 3);
    for (int y = 0; y < shape.height; y++)
        for (int x = 0; x < shape.width; x++) {
            const glm::dvec3 d = grid.direction(0, x, y);
            for (int c = 0; c < 3; c++) image.at(x, y, c) = static_cast<float>(d[c]);
        }
    return probe;
}

// The largest angle between a texel's direction and the one that it shows, in texels of the lat-long image's
// equator.
double largestError_texels(const Probe& cube) {
    const TexelGrid grid(cube.shape);
    double largest = 0;
    for (int layer = 0; layer < cube.shape.layers(); layer++)
        for (int y = 0; y < cube.shape.height; y++)
            for (int x = 0; x < cube.shape.width; x++) {
                const glm::dvec3 a = grid.direction(layer, x, y);
                const Image<float>& face = cube.radiance[static_cast<size_t>(layer)];
                const glm::dvec3 b(face.at(x, y, 0), face.at(x, y, 1), face.at(x, y, 2));
                const glm::dvec3 n(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
                largest = std::max(largest, std::sqrt(n.x * n.x + n.y * n.y + n.z * n.z));
            }
    return largest * kLargeLatLong.width / (2 * M_PI);
}

void addMaker(const std::string& name, const CubeMaker& make, const Probe& empty, bool writesInto) {
    Probe cube = empty;
    make(cube);
    const double error = largestError_texels(cube);
    benchmark::RegisterBenchmark(("latlong-cube/" + name).c_str(),
                                 [=](benchmark::State& state) {
                                     constexpr double kTexels = 6.0 * kLargeCube.width * kLargeCube.height;
                                     Probe into = writesInto ? empty : Probe{};
                                     state.counters["error_texels"] = error;
                                     measure(state, {.pixels = kTexels}, [&] {
                                         make(into);
                                         return into.radiance.size();
                                     });
                                 })
        ->Unit(benchmark::kMillisecond)
        ->MeasureProcessCPUTime()
        ->UseRealTime();
}

void addAll() {
    const Probe latLong = directionsOf(kLargeLatLong);
    Probe empty;
    empty.shape = kLargeCube;
    empty.radiance.assign(6, Image<float>(kLargeCube.width, kLargeCube.height, 3));
    addMaker(
        "etalon",
        [=](Probe& cube) {
            convertProbe(cube, latLong, {.shape = kLargeCube, .resampling = Resampling::bilinear},
                         Arithmetic::fp32, 1);
        },
        empty, true);
#ifdef ETALON_HAS_OPENCV
    addMaker("opencv", openCvCubes(latLong, kLargeCube), empty, false);
#endif
#ifdef ETALON_HAS_OPENIMAGEIO
    addMaker("openimageio", openImageIoCubes(latLong), empty, true);
#endif
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
