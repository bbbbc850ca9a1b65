// The tiles of a viewport, and the pixels whose samples an interval of subpixels can hold.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "raster/rasterizer.h"
#include "raster/render_target.h"

namespace etalon {

// The tiles x0 <= x <= x1, y0 <= y <= y1; none when x0 > x1.
struct TileBox {
    uint16_t x0, y0, x1, y1;
};
inline constexpr TileBox kNoTiles = {1, 1, 0, 0};

// First and last pixel along one axis with a sample inside [min, max] (subpixels).
class SampleInterval {
  public:
    // axis: 0 for x, 1 for y.
    SampleInterval(const RenderTargetFormat& format, size_t axis) : bits_(format.subpixelBits) {
        lowest_ = INT32_MAX, highest_ = INT32_MIN;
        for (const auto& position : samplePositions(format.samples)) {
            lowest_ = std::min(lowest_, (position[axis] << bits_) >> 4);
            highest_ = std::max(highest_, (position[axis] << bits_) >> 4);
        }
    }
    int first(int32_t min_subpx) const { return (min_subpx - highest_ + (1 << bits_) - 1) >> bits_; }
    int last(int32_t max_subpx) const { return (max_subpx - lowest_) >> bits_; }

  private:
    int bits_;
    int32_t lowest_, highest_;  // sample positions in a pixel
};

class TileGrid {
  public:
    TileGrid(const Viewport& viewport, int tileSize, const RenderTargetFormat& format);

    size_t count() const { return static_cast<size_t>(columns_) * static_cast<size_t>(rows_); }
    size_t index(int column, int row) const {
        return static_cast<size_t>(row) * static_cast<size_t>(columns_) + static_cast<size_t>(column);
    }

    // The tiles that samples of a box of subpixels can be in; kNoTiles when it holds no sample of the
    // viewport.
    TileBox tilesOf(int32_t xMin_subpx, int32_t yMin_subpx, int32_t xMax_subpx, int32_t yMax_subpx) const {
        const int x0 = std::max(x_.first(xMin_subpx), viewport_.x),
                  y0 = std::max(y_.first(yMin_subpx), viewport_.y);
        const int x1 = std::min(x_.last(xMax_subpx), viewport_.x + viewport_.width - 1);
        const int y1 = std::min(y_.last(yMax_subpx), viewport_.y + viewport_.height - 1);
        if (x0 > x1 || y0 > y1) return kNoTiles;
        return {columnOf(x0), rowOf(y0), columnOf(x1), rowOf(y1)};
    }

    // The pixels of a tile inside the viewport, and the tile's corner.
    struct Rectangle {
        int tileX, tileY;
        int x0, y0, x1, y1;  // x0 <= x < x1, y0 <= y < y1
    };
    Rectangle rectangle(size_t tile) const;

  private:
    // A division per triangle would cost more than the look-up per 8 pixels, which is what tiles are
    // multiples of.
    uint16_t columnOf(int x) const { return columnOfBlock_[static_cast<size_t>(x >> 3)]; }
    uint16_t rowOf(int y) const { return rowOfBlock_[static_cast<size_t>(y >> 3)]; }

    Viewport viewport_;
    int size_, firstX_, firstY_, columns_,
        rows_;  // firstX_, firstY_: tiles are counted from the target's corner
    SampleInterval x_, y_;
    std::vector<uint16_t> columnOfBlock_, rowOfBlock_;
};

}  // namespace etalon
