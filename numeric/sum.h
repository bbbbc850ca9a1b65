// Sums whose shape depends on the number of values only: the same bits for any number of threads and lanes.
#pragma once

#include <span>

namespace etalon {

// Values per tile, and partial sums per tile.
inline constexpr int kSumTile = 1024;
inline constexpr int kSumLanes = 32;

// The sum of the values, in double, on `threads` threads (0: all hardware threads).
// Shape: the values are cut into tiles of kSumTile, the last one shorter. In a tile, partial sum j adds the
// values j, j + 32, j + 64, ... in order, starting from 0; then j + 16 is added to j, then j + 8 to j, and so
// on down to one. The sums of the tiles are added in the same manner: neighbours in pairs, again and again,
// an odd last one kept as it is. Empty spans give 0. Error: at most (kSumTile / kSumLanes + 5 +
// ceil(log2(tiles))) 2^-53 times the sum of the magnitudes; for 2^24 values 51 2^-53 = 5.7e-15. Typical:
// 3e-17 relative for 2^24 positive floats. A NaN or infinities of both signs give NaN (always the same bits),
// infinities of one sign that infinity. For doubles, partial sums may overflow where the whole would not.
double fixedSum(std::span<const float> values, int threads = 1);
double fixedSum(std::span<const double> values, int threads = 1);

}  // namespace etalon
