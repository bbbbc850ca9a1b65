// A scene as one view shows it, shaded.
#pragma once

#include <functional>
#include <initializer_list>
#include <vector>

#include "lighting/render_view.h"
#include "numeric/format.h"

namespace etalon::test {

// A camera at the origin that looks along -Z with a field of view of 90 degrees.
inline View squareView(int size) {
    PinholeCamera camera;
    camera.width = camera.height = size;
    camera.fx = camera.fy = camera.cx = camera.cy = size / 2.0;
    return cameraView(camera);
}

enum class Lights { perPixel, perVertex };

struct Rendered {
    ShadedImages images;
    ShadeStatistics statistics;
};

// prepare: sets what else the view is shaded with.
inline Rendered render(const SurfaceScene& scene, const View& view, const ShadeRequest& request,
                       const char* profileName = "f32", int samples = 1, const RasterOptions& options = {},
                       Lights lights = Lights::perPixel, const std::function<void(ShadeJob&)>& prepare = {}) {
    const Profile& profile = *findProfile(profileName);
    const auto placed = placeMeshes(scene, profile.vertex, options.threads);
    const VisibleScene visible = findVisible(scene, placed, view, profile, samples, options);
    ShadeJob job = shadeJobOf(visible, scene, placed, view, profile, options);
    job.request = request;
    if (prepare) prepare(job);
    std::vector<VertexRadiance> radiance;
    if (lights == Lights::perVertex) {
        radiance = lightVerticesOf(job);
        job.vertexRadiance = &radiance;
    }
    Rendered result;
    result.images = shade(job, &result.statistics);
    return result;
}

inline ShadeRequest requestOf(std::initializer_list<ShadeOutput> outputs) {
    ShadeRequest request;
    for (ShadeOutput output : outputs) request[output] = true;
    return request;
}

inline const char* const kAllProfiles[] = {"f32",       "f64",       "truth",     "d3d11", "vulkan-min",
                                           "nv40-fp32", "nv40-fp16", "r300-fp24", "fp16",  "bf16"};

// How far apart the numbers of a profile's images are from 1 on: those of its fragment format, or of float.
inline double spacingOf(const char* profileName) {
    const Arithmetic& fragment = findProfile(profileName)->fragment;
    return fragment.format ? epsilonOf(*fragment.format) : 0x1p-23;
}

}  // namespace etalon::test
