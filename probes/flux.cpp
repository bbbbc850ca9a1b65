#include "probes/flux.h"

#include <algorithm>
#include <cmath>

#include "numeric/parallel.h"

namespace etalon {

TexelRow readRadiance(const Probe& probe, int layer, int y) {
    TexelRow row;
    row.width = probe.shape.width;
    row.padded = (row.width + kTexelGroup - 1) / kTexelGroup * kTexelGroup;
    const auto l = static_cast<size_t>(layer);
    for (int c = 0; c < 3; c++) {
        const std::span<const float> from = probe.radiance[l].row(y, c);
        std::vector<float>& to = row.radiance[static_cast<size_t>(c)];
        to.reserve(static_cast<size_t>(row.padded));
        to.assign(from.begin(), from.end());
        to.resize(static_cast<size_t>(row.padded));
        if (!probe.valid.empty())
            for (int x = 0; x < row.width; x++)
                if (probe.valid[l].at(x, y) == 0) to[static_cast<size_t>(x)] = 0;
    }
    return row;
}

TexelWeights texelWeightsOf(const Probe& probe, const TexelGrid& grid, double largest, int threads) {
    const auto width = static_cast<size_t>(probe.shape.width);
    const auto rows = static_cast<size_t>(probe.shape.layers() * probe.shape.height);
    TexelWeights weights;
    weights.solidAngle_sr.resize(rows * width);
    struct RowSums {
        double largest = 0, flux = 0;
    };
    std::vector<RowSums> sums(rows);
    parallelFor(rows, threads, [&](size_t r) {
        const int layer = static_cast<int>(r) / probe.shape.height,
                  y = static_cast<int>(r) % probe.shape.height;
        const TexelRow row = readRadiance(probe, layer, y);
        RowSums& sum = sums[r];
        for (size_t x = 0; x < width; x++) {
            const double weight = grid.solidAngle_sr(layer, static_cast<int>(x), y);
            if (!(weight > 0)) continue;
            weights.solidAngle_sr[r * width + x] = weight;
            double radiance = 0;
            for (const auto& channel : row.radiance) {
                const double magnitude = std::abs(double{channel[x]});
                if (magnitude > radiance) radiance = magnitude;  // NaN is not
            }
            radiance = std::min(radiance, largest);
            sum.largest = std::max(sum.largest, radiance);
            sum.flux += radiance * (weight * TexelWeights::kFluxHeadroom);
        }
    });
    for (const RowSums& sum : sums) {
        weights.largestRadiance = std::max(weights.largestRadiance, sum.largest);
        weights.flux += sum.flux;
    }
    return weights;
}

void readWeights(const TexelWeights& weights, size_t first, int exponent, TexelRow& row) {
    row.weight.resize(static_cast<size_t>(row.padded));
    const double scale = std::ldexp(1.0, exponent);
    for (size_t x = 0; x < static_cast<size_t>(row.width); x++) {
        row.weight[x] = weights.solidAngle_sr[first + x] * scale;
        if (!(row.weight[x] > 0))
            for (auto& channel : row.radiance) channel[x] = 0;
    }
}

void readDirections(const TexelGrid& grid, int layer, int y, TexelRow& row) {
    for (auto& component : row.direction) component.resize(static_cast<size_t>(row.padded));
    for (int x = 0; x < row.width; x++) {
        const glm::dvec3 d = grid.direction(layer, x, y);
        for (int c = 0; c < 3; c++) row.direction[static_cast<size_t>(c)][static_cast<size_t>(x)] = d[c];
    }
}

void turnDirections(const glm::dmat3& r, TexelRow& row) {
    if (r == glm::dmat3(1)) return;
    for (size_t i = 0; i < static_cast<size_t>(row.width); i++) {
        double &x = row.direction[0][i], &y = row.direction[1][i], &z = row.direction[2][i];
        const glm::dvec3 d(x, y, z);
        x = r[0].x * d.x + (r[1].x * d.y + r[2].x * d.z);
        y = r[0].y * d.x + (r[1].y * d.y + r[2].y * d.z);
        z = r[0].z * d.x + (r[1].z * d.y + r[2].z * d.z);
    }
}

}  // namespace etalon
