// What a better shadow costs: each shadow method against the visibility oracle. Prints the tables of
// docs/experiments/shadow_cost.md between lines "== NAME"; scripts/experiments puts them there.
//   etalon_experiment_shadow_cost FOLDER: where shadow_cost.svg is written

#include <algorithm>
#include <cmath>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <functional>
#include <numeric>
#include <optional>
#include <vector>

#include "bitcheck/inputs.h"
#include "experiments/plot.h"
#include "lighting/lit_points.h"
#include "lighting/render_view.h"
#include "numeric/parallel.h"
#include "numeric/text.h"
#include "raster/blur.h"
#include "shadows/light_samples.h"
#include "shadows/planar_visibility.h"
#include "shadows/screen_mask.h"
#include "shadows/shadow_maps.h"
#include "shadows/visibility_oracle.h"
#include "shadows/volume_shadows.h"

namespace etalon::experiments {
namespace {

constexpr int kWidth = 320, kHeight = 240, kLightPoints = 1024;
constexpr double kLampRadius_m = 0.2;
constexpr uint64_t kSeed = 1, kTruthSeed = 2;
constexpr uint32_t kGround = 3;  // its instance in the demo scene

double dot(const glm::dvec3& a, const glm::dvec3& b) { return a.x * b.x + (a.y * b.y + a.z * b.z); }

SurfaceLight lampAt(const glm::dvec3& place) {
    SurfaceLight lamp;
    lamp.kind = LightKind::spot;
    lamp.position_m = place;
    lamp.intensity = glm::dvec3(1);
    lamp.axis = -place / std::sqrt(dot(place, place));
    lamp.cosInner = 0.9, lamp.cosOuter = 0.6;
    return lamp;
}

// The knot over its ground under a lamp, the points that the camera sees, and the truth about them.
struct Study {
    SurfaceScene scene = demoScene();
    View view = demoView(kWidth, kHeight);
    LitPoints points;
    std::vector<double> hard, soft;

