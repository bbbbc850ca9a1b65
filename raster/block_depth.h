// Blocks of pixels whose depth tests have one outcome, found without the depth of any pixel. Included by
// sources that are compiled once per level.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace etalon {

// Large triangles are decided in blocks of 8 x 8 pixels first.
inline constexpr int kBlockSize = 8;

// Depths as numbers.
struct DepthRange {
    double smallest, largest;
};

// The depths of a triangle over a block: what rules 5 to 7 give for its samples lies inside the range.
class BlockDepth {
  public:
    // z: the z_i of rule 5; area: A; stepX, stepY: of the edge values from pixel to pixel; bias: of rule 7;
    // step: between the numbers that the depth format stores (0 for floats).
    BlockDepth(const std::array<double, 3>& z, double area, const double (&stepX)[3],
               const double (&stepY)[3], double bias, double step)
        : z_(z), reciprocal_(1 / area) {
        double acrossX = 0, acrossY = 0, largest = 0;
        for (size_t i = 0; i < 3; i++) {
            acrossX += stepX[i] * z[i] * (kBlockSize - 1), acrossY += stepY[i] * z[i] * (kBlockSize - 1);
            across_ += (std::fabs(stepX[i]) + std::fabs(stepY[i])) * (kBlockSize - 1) * std::fabs(z[i]);
            largest = std::max(largest, std::fabs(z[i]));
        }
        below_ = (std::min(acrossX, 0.0) + std::min(acrossY, 0.0)) * reciprocal_ + bias;
        above_ = (std::max(acrossX, 0.0) + std::max(acrossY, 0.0)) * reciprocal_ + bias;
        hull_ = {std::min({z[0], z[1], z[2]}) + bias, std::max({z[0], z[1], z[2]}) + bias};
        // Rules 5 to 7 round less than nine times in float, the weights are positive and add up to 1.
        margin_ = kLost * (largest + std::fabs(bias)) + step;
    }

    // e: the edge values at the first sample of the block.
    DepthRange at(const double (&e)[3]) const {
        double sum = 0, magnitude = across_;
        for (size_t i = 0; i < 3; i++) sum += e[i] * z_[i], magnitude += std::fabs(e[i] * z_[i]);
        const double first = sum * reciprocal_, margin = margin_ + kLostHere * magnitude * reciprocal_;
        const double smallest = std::max(first + below_, hull_.smallest) - margin,
                     largest = std::min(first + above_, hull_.largest) + margin;
        return {std::min(smallest, 1.0), std::max(largest, 0.0)};
    }

  private:
    // Of a sum of positive parts, nine roundings to 24 bits; and of the sums here, whose parts have either
    // sign.
    static constexpr double kLost = 0x1p-20, kLostHere = 0x1p-44;

    std::array<double, 3> z_;
    double reciprocal_, across_ = 0, below_, above_, margin_;
    DepthRange hull_;
};

}  // namespace etalon
