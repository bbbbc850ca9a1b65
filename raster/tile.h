// Visibility of one tile: replays triangle records in order (rules 4 to 7, 10 and 11).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "numeric/lanes.h"
#include "raster/draw.h"
#include "raster/render_target.h"

namespace etalon {

// Coverage is decided in blocks of 8 x 8 pixels, one row of 8 lanes at a time.
inline constexpr int kBlockSize = 8;
using BlockMask = Mask<int32_t, kBlockSize>;

// The pixels x0 <= x < x1, y0 <= y < y1 of a tile that lie inside the viewport, and the tile's corner.
struct TileRectangle {
    int tileX, tileY;
    int x0, y0, x1, y1;
};

// Depth, stencil and ids of one tile; reused from tile to tile by one thread.
class TileRasterizer {
  public:
    explicit TileRasterizer(int tileSize) : tileSize_(tileSize) {}

    // Draws the records whose indices are listed, in that order, with the state of their draw (`draws` start
    // at the target's draw number firstDraw). A record with a groupSize stands for its whole group.
    void run(RenderTarget& target, const TileRectangle& rectangle, std::span<const Draw> draws,
             uint32_t firstDraw, std::span<const uint32_t> recordIndices);

  private:
    struct Piece;
    struct BlockRow;

    void load(const RenderTarget& target);
    void store(RenderTarget& target) const;
    Piece preparePiece(const RenderTarget& target, uint32_t recordIndex, const DrawState& state) const;
    void drawPiece(const Piece& piece);
    void drawBlock(const Piece& piece, int blockX, int blockY, int sample);
    void drawGroup(std::span<const Piece> pieces);
    BlockMask windingRow(std::span<const Piece> pieces, const BlockRow& row,
                         std::span<int> firstCovering) const;
    BlockMask insideRectangle(int x, int y) const;
    template <class Real>
    Lanes<int32_t, kBlockSize> rowDepth(const Piece& piece, const BlockRow& row) const;
    void testRow(const Piece& piece, const BlockRow& row, BlockMask covered);
    BlockMask stencilRow(const Piece& piece, const BlockRow& row, BlockMask covered, BlockMask depthPassed);
    size_t rowOffset(const BlockRow& row) const;

    int tileSize_;
    TileRectangle rectangle_{};
    RenderTargetFormat format_;
    std::span<const std::array<int, 2>> samplePositions_;
    std::vector<int32_t> depth_;
    std::vector<uint8_t> stencil_;
    std::vector<uint32_t> id_;
};

}  // namespace etalon
