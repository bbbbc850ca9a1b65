// What a better shadow costs: shadow maps against the visibility oracle, over filter, taps, resolution and
// profile. Prints the tables of docs/experiments/shadow_maps.md.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <numeric>
#include <vector>

#include "bitcheck/inputs.h"
#include "lighting/render_view.h"
#include "numeric/parallel.h"
#include "shadows/shadow_maps.h"
#include "shadows/shadow_pattern.h"
#include "shadows/visibility_oracle.h"

namespace etalon {
namespace {

constexpr int kWidth = 320, kHeight = 240, kLightPoints = 256;
constexpr double kLampSize_m = 0.4;

double dot(const glm::dvec3& a, const glm::dvec3& b) { return a.x * b.x + (a.y * b.y + a.z * b.z); }

glm::dvec3 cross(const glm::dvec3& a, const glm::dvec3& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

// Keeps the points that shading asks about, where they face the light.
class PointRecorder final : public LightVisibility {
  public:
    explicit PointRecorder(const glm::dvec3& light_m) : light_m_(light_m) {}
    bool casts(size_t) const override { return true; }
    void find(size_t, const LitPoints& points, std::span<double> visibility) const override {
        std::fill(visibility.begin(), visibility.end(), 1.0);
        for (size_t i = 0; i < points.size(); i++) {
            const auto at = [i](const std::array<std::vector<double>, 3>& v) {
                return glm::dvec3(v[0][i], v[1][i], v[2][i]);
            };
            const glm::dvec3 toLight = light_m_ - at(points.position_m);
            const double least = 0.05 * std::sqrt(dot(toLight, toLight));
            if (points.instance[i] == kNoInstance || !(dot(at(points.normal), toLight) > least) ||
                !(dot(at(points.faceNormal), toLight) > least))
                continue;
            for (size_t k = 0; k < 3; k++) {
                all.position_m[k].push_back(points.position_m[k][i]);
                all.normal[k].push_back(points.normal[k][i]);
                all.faceNormal[k].push_back(points.faceNormal[k][i]);
            }
            all.instance.push_back(points.instance[i]);
            all.x_px.push_back(points.x_px[i]), all.y_px.push_back(points.y_px[i]);
        }
    }
    mutable LitPoints all;

  private:
    glm::dvec3 light_m_;
};

// The knot over its ground under a lamp, the points that the camera sees, and the truth about them.
struct Study {
    SurfaceScene scene = demoScene();
    LitPoints points;
    std::vector<double> hard, soft;

    Study() {
        scene.lights.assign(1, {});
        SurfaceLight& lamp = scene.lights[0];
        lamp.kind = LightKind::spot;
        lamp.position_m = {1.5, 4, 2};
        lamp.intensity = glm::dvec3(1);
        const double distance_m = std::sqrt(dot(lamp.position_m, lamp.position_m));
        lamp.axis = -lamp.position_m / distance_m;
        lamp.cosInner = 0.9, lamp.cosOuter = 0.6;
        const Profile& profile = *findProfile("f64");
        const std::vector<PlacedMesh> placed = placeMeshes(scene, profile.vertex, 0);
        const View view = demoView(kWidth, kHeight);
        const VisibleScene visible = findVisible(scene, placed, view, profile, 1, {});
        const PointRecorder recorder(lamp.position_m);
        ShadeJob job = shadeJobOf(visible, scene, placed, view, profile, {.threads = 1});
        job.visibility = &recorder;
        job.request[ShadeOutput::diffuse] = true;
        shade(job);
        points = std::move(recorder.all);

        // A disc that faces the scene.
        const glm::dvec3 up(0, 1, 0);
        glm::dvec3 right = cross(lamp.axis, up);
        right = right / std::sqrt(dot(right, right));
        const glm::dvec3 down = cross(lamp.axis, right);
        std::vector<glm::dvec3> disc;
        for (const glm::dvec2& p : discPattern(kLightPoints, 1))
            disc.push_back(lamp.position_m + (p.x * kLampSize_m / 2) * right +
                           (p.y * kLampSize_m / 2) * down);
        const VisibilityOracle oracle(worldTriangles(placed));
        constexpr double kOffset_m = 1e-6;
        hard.resize(points.size()), soft.resize(points.size());
        parallelFor(points.size(), 0, [&](size_t i) {
            glm::dvec3 p;
            for (int k = 0; k < 3; k++)
                p[k] = points.position_m[static_cast<size_t>(k)][i] +
                       kOffset_m * points.faceNormal[static_cast<size_t>(k)][i];
            hard[i] = oracle.isVisible(p, lightSourceOf(lamp)) ? 1 : 0;
            soft[i] = oracle.visibleFraction(p, disc);
        });
    }
};

struct Row {
    const char* name;
    ShadowFilter filter;
    int taps;
};

void printRow(const Study& study, const Row& row, int size, ShadowDepth depth,
              const std::string& profileName) {
    const Profile& profile = *findProfile(profileName);
    const std::vector<PlacedMesh> placed = placeMeshes(study.scene, profile.vertex, 0);
    ShadowMapSettings settings;
    settings.size = size;
    settings.depth = depth;
    settings.filter = row.filter;
    settings.taps = row.taps;
    settings.radius_texels = row.filter == ShadowFilter::soft ? kMaxShadowRadius_texels : 3;
    settings.bias = {2, 0.5, 0};
    settings.receiverPlane = true;
    settings.lightSize_m = kLampSize_m;
    // Processor time: one thread computes, and other programs may run.
    const auto milliseconds = [] { return 1e3 * static_cast<double>(std::clock()) / CLOCKS_PER_SEC; };
    double map_ms = 1e9, lookup_ms = 1e9;
    std::vector<double> visibility(study.points.size());
    for (int round = 0; round < 3; round++) {
        const double start = milliseconds();
        ShadowMaps maps(1);
        maps.set(0,
                 renderShadowMap(study.scene, placed, study.scene.lights[0], {}, settings, profile,
                                 {.threads = 1}),
                 profile, 1);
        map_ms = std::min(map_ms, milliseconds() - start);
        const double lookup = milliseconds();
        maps.find(0, study.points, visibility);
        lookup_ms = std::min(lookup_ms, milliseconds() - lookup);
    }
    const auto n = static_cast<double>(visibility.size());
    double falseShadow = 0, falseLight = 0, squareHard = 0, squareSoft = 0;
    for (size_t i = 0; i < visibility.size(); i++) {
        const double e = visibility[i] - study.hard[i], s = visibility[i] - study.soft[i];
        falseShadow += std::max(0.0, -e) / n, falseLight += std::max(0.0, e) / n;
        squareHard += e * e / n, squareSoft += s * s / n;
    }
    fmt::print("| {} | {} | {} | {:.2f} | {:.2f} | {:.4f} | {:.4f} | {:.1f} | {:.0f} |\n", row.name, size,
               profileName, 100 * falseShadow, 100 * falseLight, std::sqrt(squareHard), std::sqrt(squareSoft),
               map_ms, 1e6 * lookup_ms / n);
}

int run() {
    const Study study;
    fmt::print("{} points; {:.1f} % of them see the lamp's centre, {:.1f} % a part of it only.\n\n",
               study.points.size(),
               100 * std::accumulate(study.hard.begin(), study.hard.end(), 0.0) /
                   static_cast<double>(study.hard.size()),
               100.0 *
                   static_cast<double>(std::count_if(study.soft.begin(), study.soft.end(),
                                                     [](double v) { return v > 0 && v < 1; })) /
                   static_cast<double>(study.soft.size()));
    fmt::print(
        "| filter | size | profile | false shadow, % | false light, % | RMSE, point | RMSE, disc | map, ms | "
        "ns/point "
        "|\n| --- | ---: | --- | ---: | ---: | ---: | ---: | ---: | ---: |\n");
    constexpr Row kRows[] = {{"hard", ShadowFilter::hard, 1},     {"pcf 2 x 2", ShadowFilter::pcf, 2},
                             {"pcf 4 x 4", ShadowFilter::pcf, 4}, {"pcf 16 x 16", ShadowFilter::pcf, 16},
                             {"disc 16", ShadowFilter::disc, 16}, {"soft 16", ShadowFilter::soft, 16},
                             {"soft 64", ShadowFilter::soft, 64}, {"soft 256", ShadowFilter::soft, 256}};
    for (const Row& row : kRows)
        for (const int size : {256, 1024, 4096})
            if (size < 4096 || row.taps < 256) printRow(study, row, size, ShadowDepth::d24, "f32");
    for (const std::string_view profile : profileNames())
        if (profile != "truth")
            printRow(study, kRows[2], 1024,
                     findProfile(profile)->depth == DepthFormat::d16 ? ShadowDepth::d16 : ShadowDepth::d24,
                     std::string(profile));
    fmt::print(
        "\nDepth formats, pcf 4 x 4, f32: D16, D24, D32F, linear.\n\n| filter | size | profile | false "
        "shadow, % | false light, % | RMSE, point | RMSE, disc | map, ms | ns/point |\n| --- | ---: | --- | "
        "---: | ---: | ---: | ---: | ---: | ---: |\n");
    for (const ShadowDepth depth :
         {ShadowDepth::d16, ShadowDepth::d24, ShadowDepth::d32f, ShadowDepth::linear})
        printRow(study, kRows[2], 1024, depth, "f32");
    return 0;
}

}  // namespace
}  // namespace etalon

int main() { return etalon::run(); }
