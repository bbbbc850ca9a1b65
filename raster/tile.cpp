#include "raster/tile.h"

#include <algorithm>

#include "raster/depth.h"
#include "raster/setup.h"

namespace etalon {

using RowInt = Lanes<int32_t, kBlockSize>;
using RowDouble = Lanes<double, kBlockSize>;

// A record with everything that its pixels share.
struct TileRasterizer::Piece {
    std::array<EdgeFunction, 3> edges;
    std::array<double, 3> z;
    double reciprocalArea, bias;
    int x0, y0, x1, y1;  // pixels that can be covered: x0 <= x <= x1, y0 <= y <= y1
    uint32_t id;
    bool front, reversed;
    const DrawState* state;
};

// Eight pixels of one sample plane, starting at a multiple of 8 inside the tile.
struct TileRasterizer::BlockRow {
    int x, y;  // target pixels
    int sample;
    int64_t x_subpx, y_subpx;  // sample position of the first pixel
};

namespace {

RowInt laneIndices() {
    return RowInt::generate([](int i) { return i; });
}

// a compared with b: a Result (a mask for lanes, bool for single values).
template <class Result, class Value>
Result compareValues(Compare compare, Value a, Value b) {
    switch (compare) {
        case Compare::never:
            return Result(false);
        case Compare::less:
            return a < b;
        case Compare::equal:
            return a == b;
        case Compare::lessEqual:
            return a <= b;
        case Compare::greater:
            return a > b;
        case Compare::notEqual:
            return a != b;
        case Compare::greaterEqual:
            return a >= b;
        case Compare::always:
            return Result(true);
    }
    return Result(false);
}

uint8_t stencilResult(StencilOperation operation, uint8_t stored, uint8_t reference) {
    switch (operation) {
        case StencilOperation::keep:
            return stored;
        case StencilOperation::zero:
            return 0;
        case StencilOperation::replace:
            return reference;
        case StencilOperation::incrementClamp:
            return static_cast<uint8_t>(std::min(stored + 1, 255));
        case StencilOperation::decrementClamp:
            return static_cast<uint8_t>(std::max(stored - 1, 0));
        case StencilOperation::invert:
            return static_cast<uint8_t>(~stored);
        case StencilOperation::incrementWrap:
            return static_cast<uint8_t>(stored + 1);
        case StencilOperation::decrementWrap:
            return static_cast<uint8_t>(stored - 1);
    }
    return stored;
}

}  // namespace

void TileRasterizer::run(RenderTarget& target, const TileRectangle& rectangle, std::span<const Draw> draws,
                         uint32_t firstDraw, std::span<const uint32_t> recordIndices) {
    if (recordIndices.empty()) return;
    rectangle_ = rectangle;
    format_ = target.format;
    samplePositions_ = samplePositions(format_.samples);
    load(target);
    std::vector<Piece> group;
    for (uint32_t index : recordIndices) {
        const TriangleRecord& record = target.triangles[index];
        const DrawState& state = draws[record.draw - firstDraw].state;
        if (record.groupSize == 0) {
            drawPiece(preparePiece(target, index, state));
            continue;
        }
        group.clear();
        for (uint32_t k = 0; k < record.groupSize; k++)
            group.push_back(preparePiece(target, index + k, state));
        drawGroup(group);
    }
    store(target);
}

void TileRasterizer::load(const RenderTarget& target) {
    const size_t size = static_cast<size_t>(tileSize_) * static_cast<size_t>(tileSize_);
    const size_t total = size * static_cast<size_t>(format_.samples);
    depth_.resize(total);
    stencil_.resize(total);
    id_.resize(total);
    const size_t width = static_cast<size_t>(rectangle_.x1 - rectangle_.tileX);
    for (int s = 0; s < format_.samples; s++) {
        for (int y = rectangle_.y0; y < rectangle_.y1; y++) {
            const size_t to = rowOffset({rectangle_.tileX, y, s, 0, 0});
            const size_t from = static_cast<size_t>(rectangle_.tileX);
            std::copy_n(target.depth.row(y, s).begin() + from, width, depth_.begin() + to);
            std::copy_n(target.stencil.row(y, s).begin() + from, width, stencil_.begin() + to);
            std::copy_n(target.id.row(y, s).begin() + from, width, id_.begin() + to);
        }
    }
}

void TileRasterizer::store(RenderTarget& target) const {
    const size_t width = static_cast<size_t>(rectangle_.x1 - rectangle_.tileX);
    for (int s = 0; s < format_.samples; s++) {
        for (int y = rectangle_.y0; y < rectangle_.y1; y++) {
            const size_t from = rowOffset({rectangle_.tileX, y, s, 0, 0});
            const size_t to = static_cast<size_t>(rectangle_.tileX);
            std::copy_n(depth_.begin() + from, width, target.depth.row(y, s).begin() + to);
            std::copy_n(stencil_.begin() + from, width, target.stencil.row(y, s).begin() + to);
            std::copy_n(id_.begin() + from, width, target.id.row(y, s).begin() + to);
        }
    }
}

size_t TileRasterizer::rowOffset(const BlockRow& row) const {
    const int line = row.sample * tileSize_ + (row.y - rectangle_.tileY);
    return static_cast<size_t>(line) * static_cast<size_t>(tileSize_) +
           static_cast<size_t>(row.x - rectangle_.tileX);
}

TileRasterizer::Piece TileRasterizer::preparePiece(const RenderTarget& target, uint32_t recordIndex,
                                                   const DrawState& state) const {
    const TriangleRecord& record = target.triangles[recordIndex];
    Piece piece;
    piece.edges = edgeFunctions(record);
    piece.z = vertexDepths(record, format_.real);
    piece.reciprocalArea = 1.0 / static_cast<double>(record.area);
    piece.bias = depthBias(state.bias, format_.depth, record, piece.z, format_.subpixelBits);
    const auto [xMin, xMax] = std::minmax({record.x_subpx[0], record.x_subpx[1], record.x_subpx[2]});
    const auto [yMin, yMax] = std::minmax({record.y_subpx[0], record.y_subpx[1], record.y_subpx[2]});
    piece.x0 = std::max(xMin >> format_.subpixelBits, rectangle_.x0);
    piece.y0 = std::max(yMin >> format_.subpixelBits, rectangle_.y0);
    piece.x1 = std::min(xMax >> format_.subpixelBits, rectangle_.x1 - 1);
    piece.y1 = std::min(yMax >> format_.subpixelBits, rectangle_.y1 - 1);
    piece.id = recordIndex;
    piece.front = record.front;
    piece.reversed = record.reversed;
    piece.state = &state;
    return piece;
}

void TileRasterizer::drawPiece(const Piece& piece) {
    if (piece.x0 > piece.x1 || piece.y0 > piece.y1) return;
    const int blockX0 = (piece.x0 - rectangle_.tileX) / kBlockSize,
              blockX1 = (piece.x1 - rectangle_.tileX) / kBlockSize;
    const int blockY0 = (piece.y0 - rectangle_.tileY) / kBlockSize,
              blockY1 = (piece.y1 - rectangle_.tileY) / kBlockSize;
    for (int by = blockY0; by <= blockY1; by++)
        for (int bx = blockX0; bx <= blockX1; bx++)
            for (int s = 0; s < format_.samples; s++)
                drawBlock(piece, rectangle_.tileX + bx * kBlockSize, rectangle_.tileY + by * kBlockSize, s);
}

// Decides each edge for the whole block first; rows then look at the undecided edges only. Edge values are
// floored to whole pixels' steps, E >> n, which keeps the sign and fits 32 bits near an undecided edge:
// |step| <= 2^25, so |E >> n| < 7 * 2 * 2^25 < 2^29 in the block.
void TileRasterizer::drawBlock(const Piece& piece, int blockX, int blockY, int sample) {
    const int n = format_.subpixelBits;
    const auto& position = samplePositions_[static_cast<size_t>(sample)];
    BlockRow row{blockX, blockY, sample, (int64_t{blockX} << n) + ((position[0] << n) >> 4),
                 (int64_t{blockY} << n) + ((position[1] << n) >> 4)};
    struct {
        int32_t value, stepX, stepY;
    } undecided[3];
    int undecidedCount = 0;
    for (const EdgeFunction& edge : piece.edges) {
        const int64_t value = (edge.at(row.x_subpx, row.y_subpx) - (edge.ownsZero ? 0 : 1)) >> n;
        const int64_t acrossX = edge.stepX * (kBlockSize - 1), acrossY = edge.stepY * (kBlockSize - 1);
        const int64_t highest = value + std::max<int64_t>(acrossX, 0) + std::max<int64_t>(acrossY, 0);
        const int64_t lowest = value + std::min<int64_t>(acrossX, 0) + std::min<int64_t>(acrossY, 0);
        if (highest < 0) return;
        if (lowest >= 0) continue;
        undecided[undecidedCount++] = {static_cast<int32_t>(value), static_cast<int32_t>(edge.stepX),
                                       static_cast<int32_t>(edge.stepY)};
    }
    const RowInt lanes = laneIndices();
    const bool wholeRows = blockX >= rectangle_.x0 && blockX + kBlockSize <= rectangle_.x1;
    const int firstRow = std::max(piece.y0 - blockY, 0),
              lastRow = std::min(piece.y1 - blockY, kBlockSize - 1);
    for (int j = firstRow; j <= lastRow; j++) {
        RowInt outside(0.0);
        for (int k = 0; k < undecidedCount; k++) {
            const int32_t atRow = undecided[k].value + undecided[k].stepY * j;
            outside = outside | (RowInt(RowInt::Vector{} + atRow) +
                                 RowInt(RowInt::Vector{} + undecided[k].stepX) * lanes);
        }
        BlockMask covered = outside >= RowInt(0.0);
        const BlockRow here{blockX, blockY + j, sample, row.x_subpx, row.y_subpx + (int64_t{j} << n)};
        if (!wholeRows) covered = covered && insideRectangle(here.x, here.y);
        if (anyOf(covered)) testRow(piece, here, covered);
    }
}

BlockMask TileRasterizer::insideRectangle(int x, int y) const {
    BlockMask inside(false);
    if (y < rectangle_.y0 || y >= rectangle_.y1) return inside;
    for (int i = 0; i < kBlockSize; i++)
        inside.m[i] = x + i >= rectangle_.x0 && x + i < rectangle_.x1 ? -1 : 0;
    return inside;
}

// A polygon some of whose pieces were turned around by snapping (rule 2): rare and thin, so pixel by pixel.
void TileRasterizer::drawGroup(std::span<const Piece> pieces) {
    const int n = format_.subpixelBits;
    int y0 = rectangle_.y1, y1 = rectangle_.y0 - 1, x0 = rectangle_.x1, x1 = rectangle_.x0 - 1;
    for (const Piece& piece : pieces) {
        x0 = std::min(x0, piece.x0);
        x1 = std::max(x1, piece.x1);
        y0 = std::min(y0, piece.y0);
        y1 = std::max(y1, piece.y1);
    }
    x0 = std::max(x0, rectangle_.x0);
    x1 = std::min(x1, rectangle_.x1 - 1);
    const int firstBlockX = rectangle_.tileX + (x0 - rectangle_.tileX) / kBlockSize * kBlockSize;
    for (int y = std::max(y0, rectangle_.y0); y <= std::min(y1, rectangle_.y1 - 1); y++) {
        for (int x = firstBlockX; x <= x1; x += kBlockSize) {
            for (int s = 0; s < format_.samples; s++) {
                const auto& position = samplePositions_[static_cast<size_t>(s)];
                const BlockRow row{x, y, s, (int64_t{x} << n) + ((position[0] << n) >> 4),
                                   (int64_t{y} << n) + ((position[1] << n) >> 4)};
                std::array<int, kBlockSize> firstCovering;
                const BlockMask covered = windingRow(pieces, row, firstCovering) && insideRectangle(x, y);
                for (size_t k = 0; k < pieces.size(); k++) {
                    BlockMask mine = covered;
                    for (int i = 0; i < kBlockSize; i++)
                        if (firstCovering[static_cast<size_t>(i)] != static_cast<int>(k)) mine.m[i] = 0;
                    if (anyOf(mine)) testRow(pieces[k], row, mine);
                }
            }
        }
    }
}

// Which of the row's samples more pieces of the polygon's sign cover than reversed ones, and the first
// covering piece of the polygon's sign.
BlockMask TileRasterizer::windingRow(std::span<const Piece> pieces, const BlockRow& row,
                                     std::span<int> firstCovering) const {
    BlockMask covered(false);
    for (int i = 0; i < kBlockSize; i++) {
        const int64_t x_subpx = row.x_subpx + (int64_t{i} << format_.subpixelBits);
        int winding = 0, first = -1;
        for (size_t k = 0; k < pieces.size(); k++) {
            bool inside = true;
            for (const EdgeFunction& edge : pieces[k].edges)
                inside = inside && edge.covers(x_subpx, row.y_subpx);
            if (!inside) continue;
            winding += pieces[k].reversed ? -1 : 1;
            if (!pieces[k].reversed && first < 0) first = static_cast<int>(k);
        }
        firstCovering[static_cast<size_t>(i)] = first;
        covered.m[i] = winding > 0 ? -1 : 0;
    }
    return covered;
}

// The stored depths of the row (rules 5 to 7). Edge values are exact integers below 2^53, so doubles hold
// them.
template <class Real>
RowInt TileRasterizer::rowDepth(const Piece& piece, const BlockRow& row) const {
    using Row = Lanes<Real, kBlockSize>;
    using Kernels = RasterKernels<Row>;
    const RowDouble lanes = convertLanes<double>(laneIndices());
    Row e[3], z[3];
    for (size_t i = 0; i < 3; i++) {
        const EdgeFunction& edge = piece.edges[i];
        const double atFirst = static_cast<double>(edge.at(row.x_subpx, row.y_subpx));
        const double perPixel = static_cast<double>(edge.stepX * (int64_t{1} << format_.subpixelBits));
        e[i] = convertLanes<Real>(RowDouble(atFirst) + RowDouble(perPixel) * lanes);
        z[i] = Row(piece.z[i]);
    }
    Kernels kernels;
    using vec3 = typename Kernels::vec3;
    Row depth =
        kernels.interpolateDepth(vec3(e[0], e[1], e[2]), Row(piece.reciprocalArea), vec3(z[0], z[1], z[2]));
    if (piece.bias != 0) depth = depth + Row(piece.bias);
    return storedDepth(format_.depth, format_.depthRounding, depth);
}

void TileRasterizer::testRow(const Piece& piece, const BlockRow& row, BlockMask covered) {
    const DrawState& state = *piece.state;
    const size_t offset = rowOffset(row);
    const RowInt stored = RowInt::load(&depth_[offset]);
    const RowInt depth =
        format_.real == RasterReal::fp32 ? rowDepth<float>(piece, row) : rowDepth<double>(piece, row);
    BlockMask passed = covered && compareValues<BlockMask>(state.depthCompare, depth, stored);
    if (state.stencil.enabled) passed = stencilRow(piece, row, covered, passed);
    if (state.depthWrite) select(passed, depth, stored).store(&depth_[offset]);
    if (!state.idWrite) return;
    for (int i = 0; i < kBlockSize; i++)
        if (passed[i]) id_[offset + static_cast<size_t>(i)] = piece.id;
}

// Runs the stencil test and operations; returns the samples that pass both tests.
BlockMask TileRasterizer::stencilRow(const Piece& piece, const BlockRow& row, BlockMask covered,
                                     BlockMask depthPassed) {
    const StencilState& stencil = piece.state->stencil;
    const StencilFace& face = piece.front ? stencil.front : stencil.back;
    const size_t offset = rowOffset(row);
    BlockMask passed(false);
    for (int i = 0; i < kBlockSize; i++) {
        if (!covered[i]) continue;
        uint8_t& stored = stencil_[offset + static_cast<size_t>(i)];
        StencilOperation operation = face.onStencilFail;
        if (compareValues<bool>(face.compare, stencil.reference & stencil.readMask,
                                stored & stencil.readMask)) {
            operation = depthPassed[i] ? face.onPass : face.onDepthFail;
            passed.m[i] = depthPassed[i] ? -1 : 0;
        }
        const uint8_t result = stencilResult(operation, stored, stencil.reference);
        stored = static_cast<uint8_t>((stored & ~stencil.writeMask) | (result & stencil.writeMask));
    }
    return passed;
}

}  // namespace etalon
