// How close planar shadows of few samples, with and without blur, come to the converged average of point
// lights, and what they cost. Prints one line per variant, comma separated; bench/planar_study makes the
// page's table and plot from it. With a folder as argument, the shadows of some variants are written there as
// PGM.
#include <algorithm>
#include <cmath>
#include <ctime>
#include <fstream>
#include <iostream>
#include <string>
#include <vector>

#include "bench/passes.h"
#include "numeric/door.h"
#include "shadows/light_samples.h"
#include "shadows/planar_visibility.h"

namespace etalon::bench {
namespace {

constexpr int kReferenceSamples = 4096;
constexpr uint64_t kSeed = 1, kReferenceSeed = 2, kOtherReferenceSeed = 3;

// A square light over a plane, and what stands between.
struct StudyScene {
    std::string name;
    PlanarReceiver receiver;
    PlanarCasters casters;
    RectangularPatch light;
    // How far apart neighbouring hard shadows of a caster in the middle are, times the samples along a side.
    double penumbra_m;
};

PlanarReceiver square(double height_m, double half_m) {
    PlanarReceiver receiver;
    receiver.frame = planeFrame({0, height_m, 0}, {0, 1, 0});
    receiver.corners_m = {{-half_m, -half_m}, {half_m, -half_m}, {half_m, half_m}, {-half_m, half_m}};
    receiver.indices = {0, 1, 2, 0, 2, 3};
    return receiver;
}

// A box that stands on the ground, and a bar above it: from the contact to a wide penumbra.
StudyScene boxAndBar() {
    StudyScene scene{"box", square(0, 2), {}, {{0.6, 2.5, 0.4}, {0.25, 0, 0}, {0, 0, 0.25}}, 0};
    const auto add = [&](const glm::dvec3& lowest, const glm::dvec3& highest) {
        const auto first = static_cast<uint32_t>(scene.casters.vertices.size());
        for (int i = 0; i < 8; i++)
            scene.casters.vertices.emplace_back(i & 1 ? highest.x : lowest.x, i & 2 ? highest.y : lowest.y,
                                                i & 4 ? highest.z : lowest.z);
        for (const uint32_t v : {0, 1, 3, 0, 3, 2, 4, 6, 7, 4, 7, 5, 0, 4, 5, 0, 5, 1,
                                 2, 3, 7, 2, 7, 6, 0, 2, 6, 0, 6, 4, 1, 5, 7, 1, 7, 3})
            scene.casters.indices.push_back(first + v);
    };
    // (s, t, height)
    add({-0.4, -0.3, 0}, {0.1, 0.2, 0.8});
    add({0.3, -0.8, 0.9}, {0.4, 0.8, 1.0});
    scene.penumbra_m = 0.5 * 0.8 / (2.5 - 0.8);
    return scene;
}

StudyScene knot() {
    const PlanarWork work = planarWork(place(workload("1k", 1), "f32"), 1);
    StudyScene scene{"knot", work.receiver, work.casters, {{1, 4, 0.5}, {0.5, 0, 0}, {0, 0, 0.5}}, 0};
    scene.penumbra_m = 1.0 * 1.3 / (5.3 - 1.3);
    return scene;
}

PlanarShadow shadowOf(const StudyScene& scene, int samples, double blur_m, uint64_t seed,
                      double texel_m = 0) {
    PlanarShadowOptions options;
    options.texel_m = texel_m;
    options.resolution = kPlanarResolution;
    options.blurSigma_m = blur_m;
    return planarShadow(scene.receiver, scene.casters, lightSamples(scene.light, samples, seed), options,
                        *findProfile("f32"), {.threads = 1});
}

// Against the reference at the centres of its texels: over its penumbra (where it is neither 0 nor 1) the
// root mean square and the largest difference; and over the whole texture the largest step from texel to
// texel beyond the reference's.
struct Difference {
    double rms = 0, largest = 0, step = 0;
};
Difference compare(const PlanarShadow& reference, const PlanarShadow& shadow) {
    const PlanarGrid& grid = reference.grid;
    const auto passes = passesIn<PlanarPasses>(Arithmetic::fp64);
    const auto width = static_cast<size_t>(grid.width);
    LitPoints points;
    points.instance.assign(width, 0);
    for (auto& component : points.position_m) component.resize(width);
    std::vector<uint32_t> listed(width);
    for (size_t x = 0; x < width; x++) listed[x] = static_cast<uint32_t>(x);
    Difference result;
    double squares = 0, count = 0;
    std::vector<double> row(width), above(width);
    for (int y = 0; y < grid.height; y++) {
        for (size_t x = 0; x < width; x++) {
            const glm::dvec3 p = grid.toWorld(static_cast<double>(x) + 0.5, y + 0.5);
            for (int c = 0; c < 3; c++) points.position_m[static_cast<size_t>(c)][x] = p[c];
        }
        std::swap(row, above);
        passes->visibility(shadow, {}, points, listed, row);
        const auto expected = [&](size_t x, int line) {
            return 1.0 - static_cast<double>(reference.shadow.at(static_cast<int>(x), line));
        };
        for (size_t x = 0; x < width; x++) {
            const double e = expected(x, y), difference = std::abs(row[x] - e);
            result.largest = std::max(result.largest, difference);
            if (e > 0 && e < 1) squares += difference * difference, count++;
            if (x > 0)
                result.step =
                    std::max(result.step, std::abs(row[x] - row[x - 1]) - std::abs(e - expected(x - 1, y)));
            if (y > 0)
                result.step =
                    std::max(result.step, std::abs(row[x] - above[x]) - std::abs(e - expected(x, y - 1)));
        }
    }
    result.rms = std::sqrt(squares / count);
    return result;
}

void writePgm(const std::string& path, const Image<float>& shadow) {
    std::ofstream file(path, std::ios::binary);
    file << "P5\n" << shadow.width() << " " << shadow.height() << "\n255\n";
    for (const float value : shadow.values())
        file.put(static_cast<char>(static_cast<unsigned char>(std::lround(255 * (1 - value)))));
}

void study(const StudyScene& scene, const std::string& folder) {
    const PlanarShadow reference = shadowOf(scene, kReferenceSamples, 0, kReferenceSeed);
    const auto report = [&](int samples, double blur, uint64_t seed) {
        const double blur_m = blur * scene.penumbra_m / std::sqrt(static_cast<double>(samples));
        // Processor time, the least of three runs.
        double least_ms = 1e30;
        PlanarShadow shadow;
        for (int run = 0; run < (samples > 1024 ? 1 : 3); run++) {
            const std::clock_t start = std::clock();
            shadow = shadowOf(scene, samples, blur_m, seed, reference.grid.texel_m);
            least_ms = std::min(least_ms, 1e3 * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
        }
        const Difference d = compare(reference, shadow);
        std::cout << scene.name << ',' << samples << ',' << blur << ',' << blur_m << ',' << least_ms << ','
                  << d.rms << ',' << d.largest << ',' << d.step << std::endl;
        const bool isShown =
            blur == 0 ? samples == 25 || samples == 256 || samples == 4096 : samples == 25 && blur == 0.5;
        if (!folder.empty() && isShown)
            writePgm(folder + "/" + scene.name + "_" + std::to_string(samples) + (blur > 0 ? "_blur" : "") +
                         ".pgm",
                     shadow.shadow);
    };
    for (const int samples : {1, 9, 16, 25, 49, 100, 144, 256, 512, 1024}) report(samples, 0, kSeed);
    for (const int samples : {9, 16, 25, 49, 100, 256, 512})
        for (const double blur : {0.125, 0.25, 0.5, 1.0}) report(samples, blur, kSeed);
    for (const uint64_t seed : {kSeed + 10, kSeed + 20}) {
        report(25, 0, seed);
        report(25, 0.25, seed);
        report(25, 0.5, seed);
    }
    report(kReferenceSamples, 0, kOtherReferenceSeed);
}

}  // namespace
}  // namespace etalon::bench

int main(int argc, char** argv) {
    using namespace etalon::bench;
    std::cout << "scene,samples,blur,blur_m,ms,rms,largest,step" << std::endl;
    for (const StudyScene& scene : {boxAndBar(), knot()}) study(scene, argc > 1 ? argv[1] : "");
}