    Study() {
        const SurfaceLight lamp = lampAt({1.5, 4, 2});
        scene.lights.assign(1, lamp);
        const Profile& profile = *findProfile("f64");
        const std::vector<PlacedMesh> placed = placeMeshes(scene, profile.vertex, 0);
        const VisibleScene visible = findVisible(scene, placed, view, profile, 1, {});
        const ShadeJob job = shadeJobOf(visible, scene, placed, view, profile, {});
        // Those that face the lamp.
        points = litPointsOf(job, [&](const LitPoints& all, size_t i) {
            const auto at = [i](const std::array<std::vector<double>, 3>& v) {
                return glm::dvec3(v[0][i], v[1][i], v[2][i]);
            };
            const glm::dvec3 toLight = lamp.position_m - at(all.position_m);
            const double least = 0.05 * std::sqrt(dot(toLight, toLight));
            return dot(at(all.normal), toLight) > least && dot(at(all.faceNormal), toLight) > least;
        });

        std::vector<glm::dvec3> disc;
        for (const glm::dvec4& p : samples(kLightPoints, kTruthSeed)) disc.emplace_back(p);
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

    // Of the lamp, a disc that faces the scene.
    std::vector<glm::dvec4> samples(int count, uint64_t seed) const {
        const SurfaceLight& lamp = scene.lights[0];
        return lightSamples(DiscPatch{glm::dvec4(lamp.position_m, 1), lamp.axis, kLampRadius_m}, count, seed);
    }
    bool isPenumbraOfGround(size_t i) const {
        return points.instance[i] == kGround && soft[i] > 0 && soft[i] < 1;
    }
};

// A method with its parameters.
struct Method {
    std::string name, parameter, profile = "f32";
    bool onlyGround = false;
    // Fills the visibility of the study's points; the scene's meshes are placed.
    std::function<void(const std::vector<PlacedMesh>& placed, const Profile& profile,
                       std::vector<double>& visibility)>
        find;
};

// Shares of light; root mean squares. hard: against the lamp's centre, soft: against the disc, both over all
// points; penumbra: against the disc over the ground's points that see a part of it.
struct Result {
    double falseShadow = 0, falseLight = 0, hard = 0, soft = 0, penumbra = 0, milliseconds = 1e9;
};

Result measure(const Study& study, const Method& method) {
    constexpr int kRounds = 3;
    const Profile& profile = *findProfile(method.profile);
    const std::vector<PlacedMesh> placed = placeMeshes(study.scene, profile.vertex, 0);
    // Processor time: one thread computes, and other programs may run.
    const auto milliseconds = [] { return 1e3 * static_cast<double>(std::clock()) / CLOCKS_PER_SEC; };
    std::vector<double> visibility(study.points.size());
    Result result;
    for (int round = 0; round < kRounds; round++) {
        const double start = milliseconds();
        method.find(placed, profile, visibility);
        result.milliseconds = std::min(result.milliseconds, milliseconds() - start);
    }
    const auto n = static_cast<double>(visibility.size());
    double penumbra = 0;
    for (size_t i = 0; i < visibility.size(); i++) {
        const double e = visibility[i] - study.hard[i], s = visibility[i] - study.soft[i];
        result.falseShadow += std::max(0.0, -e) / n, result.falseLight += std::max(0.0, e) / n;
        result.hard += e * e / n, result.soft += s * s / n;
        if (study.isPenumbraOfGround(i)) result.penumbra += s * s, penumbra++;
    }
    result.hard = std::sqrt(result.hard), result.soft = std::sqrt(result.soft);
    result.penumbra = std::sqrt(result.penumbra / penumbra);
    return result;
}

constexpr const char* kHeader =
    "| method | | profile | false shadow, % | false light, % | RMSE, point | RMSE, disc | RMSE, penumbra | "
    "ms |\n"
    "| --- | --- | --- | ---: | ---: | ---: | ---: | ---: | ---: |\n";

Result printRow(const Study& study, const Method& method) {
    const Result r = measure(study, method);
    const auto ofAll = [&](double value, int digits) {
        return method.onlyGround ? std::string() : formatText("{:.{}f}", value, digits);
    };
    printText("| {} | {} | {} | {} | {} | {} | {} | {:.4f} | {:.1f} |\n", method.name, method.parameter,
              method.profile, ofAll(100 * r.falseShadow, 2), ofAll(100 * r.falseLight, 2), ofAll(r.hard, 4),
              ofAll(r.soft, 4), r.penumbra, r.milliseconds);
    std::fflush(stdout);
    return r;
}

ShadowMapSettings settingsOf(ShadowFilter filter, int taps, int size) {
    ShadowMapSettings settings;
    settings.size = size;
    settings.filter = filter;
    settings.taps = taps;
    settings.radius_texels = filter == ShadowFilter::soft ? kMaxShadowRadius_texels : 3;
    settings.bias = {2, 0.5, 0};
    settings.receiverPlane = true;
    settings.lightSize_m = 2 * kLampRadius_m;
    return settings;
}

ShadowMaps mapsOf(const Study& study, const std::vector<PlacedMesh>& placed, const Profile& profile,
                  const ShadowMapSettings& settings) {
    ShadowMaps maps(1);
    maps.set(
        0, renderShadowMap(study.scene, placed, study.scene.lights[0], {}, settings, profile, {.threads = 1}),
        profile, 1);
    return maps;
}

Method shadowMap(const Study& study, std::string name, std::string parameter,
                 const ShadowMapSettings& settings, std::string profile = "f32") {
    Method method{std::move(name), std::move(parameter), std::move(profile), false, {}};
    method.find = [&study, settings](const auto& placed, const Profile& own,
                                     std::vector<double>& visibility) {
        mapsOf(study, placed, own, settings).find(0, study.points, visibility);
    };
    return method;
}

// The hard map's answer for each pixel, blurred in the image. The points' pixels are found beforehand, as
// shading does.
Method screenMaskOf(const Study& study, double sigma_px) {
    Method method{"screen mask", formatText("blur of {:g} px", sigma_px), "f32", false, {}};
    method.find = [&study, sigma_px](const auto& placed, const Profile& profile,
                                     std::vector<double>& visibility) {
        const ShadowMaps maps = mapsOf(study, placed, profile, settingsOf(ShadowFilter::hard, 1, 1024));
        const VisibleScene visible = findVisible(study.scene, placed, study.view, profile, 1, {.threads = 1});
        ShadeJob job = shadeJobOf(visible, study.scene, placed, study.view, profile, {.threads = 1});
        job.visibility = &maps;
        ScreenMasks masks(1);
        masks.set(0,
                  blurGaussian(screenMask(job, 0), static_cast<int>(std::ceil(3 * sigma_px)), sigma_px, 1));
        masks.find(0, study.points, visibility);
    };
    return method;
}

std::string lightsInWords(int count) { return formatText("{} light{}", count, count == 1 ? "" : "s"); }

// The mean of the volumes of points of the lamp.
Method volumes(const Study& study, int count) {
    Method method{"volumes", lightsInWords(count), "f32", false, {}};
    method.find = [&study, count](const auto& placed, const Profile& profile,
                                  std::vector<double>& visibility) {
        SurfaceScene scene = study.scene;
        scene.lights.clear();
        for (const glm::dvec4& p : study.samples(count, kSeed)) scene.lights.push_back(lampAt(glm::dvec3(p)));
        const VolumeShadows shadows(scene, placed, study.view, profile, {}, {.threads = 1});
        std::vector<double> one(visibility.size());
        std::fill(visibility.begin(), visibility.end(), 0.0);
        for (size_t l = 0; l < scene.lights.size(); l++) {
            shadows.find(l, study.points, one);
            for (size_t i = 0; i < one.size(); i++) visibility[i] += one[i] / count;
        }
    };
    return method;
}

// On the ground. The blur in gaps: distances between neighbouring hard shadows of a caster at half the knot's
// height.
Method planar(const Study& study, int count, double gaps) {
    Method method{gaps > 0 ? "planar, blurred" : "planar", lightsInWords(count), "f32", true, {}};
    method.find = [&study, count, gaps](const auto& placed, const Profile& profile,
                                        std::vector<double>& visibility) {
        constexpr double kCaster_m = 1.1;
        const double height_m = study.scene.lights[0].position_m.y,
                     penumbra_m = 2 * kLampRadius_m * kCaster_m / (height_m - kCaster_m);
        const std::optional<PlanarReceiver> receiver = planarReceiverOf(placed[kGround]);
        std::vector<const PlacedMesh*> casters;
        for (uint32_t i = 0; i < placed.size(); i++)
            if (i != kGround) casters.push_back(&placed[i]);
        PlanarShadowOptions options;
        options.resolution = 512;
        options.blurSigma_m = gaps * penumbra_m / std::sqrt(static_cast<double>(count));
        PlanarShadow shadow =
            planarShadow(*receiver, castersAbove(receiver->frame, casters, options.contact_m),
                         study.samples(count, kSeed), options, profile, {.threads = 1});
        std::vector<PlanarVisibility::Entry> entries;
        entries.push_back({0, kGround, std::move(shadow)});
        PlanarVisibility(std::move(entries), profile).find(0, study.points, visibility);
    };
    return method;
}

int run(const std::filesystem::path& folder) {
    const Study study;
    const auto all = static_cast<double>(study.points.size());
    size_t penumbra = 0;
    for (size_t i = 0; i < study.points.size(); i++) penumbra += study.isPenumbraOfGround(i);
    printText(
        "== shadow-points\n{} points; {:.1f} % of them see the lamp's centre, {:.1f} % a part of the lamp "
        "only; {} of "
        "these are on the ground.\n",
        study.points.size(), 100 * std::accumulate(study.hard.begin(), study.hard.end(), 0.0) / all,
        100.0 *
            static_cast<double>(std::count_if(study.soft.begin(), study.soft.end(),
                                              [](double v) { return v > 0 && v < 1; })) /
            all,
        penumbra);

    Plot plot{
        "What a better shadow costs", "milliseconds, one thread", "RMSE in the ground's penumbra", {}, {}};
    const auto curve = [&](const std::string& name, const std::vector<Method>& methods) {
        Series series{name, {}, {}};
        for (const Method& method : methods) {
            const Result r = printRow(study, method);
            series.x.push_back(r.milliseconds), series.y.push_back(r.penumbra);
        }
        plot.series.push_back(std::move(series));
    };
    const auto overSizes = [&](const char* name, ShadowFilter filter, int taps,
                               const std::vector<int>& sizes) {
        std::vector<Method> methods;
        for (const int size : sizes)
            methods.push_back(
                shadowMap(study, name, formatText("{} texels", size), settingsOf(filter, taps, size)));
        curve(name, methods);
    };
    // The first large maps of a process wait for its memory.
    measure(study, shadowMap(study, "", "", settingsOf(ShadowFilter::hard, 1, 2048)));
    printText("== shadow-methods\n{}", kHeader);
    overSizes("hard", ShadowFilter::hard, 1, {256, 512, 1024, 2048, 4096});
    for (const int taps : {2, 4, 16})
        overSizes(taps == 2   ? "pcf 2 x 2"
                  : taps == 4 ? "pcf 4 x 4"
                              : "pcf 16 x 16",
                  ShadowFilter::pcf, taps, {256, 512, 1024, 2048, 4096});
    overSizes("disc 16", ShadowFilter::disc, 16, {256, 512, 1024, 2048, 4096});
    for (const int size : {256, 1024}) {
        std::vector<Method> methods;
        for (const int taps : {16, 64, 256})
            methods.push_back(shadowMap(study, formatText("soft, {} texels", size),
                                        formatText("{} points", taps),
                                        settingsOf(ShadowFilter::soft, taps, size)));
        curve(formatText("soft, {} texels", size), methods);
    }
    std::vector<Method> masks, ofVolumes;
    for (const double sigma_px : {0.5, 1.0, 2.0, 4.0}) masks.push_back(screenMaskOf(study, sigma_px));
    curve("screen mask", masks);
    for (const int count : {1, 4, 16, 64}) ofVolumes.push_back(volumes(study, count));
    curve("volumes", ofVolumes);
    for (const double gaps : {0.0, 0.5}) {
        std::vector<Method> methods;
        for (const int count : {1, 4, 9, 25, 49, 100, 256, 512})
            if (gaps == 0 || (count > 1 && count < 512)) methods.push_back(planar(study, count, gaps));
        curve(gaps > 0 ? "planar, blurred" : "planar", methods);
    }
    std::ofstream(folder / "shadow_cost.svg") << svgOf(plot);

    printText("== shadow-profiles\n{}", kHeader);
    for (const std::string_view name : profileNames()) {
        if (name == "truth") continue;
        ShadowMapSettings settings = settingsOf(ShadowFilter::pcf, 4, 1024);
        if (findProfile(std::string(name))->depth == DepthFormat::d16) settings.depth = ShadowDepth::d16;
        printRow(study, shadowMap(study, "pcf 4 x 4", "1024 texels", settings, std::string(name)));
    }
    printText("== shadow-formats\n{}", kHeader);
    constexpr std::pair<ShadowDepth, const char*> kDepths[] = {{ShadowDepth::d16, "D16"},
                                                               {ShadowDepth::d24, "D24"},
                                                               {ShadowDepth::d32f, "D32F"},
                                                               {ShadowDepth::linear, "linear distance"}};
    for (const auto& [depth, name] : kDepths) {
        ShadowMapSettings settings = settingsOf(ShadowFilter::pcf, 4, 1024);
        settings.depth = depth;
        printRow(study, shadowMap(study, "pcf 4 x 4", name, settings));
    }
    return 0;
}

}  // namespace
}  // namespace etalon::experiments

int main(int count, char** arguments) {
    if (count < 2) {
        etalon::printText(stderr, "usage: {} FOLDER\n", arguments[0]);
        return 2;
    }
    return etalon::experiments::run(arguments[1]);
}
