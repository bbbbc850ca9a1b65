#include "probes/median_cut.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "numeric/check.h"
#include "numeric/door.h"
#include "numeric/elementary.h"
#include "numeric/parallel.h"
#include "numeric/vectors.h"
#include "probes/latlong.h"
#include "probes/light_passes.h"

namespace etalon {
namespace {

// A place in the image in texels, from the upper left corner.
struct ImagePoint {
    double x, y;
};

ImagePoint middleOf(const TexelRegion& r) { return {0.5 * (r.x0 + r.x1), 0.5 * (r.y0 + r.y1)}; }

double latitude_rad(double y, int height) { return 0.5 * kPi * ((height - 2.0 * y) / height); }

glm::dvec3 latLongDirection(const ImagePoint& p, int width, int height) {
    const double longitude = kPi * ((width - 2.0 * p.x) / width), latitude = latitude_rad(p.y, height);
    const double ring = cosOf(latitude);
    return {sinOf(longitude) * ring, sinOf(latitude), cosOf(longitude) * ring};
}

bool isWide(const TexelRegion& r, const EnergyTable& table, const MedianCut& options) {
    const double angle = 2.0 * r.width() / table.width();
    const double along = options.side == LongerSide::angle
                             ? angle
                             : angle * cosOf(latitude_rad(middleOf(r).y, table.height()));
    const double down = static_cast<double>(r.height()) / table.height();
    return along > down || (along == down && options.cutsSquaresInColumns);
}

// The place first < i < last where sumUpTo(i) is nearest to half of `whole`.
template <class SumUpTo>
int evenCut(int first, int last, double whole, SumUpTo&& sumUpTo) {
    int best = first + 1;
    double least = std::numeric_limits<double>::infinity();
    for (int i = first + 1; i < last; i++) {
        const double difference = std::abs(2.0 * sumUpTo(i) - whole);
        if (difference < least) least = difference, best = i;
    }
    return best;
}

// Appends the parts of a region, or the region if it is one texel.
void cutInTwo(const TexelRegion& r, const EnergyTable& table, const MedianCut& options,
              std::vector<TexelRegion>& out) {
    if (r.width() == 1 && r.height() == 1) return out.push_back(r);
    const double whole = table.sum(r);
    const bool isDark = !(whole > table.noise());
    const bool cutsColumns = r.height() == 1 || (r.width() > 1 && isWide(r, table, options));
    TexelRegion before = r, after = r;
    if (cutsColumns) {
        before.x1 = after.x0 = isDark ? r.x0 + r.width() / 2 : evenCut(r.x0, r.x1, whole, [&](int x) {
            return table.sum({r.x0, r.y0, x, r.y1});
        });
    } else {
        before.y1 = after.y0 = isDark ? r.y0 + r.height() / 2 : evenCut(r.y0, r.y1, whole, [&](int y) {
            return table.sum({r.x0, r.y0, r.x1, y});
        });
    }
    out.push_back(before);
    out.push_back(after);
}

ImagePoint medianOf(const TexelRegion& r, const EnergyTable& table) {
    const double half = 0.5 * table.sum(r);
    int x = r.x0, y = r.y0;
    while (x + 1 < r.x1 && table.sum({r.x0, r.y0, x + 1, r.y1}) < half) x++;
    while (y + 1 < r.y1 && table.sum({r.x0, r.y0, r.x1, y + 1}) < half) y++;
    return {x + 0.5, y + 0.5};
}

// The mean of the texels' centres weighted with columnSum(i, j) of columns i ... j - 1 and rowSum(i, j).
template <class ColumnSum, class RowSum>
ImagePoint centroidOf(const TexelRegion& r, ColumnSum&& columnSum, RowSum&& rowSum) {
    // Sum of (i + 1/2) e_i, e_i the weight of column or row i, from the weights of all columns up to i.
    const auto mean = [](int first, int last, auto&& sum) {
        const double whole = sum(first, last);
        double moment = (last - 0.5) * whole;
        for (int i = first + 1; i < last; i++) moment -= sum(first, i);
        return std::clamp(moment / whole, first + 0.5, last - 0.5);
    };
    return {mean(r.x0, r.x1, columnSum), mean(r.y0, r.y1, rowSum)};
}

ImagePoint placeOf(const TexelRegion& r, const EnergyTable& table, std::span<const double> weights,
                   LightPlace place) {
    if (!(table.sum(r) > table.noise())) return middleOf(r);
    const auto columnSum = [&](int i, int j) { return table.sum({i, r.y0, j, r.y1}); };
    const auto rowSum = [&](int i, int j) { return table.sum({r.x0, i, r.x1, j}); };
    switch (place) {
        case LightPlace::centre:
            return middleOf(r);
        case LightPlace::median:
            return medianOf(r, table);
        case LightPlace::centroid:
            return centroidOf(r, columnSum, rowSum);
        case LightPlace::centroidTwice:
            break;
    }
    const auto twice = [&](int x0, int x1, int y0, int y1) {
        double sum = 0.0;
        for (int y = y0; y < y1; y++) sum += weights[static_cast<size_t>(y)] * table.sum({x0, y, x1, y + 1});
        return sum;
    };
    if (!(twice(r.x0, r.x1, r.y0, r.y1) > 0.0)) return middleOf(r);
    return centroidOf(
        r, [&](int i, int j) { return twice(i, j, r.y0, r.y1); },
        [&](int i, int j) { return twice(r.x0, r.x1, i, j); });
}

// The radiance with black texels where it is not valid: the probe's own image, or a copy that is kept in
// `masked`.
const Image<float>& countedRadiance(const Probe& probe, Image<float>& masked) {
    if (probe.valid.empty()) return probe.radiance[0];
    masked = probe.radiance[0];
    for (int c = 0; c < 3; c++)
        for (size_t i = 0; i < masked.pixelCount(); i++)
            if (probe.valid[0].values()[i] == 0) masked.plane(c)[i] = 0.0f;
    return masked;
}

std::optional<glm::dvec3> positionAt(const Probe& probe, const ImagePoint& p, const glm::dvec3& direction) {
    if (probe.distance_m.empty()) return std::nullopt;
    const Image<float>& distance = probe.distance_m[0];
    const int x = std::min(static_cast<int>(p.x), distance.width() - 1),
              y = std::min(static_cast<int>(p.y), distance.height() - 1);
    const double metres = distance.at(x, y);
    if (!(metres > 0.0 && metres <= std::numeric_limits<double>::max())) return std::nullopt;
    return probe.position_m + metres * direction;
}

// Of a probe whose counted radiance is `radiance`.
LightsOfProbe lightsIn(const Image<float>& radiance, const Probe& probe, const EnergyTable& table,
                       std::span<const TexelRegion> regions, const MedianCut& options, Arithmetic arithmetic,
                       int threads) {
    const int width = probe.shape.width, height = probe.shape.height;
    ETALON_CHECK(
        probe.shape.mapping == Mapping::latLong && table.width() == width && table.height() == height,
        "mapping {}, {}x{} texels, table of {}x{}", static_cast<int>(probe.shape.mapping), width, height,
        table.width(), table.height());
    const std::vector<double> weights = texelWeights(width, height, options.weight);
    const std::vector<double> solidAngles = texelWeights(width, height, TexelWeight::exact);
    LightsOfProbe result;
    result.lights.resize(regions.size());
    std::vector<size_t> uncounted(regions.size());
    const auto passes = passesIn<LightPasses>(arithmetic);
    parallelFor(regions.size(), threads, [&](size_t i) {
        const TexelRegion& r = regions[i];
        ProbeLight& light = result.lights[i];
        light.region = r;
        const RegionSums sums = passes->regionSums(radiance, r, weights.data());
        light.energy = sums.energy;
        uncounted[i] = sums.uncountedValues;
        for (int y = r.y0; y < r.y1; y++)
            light.solidAngle_sr += solidAngles[static_cast<size_t>(y)] * r.width();
        const ImagePoint point = placeOf(r, table, weights, options.place);
        light.direction = probe.rotation * latLongDirection(point, width, height);
        light.position_m = positionAt(probe, point, light.direction);
    });
    for (const size_t count : uncounted) result.uncountedValues += count;
    return result;
}

}  // namespace

std::vector<double> texelWeights(int width, int height, TexelWeight weight) {
    ETALON_CHECK(width >= 1 && height >= 1, "{}x{}", width, height);
    const LatLongGrid grid(width, height);
    const double step = 2.0 * kPi / width * (kPi / height);
    std::vector<double> weights;
    for (int y = 0; y < height; y++) switch (weight) {
            case TexelWeight::exact:
                weights.push_back(grid.solidAngle_sr(y));
                break;
            case TexelWeight::midpoint:
                weights.push_back(step * sinOf(kPi * (y + 0.5) / height));
                break;
            case TexelWeight::edge:
                weights.push_back(step * sinOf(kPi * y / height));
                break;
            case TexelWeight::uniform:
                weights.push_back(4.0 * kPi / width / height);
                break;
        }
    return weights;
}

std::vector<TexelRegion> medianCutRegions(const EnergyTable& table, const MedianCut& options) {
    std::vector<TexelRegion> regions = {{0, 0, table.width(), table.height()}};
    for (int level = 0; level < std::min(options.log2Count, kMaxLog2Lights); level++) {
        std::vector<TexelRegion> next;
        next.reserve(2 * regions.size());
        for (const TexelRegion& region : regions) cutInTwo(region, table, options, next);
        if (next.size() == regions.size()) break;
        regions = std::move(next);
    }
    return regions;
}

LightsOfProbe lightsOfRegions(const Probe& probe, const EnergyTable& table,
                              std::span<const TexelRegion> regions, const MedianCut& options, int threads) {
    Image<float> masked;
    return lightsIn(countedRadiance(probe, masked), probe, table, regions, options, Arithmetic::fp64,
                    threads);
}

LightsOfProbe medianCutLights(const Probe& probe, const MedianCut& options, int threads) {
    return medianCutLights(probe, options, Arithmetic::fp64, threads);
}

LightsOfProbe medianCutLights(const Probe& probe, const MedianCut& options, Arithmetic arithmetic,
                              int threads) {
    ETALON_CHECK(probe.shape.mapping == Mapping::latLong && options.log2Count >= 0, "mapping {}, 2^{} lights",
                 static_cast<int>(probe.shape.mapping), options.log2Count);
    const std::vector<double> weights = texelWeights(probe.shape.width, probe.shape.height, options.weight);
    Image<float> masked;
    const Image<float>& radiance = countedRadiance(probe, masked);
    const auto tableOf = [&] {
        if (arithmetic == Arithmetic::fp64) return EnergyTable(radiance, weights, threads);
        const auto passes = passesIn<LightPasses>(arithmetic);
        return EnergyTable(
            passes->summedArea(passes->texelEnergies(radiance, weights.data(), threads), threads));
    };
    const EnergyTable table = tableOf();
    return lightsIn(radiance, probe, table, medianCutRegions(table, options), options, arithmetic, threads);
}

}  // namespace etalon
