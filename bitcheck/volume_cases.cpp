// The visibility oracle, shadow volumes and ambient occlusion.
#include <array>

#include "bitcheck/bit_case.h"
#include "bitcheck/inputs.h"
#include "shadows/ambient_occlusion.h"
#include "shadows/volume_shadows.h"

namespace etalon {
namespace {

constexpr int kSize_px = 96;

// The demo scene with a point light inside the knot's hole and a spot among its directional lights.
SurfaceScene shadowScene() {
    SurfaceScene scene = demoScene();
    SurfaceLight point, spot;
    point.kind = LightKind::point;
    point.position_m = {0.1, 1.6, 0.2};
    spot.kind = LightKind::spot;
    spot.position_m = {-1.8, 0.55, 1.05};  // inside a ball
    scene.lights.push_back(point);
    scene.lights.push_back(spot);
    return scene;
}

std::vector<BitPlane> countVolumes(VolumeCounting counting, const Profile& profile, int samples,
                                   const RasterOptions& options) {
    const SurfaceScene scene = shadowScene();
    const auto placed = placeMeshes(scene, profile.vertex, options.threads);
    VolumeShadowOptions volume;
    volume.counting = counting;
    volume.samples = samples;
    const VolumeShadows shadows(scene, placed, demoView(kSize_px, kSize_px), profile, volume, options);
    std::vector<BitPlane> planes;
    for (size_t l = 0; l < scene.lights.size(); l++)
        planes.push_back(planeOf("light" + std::to_string(l), shadows.mask(l)));
    return planes;
}

std::vector<BitPlane> askOracle() {
    const SurfaceScene scene = shadowScene();
    const VisibilityOracle oracle(worldTriangles(placeMeshes(scene, RasterReal::fp64, 1)));
    Image<uint32_t> blockers(kSize_px, kSize_px, static_cast<int>(scene.lights.size()));
    for (size_t l = 0; l < scene.lights.size(); l++)
        for (int y = 0; y < kSize_px; y++)
            for (int x = 0; x < kSize_px; x++)
                blockers.at(x, y, static_cast<int>(l)) = static_cast<uint32_t>(
                    oracle.blockers({x / 16.0 - 3, 0, y / 16.0 - 3}, lightSourceOf(scene.lights[l])));
    return {planeOf("blockers", blockers, "light")};
}

std::vector<BitPlane> planesOf(const std::vector<Occlusion>& occlusion) {
    std::array<std::vector<double>, 4> values;
    for (const Occlusion& o : occlusion) {
        values[0].push_back(o.open);
        for (int c = 0; c < 3; c++) values[static_cast<size_t>(c) + 1].push_back(o.bentNormal[c]);
    }
    std::vector<BitPlane> planes;
    for (size_t i = 0; i < values.size(); i++)
        planes.push_back(planeOf(std::array{"open", "bent-x", "bent-y", "bent-z"}[i], values[i], 32));
    return planes;
}

}  // namespace

void addVolumeCases(std::vector<BitCase>& cases) {
    const Profile &fp32 = *findProfile("f32"), &fp64 = *findProfile("f64"), &truth = *findProfile("truth");
    Profile reversed = fp32;
    reversed.depthDirection = DepthDirection::reversed;
    cases.push_back({"shadows/volumes", "shadow volumes, z-fail", true, true, true,
                     [&fp32](const RasterOptions& options) {
                         return countVolumes(VolumeCounting::zFail, fp32, 1, options);
                     }});
    cases.push_back({"shadows/volumes-pass-fp64-4", "the same, z-pass, f64, 4 samples", true, true, true,
                     [&fp64](const RasterOptions& options) {
                         return countVolumes(VolumeCounting::zPass, fp64, 4, options);
                     }});
    cases.push_back({"shadows/volumes-reversed", "the same, z-fail, f32 with reversed depths", true, true,
                     true, [reversed](const RasterOptions& options) {
                         return countVolumes(VolumeCounting::zFail, reversed, 1, options);
                     }});
    cases.push_back({"shadows/volumes-truth", "the same, z-fail, truth", true, true, true,
                     [&truth](const RasterOptions& options) {
                         return countVolumes(VolumeCounting::zFail, truth, 1, options);
                     }});
    cases.push_back({"shadows/oracle", "triangles between points and lights", false, false, false,
                     [](const RasterOptions&) { return askOracle(); }});
    cases.push_back({"shadows/hemicube", "ambient occlusion and bent normals of a knot's vertices", true,
                     true, false, [](const RasterOptions& options) {
                         const SurfaceScene scene = demoScene();
                         const auto placed = placeMeshes(scene, RasterReal::fp64, options.threads);
                         auto points = occlusionPointsOf(placed[0]);
                         points.resize(64);
                         HemicubeOptions hemicube;
                         hemicube.size = 16;
                         hemicube.threads = options.threads;
                         return planesOf(hemicubeOcclusion(placed, points, hemicube));
                     }});
    cases.push_back({"shadows/directions", "the same from many directions", true, true, true,
                     [](const RasterOptions& options) {
                         const SurfaceScene scene = demoScene();
                         const auto placed = placeMeshes(scene, RasterReal::fp64, options.threads);
                         DirectionalOptions directional;
                         directional.directions = 24;
                         directional.mapSize = 128;
                         directional.raster = options;
                         return planesOf(
                             directionalOcclusion(placed, occlusionPointsOf(placed[0]), directional));
                     }});
}

}  // namespace etalon
