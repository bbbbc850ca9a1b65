// The rows of etalon_bench about shadows.
#include "bench/measure.h"
#include "bench/passes.h"
#include "bench/rows.h"
#include "shadows/ambient_occlusion.h"
#include "shadows/volume_shadows.h"

namespace etalon::bench {
namespace {

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

}  // namespace

void addShadowRows(const Way& way) {
    for (const char* name : {"70k", "870k"}) {
        addShadowMap(name, way);
        addShadowedFrame(name, way);
    }
    addPcf("70k", way);
    addVolumes("70k", way);
    addDirectionalOcclusion("70k", way);
    addHemicubeOcclusion("1k", way);
    for (const char* name : {"1k", "70k"}) {
        addPlanar(name, 256, 0, way);
        addPlanar(name, 25, 0, way);
        addPlanar(name, 25, kPlanarBlur_m, way);
    }
}

void addShadowRowsOfLevel(const Way& way) { addPcf("70k", way); }

}  // namespace etalon::bench
