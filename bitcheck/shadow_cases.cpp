// Shadow maps: what lights see, and what shading gets of them.
#include <string>

#include "bitcheck/bit_case.h"
#include "bitcheck/inputs.h"
#include "lighting/render_view.h"
#include "raster/blur.h"
#include "shadows/screen_mask.h"
#include "shadows/shadow_maps.h"

namespace etalon {
namespace {

// The demo scene's lights with a lamp above the knot, and one in a cone.
SurfaceScene scene() {
    SurfaceScene scene = demoScene();
    SurfaceLight lamp;
    lamp.kind = LightKind::point;
    lamp.position_m = {0.25, 2, 0.5};
    lamp.intensity = glm::dvec3(2);
    scene.lights.push_back(lamp);
    lamp.kind = LightKind::spot;
    lamp.position_m = {-2, 3, 1};
    lamp.axis = {0.48, -0.8, -0.36};
    lamp.cosInner = 0.95;
    lamp.cosOuter = 0.8;
    scene.lights.push_back(lamp);
    return scene;
}

ShadowMapSettings settingsOf(ShadowDepth depth, ShadowFilter filter, int size) {
    ShadowMapSettings settings;
    settings.size = size;
    settings.depth = depth;
    settings.filter = filter;
    settings.bias = {2, 0.5, 0};
    settings.receiverPlane = true;
    settings.lightSize_m = 0.2;
    settings.tangentOfHalfAngle = 0.02;
    settings.taps = filter == ShadowFilter::disc || filter == ShadowFilter::soft ? 12 : 4;
    settings.seed = 5;
    return settings;
}

std::vector<BitPlane> mapsOf(const RasterOptions& options) {
    const SurfaceScene lit = scene();
    const Profile& profile = profiles().front();
    const auto placed = placeMeshes(lit, profile.vertex, options.threads);
    std::vector<BitPlane> planes;
    for (size_t l = 0; l < lit.lights.size(); l++)
        for (const auto& [name, depth] :
             {std::pair("d16", ShadowDepth::d16), std::pair("d24", ShadowDepth::d24),
              std::pair("d32f", ShadowDepth::d32f), std::pair("linear", ShadowDepth::linear)}) {
            const ShadowMap map = renderShadowMap(lit, placed, lit.lights[l], {},
                                                  settingsOf(depth, ShadowFilter::pcf, 40), profile, options);
            for (size_t layer = 0; layer < map.layers.size(); layer++) {
                const std::string plane =
                    std::string(name) + "-" + std::to_string(l) + "-" + std::to_string(layer);
                if (!map.layers[layer].stored.empty())
                    planes.push_back(planeOf(plane, map.layers[layer].stored));
                if (!map.layers[layer].distance_m.empty())
                    planes.push_back(planeOf(plane, map.layers[layer].distance_m));
            }
        }
    return planes;
}

// The lit part of every pixel, for each light and filter; the last ones blurred in the image.
std::vector<BitPlane> masksOf(const Profile& profile, int width, int height, int size,
                              const RasterOptions& options) {
    const SurfaceScene lit = scene();
    const auto placed = placeMeshes(lit, profile.vertex, options.threads);
    const View view = demoView(width, height);
    const VisibleScene visible = findVisible(lit, placed, view, profile, 1, options);
    std::vector<BitPlane> planes;
    for (const auto& [name, filter] :
         {std::pair("hard", ShadowFilter::hard), std::pair("pcf", ShadowFilter::pcf),
          std::pair("disc", ShadowFilter::disc), std::pair("soft", ShadowFilter::soft)})
        for (const auto& [depthName, depth] :
             {std::pair("d24", ShadowDepth::d24), std::pair("linear", ShadowDepth::linear)}) {
            ShadowMaps maps(lit.lights.size());
            for (size_t l = 0; l < lit.lights.size(); l++)
                maps.set(l,
                         renderShadowMap(lit, placed, lit.lights[l], {}, settingsOf(depth, filter, size),
                                         profile, options),
                         profile, options.threads);
            ShadeJob job = shadeJobOf(visible, lit, placed, view, profile, options);
            job.visibility = &maps;
            for (size_t l = 0; l < lit.lights.size(); l++)
                planes.push_back(planeOf(std::string(name) + "-" + depthName + "-" + std::to_string(l),
                                         screenMask(job, l)));
        }
    return planes;
}

std::vector<BitPlane> blurredMask(const RasterOptions& options) {
    const SurfaceScene lit = scene();
    const Profile& profile = profiles().front();
    const auto placed = placeMeshes(lit, profile.vertex, options.threads);
    const View view = demoView(96, 80);
    const VisibleScene visible = findVisible(lit, placed, view, profile, 1, options);
    ShadowMaps maps(lit.lights.size());
    maps.set(0,
             renderShadowMap(lit, placed, lit.lights[0], {},
                             settingsOf(ShadowDepth::d24, ShadowFilter::hard, 64), profile, options),
             profile, options.threads);
    ShadeJob job = shadeJobOf(visible, lit, placed, view, profile, options);
    job.visibility = &maps;
    ScreenMasks masks(lit.lights.size());
    masks.set(0, blurGaussian(screenMask(job, 0), 4, 1.5, options.threads));
    job.visibility = &masks;
    job.request[ShadeOutput::beauty] = true;
    return {planeOf("beauty", shade(job)[ShadeOutput::beauty])};
}

}  // namespace

void addShadowCases(std::vector<BitCase>& cases) {
    const auto add = [&](std::string name, std::string what, auto run) {
        cases.push_back({std::move(name), std::move(what), true, true, true, std::move(run)});
    };
    const std::string first(profiles().front().name);
    add("shadow-map/" + first, "maps of far, point and spot lights in every format", mapsOf);
    add("shadow-mask/" + first, "a mask in the image, blurred and composed", blurredMask);
    for (const Profile& profile : profiles()) {
        const bool isTruth = profile.fragment == Arithmetic::truth;
        add("shadow-filter/" + std::string(profile.name),
            "look-ups with every filter, in depths and distances",
            [&profile, isTruth](const RasterOptions& options) {
                return isTruth ? masksOf(profile, 18, 10, 16, options)
                               : masksOf(profile, 40, 32, 40, options);
            });
    }
}

}  // namespace etalon
