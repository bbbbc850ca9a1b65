// Summed-area tables [Crow84]: the sum over any rectangle of texels from the entries at its four corners
// [Pedersen2008, Eq. 6.1, 6.2].
//
// EnergyTable, in double, is what the median cut stands on. summedArea and boxSums compute the same in the
// arithmetic T of a profile (probes/light_passes.h), to show what few digits do to a difference of large
// sums. Signal-to-noise ratio of 1x1 boxes, which should be the texels (peak 1), for random texels in [0, 1)
// on 256^2, 1024^2 and 4096^2 texels: float 68, 44 and 20 dB, fp24 of R300 26, 3 and -10 dB, double above 200
// dB, float with the mean subtracted first above 94 dB, but 55 dB for a ramp on 1024^2 (test:
// TablesOfFewDigitsLoseTheTexels).
#pragma once

#include <algorithm>
#include <array>
#include <memory>
#include <span>
#include <vector>

#include "numeric/kernel_types.h"
#include "numeric/number.h"
#include "numeric/parallel.h"
#include "probes/probe_light.h"
#include "raster/image.h"

namespace etalon {

// Sums over rectangles of texels of the energy of their counted radiance (probes/energy_passes.h) times the
// weight of their row.
//
// Order of the sums, the same for any number of threads: each row is summed from the left; in bands of
// kBandRows rows these sums are added from above; the last rows of the bands are added from above.
class EnergyTable {
  public:
    static constexpr int kBandRows = 32;
    // Largest error of sum() in units of the whole image's energy times (width + height).
    static constexpr double kError = 0x1p-52;

    // Three channels, at least one texel; a weight for each row.
    EnergyTable(const Image<float>& radiance, std::span<const double> rowWeights, int threads);

    // From the entries of a table of one channel, as summedArea computes them in any arithmetic; sums of them
    // are in double.
    explicit EnergyTable(const Image<double>& entries);

    int width() const { return width_; }
    int height() const { return height_; }

    // Over the texels of the region, which lies in the image; 0 for an empty one.
    double sum(const TexelRegion& r) const {
        return (corner(r.x1, r.y1) - corner(r.x1, r.y0)) - (corner(r.x0, r.y1) - corner(r.x0, r.y0));
    }
    // Of the whole image.
    double total() const { return corner(width_, height_); }
    // The largest error of sum(): sums below it are not known from 0.
    double noise() const { return kError * (width_ + height_) * total(); }

  private:
    double corner(int x, int y) const {
        if (x == 0 || y == 0) return 0.0;
        const auto row = static_cast<size_t>(y - 1), column = static_cast<size_t>(x - 1);
        const size_t band = row / kBandRows, stride = static_cast<size_t>(width_);
        return bandStart_[band * stride + column] + inBand_[row * stride + column];
    }

    int width_, height_;
    std::unique_ptr<double[], void (*)(void*)> inBand_;  // [y][x]: the texels up to (x, y) in its band's rows
    std::vector<double> bandStart_;                      // [band][x]: those above the band
};

// What summed_area.glsl sums, and the text, over T: the rows, or columns, of a table from the one numbered `first` on, in
// lanes.
template <class T>
struct SummedAreaKernel {
#include "numeric/kernel_scope.inc"
    Image<double>* table = nullptr;
    bool sumsColumns = false;
    int first = 0;

    double& at(int i, int line) const { return sumsColumns ? table->at(line, i) : table->at(i, line); }
    int last() const { return (sumsColumns ? table->width() : table->height()) - 1; }
    real tableNumber(int i) const {
        return Number<T>::generate([&](int lane) { return at(i, std::min(first + lane, last())); });
    }
    void setTableNumber(int i, real sum) const {
        for (int lane = 0; lane < Number<T>::lanes && first + lane <= last(); lane++)
            at(i, first + lane) = numberLane(sum, lane);
    }
#include "probes/kernels/summed_area.glsl"
};

// The text over T for kNumbers numbers of each lane's row, or column.
template <class T, size_t kNumbers>
struct BlockSumsKernel {
#include "numeric/kernel_scope.inc"
    std::array<T, kNumbers> numbers;

