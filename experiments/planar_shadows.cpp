// How close planar shadows of few samples, with and without blur, come to the converged average of point lights, and
// what they cost. Prints the tables of docs/experiments/planar_shadows.md between lines "== NAME"; scripts/experiments
// puts them there.
//   etalon_experiment_planar_shadows FOLDER: where planar_shadows.svg and planar_shadows.png are written
#include <algorithm>
#include <array>
#include <cmath>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <vector>

#include "bitcheck/inputs.h"
#include "experiments/plot.h"
#include "files/image_io.h"
#include "numeric/door.h"
#include "numeric/text.h"
#include "shadows/light_samples.h"
#include "shadows/planar_visibility.h"

namespace etalon::experiments {
namespace {

constexpr int kReferenceSamples = 4096, kResolution = 1024;
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

// A knot above the ground.
StudyScene knot() {
    constexpr double kGround_m = -1.3;
    SurfaceScene scene;
    scene.meshes = {torusKnotMesh(42, 12, {0.78, 0.39, 0.78, 0.32})};
    scene.materials.emplace_back();
    scene.instances.emplace_back();
    const std::vector<PlacedMesh> placed = placeMeshes(scene, findProfile("f32")->vertex, 0);
    const PlacedMesh* mesh = &placed[0];
    StudyScene study{"knot", square(kGround_m, 3), {}, {{1, 4, 0.5}, {0.5, 0, 0}, {0, 0, 0.5}}, 0};
    study.casters = castersAbove(study.receiver.frame, {&mesh, 1}, PlanarShadowOptions().contact_m);
    study.penumbra_m = 1.0 * -kGround_m / 4;
    return study;
}

// texel_m: that of another one, kept even where a blur needs more texels around the shadow; 0: fitted.
PlanarShadow shadowOf(const StudyScene& scene, int samples, double blur_m, uint64_t seed,
                      double texel_m = 0) {
    PlanarShadowOptions options;
    options.texel_m = texel_m;
    options.resolution = texel_m > 0 ? 2 * kResolution : kResolution;
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
        std::fill(row.begin(), row.end(), 1.0);
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

// A variant of a scene, and how it did.
struct Row {
    int samples;
    double blur;  // standard deviation in gaps (StudyScene::penumbra_m); 0: none
    double blur_m, ms;
    Difference difference;
};

// What the pictures show of a scene, left to right.
constexpr int kPictureSide_px = 240, kPictureGap_px = 6;
constexpr std::pair<int, double> kPictures[] = {{25, 0}, {25, 0.5}, {256, 0}, {kReferenceSamples, 0}};

struct Study {
    std::vector<Row> rows;  // of the first seed
    // For 25 samples without blur, with a blur of a quarter and half a gap: the errors of other seeds.
    std::map<double, std::vector<double>> otherSeeds;
    std::array<Image<float>, std::size(kPictures)> pictures;

    const Row& row(int samples, double blur) const {
        return *std::ranges::find_if(rows,
                                     [&](const Row& r) { return r.samples == samples && r.blur == blur; });
    }
};

Study study(const StudyScene& scene) {
    const PlanarShadow reference = shadowOf(scene, kReferenceSamples, 0, kReferenceSeed);
    Study result;
    const auto measure = [&](int samples, double blur, uint64_t seed) {
        Row row{samples, blur, blur * scene.penumbra_m / std::sqrt(static_cast<double>(samples)), 1e30, {}};
        // Processor time, the least of three runs.
        PlanarShadow shadow;
        for (int run = 0; run < (samples > 1024 ? 1 : 3); run++) {
            const std::clock_t start = std::clock();
            shadow = shadowOf(scene, samples, row.blur_m, seed, reference.grid.texel_m);
            row.ms = std::min(row.ms, 1e3 * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
        }
        row.difference = compare(reference, shadow);
        for (size_t p = 0; p < std::size(kPictures); p++)
            if (kPictures[p] == std::pair(samples, blur) && result.pictures[p].empty())
                result.pictures[p] = shadow.shadow;
        return row;
    };
    for (const int samples : {1, 9, 16, 25, 49, 100, 144, 256, 512, 1024})
        result.rows.push_back(measure(samples, 0, kSeed));
    for (const int samples : {9, 16, 25, 49, 100, 256, 512})
        for (const double blur : {0.125, 0.25, 0.5, 1.0})
            result.rows.push_back(measure(samples, blur, kSeed));
    for (const uint64_t seed : {kSeed + 10, kSeed + 20})
        for (const double blur : {0.0, 0.25, 0.5})
            result.otherSeeds[blur].push_back(measure(25, blur, seed).difference.rms);
    result.rows.push_back(measure(kReferenceSamples, 0, kOtherReferenceSeed));
    return result;
}

void printTable(const StudyScene& scene, const Study& of) {
    printText(
        "== planar-{}\n| samples | blur, standard deviation | ms | RMS error | largest error | largest step "
        "|\n"
        "| ---: | ---: | ---: | ---: | ---: | ---: |\n",
        scene.name);
    for (const Row& row : of.rows) {
        const std::string blur =
            row.blur > 0 ? formatText("{:.1f} mm ({:g} gaps)", 1000 * row.blur_m, row.blur) : "none";
        printText("| {} | {} | {:.1f} | {:.4f} | {:.3f} | {:.3f} |\n", row.samples, blur, row.ms,
                  row.difference.rms, row.difference.largest, row.difference.step);
    }
    printText("== planar-{}-seeds\n| blur | RMS error of 25 samples, three seeds |\n| ---: | --- |\n",
              scene.name);
    for (const auto& [blur, errors] : of.otherSeeds) {
        printText("| {} | {:.4f}", blur > 0 ? formatText("{:g} gaps", blur) : "none",
                  of.row(25, blur).difference.rms);
        for (const double rms : errors) printText(", {:.4f}", rms);
        printText(" |\n");
    }
}

void printSummary(const Study& of) {
    printText("== planar-summary\n| knot | ms | RMS error | largest step |\n| --- | ---: | ---: | ---: |\n");
    for (const auto& [samples, blur] : {std::pair(25, 0.0), std::pair(25, 0.5), std::pair(49, 0.0),
                                        std::pair(256, 0.0), std::pair(512, 0.0)}) {
        const Row& row = of.row(samples, blur);
        printText("| {} samples{} | {:.0f} | {:.4f} | {:.3f} |\n", samples,
                  blur > 0 ? ", blur of half a gap" : "", row.ms, row.difference.rms, row.difference.step);
    }
}

// Of each number of samples from 9 to 1024, without blur or with the best one.
Series seriesOf(const StudyScene& scene, const Study& of, bool isBlurred) {
    Series series{scene.name + (isBlurred ? ", best blur" : ""), {}, {}};
    std::map<int, const Row*> best;
    for (const Row& row : of.rows) {
        if ((row.blur > 0) != isBlurred || row.samples == 1 || row.samples > 1024) continue;
        const Row*& kept = best[row.samples];
        if (!kept || row.difference.rms < kept->difference.rms) kept = &row;
    }
    for (const auto& [samples, row] : best)
        series.x.push_back(row->ms), series.y.push_back(row->difference.rms);
    return series;
}

// Each picture a part of the shadow from its middle, 2 x 2 texels a pixel; white is lit.
void addPictures(const Study& of, int top, Image<uint8_t>& image) {
    for (size_t p = 0; p < of.pictures.size(); p++) {
        const Image<float>& shadow = of.pictures[p];
        const auto first = [](int texels) { return std::max(0, texels / 2 - kPictureSide_px); };
        for (int y = 0; y < kPictureSide_px; y++)
            for (int x = 0; x < kPictureSide_px; x++) {
                double sum = 0;
                for (const int j : {0, 1})
                    for (const int i : {0, 1})
                        sum += 1.0 - static_cast<double>(shadow.at(
                                         std::min(first(shadow.width()) + 2 * x + i, shadow.width() - 1),
                                         std::min(first(shadow.height()) + 2 * y + j, shadow.height() - 1)));
                for (int c = 0; c < 3; c++)
                    image.at(static_cast<int>(p) * (kPictureSide_px + kPictureGap_px) + x, top + y, c) =
                        static_cast<uint8_t>(std::lround(255 * sum / 4));
            }
    }
}

int run(const std::filesystem::path& folder) {
    constexpr int kPictureCount = static_cast<int>(std::size(kPictures));
    Plot plot{"Planar shadows: error against time", "processor time of one thread, ms", "RMS error", {}, {}};
    Image<uint8_t> image(kPictureCount * (kPictureSide_px + kPictureGap_px) - kPictureGap_px,
                         2 * kPictureSide_px + kPictureGap_px, 3);
    image.fill(255);
    int top = 0;
    for (const StudyScene& scene : {boxAndBar(), knot()}) {
        const Study of = study(scene);
        printTable(scene, of);
        if (scene.name == "knot") printSummary(of);
        std::fflush(stdout);
        for (const bool isBlurred : {false, true}) plot.series.push_back(seriesOf(scene, of, isBlurred));
        addPictures(of, top, image);
        top += kPictureSide_px + kPictureGap_px;
    }
    std::ofstream(folder / "planar_shadows.svg") << svgOf(plot);
    writePng(image, folder / "planar_shadows.png");
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
