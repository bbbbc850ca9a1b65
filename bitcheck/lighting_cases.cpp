// What lights surfaces besides lights, and where they are lit: environments, occlusion, vertices.
#include <string>

#include "bitcheck/bit_case.h"
#include "bitcheck/inputs.h"
#include "lighting/render_view.h"
#include "probes/harmonics_lobes.h"
#include "probes/irradiance.h"
#include "probes/texel_grid.h"
#include "shadows/surface_occlusion.h"

namespace etalon {
namespace {

constexpr int kSkyWidth = 8, kSkyHeight = 4, kMapSize = 5;

Probe skyProbe() {
    Probe probe;
    probe.shape = {Mapping::latLong, kSkyWidth, kSkyHeight};
    probe.radiance.push_back(skyImage(kSkyWidth, kSkyHeight));
    return probe;
}

EnvironmentLight harmonicsLight() {
    EnvironmentLight light;
    light.kind = EnvironmentLight::Kind::harmonics;
    light.harmonics = irradianceOfHarmonics(projectHarmonics(skyProbe(), 2, 1));
    return light;
}
EnvironmentLight texelsLight() {
    const Probe probe = skyProbe();
    const TexelGrid grid(probe.shape);
    EnvironmentLight light;
    light.kind = EnvironmentLight::Kind::texels;
    for (int y = 0; y < kSkyHeight; y++)
        for (int x = 0; x < kSkyWidth; x++) {
            light.directions.push_back(grid.direction(0, x, y));
            glm::dvec3& flux = light.flux.emplace_back();
            for (int c = 0; c < 3; c++)
                flux[c] = double{probe.radiance[0].at(x, y, c)} * grid.solidAngle_sr(0, x, y);
        }
    return light;
}
EnvironmentLight mapLight() {
    EnvironmentLight light;
    light.kind = EnvironmentLight::Kind::map;
    const Probe map = irradianceProbe(skyProbe(), {Mapping::cube, kMapSize, kMapSize}, Arithmetic::fp64, 1);
    for (size_t f = 0; f < light.map.faces.size(); f++) light.map.faces[f] = map.radiance[f];
    return light;
}

// Eighths: open to one part in eight at least.
Occlusion openOf(uint32_t eighths, const glm::dvec3& bentNormal) {
    return {(1 + eighths % 8) / 8.0, bentNormal};
}
// Pixels are open by their place; what is open lies along the normal of the triangle.
TileOcclusion occlusionOfFragments(const ShadeJob& job) {
    TileOcclusion occlusion;
    for (const LitPoints& points : fragmentPoints(job)) {
        std::vector<Occlusion>& tile = occlusion.emplace_back();
        for (size_t i = 0; i < points.size(); i++)
            tile.push_back(
                openOf(points.x_px[i] + 3 * points.y_px[i],
                       {points.faceNormal[0][i], points.faceNormal[1][i], points.faceNormal[2][i]}));
    }
    return occlusion;
}
// Vertices are open by their number, upwards.
std::vector<VertexOcclusion> occlusionOfVertices(const std::vector<PlacedMesh>& placed) {
    std::vector<VertexOcclusion> occlusion(placed.size());
    for (size_t m = 0; m < placed.size(); m++)
        for (uint32_t side = 0; side < 2; side++)
            for (uint32_t i = 0; i < placed[m].positions.size(); i++)
                occlusion[m][side].push_back(openOf(i + 5 * side, {0, 1, 0}));
    return occlusion;
}

// The demo scene with a lamp.
SurfaceScene litScene() {
    SurfaceScene scene = demoScene();
    SurfaceLight lamp;
    lamp.kind = LightKind::point;
    lamp.position_m = {0.25, 2, 0.5};
    lamp.intensity = {2, 1.5, 1};
    scene.lights.push_back(lamp);
    return scene;
}

// The ambient, diffuse and specular parts together, in every way in which light gets there.
std::vector<BitPlane> lightings(const Profile& profile, int width, int height, const RasterOptions& options) {
    SurfaceScene scene = litScene();
    const auto placed = placeMeshes(scene, profile.vertex, options.threads);
    const View view = demoView(width, height);
    const VisibleScene visible = findVisible(scene, placed, view, profile, 1, options);
    ShadeJob job = shadeJobOf(visible, scene, placed, view, profile, options);
    job.request[ShadeOutput::beauty] = true;
    for (const ShadeOutput part : {ShadeOutput::mirror, ShadeOutput::background})
        job.request.evaluated[static_cast<size_t>(part)] = false;

    std::vector<BitPlane> planes;
    const auto add = [&](const char* name) {
        planes.push_back(planeOf(name, shade(job)[ShadeOutput::beauty]));
    };
    const TileOcclusion ofFragments = occlusionOfFragments(job);
    const std::vector<VertexOcclusion> ofVertices = occlusionOfVertices(placed);
    std::vector<VertexRadiance> vertices = lightVerticesOf(job);
    job.vertexRadiance = &vertices;
    add("vertices");
    job.vertexRadiance = nullptr;
    job.occlusion = &ofFragments;
    add("occluded");
    for (const auto& [name, make] : {std::pair("harmonics", &harmonicsLight),
                                     std::pair("texels", &texelsLight), std::pair("map", &mapLight)}) {
        scene.environment.light = make();
        job.occlusion = nullptr;
        add(name);
        job.occlusion = &ofFragments;
        add((std::string(name) + "-occluded").c_str());
        job.occlusion = nullptr;
        vertices = lightVerticesOf(job, ofVertices);
        job.vertexRadiance = &vertices;
        add((std::string(name) + "-vertices-occluded").c_str());
        job.vertexRadiance = nullptr;
    }
    return planes;
}

// What fragments and vertices see of the scene around them.
std::vector<BitPlane> surroundings(const RasterOptions& options) {
    const SurfaceScene scene = demoScene();
    const Profile& profile = profiles().front();
    const auto placed = placeMeshes(scene, profile.vertex, options.threads);
    const View view = demoView(40, 32);
    const VisibleScene visible = findVisible(scene, placed, view, profile, 1, options);
    ShadeJob job = shadeJobOf(visible, scene, placed, view, profile, options);
    for (const ShadeOutput output : {ShadeOutput::ambient, ShadeOutput::beauty}) job.request[output] = true;
    DirectionalOptions directional;
    directional.directions = 6;
    directional.mapSize = 48;
    directional.raster = options;
    const TileOcclusion ofFragments = fragmentOcclusion(job, directional);
    job.occlusion = &ofFragments;
    std::vector<BitPlane> planes = {planeOf("fragments", shade(job)[ShadeOutput::ambient])};
    job.occlusion = nullptr;
    const std::vector<VertexRadiance> vertices = lightVerticesOf(job, vertexOcclusion(job, directional));
    job.vertexRadiance = &vertices;
    planes.push_back(planeOf("vertices", shade(job)[ShadeOutput::ambient]));
    return planes;
}

}  // namespace

void addLightingCases(std::vector<BitCase>& cases) {
    const auto add = [&](std::string name, std::string what, auto run) {
        cases.push_back({std::move(name), std::move(what), true, true, true, std::move(run)});
    };
    add("surroundings/" + std::string(profiles().front().name), "ambient light with the scene in its way",
        surroundings);
    for (const Profile& profile : profiles()) {
        const bool isTruth = profile.fragment == Arithmetic::truth;
        add("lighting/" + std::string(profile.name),
            "light of an environment, what is open to it, and light per vertex",
            [&profile, isTruth](const RasterOptions& options) {
                return isTruth ? lightings(profile, 10, 8, options) : lightings(profile, 40, 32, options);
            });
    }
}

}  // namespace etalon
