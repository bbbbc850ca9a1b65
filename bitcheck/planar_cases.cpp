// Planar shadows of area lights: counts of blocked samples, their texture and its look-up.
#include <string>
#include <vector>

#include "bitcheck/bit_case.h"
#include "bitcheck/inputs.h"
#include "shadows/light_samples.h"
#include "shadows/planar_visibility.h"

namespace etalon {
namespace {

// The first plane of the demo scene, and what casts on it.
struct PlanarDemo {
    uint32_t instance = 0;
    PlanarReceiver receiver;
    PlanarCasters casters;
    std::vector<glm::dvec4> lights;
};

PlanarDemo planarDemo(const Profile& profile, const PlanarShadowOptions& options, int threads) {
    const SurfaceScene scene = demoScene();
    const auto placed = placeMeshes(scene, profile.vertex, threads);
    PlanarDemo demo;
    while (!planarReceiverOf(placed.at(demo.instance))) demo.instance++;
    demo.receiver = *planarReceiverOf(placed[demo.instance]);
    if (demo.receiver.frame.normal.y < 0) demo.receiver = demo.receiver.reversed();
    std::vector<const PlacedMesh*> others;
    for (size_t i = 0; i < placed.size(); i++)
        if (i != demo.instance) others.push_back(&placed[i]);
    demo.casters = castersAbove(demo.receiver.frame, others, options.contact_m);
    // A patch above, some samples of it lower than the casters, and one of the sky.
    demo.lights = lightSamples(RectangularPatch{{0.4, 1.6, 0.7}, {0.5, 1.2, 0}, {0, 0, 0.6}}, 20, 5);
    for (const glm::dvec4& light : lightSamples(SphericalPatch{{0, 0, 0}, 4, {-1, 2, 1}, 0.2, 0.1}, 9, 6))
        demo.lights.push_back(light);
    return demo;
}

std::vector<BitPlane> counts(const Profile& profile, const RasterOptions& raster) {
    std::vector<BitPlane> planes;
    PlanarShadowOptions options;
    options.resolution = 100;
    for (const int positions : {1, 4}) {
        options.samplesPerTexel = positions;
        const PlanarDemo demo = planarDemo(profile, options, raster.threads);
        const BlockedSamples blocked =
            countBlocked(demo.receiver, demo.casters, demo.lights, options, profile, raster);
        planes.push_back(planeOf("positions-" + std::to_string(positions), blocked.blocked, "texel"));
    }
    return planes;
}

std::vector<BitPlane> shadowAndLookUp(const Profile& profile, const RasterOptions& raster) {
    PlanarShadowOptions options;
    options.resolution = 64;
    options.blurSigma_m = 0.1;
    const PlanarDemo demo = planarDemo(profile, options, raster.threads);
    const PlanarShadow shadow =
        planarShadow(demo.receiver, demo.casters, demo.lights, options, profile, raster);
    // Points between the texels, some beyond the texture.
    LitPoints points;
    for (int i = 0; i < 4096; i++) {
        const int column = i % 64, row = i / 64;
        const glm::dvec3 p = shadow.grid.toWorld(-8.0 + column * (80.0 / 64), -8.0 + row * (80.0 / 64));
        for (int c = 0; c < 3; c++) points.position_m[static_cast<size_t>(c)].push_back(p[c]);
        points.instance.push_back(demo.instance);
    }
    std::vector<PlanarVisibility::Entry> entries(1);
    entries[0] = {0, demo.instance, shadow};
    std::vector<double> visibility(points.size());
    PlanarVisibility(std::move(entries), profile).find(0, points, visibility);
    const std::vector<WeightedShadow> weighted = {{&shadow, 0.75}, {&shadow, 0.5}};
    return {planeOf("shadow", shadow.shadow), planeOf("visibility", visibility, 64),
            planeOf("composed", composeShadows(demo.receiver, shadow.grid, weighted, profile, raster))};
}

}  // namespace

void addPlanarCases(std::vector<BitCase>& cases) {
    for (const char* name : {"f32", "f64", "vulkan-min"})
        cases.push_back({"planar-counts/" + std::string(name), "blocked samples of an area light on a plane",
                         true, true, true,
                         [=](const RasterOptions& options) { return counts(*findProfile(name), options); }});
    for (const Profile& profile : profiles())
        cases.push_back(
            {"planar-shadow/" + std::string(profile.name),
             "blurred shadow on a plane, its look-up and composition", true, true, true,
             [&profile](const RasterOptions& options) { return shadowAndLookUp(profile, options); }});
}

}  // namespace etalon
