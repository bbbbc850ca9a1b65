// The passes of probes/energy_passes.h, for the sources that are compiled once per level. The text is
// probes/kernels/energy.glsl.
#pragma once

#include <algorithm>
#include <array>
#include <limits>

#include "numeric/parallel.h"
#include "probes/energy_passes.h"
#include "probes/flux.h"
#include "probes/summed_area.h"
#include "probes/term_sums.h"

namespace etalon {

inline constexpr double kLargestRadiance = std::numeric_limits<float>::max();

// What energy.glsl reads, and the text, over T: the radiance of a region, in lanes of columns. `part` is the column of
// the region where the lanes begin, `most` how many of them hold values.
template <class T>
struct EnergyKernel {
#include "numeric/kernel_scope.inc"
#include "numeric/kernels/vector.glsl"
#include "probes/flux_scope.inc"
#include "probes/kernels/flux.glsl"
    static constexpr int kWidth = Number<T>::lanes;
    using Floats = Lanes<float, kWidth>;
    using Counts = Lanes<int32_t, kWidth>;

    const Image<float>* image;
    TexelRegion region;
    const double* rowWeights;
    int part = 0, most = kWidth;
    Counts uncounted{0.0};  // values that do not count

    vec3 countedRadiance(int x, int y) {
        const int column = part + x, active = std::clamp(region.width() - column, 0, most);
        const float* from = image->row(region.y0 + y, 0).data() + std::min(region.x0 + column, region.x1);
        const size_t plane = image->pixelCount();
        return {counted(from, active), counted(from + plane, active), counted(from + 2 * plane, active)};
    }
    real regionWeight(int y) const { return T(rowWeights[region.y0 + y]); }
#include "probes/kernels/energy.glsl"

  private:
    // The first `active` values as numbers of T, inside its finite ones; those that do not count, and those behind
    // them, as 0.
    real counted(const float* from, int active) {
        Floats v;
        if (active == kWidth)
            v = Floats::load(from);
        else
            v = Floats::generate([&](int i) { return i < active ? from[i] : 0.0f; });
        const auto counts = v >= Floats(0.0) && v <= Floats(kLargestRadiance);
        uncounted = uncounted + etalon::select(convertMask<int32_t>(counts), Counts(0.0), Counts(1.0));
        v = etalon::select(counts, v, Floats(0.0));
        if constexpr (std::is_same_v<T, Lanes<double, kWidth>>)
            return convertLanes<double>(v);
        else {
            std::array<float, kWidth> stored;
            v.store(stored.data());
            const real number = Number<T>::load(stored.data());
            if constexpr (Number<T>::isNative)
                return number;
            else
                return finiteTerm(number);
        }
    }
};

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
    EnergyKernel<D> kernel{};
    BlockSumsKernel<D, N> block;
    D rowSums(0.0);
    forEachLaneGroup<N>(width, [&](size_t first, int active) {
#pragma GCC unroll 8
        for (size_t r = 0; r < N; r++) {
            block.numbers[r] = kernel.texelEnergy(
                {countedRadianceOf<N>(red[r] + first, active), countedRadianceOf<N>(green[r] + first, active),
                 countedRadianceOf<N>(blue[r] + first, active)},
                D(rowWeights[firstRow + static_cast<int>(r)]));
        }
        transposeLanes(block.numbers);
        rowSums = block.sumAlong(rowSums, N);
        transposeLanes(block.numbers);
        block.sumAlong(above ? loadActive<double, N>(above + first, active) : D(0.0), N);
#pragma GCC unroll 8
        for (size_t r = 0; r < N; r++) storeActive(block.numbers[r], table + r * width + first, active);
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

template <class T>
RegionSums regionSumsOver(const Image<float>& radiance, const TexelRegion& region, const double* rowWeights) {
    using Kept = typename Number<T>::Kept;
    constexpr int kParts = 8, kWidth = Number<T>::lanes;
    constexpr size_t kTerms = paddedTerms<T>(3);
    EnergyKernel<T> kernel{.image = &radiance, .region = region, .rowWeights = rowWeights};
    kernel.most = std::min(kWidth, kParts);
    std::array<Kept, kParts * kTerms> sums;
    sums.fill(Kept(0.0));
    std::array<Kept, kWidth> lanes;
    for (; kernel.part < kParts; kernel.part += kernel.most) {
        const auto sum = kernel.regionSum(region.width(), region.height(), kParts);
        for (int c = 0; c < 3; c++) {
            Number<T>::storeKept(sum[c], lanes.data());
            for (int i = 0; i < kernel.most; i++)
                sums[static_cast<size_t>(kernel.part + i) * kTerms + static_cast<size_t>(c)] =
                    lanes[static_cast<size_t>(i)];
        }
    }
    foldTerms<T>(sums.data(), kTerms, kParts);
    RegionSums result;
    for (int c = 0; c < 3; c++) result.energy[c] = termAsDouble(sums[static_cast<size_t>(c)]);
    for (int i = 0; i < kWidth; i++) result.uncountedValues += static_cast<size_t>(kernel.uncounted[i]);
    return result;
}
template <class T>
[[gnu::flatten]] RegionSums flattenedRegionSums(const Image<float>& radiance, const TexelRegion& region,
                                                const double* rowWeights) {
    return regionSumsOver<T>(radiance, region, rowWeights);
}
template <class T>
RegionSums regionSums(const Image<float>& radiance, const TexelRegion& region, const double* rowWeights) {
    if constexpr (Number<T>::isNative)
        return flattenedRegionSums<T>(radiance, region, rowWeights);
    else
        return regionSumsOver<T>(radiance, region, rowWeights);
}

template <class T>
Image<double> texelEnergies(const Image<float>& radiance, const double* rowWeights, int threads) {
    Image<double> energies(radiance.width(), radiance.height());
    parallelFor(static_cast<size_t>(radiance.height()), threads, [&](size_t row) {
        const int y = static_cast<int>(row);
        EnergyKernel<T> kernel{.image = &radiance,
                               .region = {0, 0, radiance.width(), radiance.height()},
                               .rowWeights = rowWeights};
        const T weight = kernel.regionWeight(y);
        forEachLaneGroup<Number<T>::lanes>(static_cast<size_t>(radiance.width()), [&](size_t first,
                                                                                      int active) {
            Number<T>::store(kernel.texelEnergy(kernel.countedRadiance(static_cast<int>(first), y), weight),
                             energies.row(y).data() + first, active);
        });
    });
    return energies;
}

}  // namespace etalon
