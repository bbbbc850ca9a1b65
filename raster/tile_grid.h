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
    // The first sample of a pixel, and the last one.
    int32_t sampleOf(int pixel) const { return (pixel << bits_) + lowest_; }
    int32_t lastSampleOf(int pixel) const { return (pixel << bits_) + highest_; }

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

    // The pixels of the viewport x0 <= x <= x1, y0 <= y <= y1 that have a sample in a box of subpixels; none
    // when x0 > x1 or y0 > y1.
    struct PixelBox {
        int x0, y0, x1, y1;
        bool empty() const { return x0 > x1 || y0 > y1; }
    };
    PixelBox pixelsOf(int32_t xMin_subpx, int32_t yMin_subpx, int32_t xMax_subpx, int32_t yMax_subpx) const {
        return {std::max(x_.first(xMin_subpx), viewport_.x), std::max(y_.first(yMin_subpx), viewport_.y),
                std::min(x_.last(xMax_subpx), viewport_.x + viewport_.width - 1),
                std::min(y_.last(yMax_subpx), viewport_.y + viewport_.height - 1)};
    }
    TileBox tilesOf(const PixelBox& box) const {
        if (box.empty()) return kNoTiles;
        return {columnOf(box.x0), rowOf(box.y0), columnOf(box.x1), rowOf(box.y1)};
    }

    // Subpixels from the first to the last sample of a column of tiles (those of a row), and from column to
    // column.
    struct Samples {
        int32_t first, last;
    };
    Samples samplesOfColumn(int column) const { return samplesOf(x_, firstX_ + column); }
    Samples samplesOfRow(int row) const { return samplesOf(y_, firstY_ + row); }
    int32_t tileSize_subpx() const { return x_.sampleOf(size_) - x_.sampleOf(0); }

    // The only sample of a pixel, in a format with one sample per pixel.
    bool hasOneSample() const { return samples_ == 1; }
    int32_t sampleX_subpx(int x) const { return x_.sampleOf(x); }
    int32_t sampleY_subpx(int y) const { return y_.sampleOf(y); }

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
    Samples samplesOf(const SampleInterval& axis, int tile) const {
        return {axis.sampleOf(tile * size_), axis.lastSampleOf((tile + 1) * size_ - 1)};
    }

    Viewport viewport_;
    int size_, firstX_, firstY_, columns_,
        rows_;  // firstX_, firstY_: tiles are counted from the target's corner
    int samples_;
    SampleInterval x_, y_;
    std::vector<uint16_t> columnOfBlock_, rowOfBlock_;
};

}  // namespace etalon
