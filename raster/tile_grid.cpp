#include "raster/tile_grid.h"

namespace etalon {
namespace {

std::vector<uint16_t> tileOfBlocks(int end_px, int tileSize, int firstTile) {
    std::vector<uint16_t> tiles;
    for (int x = 0; x < end_px; x += 8)
        tiles.push_back(static_cast<uint16_t>(std::max(x / tileSize - firstTile, 0)));
    return tiles;
}

}  // namespace

TileGrid::TileGrid(const Viewport& viewport, int tileSize, const RenderTargetFormat& format)
    : viewport_(viewport),
      size_(tileSize),
      firstX_(viewport.x / tileSize),
      firstY_(viewport.y / tileSize),
      columns_((viewport.x + viewport.width - 1) / tileSize - firstX_ + 1),
      rows_((viewport.y + viewport.height - 1) / tileSize - firstY_ + 1),
      samples_(format.samples),
      x_(format, 0),
      y_(format, 1),
      columnOfBlock_(tileOfBlocks(viewport.x + viewport.width, tileSize, firstX_)),
      rowOfBlock_(tileOfBlocks(viewport.y + viewport.height, tileSize, firstY_)) {}

TileGrid::Rectangle TileGrid::rectangle(size_t tile) const {
    const int tileX = (firstX_ + static_cast<int>(tile % static_cast<size_t>(columns_))) * size_;
    const int tileY = (firstY_ + static_cast<int>(tile / static_cast<size_t>(columns_))) * size_;
    return {tileX,
            tileY,
            std::max(tileX, viewport_.x),
            std::max(tileY, viewport_.y),
            std::min(tileX + size_, viewport_.x + viewport_.width),
            std::min(tileY + size_, viewport_.y + viewport_.height)};
}

}  // namespace etalon
