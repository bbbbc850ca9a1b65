// The passes of probes/energy_passes.h in N lanes, for the source that is compiled once per level.
#pragma once

#include <algorithm>
#include <array>
#include <limits>

#include "numeric/lanes.h"
#include "probes/energy_passes.h"

namespace etalon {

inline constexpr double kLargestRadiance = std::numeric_limits<float>::max();

// `active` values, those that do not count and those behind them as 0.
template <int N>
Lanes<double, N> countedRadianceOf(const float* from, int active) {
    using D = Lanes<double, N>;
    D v;
    if (active == N) {
        v = convertLanes<double>(Lanes<float, N>::load(from));
    } else {
        v = D::generate([&](int i) { return i < active ? static_cast<double>(from[i]) : 0.0; });
    }
    return select(v > D(0.0) && v <= D(kLargestRadiance), v, D(0.0));
}

// N rows of the table: blocks of N x N texels, whose lanes are columns but for the running sums of the rows.
// `above` is the row of the table above them, or null.
template <int N>
void addRowsToTable(const Image<float>& radiance, int firstRow, const double* rowWeights, const double* above,
                    double* table) {
    using D = Lanes<double, N>;
    const auto width = static_cast<size_t>(radiance.width());
    std::array<const float*, N> red, green, blue;
    for (size_t r = 0; r < N; r++) {
        const int y = firstRow + static_cast<int>(r);
        red[r] = radiance.row(y, 0).data();
        green[r] = radiance.row(y, 1).data();
        blue[r] = radiance.row(y, 2).data();
    }
    D rowSums(0.0);
    forEachLaneGroup<N>(width, [&](size_t first, int active) {
        std::array<D, N> block;
#pragma GCC unroll 8
        for (size_t r = 0; r < N; r++) {
            const D rgb[3] = {countedRadianceOf<N>(red[r] + first, active),
                              countedRadianceOf<N>(green[r] + first, active),
                              countedRadianceOf<N>(blue[r] + first, active)};
            // energyOf (probes/probe_light.h)
            const D energy = D(0.2125) * rgb[0] + (D(0.7154) * rgb[1] + D(0.0721) * rgb[2]);
            block[r] = D(rowWeights[firstRow + static_cast<int>(r)]) * energy;
        }
        transposeLanes(block);
#pragma GCC unroll 8
        for (size_t x = 0; x < N; x++) block[x] = rowSums = rowSums + block[x];
        transposeLanes(block);
        D column(0.0);
        if (above) column = loadActive<double, N>(above + first, active);
#pragma GCC unroll 8
        for (size_t r = 0; r < N; r++) {
            column = column + block[r];
            storeActive(column, table + r * width + first, active);
        }
    });
}

template <int N>
void bandOfTable(const Image<float>& radiance, int firstRow, int lastRow, const double* rowWeights,
                 double* table) {
    const auto width = static_cast<size_t>(radiance.width());
    int y = firstRow;
    const auto row = [&](int i) { return table + static_cast<size_t>(i - firstRow) * width; };
    for (; y + N <= lastRow; y += N)
        addRowsToTable<N>(radiance, y, rowWeights, y == firstRow ? nullptr : row(y - 1), row(y));
    for (; y < lastRow; y++)
        addRowsToTable<1>(radiance, y, rowWeights, y == firstRow ? nullptr : row(y - 1), row(y));
}

// Eight partial sums in N lanes.
template <int N>
RegionSums regionSums(const Image<float>& radiance, const TexelRegion& region, const double* rowWeights) {
    constexpr size_t kSums = 8, kVectors = kSums / N;
    using D = Lanes<double, N>;
    const auto count = static_cast<size_t>(region.width());
    RegionSums result;
    D uncounted(0.0);
    for (int c = 0; c < 3; c++) {
        std::array<D, kVectors> sums;
        sums.fill(D(0.0));
        for (int y = region.y0; y < region.y1; y++) {
            const float* values = radiance.row(y, c).data() + region.x0;
            std::array<D, kVectors> rowSums;
            rowSums.fill(D(0.0));
            const auto add = [&](size_t vector, const D& v) {
                const auto counts = v >= D(0.0) && v <= D(kLargestRadiance);
                rowSums[vector] = rowSums[vector] + select(counts, v, D(0.0));
                uncounted = uncounted + select(counts, D(0.0), D(1.0));
            };
            size_t first = 0;
            for (; first + kSums <= count; first += kSums)
#pragma GCC unroll 8
                for (size_t i = 0; i < kVectors; i++)
                    add(i, convertLanes<double>(Lanes<float, N>::load(values + first + i * N)));
            if (first < count) {
                std::array<float, kSums> rest{};
                std::copy(values + first, values + count, rest.begin());
#pragma GCC unroll 8
                for (size_t i = 0; i < kVectors; i++)
                    add(i, convertLanes<double>(Lanes<float, N>::load(rest.data() + i * N)));
            }
            for (size_t i = 0; i < kVectors; i++) sums[i] = sums[i] + D(rowWeights[y]) * rowSums[i];
        }
        std::array<double, kSums> partial;
        for (size_t i = 0; i < kVectors; i++) sums[i].store(partial.data() + i * N);
        for (size_t half = kSums / 2; half > 0; half /= 2)
            for (size_t i = 0; i < half; i++) partial[i] += partial[i + half];
        result.energy[c] = partial[0];
    }
    for (int lane = 0; lane < N; lane++) result.uncountedValues += static_cast<size_t>(uncounted[lane]);
    return result;
}

}  // namespace etalon