    real tableNumber(int i) const { return numbers[static_cast<size_t>(i)]; }
    void setTableNumber(int i, real sum) { numbers[static_cast<size_t>(i)] = sum; }
#include "probes/kernels/summed_area.glsl"
};

// The values, each rounded once to T.
template <class T>
Image<double> roundedValues(const Image<double>& values, int threads) {
    constexpr int kWidth = Number<T>::lanes;
    Image<double> result = values;
    parallelFor(static_cast<size_t>(values.height()) * static_cast<size_t>(values.channels()), threads,
                [&](size_t item) {
                    const auto height = static_cast<size_t>(values.height());
                    const auto row =
                        result.row(static_cast<int>(item % height), static_cast<int>(item / height));
                    forEachLaneGroup<kWidth>(row.size(), [&](size_t first, int active) {
                        const T rounded = Number<T>::generate([&](int lane) {
                            return row[first + static_cast<size_t>(std::min(lane, active - 1))];
                        });
                        for (int lane = 0; lane < active; lane++)
                            row[first + static_cast<size_t>(lane)] = numberLane(rounded, lane);
                    });
                });
    return result;
}

// Entry (x, y): the sum of the texels in columns 0 ... x and rows 0 ... y, in the arithmetic T. Each row is
// summed from the left, then these sums from above, every sum rounded to T. One channel.
template <class T>
Image<double> summedArea(const Image<double>& values, int threads) {
    ETALON_CHECK(values.channels() == 1, "{} channels", values.channels());
    constexpr int kWidth = Number<T>::lanes;
    Image<double> table = values;
    for (const bool sumsColumns : {false, true}) {
        const int lines = sumsColumns ? table.width() : table.height();
        parallelFor((static_cast<size_t>(lines) + kWidth - 1) / kWidth, threads, [&](size_t group) {
            SummedAreaKernel<T> kernel{&table, sumsColumns, static_cast<int>(group) * kWidth};
            kernel.sumAlong(T(0.0), sumsColumns ? table.height() : table.width());
        });
    }
    return table;
}

// The sums over the boxes of width x height texels, in T, from a table: pixel (x, y) is the box whose upper
// left texel is (x, y). The image is (width - 1, height - 1) smaller than the table; the box fits in it.
template <class T>
Image<double> boxSums(const Image<double>& table, int width, int height, int threads) {
    ETALON_CHECK(table.channels() == 1 && width >= 1 && height >= 1 && width <= table.width() &&
                     height <= table.height(),
                 "box of {}x{} in a table of {}x{} with {} channels", width, height, table.width(),
                 table.height(), table.channels());
    constexpr int kWidth = Number<T>::lanes;
    using Kernel = SummedAreaKernel<T>;
    Image<double> sums(table.width() - width + 1, table.height() - height + 1);
    parallelFor(static_cast<size_t>(sums.height()), threads, [&](size_t row) {
        const int y = static_cast<int>(row);
        Kernel kernel{};
        forEachLaneGroup<kWidth>(static_cast<size_t>(sums.width()), [&](size_t first, int active) {
            const auto entry = [&](int dx, int dy) {
                return Number<T>::generate([&](int lane) {
                    const int x = static_cast<int>(first) + std::min(lane, active - 1) + dx;
                    return x < 0 || y + dy < 0 ? 0.0 : table.at(x, y + dy);
                });
            };
            const T sum = kernel.boxSum(entry(width - 1, height - 1), entry(width - 1, -1),
                                        entry(-1, height - 1), entry(-1, -1));
            for (int lane = 0; lane < active; lane++)
                sums.at(static_cast<int>(first) + lane, y) = numberLane(sum, lane);
        });
    });
    return sums;
}

}  // namespace etalon
