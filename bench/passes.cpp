#include "bench/passes.h"

#include <random>

#include "lighting/lit_points.h"
#include "numeric/check.h"
#include "shadows/light_samples.h"

namespace etalon::bench {
namespace {

Image<float> randomImage(int width, int height, int channels) {
    Image<float> image(width, height, channels);
    std::mt19937 random(1);
    for (float& value : image.values()) value = static_cast<float>(random()) * 0x1p-32f;
    return image;
}

}  // namespace

PlacedWorkload place(const Workload& workload, const std::string& profile) {
    const Profile* found = findProfile(profile);
    ETALON_CHECK(found, "no profile is called {}", profile);
    return {&workload, found, placeMeshes(workload.scene, found->vertex, 0)};
}

VisibleScene drawDepth(const PlacedWorkload& work, int samples, const RasterOptions& options) {
    return findVisible(work.workload->scene, work.placed, work.workload->view, *work.profile, samples,
                       options);
}

void drawDepth(VisibleScene& visible, const PlacedWorkload& work, int samples, const RasterOptions& options) {
    findVisible(visible, work.workload->scene, work.placed, work.workload->view, *work.profile, samples,
                options);
}

ShadedImages shadeVisible(const PlacedWorkload& work, const VisibleScene& visible,
                          const RasterOptions& options) {
    ShadeJob job =
        shadeJobOf(visible, work.workload->scene, work.placed, work.workload->view, *work.profile, options);
    job.request[ShadeOutput::beauty] = true;
    return shade(job);
}

ShadowMapSettings shadowSettings() {
    ShadowMapSettings settings;
    settings.size = kShadowMapSize;
    settings.bias = {2, 1, 0};
    settings.receiverPlane = true;
    return settings;
}

ShadowMap drawShadowMap(const PlacedWorkload& work, const RasterOptions& options) {
    const SurfaceScene& scene = work.workload->scene;
    return renderShadowMap(scene, work.placed, scene.lights[0], {}, shadowSettings(), *work.profile, options);
}

ShadowMaps readyForLookUp(const PlacedWorkload& work, ShadowMap map, const RasterOptions& options) {
    ShadowMaps maps(work.workload->scene.lights.size());
    maps.set(0, std::move(map), *work.profile, options.threads);
    return maps;
}

ShadedImages shadeVisible(const PlacedWorkload& work, const VisibleScene& visible,
                          const LightVisibility& shadows, const RasterOptions& options) {
    ShadeJob job =
        shadeJobOf(visible, work.workload->scene, work.placed, work.workload->view, *work.profile, options);
    job.request[ShadeOutput::beauty] = true;
    job.visibility = &shadows;
    return shade(job);
}

LitPoints visiblePoints(const PlacedWorkload& work, const VisibleScene& visible) {
    return litPointsOf(
        shadeJobOf(visible, work.workload->scene, work.placed, work.workload->view, *work.profile, {}));
}

CubeRenderRequest cubeRequest() {
    CubeRenderRequest request;
    request.centre = {0, 0, 0};
    request.size = kCubeSize;
    request.near_m = 0.05;
    request.far_m = 20;
    return request;
}

CubeRender drawCube(const PlacedWorkload& work, const RasterOptions& options) {
    return renderCubeMap(work.workload->scene, work.placed, cubeRequest(), nullptr, *work.profile, options);
}

PlanarWork planarWork(const PlacedWorkload& work, int samples) {
    constexpr double kGround_m = -1.3, kHalfSize_m = 3;
    PlanarWork result;
    result.receiver.frame = planeFrame({0, kGround_m, 0}, {0, 1, 0});
    result.receiver.corners_m = {{-kHalfSize_m, -kHalfSize_m},
                                 {kHalfSize_m, -kHalfSize_m},
                                 {kHalfSize_m, kHalfSize_m},
                                 {-kHalfSize_m, kHalfSize_m}};
    result.receiver.indices = {0, 1, 2, 0, 2, 3};
    const PlacedMesh* mesh = &work.placed[0];
    result.casters = castersAbove(result.receiver.frame, {&mesh, 1}, PlanarShadowOptions().contact_m);
    const RectangularPatch patch{{1, 4, 0.5}, {0.5, 0, 0}, {0, 0, 0.5}};
    result.lights = lightSamples(patch, samples, 1);
    result.profile = work.profile;
    return result;
}

PlanarShadow drawPlanarShadow(const PlanarWork& work, double blur_m, const RasterOptions& options) {
    PlanarShadowOptions planar;
    planar.resolution = kPlanarResolution;
    planar.blurSigma_m = blur_m;
    return planarShadow(work.receiver, work.casters, work.lights, planar, *work.profile, options);
}

Image<float> blurInput() { return randomImage(kBlurSize, kBlurSize, 1); }

Image<float> latLongInput() { return randomImage(kLatLongWidth, kLatLongHeight, 3); }

Probe probeInput(const ProbeShape& shape) {
    Probe probe;
    probe.shape = shape;
    probe.radiance.assign(static_cast<size_t>(shape.layers()), randomImage(shape.width, shape.height, 3));
    return probe;
}

}  // namespace etalon::bench
