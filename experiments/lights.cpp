// What docs/experiments/lights.md says about lights from probes, measured. scripts/experiments runs it and
// puts what it prints, between lines "== NAME", into the page's blocks of these names.
//   etalon_experiment_lights FOLDER_OF_PLOTS [FOLDER_OF_PAPER_DATA]

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>

#include "experiments/light_probes.h"
#include "experiments/plot.h"
#include "files/image_io.h"
#include "numeric/door.h"
#include "numeric/random.h"
#include "numeric/text.h"
#include "numeric/vectors.h"
#include "probes/irradiance.h"
#include "probes/light_filter.h"
#include "probes/light_passes.h"
#include "probes/median_cut.h"
#include "probes/names.h"
#include "probes/texel_grid.h"

namespace etalon::experiments {
namespace {

namespace fs = std::filesystem;

// ---- What lights give, against the truth.

struct Error {
    double mean_percent = 0, rms = 0;
};

// Of irradiance / pi, over texels and channels alike: the mean of |error| / truth where the truth is not 0,
// the root mean square error.
Error errorOf(const std::vector<glm::dvec3>& truth, const std::vector<glm::dvec3>& irradiance) {
    Error e;
    double count = 0, relative = 0;
    for (size_t i = 0; i < truth.size(); i++)
        for (int c = 0; c < 3; c++) {
            const double difference = irradiance[i][c] / kPi - truth[i][c];
            e.rms += difference * difference;
            count++;
            if (truth[i][c] > 0) e.mean_percent += std::abs(difference) / truth[i][c], relative++;
        }
    return {100 * e.mean_percent / std::max(1.0, relative), std::sqrt(e.rms / count)};
}

std::vector<glm::dvec3> valuesOf(const Image<double>& image) {
    std::vector<glm::dvec3> values;
    for (int y = 0; y < image.height(); y++)
        for (int x = 0; x < image.width(); x++)
            values.emplace_back(image.at(x, y, 0), image.at(x, y, 1), image.at(x, y, 2));
    return values;
}

// The directions that the irradiance is compared in.
const ProbeShape kShown = {Mapping::latLong, 64, 32};

std::vector<glm::dvec3> diffuseTruth(const Probe& probe, const ProbeShape& shape) {
    std::vector<glm::dvec3> truth = irradianceAt(probe, texelDirections(shape), Arithmetic::fp64);
    for (glm::dvec3& v : truth) v /= kPi;
    return truth;
}

std::vector<glm::dvec3> diffuseOfLights(const Probe& probe, const MedianCut& cut, const ProbeShape& shape) {
    return valuesOf(passesIn<LightPasses>(Arithmetic::fp64)
                        ->irradianceOfLights(medianCutLights(probe, cut).lights, shape, 0)[0]);
}

// ---- Table 7.1: unit radiance.

struct Furnace {
    double weighted = 0, unweighted = 0, rms = 0;
};

Furnace furnaceOf(const Probe& unit, const MedianCut& cut) {
    const auto irradiance = diffuseOfLights(unit, cut, unit.shape);
    const TexelGrid grid(unit.shape);
    Furnace f;
    const auto count = static_cast<double>(irradiance.size());
    size_t i = 0;
    for (int y = 0; y < unit.shape.height; y++)
        for (int x = 0; x < unit.shape.width; x++, i++) {
            const double e = irradiance[i].y;
            f.weighted += e * grid.solidAngle_sr(0, x, y) / (4 * kPi);
            f.unweighted += e / count;
            f.rms += (e - kPi) * (e - kPi) / count;
        }
    f.rms = std::sqrt(f.rms);
    return f;
}

void printFurnaces() {
    constexpr double kPrinted16 = 3.046, kPrinted64 = 3.108, kRms16 = 0.241, kRms64 = 0.050;
    Image<float> radiance(256, 128, 3);
    radiance.fill(1.0f);
    const Probe unit = latLongProbe(std::move(radiance));
    struct Row {
        double byMean, byAll;
        std::string text;
    };
    std::vector<Row> rows;
    double largest = 0;
    for (const auto side : {LongerSide::angle, LongerSide::arc})
        for (const bool columns : {false, true})
            for (const auto place :
                 {LightPlace::centre, LightPlace::centroid, LightPlace::median, LightPlace::centroidTwice})
                for (const auto weight :
                     {TexelWeight::exact, TexelWeight::midpoint, TexelWeight::edge, TexelWeight::uniform}) {
                    const Furnace a = furnaceOf(unit, {4, side, place, weight, columns}),
                                  b = furnaceOf(unit, {6, side, place, weight, columns});
                    for (const Furnace& f : {a, b}) largest = std::max(largest, std::abs(f.weighted - kPi));
                    const double byMean =
                        std::abs(a.unweighted - kPrinted16) + std::abs(b.unweighted - kPrinted64);
                    rows.push_back(
                        {byMean, byMean + std::abs(a.rms - kRms16) + std::abs(b.rms - kRms64),
                         formatText(
                             "| {} | {} | {} | {} | {:.4f} | {:.4f} | {:.3f} | {:.4f} | {:.4f} | {:.3f} |",
                             nameOf(side), columns ? "columns" : "rows", nameOf(place), nameOf(weight),
                             a.weighted, a.unweighted, a.rms, b.weighted, b.unweighted, b.rms)});
                }
    const std::string header =
        "| longer side | squares | place | weights | 16: mean | unweighted | RMS | 64: mean | unweighted | "
        "RMS |\n"
        "| --- | --- | --- | --- | ---: | ---: | ---: | ---: | ---: | ---: |\n"
        "| printed | | | | | 3.046 | 0.241 | | 3.108 | 0.050 |";
    const auto print = [&](const char* block, auto key, size_t count) {
        std::stable_sort(rows.begin(), rows.end(),
                         [&](const Row& a, const Row& b) { return a.*key < b.*key; });
        printText("== {}\n{}\n", block, header);
        for (size_t i = 0; i < std::min(count, rows.size()); i++) printText("{}\n", rows[i].text);
    };
    print("furnace-nearest", &Row::byAll, 6);
    print("furnace-by-mean", &Row::byMean, rows.size());
    printText(
        "== furnace-identity\nLargest difference of a weighted mean from pi, over all {} rows: {:.1e}.\n",
        2 * rows.size(), largest);
}

// ---- Tables 7.2 and 7.3: diffuse convolution.

void printDiffuse(const std::vector<NamedProbe>& probes, const fs::path& data, const char* block) {
    const std::pair<LongerSide, LightPlace> ways[] = {
        {LongerSide::angle, LightPlace::centre}, {LongerSide::angle, LightPlace::centroid},
        {LongerSide::angle, LightPlace::median}, {LongerSide::angle, LightPlace::centroidTwice},
        {LongerSide::arc, LightPlace::centre},   {LongerSide::arc, LightPlace::centroid}};
    std::string header = "| probe | truth | lights |", rule = "| --- | --- | ---: |";
    for (const auto& way : ways) {
        header += formatText(" {}, {} |", nameOf(way.first), nameOf(way.second));
        rule += " ---: |";
    }
    printText("== {}\n{}\n{}\n", block, header, rule);
    for (const NamedProbe& n : probes) {
        std::vector<std::pair<std::string, std::vector<glm::dvec3>>> truths = {
            {"exact", diffuseTruth(n.probe, kShown)}};
        ProbeShape shape = kShown;
        const fs::path published = data / (n.name + "_diffuse_256x128.hdr");
        if (!data.empty() && fs::exists(published)) {
            const Image<float> map = readRgb(published);
            shape = {Mapping::latLong, map.width(), map.height()};
            truths[0].second = diffuseTruth(n.probe, shape);
            truths.emplace_back("published", std::vector<glm::dvec3>{});
            for (int y = 0; y < map.height(); y++)
                for (int x = 0; x < map.width(); x++)
                    truths[1].second.emplace_back(map.at(x, y, 0), map.at(x, y, 1), map.at(x, y, 2));
        }
        for (const auto& truth : truths)
            for (const int k : {4, 6}) {
                printText("| {} | {} | {} |", n.name, truth.first, 1 << k);
                for (const auto& way : ways) {
                    const Error e =
                        errorOf(truth.second, diffuseOfLights(n.probe, {k, way.first, way.second}, shape));
                    printText(" {:.1f} %, {:.3g} |", e.mean_percent, e.rms);
                }
                printText("\n");
            }
    }
}

// ---- Convergence.

void writePlot(const fs::path& path, const Plot& plot) { std::ofstream(path) << svgOf(plot); }

void printConvergence(const std::vector<NamedProbe>& probes, const fs::path& plots, const char* block) {
    Plot plot{
        "Median cut: mean relative error of irradiance (arc, centroid)", "lights", "error in %", {}, {}};
    constexpr int kLast = 10;
    for (int k = 1; k <= kLast; k++) plot.x.push_back(1 << k);
    std::string table = "| probe |";
    for (const double x : plot.x) table += formatText(" {:g} |", x);
    table += "\n| --- |";
    for (size_t i = 0; i < plot.x.size(); i++) table += " ---: |";
    Plot variants{"Median cut: mean over the probes", "lights", "error in %", plot.x, {}};
    std::vector<std::pair<LongerSide, LightPlace>> ways;
    for (const auto side : {LongerSide::angle, LongerSide::arc})
        for (const auto place : {LightPlace::centre, LightPlace::centroid, LightPlace::median}) {
            ways.emplace_back(side, place);
            variants.series.push_back(
                {formatText("{}, {}", nameOf(side), nameOf(place)), std::vector<double>(plot.x.size(), 0.0)});
        }
    for (const NamedProbe& n : probes) {
        const auto truth = diffuseTruth(n.probe, kShown);
        plot.series.push_back({n.name, {}});
        table += formatText("\n| {} |", n.name);
        for (int k = 1; k <= kLast; k++)
            for (size_t way = 0; way < ways.size(); way++) {
                const double percent =
                    errorOf(truth, diffuseOfLights(n.probe, {k, ways[way].first, ways[way].second}, kShown))
                        .mean_percent;
                variants.series[way].y[static_cast<size_t>(k - 1)] +=
                    percent / static_cast<double>(probes.size());
                if (ways[way] == std::pair(LongerSide::arc, LightPlace::centroid)) {
                    plot.series.back().y.push_back(percent);
                    table += formatText(" {:.2f} |", percent);
                }
            }
    }
    printText("== {}\n{}\n", block, table);
    writePlot(plots / formatText("{}.svg", block), plot);
    writePlot(plots / formatText("{}_variants.svg", block), variants);
}

// ---- Table 7.4: two kinds of hardware.

// The passes of the pipeline, each of which may run in another arithmetic.
enum Step { input, table, energies, shading, kSteps };
constexpr const char* kStepNames[] = {"input stored", "summed-area table (cuts, places)",
                                      "energies from tables", "shading"};
using Arithmetics = std::array<Arithmetic, kSteps>;

Image<double> channelOf(const Image<double>& rgb, int c) {
    Image<double> out(rgb.width(), rgb.height());
    std::copy(rgb.plane(c).begin(), rgb.plane(c).end(), out.values().begin());
    return out;
}

// The unweighted mean irradiance of 16 lights (angle, centroid).
glm::dvec3 meanOf(const Probe& probe, const Arithmetics& arithmetics) {
    const auto passes = [&](Step step) { return passesIn<LightPasses>(arithmetics[step]); };
    const int width = probe.shape.width, height = probe.shape.height;
    const MedianCut cut{4, LongerSide::angle, LightPlace::centroid, TexelWeight::exact};
    Image<double> weighted(width, height, 3), energy(width, height);
    std::copy(probe.radiance[0].values().begin(), probe.radiance[0].values().end(),
              weighted.values().begin());
    weighted = passes(input)->roundedValues(weighted, 0);
    const std::vector<double> weights = texelWeights(width, height, cut.weight);
    for (int y = 0; y < height; y++)
        for (int x = 0; x < width; x++) {
            for (int c = 0; c < 3; c++) weighted.at(x, y, c) *= weights[static_cast<size_t>(y)];
            energy.at(x, y) = energyOf({weighted.at(x, y, 0), weighted.at(x, y, 1), weighted.at(x, y, 2)});
        }
    const EnergyTable cuts(passes(table)->summedArea(energy, 0));
    const std::vector<TexelRegion> regions = medianCutRegions(cuts, cut);
    std::vector<ProbeLight> lights = lightsOfRegions(probe, cuts, regions, cut).lights;
    for (int c = 0; c < 3; c++) {
        const EnergyTable sums(passes(energies)->summedArea(channelOf(weighted, c), 0));
        for (size_t i = 0; i < lights.size(); i++) lights[i].energy[c] = sums.sum(regions[i]);
    }
    const auto irradiance = valuesOf(passes(shading)->irradianceOfLights(lights, probe.shape, 0)[0]);
    glm::dvec3 mean{0};
    for (const glm::dvec3& v : irradiance) mean += v / static_cast<double>(irradiance.size());
    return mean;
}

void printHardware(const NamedProbe& n, const char* block) {
    Arithmetics exact;
    exact.fill(Arithmetic::fp64);
    const glm::dvec3 reference = meanOf(n.probe, exact);
    printText(
        "== {}\n| {} | R | G | B | R | G | B |\n| --- | ---: | ---: | ---: | ---: | ---: | ---: |\n"
        "| f64 | {:.4f} | {:.4f} | {:.4f} | | | |\n",
        block, n.name, reference.x, reference.y, reference.z);
    const auto row = [&](const std::string& name, const Arithmetics& arithmetics) {
        const glm::dvec3 mean = meanOf(n.probe, arithmetics);
        printText("| {} | {:.4f} | {:.4f} | {:.4f} |", name, mean.x, mean.y, mean.z);
        for (int c = 0; c < 3; c++) printText(" {:+.3f} % |", 100 * (mean[c] / reference[c] - 1));
        printText("\n");
    };
    for (const auto& [name, arithmetic] :
         {std::pair("r300-fp24", Arithmetic::fp24R300), std::pair("nv40-fp16", Arithmetic::fp16Nv40),
          std::pair("nv40-fp32", Arithmetic::fp32Nv40)}) {
        Arithmetics all;
        all.fill(arithmetic);
        row(formatText("**{}**", name), all);
        for (size_t step = 0; step < kSteps; step++) {
            Arithmetics one = exact, others = all;
            one[step] = arithmetic, others[step] = Arithmetic::fp64;
            row(formatText("{}: only {}", name, kStepNames[step]), one);
            row(formatText("{}: all but {}", name, kStepNames[step]), others);
        }
    }
}

// The means of the other ways to place and weight the lights, in f64.
void printVariantMeans(const NamedProbe& n) {
    printText(
        "== means-papers\n| longer side | place | weights | R | G | B |\n"
        "| --- | --- | --- | ---: | ---: | ---: |\n");
    for (const auto side : {LongerSide::angle, LongerSide::arc})
        for (const auto place :
             {LightPlace::centre, LightPlace::centroid, LightPlace::median, LightPlace::centroidTwice})
            for (const auto weight : {TexelWeight::exact, TexelWeight::edge, TexelWeight::uniform}) {
                glm::dvec3 mean{0};
                const auto irradiance = diffuseOfLights(n.probe, {4, side, place, weight}, n.probe.shape);
                for (const glm::dvec3& v : irradiance) mean += v / static_cast<double>(irradiance.size());
                printText("| {} | {} | {} | {:.3f} | {:.3f} | {:.3f} |\n", nameOf(side), nameOf(place),
                          nameOf(weight), mean.x, mean.y, mean.z);
            }
}

// ---- Flicker.

void printFlicker(const NamedProbe& n) {
    constexpr int kFrames = 48;
    printText(
        "== flicker\n| lights | blend | angle per frame | intensity per frame |\n| ---: | ---: | ---: | ---: "
        "|\n");
    for (const int k : {4, 6}) {
        std::vector<std::vector<ProbeLight>> raw;
        for (int frame = 0; frame < kFrames; frame++) {
            Random random(static_cast<uint64_t>(frame));
            Probe noisy = n.probe;
            for (float& v : noisy.radiance[0].values()) v *= static_cast<float>(random.uniform(0.5, 1.5));
            raw.push_back(medianCutLights(noisy, {k}).lights);
        }
        const auto row = [&](const char* name, const Flicker& f) {
            printText("| {} | {} | {:.3f} deg | {:.2f} % |\n", 1 << k, name, f.angle_rad * 180 / kPi,
                      100 * f.intensity);
        };
        row("none", meanFlicker(raw));
        for (const auto& [name, blend] :
             {std::pair("0.5", 0.5), std::pair("0.2", 0.2), std::pair("0.05", 0.05)}) {
            LightFilter filter(blend);
            std::vector<std::vector<ProbeLight>> filtered;
            for (const auto& frame : raw) {
                filtered.emplace_back();
                for (const TrackedLight& light : filter.add(frame)) filtered.back().push_back(light.light);
            }
            row(name, meanFlicker(filtered));
        }
    }
}

int run(int argc, char** argv) {
    if (argc < 2 || argc > 3) {
        etalon::printText(stderr, "usage: etalon_experiment_lights FOLDER_OF_PLOTS [FOLDER_OF_PAPER_DATA]\n");
        return 2;
    }
    const fs::path plots = argv[1], data = argc > 2 ? argv[2] : "";
    const std::vector<NamedProbe> probes = fetchedProbes();
    printFurnaces();
    printDiffuse(probes, {}, "diffuse-cc0");
    printConvergence(probes, plots, "lights_convergence");
    printHardware(probes[0], "hardware-cc0");
    printFlicker(probes[1]);
    std::vector<NamedProbe> papers;
    for (const char* name : {"uffizi", "grace"}) {
        const fs::path path = data / formatText("{}_latlong_256x128.hdr", name);
        if (!data.empty() && fs::exists(path)) papers.push_back({name, latLongProbe(readRgb(path))});
    }
    if (papers.size() < 2) return 0;
    printDiffuse(papers, data, "diffuse-papers");
    printConvergence(papers, plots, "lights_convergence_papers");
    printHardware(papers[1], "hardware-papers");
    printVariantMeans(papers[1]);
    return 0;
}

}  // namespace
}  // namespace etalon::experiments

int main(int argc, char** argv) {
    try {
        return etalon::experiments::run(argc, argv);
    } catch (const std::exception& error) {
        etalon::printText(stderr, "etalon_experiment_lights: {}\n", error.what());
        return 2;
    }
}
