#include "numeric/sum.h"

#include <algorithm>
#include <array>
#include <limits>
#include <vector>

#include "numeric/parallel.h"

namespace etalon {
namespace {

// Tiles that one call of a thread's body adds: enough work to be worth a call.
constexpr size_t kTilesPerTask = 64;

template <class S>
double sumOfTile(const S* values, size_t count) {
    std::array<double, kSumLanes> partial{};
    const size_t whole = count / kSumLanes * kSumLanes;
    for (size_t first = 0; first < whole; first += kSumLanes)
        for (size_t j = 0; j < kSumLanes; j++) partial[j] += static_cast<double>(values[first + j]);
    for (size_t i = whole; i < count; i++) partial[i - whole] += static_cast<double>(values[i]);
    for (size_t half = kSumLanes / 2; half > 0; half /= 2)
        for (size_t j = 0; j < half; j++) partial[j] += partial[j + half];
    return partial[0];
}

template <class S>
double sumOf(std::span<const S> values, int threads) {
    const size_t tiles = (values.size() + kSumTile - 1) / kSumTile;
    if (tiles == 0) return 0.0;
    std::vector<double> sums(tiles);
    parallelFor((tiles + kTilesPerTask - 1) / kTilesPerTask, threads, [&](size_t task) {
        const size_t last = std::min(tiles, (task + 1) * kTilesPerTask);
        for (size_t tile = task * kTilesPerTask; tile < last; tile++) {
            const size_t first = tile * kSumTile;
            sums[tile] = sumOfTile(values.data() + first, std::min<size_t>(kSumTile, values.size() - first));
        }
    });
    for (size_t count = tiles; count > 1; count = (count + 1) / 2) {
        for (size_t i = 0; i < count / 2; i++) sums[i] = sums[2 * i] + sums[2 * i + 1];
        if (count % 2 == 1) sums[count / 2] = sums[count - 1];
    }
    return sums[0] == sums[0] ? sums[0] : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

double fixedSum(std::span<const float> values, int threads) { return sumOf(values, threads); }
double fixedSum(std::span<const double> values, int threads) { return sumOf(values, threads); }

}  // namespace etalon
