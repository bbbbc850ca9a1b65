// Measures the passes of a Vulkan driver, the peer. Names are pass/workload. Each picture is compared with
// Etalon's before; what was found stands in the context of the report.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "bench/measure.h"
#include "bench/peer/peer_passes.h"
#include "numeric/check.h"
#include "numeric/text.h"
#include "probes/latlong.h"
#include "raster/blur.h"

namespace etalon::bench {
namespace {

struct Peer {
    explicit Peer(VulkanDevice& d) : device(d), passes(d) {}
    VulkanDevice& device;
    PeerPasses passes;
};

void note(const std::string& pass, const std::string& text) {
    benchmark::AddCustomContext("picture " + pass, text);
}

// "what: N of M differ by more than bound, at most D".
class Differences {
  public:
    explicit Differences(double bound) : bound_(bound) {}
    void add(double ours, double theirs) {
        const double difference = std::fabs(ours - theirs);
        count_++;
        differing_ += !(difference <= bound_);
        largest_ = std::max(largest_, difference);
    }
    std::string text() const {
        return formatText("{} of {} values differ from Etalon's by more than {}, at most by {:.2g}",
                          differing_, count_, bound_, largest_);
    }

  private:
    double bound_, largest_ = 0;
    size_t count_ = 0, differing_ = 0;
};

void compareDepth(Peer& peer, const PeerPass& pass, const std::string& name, const Workload& w) {
    peer.device.run(pass.commands);
    const std::vector<float> depth = peer.device.download(pass.depth, 1);
    const VisibleScene visible = drawDepth(place(w, "f32"), 1, {});
    const auto ids = visible.target.id.plane(0);
    size_t theirs = 0, ours = 0, differing = 0;
    for (size_t i = 0; i < depth.size(); i++) {
        const bool inTheirs = depth[i] < 1, inOurs = ids[i] != kNoTriangle;
        theirs += inTheirs;
        ours += inOurs;
        differing += inTheirs != inOurs;
    }
    note(name, formatText("covers {} pixels, Etalon {}; {} differ", theirs, ours, differing));
}

// Radiance where both have drawn.
void compareShaded(Peer& peer, const PeerPass& pass, const std::string& name, const Workload& w,
                   int samples) {
    constexpr double kBound = 0.01;
    peer.device.run(pass.commands);
    const std::vector<float> colour = peer.device.download(pass.colour, 4);
    const PlacedWorkload work = place(w, "f32");
    const ShadedImages images = shadeVisible(work, drawDepth(work, samples, {}), {});
    const Image<float>& beauty = images[ShadeOutput::beauty];
    Differences differences(kBound);
    for (int c = 0; c < 3; c++)
        for (size_t i = 0; i < beauty.pixelCount(); i++) {
            const double ours = beauty.plane(c)[i], theirs = colour[4 * i + static_cast<size_t>(c)];
            if (ours != 0 && theirs != 0) differences.add(ours, theirs);
        }
    note(name, differences.text());
}

// The last face, -Z.
void compareCube(Peer& peer, const PeerPass& pass, const std::string& name, const Workload& w) {
    constexpr double kBound = 0.01;
    peer.device.run(pass.commands);
    const std::vector<float> colour = peer.device.download(pass.colour, 4);
    const CubeRender cube = drawCube(place(w, "f32"), {});
    Differences differences(kBound);
    const Image<float>& face = cube.radiance.faces.back();
    for (int c = 0; c < 3; c++)
        for (size_t i = 0; i < face.pixelCount(); i++)
            differences.add(face.plane(c)[i], colour[4 * i + static_cast<size_t>(c)]);
    note(name, differences.text());
}

void compareBlur(Peer& peer, const PeerPass& pass, const std::string& name) {
    constexpr double kBound = 1e-5;
    peer.device.run(pass.commands);
    const std::vector<float> theirs = peer.device.download(pass.colour, 1);
    const Image<float> ours = blurGaussian(blurInput(), kBlurRadius, kBlurSigma);
    Differences differences(kBound);
    for (size_t i = 0; i < theirs.size(); i++) differences.add(ours.values()[i], theirs[i]);
    note(name, differences.text());
}

// Texels are independent random numbers, so that a shift of a thousandth of a texel shows.
void compareCubeFromLatLong(Peer& peer, const PeerPass& pass, const std::string& name) {
    constexpr double kBound = 0.02;
    peer.device.run(pass.commands);
    const std::vector<float> theirs = peer.device.download(pass.colour, 4);
    const CubeMap<float> ours = cubeFromLatLong(latLongInput(), kLatLongCubeSize);
    Differences differences(kBound);
    for (size_t face = 0; face < ours.faces.size(); face++)
        for (int c = 0; c < 3; c++) {
            const auto plane = ours.faces[face].plane(c);
            for (size_t i = 0; i < plane.size(); i++)
                differences.add(plane[i], theirs[4 * (face * plane.size() + i) + static_cast<size_t>(c)]);
        }
    note(name, differences.text());
}

void add(Peer& peer, const std::string& name, VkCommandBuffer commands) {
    benchmark::RegisterBenchmark(name.c_str(),
                                 [&peer, commands](benchmark::State& state) {
                                     for (auto _ : state) peer.device.run(commands);
                                 })
        ->Unit(benchmark::kMillisecond)
        ->MeasureProcessCPUTime()
        ->UseRealTime();
}

void addAll(Peer& peer) {
    for (const char* name : {"1k", "70k", "870k", "large", "sub-pixel"}) {
        const Workload& w = workload(name, 1);
        const PeerPass depth = peer.passes.depth(w, 1);
        compareDepth(peer, depth, std::string("depth/") + name, w);
        add(peer, std::string("depth/") + name, depth.commands);
    }
    const auto addShaded = [&](const char* workloadName, int lights, int samples, const std::string& name) {
        const Workload& w = workload(workloadName, lights);
        const PeerPass pass = peer.passes.shaded(w, samples);
        compareShaded(peer, pass, name, w, samples);
        add(peer, name, pass.commands);
    };
    for (const char* name : {"1k", "70k", "870k", "large", "sub-pixel"})
        addShaded(name, 1, 1, std::string("lights1/") + name);
    for (const char* name : {"1k", "70k", "870k"}) addShaded(name, 64, 1, std::string("lights64/") + name);
    add(peer, "depth-msaa4/70k", peer.passes.depth(workload("70k", 1), 4).commands);
    addShaded("70k", 1, 4, "lights1-msaa4/70k");

    const PeerPass layers = peer.passes.depth(workload("layers", 1), 1);
    compareDepth(peer, layers, "fill/layers", workload("layers", 1));
    add(peer, "fill/layers", layers.commands);
    const PeerPass cube = peer.passes.cube(workload("70k", 1));
    compareCube(peer, cube, "cube/70k", workload("70k", 1));
    add(peer, "cube/70k", cube.commands);
    const PeerPass blur = peer.passes.blur();
    compareBlur(peer, blur, "blur/1024");
    add(peer, "blur/1024", blur.commands);
    const PeerPass latLong = peer.passes.cubeFromLatLong();
    compareCubeFromLatLong(peer, latLong, "latlong-to-cube/1024");
    add(peer, "latlong-to-cube/1024", latLong.commands);
}

}  // namespace
}  // namespace etalon::bench

int main(int argc, char** argv) {
    using namespace etalon;
    benchmark::Initialize(&argc, argv);
    if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
    try {
        bench::VulkanDevice device;
        benchmark::AddCustomContext("device", device.name());
        bench::Peer peer(device);
        bench::addAll(peer);
        benchmark::RunSpecifiedBenchmarks();
        benchmark::Shutdown();
    } catch (const InputError& error) {
        printText(stderr, "etalon_bench_peer: {}\n", error.what());
        return 2;
    }
    return 0;
}
