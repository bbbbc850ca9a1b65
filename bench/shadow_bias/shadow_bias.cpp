// Acne and detachment over depth formats, slopes and biases: prints the tables of docs/experiments/shadow_bias.md.
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <vector>

#include "numeric/elementary.h"
#include "shadows/lookup_passes.h"
#include "shadows/shadow_map.h"

namespace etalon {
namespace {

constexpr double kDegree = 0x1.1df46a2529d39p-6;
constexpr std::array<double, 5> kAngles_deg = {30, 60, 80, 89, 89.9};
constexpr std::array<std::pair<const char*, ShadowDepth>, 4> kDepths = {
    {{"D16", ShadowDepth::d16}, {"D24", ShadowDepth::d24}, {"D32F", ShadowDepth::d32f}, {"linear", ShadowDepth::linear}}};

struct Setting {
    const char* name;
    DepthBias bias;
    bool receiverPlane;
    double normalOffset_texels;
};
constexpr std::array<Setting, 9> kSettings = {{{"none", {0, 0, 0}, false, 0},
                                               {"constant 4", {4, 0, 0}, false, 0},
                                               {"constant 4, slope 1", {4, 1, 0}, false, 0},
                                               {"constant 4, slope 2.5", {4, 2.5, 0}, false, 0},
                                               {"constant 4, slope 5.0625", {4, 5.0625, 0}, false, 0},
                                               {"normal offset 2 texels", {4, 0, 0}, false, 2},
                                               {"receiver plane", {0, 0, 0}, true, 0},
                                               {"receiver plane, constant 4, slope 1/16", {4, 0.0625, 0}, true, 0},
                                               {"receiver plane, constant 2, slope 1/2", {2, 0.5, 0}, true, 0}}};

SurfaceMesh rectangle(glm::vec3 centre, glm::vec3 u, glm::vec3 v) {
    SurfaceMesh mesh;
    for (const auto& [a, b] : {std::pair(-1.f, -1.f), std::pair(1.f, -1.f), std::pair(1.f, 1.f), std::pair(-1.f, 1.f)}) {
        mesh.positions.push_back(centre + a * u + b * v);
        mesh.normals.emplace_back(0, 1, 0);
    }
    mesh.indices = {0, 1, 2, 0, 2, 3};
    return mesh;
}

void addObject(SurfaceScene& scene, SurfaceMesh mesh) {
    scene.instances.emplace_back().mesh = static_cast<uint32_t>(scene.meshes.size());
    scene.meshes.push_back(std::move(mesh));
}

// A point of the ground.
void addPoint(LitPoints& points, double x, double z) {
    const double p[3] = {x, 0, z};
    for (size_t k = 0; k < 3; k++) {
        points.position_m[k].push_back(p[k]);
        points.normal[k].push_back(k == 1 ? 1 : 0);
        points.faceNormal[k].push_back(k == 1 ? 1 : 0);
    }
    points.instance.push_back(0);
    points.x_px.push_back(0);
    points.y_px.push_back(0);
}

struct Outcome {
    double acne = 0;               // part of the lit points that are not lit exactly
    double detachment_texels = 0;  // falsely lit length behind the wall, across the light, in texels
};

// A ground of 4 m, drawn into the map, and a wall of 1 m at x = 0; the sun shines from -X.
Outcome measure(const Setting& setting, ShadowDepth depth, double fromNormal_deg) {
    SurfaceScene scene;
    scene.materials.emplace_back();
    addObject(scene, rectangle({0, 0, 0}, {2, 0, 0}, {0, 0, -2}));
    addObject(scene, rectangle({0, 0.5f, 0}, {0, 0, 2}, {0, 0.5f, 0}));
    SurfaceLight sun;
    const double cosine = cosOf(fromNormal_deg * kDegree);
    sun.toLight = {-sinOf(fromNormal_deg * kDegree), cosine, 0};
    // Turned a little, so that no edge runs along the texels.
    constexpr double kCosine = 0.9950371902099892, kSine = 0.09950371902099893;
    const double fromX = sun.toLight.x;
    sun.toLight.x = fromX * kCosine;
    sun.toLight.z = fromX * kSine;
    // The ground once more behind itself, not drawn: else nothing lies behind the ground, and it is not drawn.
    constexpr double kBehind_m = 0.05;
    addObject(scene, rectangle(glm::vec3(-kBehind_m * sun.toLight), {2, 0, 0}, {0, 0, -2}));
    const Profile& profile = *findProfile("f32");
    const std::vector<PlacedMesh> placed = placeMeshes(scene, profile.vertex, 0);

    ShadowMapSettings settings;
    settings.size = 512;
    settings.depth = depth;
    settings.bias = setting.bias;
    settings.receiverPlane = setting.receiverPlane;
    settings.normalOffset_texels = setting.normalOffset_texels;
    ShadowFit fit = fitShadowMap(placed, sun, {}, settings);
    fit.casters = {0, 1};
    const ShadowMap map = renderShadowMap(scene, placed, fit, settings, profile, {});
    const auto lookup = lookupPasses(profile.fragment).makeLookup(map, profile.textureFractionBits, 0);

    LitPoints lit, shadowed;
    constexpr int kPoints = 200;
    for (int j = 0; j < kPoints; j++)
        for (int i = 0; i < kPoints; i++) addPoint(lit, -1.9 + 1.6 * (i + 0.5) / kPoints, -0.9 + 1.8 * (j + 0.5) / kPoints);
    const double length_m = 0.5;
    for (int j = 0; j < 8; j++)
        for (int i = 0; i < 4000; i++) addPoint(shadowed, length_m * (i + 0.5) / 4000, -0.3 + 0.01 * j);
    Outcome outcome;
    std::vector<double> visibility(lit.size());
    lookup->find(lit, visibility);
    for (const double v : visibility) outcome.acne += v != 1 ? 1.0 / static_cast<double>(lit.size()) : 0;
    visibility.resize(shadowed.size());
    lookup->find(shadowed, visibility);
    for (const double v : visibility)
        outcome.detachment_texels += v * length_m / static_cast<double>(shadowed.size()) * cosine * map.projection.scale;
    return outcome;
}

int run() {
    for (const auto& [depthName, depth] : kDepths) {
        fmt::print("### {}\n\n| bias |", depthName);
        for (const double angle_deg : kAngles_deg) fmt::print(" {} deg |", angle_deg);
        fmt::print("\n| --- |");
        for (size_t i = 0; i < kAngles_deg.size(); i++) fmt::print(" ---: |");
        fmt::print("\n");
        for (const Setting& setting : kSettings) {
            fmt::print("| {} |", setting.name);
            for (const double angle_deg : kAngles_deg) {
                const Outcome outcome = measure(setting, depth, angle_deg);
                fmt::print(" {:.2f} % / {:.2f} |", 100 * outcome.acne, outcome.detachment_texels);
            }
            fmt::print("\n");
        }
        fmt::print("\n");
    }
    return 0;
}

}  // namespace
}  // namespace etalon

int main() { return etalon::run(); }
