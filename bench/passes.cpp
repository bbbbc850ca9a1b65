#include "bench/passes.h"

#include <random>

#include "numeric/check.h"

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

Image<float> blurInput() { return randomImage(kBlurSize, kBlurSize, 1); }

Image<float> latLongInput() { return randomImage(kLatLongWidth, kLatLongHeight, 3); }

Probe probeInput(const ProbeShape& shape) {
    Probe probe;
    probe.shape = shape;
    probe.radiance.assign(static_cast<size_t>(shape.layers()), randomImage(shape.width, shape.height, 3));
    return probe;
}

}  // namespace etalon::bench
