// Acne and detachment over depth formats, slopes and biases. Prints the tables of docs/experiments/shadow_bias.md
// between lines "== NAME"; scripts/experiments puts them there.

#include <array>
#include <cmath>
#include <cstdio>
#include <vector>

#include "numeric/door.h"
#include "numeric/elementary.h"
#include "numeric/text.h"
#include "shadows/lookup_passes.h"
#include "shadows/shadow_map.h"

namespace etalon {
namespace {

constexpr double kDegree = 0x1.1df46a2529d39p-6;
constexpr std::array<double, 5> kAngles_deg = {30, 60, 80, 89, 89.9};
constexpr std::array<std::pair<const char*, ShadowDepth>, 4> kDepths = {{{"D16", ShadowDepth::d16},
                                                                         {"D24", ShadowDepth::d24},
                                                                         {"D32F", ShadowDepth::d32f},
                                                                         {"linear", ShadowDepth::linear}}};

struct Setting {
    const char* name;
    DepthBias bias;
    bool receiverPlane;
    double normalOffset_texels;
};
constexpr std::array<Setting, 9> kSettings = {
    {{"none", {0, 0, 0}, false, 0},
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
    for (const auto& [a, b] :
         {std::pair(-1.f, -1.f), std::pair(1.f, -1.f), std::pair(1.f, 1.f), std::pair(-1.f, 1.f)}) {
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

// The light at an angle from the ground's normal, from -X, turned a little about +Y, so that no edge runs
// along the texels: the sun, or for linear a lamp 10 m away.
constexpr double kLamp_m = 10;
SurfaceLight lightAt(ShadowDepth depth, double fromNormal_deg) {
    constexpr double kCosine = 0.9950371902099892, kSine = 0.09950371902099893;
    const double sine = sinOf(fromNormal_deg * kDegree);
    SurfaceLight light;
    light.toLight = {-sine * kCosine, cosOf(fromNormal_deg * kDegree), -sine * kSine};
    if (depth != ShadowDepth::linear) return light;
    light.kind = LightKind::spot;
    light.position_m = light.toLight * kLamp_m;
    light.axis = -light.toLight;
    light.cosOuter = 0.9;
    return light;
}

// Visibility of points of a ground of 4 m, drawn into the map, with or without a wall of 1 m at x = 0.
std::vector<double> visibilityOf(const LitPoints& points, const Setting& setting, ShadowDepth depth,
                                 const SurfaceLight& light, bool hasWall, double& perMetre) {
    SurfaceScene scene;
    scene.materials.emplace_back();
    addObject(scene, rectangle({0, 0, 0}, {2, 0, 0}, {0, 0, -2}));
    // The ground once more behind itself, not drawn: else nothing lies behind the ground, and it is not
    // drawn.
    constexpr double kBehind_m = 0.05;
    addObject(scene, rectangle(glm::vec3(-kBehind_m * light.toLight), {2, 0, 0}, {0, 0, -2}));
    if (hasWall) addObject(scene, rectangle({0, 0.5f, 0}, {0, 0, 2}, {0, 0.5f, 0}));
    const Profile& profile = *findProfile("f32");
    const std::vector<PlacedMesh> placed = placeMeshes(scene, profile.vertex, 0);
    ShadowMapSettings settings;
    settings.size = 512;
    settings.depth = depth;
    settings.bias = setting.bias;
    settings.receiverPlane = setting.receiverPlane;
    settings.normalOffset_texels = setting.normalOffset_texels;
    ShadowFit fit = fitShadowMap(placed, light, {}, settings);
    fit.casters = {0};
    if (hasWall) fit.casters.push_back(2);
    const ShadowMap map = renderShadowMap(scene, placed, fit, settings, profile, {});
    perMetre = map.projection.scale / (map.projection.isPerspective ? kLamp_m : 1);
    std::vector<double> visibility(points.size());
    passesIn<LookupPasses>(profile.fragment)
        ->makeLookup(map, samplerOf(profile), 0, WindowSearch::sideBySide)
        ->find(points, visibility);
    return visibility;
}

Outcome measure(const Setting& setting, ShadowDepth depth, double fromNormal_deg) {
    const SurfaceLight light = lightAt(depth, fromNormal_deg);
    LitPoints ground, behindWall;
    constexpr int kPoints = 200, kRows = 8, kSteps = 4000;
    for (int j = 0; j < kPoints; j++)
        for (int i = 0; i < kPoints; i++)
            addPoint(ground, -1.9 + 3.8 * (i + 0.5) / kPoints, -1.9 + 3.8 * (j + 0.5) / kPoints);
    constexpr double kLength_m = 0.5;
    for (int j = 0; j < kRows; j++)
        for (int i = 0; i < kSteps; i++)
            addPoint(behindWall, kLength_m * (i + 0.5) / kSteps, -0.3 + 0.01 * j);
    Outcome outcome;
    double perMetre = 0;
    for (const double v : visibilityOf(ground, setting, depth, light, false, perMetre))
        outcome.acne += v != 1 ? 1.0 / static_cast<double>(ground.size()) : 0;
    for (const double v : visibilityOf(behindWall, setting, depth, light, true, perMetre))
        outcome.detachment_texels += v * kLength_m / static_cast<double>(behindWall.size()) *
                                     cosOf(fromNormal_deg * kDegree) * perMetre;
    return outcome;
}

int run() {
    for (const auto& [depthName, depth] : kDepths) {
        printText("== bias-{}\n| bias |", depthName);
        for (const double angle_deg : kAngles_deg) printText(" {} deg |", angle_deg);
        printText("\n| --- |");
        for (size_t i = 0; i < kAngles_deg.size(); i++) printText(" ---: |");
        printText("\n");
        for (const Setting& setting : kSettings) {
            printText("| {} |", setting.name);
            for (const double angle_deg : kAngles_deg) {
                const Outcome outcome = measure(setting, depth, angle_deg);
                printText(" {:.2f} % / {:.2f} |", 100 * outcome.acne, outcome.detachment_texels);
            }
            printText("\n");
        }
    }
    return 0;
}

}  // namespace
}  // namespace etalon

int main() { return etalon::run(); }
