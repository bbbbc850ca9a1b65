// What docs/experiments/irradiance.md says about ways to irradiance, measured. scripts/experiments runs it
// and puts what it prints, between lines "== NAME", into the page's blocks of these names.
//   etalon_experiment_irradiance FOLDER_OF_PICTURES [FOLDER_OF_PAPER_DATA]
#include "probes/irradiance.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "experiments/light_probes.h"
#include "files/image_io.h"
#include "lighting/tone_map.h"
#include "numeric/door.h"
#include "numeric/text.h"
#include "numeric/vectors.h"
#include "probes/convert.h"
#include "probes/harmonics_lobes.h"
#include "probes/light_passes.h"
#include "probes/median_cut.h"
#include "probes/texel_grid.h"

namespace etalon::experiments {
namespace {

constexpr Arithmetic kDouble = Arithmetic::fp64;

// The directions of the comparison, and those of the pictures.
constexpr ProbeShape kShown{Mapping::latLong, 64, 32}, kPicture{Mapping::latLong, 256, 128};

// A way to the irradiance in the directions of a shape.
struct Way {
    const char* name;
    Probe (*irradiance)(const Probe& probe, const ProbeShape& shape);
};

Probe exact(const Probe& probe, const ProbeShape& shape) { return irradianceProbe(probe, shape, kDouble); }

template <int kDegree>
Probe ofHarmonics(const Probe& probe, const ProbeShape& shape) {
    return irradianceProbe(projectHarmonics(probe, kDegree), shape, probe, kDouble);
}

template <int kLog2>
Probe ofLights(const Probe& probe, const ProbeShape& shape) {
    const auto images = passesIn<LightPasses>(kDouble)->irradianceOfLights(
        medianCutLights(probe, {.log2Count = kLog2}).lights, shape, 0);
    std::vector<glm::dvec3> values;
    for (int y = 0; y < shape.height; y++)
        for (int x = 0; x < shape.width; x++)
            values.emplace_back(images[0].at(x, y, 0), images[0].at(x, y, 1), images[0].at(x, y, 2));
    return probeOfValues(shape, values, probe);
}

Probe converted(const Probe& probe, const ProbeShape& shape, Resampling resampling) {
    ProbeConversion conversion;
    conversion.shape = shape;
    conversion.resampling = resampling;
    return convertProbe(probe, conversion, kDouble);
}

// Cubes of 32 texels along a face; the kernel of the blur is as wide as a face.
constexpr int kFace = 32;
Probe ofMap(const Probe& probe, const ProbeShape& shape) {
    return converted(exact(probe, {Mapping::cube, kFace, kFace}), shape, Resampling::bilinear);
}
Probe blurred(const Probe& probe, const ProbeShape& shape) {
    const Probe reflective = converted(probe, {Mapping::cube, kFace, kFace}, Resampling::area);
    Probe map =
        converted(blurredDiffuseMap(reflective, kFace, kFace / 2.0, kDouble), shape, Resampling::bilinear);
    for (float& value : map.radiance[0].values()) value = static_cast<float>(value * kPi);
    return map;
}

const Way kWays[] = {{"harmonics, degree 1", ofHarmonics<1>},
                     {"degree 2", ofHarmonics<2>},
                     {"degree 4", ofHarmonics<4>},
                     {"16 lights", ofLights<4>},
                     {"64 lights", ofLights<6>},
                     {"256 lights", ofLights<8>},
                     {"exact cube map of 32", ofMap},
                     {"blurred map of 32", blurred}};

struct Error {
    double rms_percent = 0, worst_percent = 0;
};

// Over the sphere and the channels, of the truth's mean over both.
Error errorOf(const Probe& truth, const Probe& found) {
    const TexelGrid grid(truth.shape);
    double squares = 0, worst = 0, mean = 0, weights = 0;
    for (int c = 0; c < 3; c++)
        for (int y = 0; y < truth.shape.height; y++)
            for (int x = 0; x < truth.shape.width; x++) {
                const double weight = grid.solidAngle_sr(0, x, y), value = truth.radiance[0].at(x, y, c);
                const double difference = double{found.radiance[0].at(x, y, c)} - value;
                squares += weight * difference * difference;
                mean += weight * value;
                weights += weight;
                worst = std::max(worst, std::abs(difference));
            }
    mean /= weights;
    return {100 * std::sqrt(squares / weights) / mean, 100 * worst / mean};
}

void printErrors(const std::vector<NamedProbe>& probes) {
    printText("== irradiance-errors\n| probe |");
    for (const Way& way : kWays) printText(" {} |", way.name);
    printText("\n| --- |");
    for (size_t i = 0; i < std::size(kWays); i++) printText(" ---: |");
    printText("\n");
    for (const NamedProbe& n : probes) {
        const Probe truth = exact(n.probe, kShown);
        printText("| {} |", n.name);
        for (const Way& way : kWays) {
            const Error e = errorOf(truth, way.irradiance(n.probe, kShown));
            printText(" {:.2f}, {:.1f} |", e.rms_percent, e.worst_percent);
        }
        printText("\n");
    }
}

// Exact, degree 2, 16 lights and the blurred map, from left to right and down; irradiance over pi.
void writePicture(const Probe& probe, const std::filesystem::path& path) {
    const Probe ways[] = {exact(probe, kPicture), ofHarmonics<2>(probe, kPicture),
                          ofLights<4>(probe, kPicture), blurred(probe, kPicture)};
    Image<float> sheet(2 * kPicture.width, 2 * kPicture.height, 3);
    for (int i = 0; i < 4; i++)
        for (int c = 0; c < 3; c++)
            for (int y = 0; y < kPicture.height; y++)
                for (int x = 0; x < kPicture.width; x++)
                    sheet.at(x + i % 2 * kPicture.width, y + i / 2 * kPicture.height, c) =
                        static_cast<float>(ways[i].radiance[0].at(x, y, c) / kPi);
    writePng(toneMap(sheet, ToneMap::filmic, -1), path);
}

// Radiance of Grace Cathedral by degree and order, red, green and blue [RamamoorthiHanrahan2001, Fig. 3]:
// directions x to the right and y upwards in the angular map, z through its centre; no Condon-Shortley phase.
constexpr double kGrace[9][3] = {{0.79, 0.44, 0.54},    {0.39, 0.35, 0.60},    {-0.34, -0.18, -0.27},
                                 {-0.29, -0.06, 0.01},  {-0.11, -0.05, -0.12}, {-0.26, -0.22, -0.47},
                                 {-0.16, -0.09, -0.15}, {0.56, 0.21, 0.14},    {0.21, -0.05, -0.30}};

// The coefficients of the probe times the one factor that brings them nearest to the printed ones.
void printGrace(const std::filesystem::path& path) {
    Image<float> radiance = readRgb(path);
    Probe probe;
    probe.shape = {Mapping::angular, radiance.width(), radiance.height()};
    probe.radiance.push_back(std::move(radiance));
    SphericalHarmonics found = projectHarmonics(probe, 2);
    double products = 0, squares = 0, largest = 0, worst = 0;
    for (int l = 0; l <= 2; l++)
        for (int m = -l; m <= l; m++) {
            if (m % 2 != 0) found.at(l, m) *= -1.0;
            for (int c = 0; c < 3; c++) {
                const double printed = kGrace[harmonicIndex(l, m)][c];
                products += found.at(l, m)[c] * printed;
                squares += found.at(l, m)[c] * found.at(l, m)[c];
                largest = std::max(largest, std::abs(printed));
            }
        }
    const double factor = products / squares;
    printText("== grace-harmonics\n| l, m | printed | measured times {:.4f} |\n| --- | --- | --- |\n",
              factor);
    for (int l = 0; l <= 2; l++)
        for (int m = -l; m <= l; m++) {
            const auto& printed = kGrace[harmonicIndex(l, m)];
            const glm::dvec3 v = factor * found.at(l, m);
            for (int c = 0; c < 3; c++) worst = std::max(worst, std::abs(v[c] - printed[c]));
            printText("| {}, {} | {:.2f} {:.2f} {:.2f} | {:.4f} {:.4f} {:.4f} |\n", l, m, printed[0],
                      printed[1], printed[2], v.x, v.y, v.z);
        }
    printText("\nLargest difference: {:.4f}, {:.2f} % of the largest coefficient.\n", worst,
              100 * worst / largest);
}

int run(int argc, char** argv) {
    if (argc < 2 || argc > 3) {
        etalon::printText(stderr,
                          "usage: etalon_experiment_irradiance FOLDER_OF_PICTURES [FOLDER_OF_PAPER_DATA]\n");
        return 2;
    }
    const std::vector<NamedProbe> probes = fetchedProbes();
    printErrors(probes);
    writePicture(probes[1].probe, std::filesystem::path(argv[1]) / "irradiance.png");
    const std::filesystem::path grace =
        std::filesystem::path(argc > 2 ? argv[2] : "") / "grace_angular_1000.hdr";
    if (std::filesystem::exists(grace)) printGrace(grace);
    return 0;
}

}  // namespace
}  // namespace etalon::experiments

int main(int argc, char** argv) {
    try {
        return etalon::experiments::run(argc, argv);
    } catch (const std::exception& error) {
        etalon::printText(stderr, "etalon_experiment_irradiance: {}\n", error.what());
        return 2;
    }
}
