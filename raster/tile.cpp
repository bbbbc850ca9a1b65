#include "raster/tile.h"

#include <algorithm>
#include <array>
#include <vector>

#include "numeric/door.h"
#include "raster/block_depth.h"
#include "raster/depth.h"
#include "raster/exact_depth.h"
#include "raster/setup.h"
#include "raster/tile_group.h"

namespace etalon {
namespace {

static_assert(kBlockSize % kGroupWidth == 0 && kBlockSize % kGroupRows == 0);

using Rectangle = TileGrid::Rectangle;

// Edges whose values fit 32 bits everywhere in the groups that the triangle touches: those of triangles of at
// most 2^14 subpixels. Then |E| <= 2 * 2^14 * (2^14 + 2 * 8 * 2^8) < 2^31.
constexpr int32_t kSmallExtent_subpx = 1 << 14;

// A triangle with everything that its pixels share.
struct Piece {
    struct Edge {
        int32_t x, y;          // its first vertex, in subpixels
        int32_t stepX, stepY;  // of E per subpixel
        int32_t excluded;      // 1 when samples with E = 0 are outside, else 0

        int64_t at(int64_t x_subpx, int64_t y_subpx) const {
            return int64_t{stepX} * (x_subpx - x) + int64_t{stepY} * (y_subpx - y);
        }
    };
    std::array<Edge, 3> edges;
    std::array<double, 3> z;
    int64_t area;
    double bias;
    int x0, y0, x1, y1;  // pixels that can be covered: x0 <= x <= x1, y0 <= y <= y1
    uint32_t id;
    bool front, reversed, isSmall;
    const DrawState* state;
};

// What a draw does with its samples; the two special ones are written out for speed.
//   plain: what is nearer passes and is written, no stencil; depths of 32 bits that grow with the distance
//   counting: what is nearer passes, nothing is written but a stencil that every sample adds 1, 0 or -1 to (modulo
//             2^bits), by the outcome of the depth test
enum class DrawKind { any, plain, counting };

// 1, 0 or -1 for an operation that adds it and wraps; else kNoFixedNumber.
constexpr int kNoFixedNumber = 2;
int addedBy(StencilOperation operation) {
    switch (operation) {
        case StencilOperation::keep:
            return 0;
        case StencilOperation::incrementWrap:
            return 1;
        case StencilOperation::decrementWrap:
            return -1;
        default:
            return kNoFixedNumber;
    }
}
bool isCounting(const StencilFace& face) {
    return face.compare == Compare::always && addedBy(face.onDepthFail) != kNoFixedNumber &&
           addedBy(face.onPass) != kNoFixedNumber;
}
inline DrawKind kindOf(const DrawState& state, const RenderTargetFormat& format) {
    if (state.depthCompare != nearerThan(format.depthDirection)) return DrawKind::any;
    const StencilState& stencil = state.stencil;
    if (stencil.enabled) {
        const bool writesNothingElse = !state.depthWrite && !state.idWrite && stencil.writeMask == 0xff;
        return writesNothingElse && isCounting(stencil.front) && isCounting(stencil.back) ? DrawKind::counting
                                                                                          : DrawKind::any;
    }
    const bool isUsual =
        format.depth != DepthFormat::d64f && format.depthDirection == DepthDirection::forward;
    return state.depthWrite && isUsual ? DrawKind::plain : DrawKind::any;
}

// kGroup pixels of one sample plane.
struct Group {
    int x, y;       // target pixel of the first
    size_t offset;  // of the first in the tile's planes
};

GroupMask compareValues(Compare compare, GroupInt a, GroupInt b) {
    switch (compare) {
        case Compare::never:
            return GroupMask(false);
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
            return GroupMask(true);
    }
    return GroupMask(false);
}

GroupInt stencilResult(StencilOperation operation, GroupInt stored, GroupInt reference) {
    const GroupInt one = splat(1), largest = splat(255);
    switch (operation) {
        case StencilOperation::keep:
            return stored;
        case StencilOperation::zero:
            return splat(0);
        case StencilOperation::replace:
            return reference;
        case StencilOperation::incrementClamp:
            return select(stored < largest, stored + one, largest);
        case StencilOperation::decrementClamp:
            return select(stored > splat(0), stored - one, splat(0));
        case StencilOperation::invert:
            return largest - stored;
        case StencilOperation::incrementWrap:
            return (stored + one) & largest;
        case StencilOperation::decrementWrap:
            return (stored - one) & largest;
    }
    return stored;
}

// What a piece's depth needs, in lanes of the raster arithmetic.
template <class Real>
struct PieceDepth {
    using Row = Lanes<Real, kGroup>;
    using Kernels = RasterKernels<Row>;
    using vec3 = typename Kernels::vec3;

    // Many small pieces turn out to cover nothing: set when the first sample is covered.
    bool isSet = false;
    void set(const Piece& piece) {
        z = vec3(Row(piece.z[0]), Row(piece.z[1]), Row(piece.z[2]));
        lowest = Row(std::min({piece.z[0], piece.z[1], piece.z[2]}));
        highest = Row(std::max({piece.z[0], piece.z[1], piece.z[2]}));
        reciprocalArea = Row(1.0 / static_cast<double>(piece.area));
        bias = Row(piece.bias);
        hasBias = piece.bias != 0;
        isSet = true;
    }

    // The depths for the edge values e (rules 5 and 7).
    [[gnu::always_inline]] Row at(const vec3& e) const {
        Kernels kernels;
        const Row depth = kernels.interpolateDepth(e, reciprocalArea, z, lowest, highest);
        return hasBias ? depth + bias : depth;
    }

    vec3 z{Row(0.0), Row(0.0), Row(0.0)};
    Row lowest{0.0}, highest{0.0}, reciprocalArea{0.0}, bias{0.0};
    bool hasBias = false;
};

class TileRasterizerOfLevel final : public TileRasterizer {
  public:
    void run(const TileWork& work, const Rectangle& rectangle, std::span<const uint32_t> triangles) override;

  private:
    template <class Stored, class Copy>
    void forEachRow(Image<Stored>& image, Copy copy) const;
    template <class Stored, class Kept>
    void load(bool used, const TileWork& work, Image<Stored>& image, Stored cleared,
              std::vector<Kept>& plane);
    template <class Stored, class Kept>
    void store(bool used, const TileWork& work, Image<Stored>& image, Stored cleared,
               const std::vector<Kept>& plane) const;
    Piece preparePiece(const RenderTarget& target, uint32_t number, const DrawState& state) const;
    template <class Real>
    void drawAll(const TileWork& work, std::span<const uint32_t> triangles);
    template <class Real>
    void drawPiece(const Piece& piece);
    // Not inlined: each kind has the registers to itself.
    template <class Real, DrawKind kKind>
    [[gnu::noinline]] void drawSmallPiece(const Piece& piece);
    template <class Real, DrawKind kKind>
    void drawLargePiece(const Piece& piece);
    template <class Real>
    void drawGroup(std::span<const Piece> pieces);
    GroupMask winding(std::span<const Piece> pieces, int64_t x_subpx, int64_t y_subpx,
                      std::span<int> firstCovering) const;
    template <class Visit>
    void forEachGroup(const Piece& box, int sample, Visit visit) const;
    GroupMask insideRectangle(const Group& group) const;
    template <class Real, DrawKind kKind>
    void test(const Piece& piece, const PieceDepth<Real>& depth, const typename PieceDepth<Real>::vec3& e,
              const Group& group, GroupMask covered);
    template <class Real, DrawKind kKind>
    [[gnu::noinline]] void testDoubles(const Piece& piece, const Lanes<Real, kGroup>& z, const Group& group,
                                       GroupMask covered);
    void orderExactly(const Piece& piece, const Group& group, GroupMask covered,
                      const DoubleDepth<kGroup>& depth, const DoubleDepth<kGroup>& stored,
                      GroupInt& order) const;
    ExactDepth exactDepth(const Piece& piece, int x, int y, int sample) const;
    bool isReversed() const { return format_.depthDirection == DepthDirection::reversed; }
    GroupMask isNearer(GroupInt depth, GroupInt stored) const {
        return isReversed() ? depth > stored : depth < stored;
    }
    void findRanges();
    // -1, 0 or 1 for the block's samples whose depth test passes, and for those whose does not.
    struct Added {
        int onPass, onFail;
    };
    static Added addedBy(const Piece& piece) {
        const StencilState& stencil = piece.state->stencil;
        const StencilFace& face = piece.front ? stencil.front : stencil.back;
        return {etalon::addedBy(face.onPass), etalon::addedBy(face.onDepthFail)};
    }
    void count(const Group& group, GroupInt added) {
        int32_t* at = &stencil_[group.offset];
        storeGroup((loadGroup(at, stride_) + added) & splat(stencilMask_), at, stride_);
    }
    const DepthRange& rangeOf(const Piece& block, int sample) const {
        const int row = (block.y0 - rectangle_.tileY) / kBlockSize,
                  column = (block.x0 - rectangle_.tileX) / kBlockSize;
        return ranges_[static_cast<size_t>((sample * blockRows_ + row) * blocksPerRow_ + column)];
    }
    GroupMask testStencil(const Piece& piece, const Group& group, GroupMask covered, GroupMask depthPassed);

    std::array<int64_t, 2> samplePosition(int x, int y, int sample) const {
        const auto& position = samplePositions_[static_cast<size_t>(sample)];
        const int n = format_.subpixelBits;
        return {(int64_t{x} << n) + ((position[0] << n) >> 4), (int64_t{y} << n) + ((position[1] << n) >> 4)};
    }
    size_t offsetOf(int x, int y, int sample) const {
        const auto line = static_cast<size_t>(sample * rows_ + (y - rectangle_.tileY));
        return line * stride_ + static_cast<size_t>(x - rectangle_.tileX);
    }
    bool holds(const Group& group) const {
        return group.x >= rectangle_.x0 && group.x + kGroupWidth <= rectangle_.x1 &&
               group.y >= rectangle_.y0 && group.y + kGroupRows <= rectangle_.y1;
    }

    Rectangle rectangle_{};
    RenderTargetFormat format_;
    std::span<const std::array<int, 2>> samplePositions_;
    // Planes have room for a group that starts at the last pixel.
    int rows_ = 0;
    size_t stride_ = 0;
    std::vector<SampleInterval> intervals_;  // in x, in y
    std::vector<int32_t> depth_, lowDepth_, id_, stencil_;
    const TileWork* work_ = nullptr;
    double undecided_ = 0;  // depths that are so near each other are decided without roundings
    int32_t stencilMask_ = 0xff;
    std::vector<Piece> group_;
    // What the blocks of each sample's plane store, row after row; empty if some draw writes depth.
    std::vector<DepthRange> ranges_;
    int blocksPerRow_ = 0, blockRows_ = 0;
};

void TileRasterizerOfLevel::run(const TileWork& work, const Rectangle& rectangle,
                                std::span<const uint32_t> triangles) {
    RenderTarget& target = *work.target;
    work_ = &work;
    rectangle_ = rectangle;
    format_ = target.format;
    samplePositions_ = samplePositions(format_.samples);
    intervals_ = {SampleInterval(format_, 0), SampleInterval(format_, 1)};
    rows_ = rectangle.y1 - rectangle.tileY + kGroupRows - 1;
    stride_ = static_cast<size_t>(rectangle.x1 - rectangle.tileX + kGroupWidth - 1);
    for (const Draw& draw : work.draws)
        ETALON_CHECK(format_.stencilBits == 8 || !draw.state.stencil.enabled ||
                         kindOf(draw.state, format_) == DrawKind::counting,
                     "a stencil of {} bits only counts", format_.stencilBits);
    load(true, work, target.depth, farthestDepth(format_), depth_);
    const bool isDouble = format_.depth == DepthFormat::d64f;
    load(isDouble, work, target.lowDepth, uint32_t{0}, lowDepth_);
    load(work.usesId, work, target.id, kNoTriangle, id_);
    const bool isWide = format_.stencilBits == 32;
    stencilMask_ = isWide ? -1 : 0xff;
    load(work.usesStencil && !isWide, work, target.stencil, uint8_t{0}, stencil_);
    load(work.usesStencil && isWide, work, target.wideStencil, uint32_t{0}, stencil_);
    // Depths are rounded less than nine times.
    undecided_ = format_.depthOrder == DepthOrder::exact ? 0x1p-48 * target.largestDepth : 0;
    ranges_.clear();
    if (!work.writesDepth && work.usesStencil) findRanges();
    if (format_.real == RasterReal::fp32)
        drawAll<float>(work, triangles);
    else
        drawAll<double>(work, triangles);
    store(true, work, target.depth, farthestDepth(format_), depth_);
    if (isDouble) store(true, work, target.lowDepth, uint32_t{0}, lowDepth_);
    store(work.usesId, work, target.id, kNoTriangle, id_);
    if (isWide)
        store(work.usesStencil, work, target.wideStencil, uint32_t{0}, stencil_);
    else
        store(work.usesStencil, work, target.stencil, uint8_t{0}, stencil_);
}

// Calls copy(first value of the row in the image, offset in the tile's plane, count) for each row of the
// rectangle.
template <class Stored, class Copy>
void TileRasterizerOfLevel::forEachRow(Image<Stored>& image, Copy copy) const {
    const auto count = static_cast<size_t>(rectangle_.x1 - rectangle_.x0);
    for (int s = 0; s < format_.samples; s++)
        for (int y = rectangle_.y0; y < rectangle_.y1; y++)
            copy(&image.at(rectangle_.x0, y, s), offsetOf(rectangle_.x0, y, s), count);
}

// Fills the tile's plane from the image, or as cleared.
template <class Stored, class Kept>
void TileRasterizerOfLevel::load(bool used, const TileWork& work, Image<Stored>& image, Stored cleared,
                                 std::vector<Kept>& plane) {
    if (!used) return;
    const size_t total = static_cast<size_t>(rows_ * format_.samples) * stride_;
    if (work.clear) {
        plane.assign(total, static_cast<Kept>(cleared));
        return;
    }
    plane.resize(total);
    forEachRow(image,
               [&](const Stored* from, size_t to, size_t count) { std::copy_n(from, count, &plane[to]); });
}

template <class Stored, class Kept>
void TileRasterizerOfLevel::store(bool used, const TileWork& work, Image<Stored>& image, Stored cleared,
                                  const std::vector<Kept>& plane) const {
    if (used)
        forEachRow(image,
                   [&](Stored* to, size_t from, size_t count) { std::copy_n(&plane[from], count, to); });
    else if (work.clear)
        forEachRow(image, [&](Stored* to, size_t, size_t count) { std::fill_n(to, count, cleared); });
}

void TileRasterizerOfLevel::findRanges() {
    blocksPerRow_ = (rectangle_.x1 - rectangle_.tileX + kBlockSize - 1) / kBlockSize;
    blockRows_ = (rectangle_.y1 - rectangle_.tileY + kBlockSize - 1) / kBlockSize;
    for (int s = 0; s < format_.samples; s++)
        for (int row = 0; row < blockRows_; row++)
            for (int column = 0; column < blocksPerRow_; column++) {
                const int x0 = std::max(rectangle_.tileX + column * kBlockSize, rectangle_.x0),
                          y0 = std::max(rectangle_.tileY + row * kBlockSize, rectangle_.y0),
                          x1 = std::min(rectangle_.tileX + (column + 1) * kBlockSize, rectangle_.x1),
                          y1 = std::min(rectangle_.tileY + (row + 1) * kBlockSize, rectangle_.y1);
                int32_t smallest = INT32_MAX, largest = INT32_MIN;
                for (int y = y0; y < y1; y++)
                    for (int x = x0; x < x1; x++) {
                        const int32_t depth = depth_[offsetOf(x, y, s)];
                        smallest = std::min(smallest, depth), largest = std::max(largest, depth);
                    }
                const auto numberOf = [&](int32_t stored, uint32_t low) {
                    return depthFromStored(format_.depth, static_cast<uint32_t>(stored), low);
                };
                ranges_.push_back(
                    {numberOf(smallest, 0) - undecided_, numberOf(largest, ~uint32_t{0}) + undecided_});
            }
}

Piece TileRasterizerOfLevel::preparePiece(const RenderTarget& target, uint32_t number,
                                          const DrawState& state) const {
    const StoredTriangle& stored = target.triangles[number];
    const std::array<const ProjectedVertex*, 3> v = {&target.vertex(stored, 0), &target.vertex(stored, 1),
                                                     &target.vertex(stored, 2)};
    Piece piece;
    for (size_t i = 0; i < 3; i++) {
        const ProjectedVertex &a = *v[(i + 1) % 3], &b = *v[(i + 2) % 3];
        const int32_t dx = b.x_subpx - a.x_subpx, dy = b.y_subpx - a.y_subpx;
        piece.edges[i] = {a.x_subpx, a.y_subpx, -dy, dx, dy < 0 || (dy == 0 && dx > 0) ? 0 : 1};
        piece.z[i] = v[i]->z;
    }
    const Piece::Edge &e1 = piece.edges[1], &e2 = piece.edges[2];
    piece.area = int64_t{e2.stepY} * e1.stepX - int64_t{e1.stepY} * e2.stepX;
    const auto [xMin, xMax] = std::minmax({v[0]->x_subpx, v[1]->x_subpx, v[2]->x_subpx});
    const auto [yMin, yMax] = std::minmax({v[0]->y_subpx, v[1]->y_subpx, v[2]->y_subpx});
    piece.isSmall = xMax - xMin <= kSmallExtent_subpx && yMax - yMin <= kSmallExtent_subpx;
    piece.x0 = std::max(intervals_[0].first(xMin), rectangle_.x0);
    piece.y0 = std::max(intervals_[1].first(yMin), rectangle_.y0);
    piece.x1 = std::min(intervals_[0].last(xMax), rectangle_.x1 - 1);
    piece.y1 = std::min(intervals_[1].last(yMax), rectangle_.y1 - 1);
    piece.id = number;
    piece.front = stored.front;
    piece.reversed = stored.reversed;
    piece.state = &state;
    piece.bias = state.bias.constant == 0 && state.bias.slopeScale == 0
                     ? 0
                     : depthBias(state.bias, format_, target.triangle(number));
    return piece;
}

template <class Real>
void TileRasterizerOfLevel::drawAll(const TileWork& work, std::span<const uint32_t> triangles) {
    const RenderTarget& target = *work.target;
    for (const uint32_t number : triangles) {
        const StoredTriangle& stored = target.triangles[number];
        const DrawState& state = work.draws[stored.draw - work.firstDraw].state;
        if (stored.groupSize == 0) {
            drawPiece<Real>(preparePiece(target, number, state));
            continue;
        }
        group_.clear();
        for (uint32_t k = 0; k < stored.groupSize; k++)
            group_.push_back(preparePiece(target, number + k, state));
        drawGroup<Real>(group_);
    }
}

template <class Real>
void TileRasterizerOfLevel::drawPiece(const Piece& piece) {
    if (piece.x0 > piece.x1 || piece.y0 > piece.y1) return;
    const auto draw = [&]<DrawKind kKind>() {
        piece.isSmall ? drawSmallPiece<Real, kKind>(piece) : drawLargePiece<Real, kKind>(piece);
    };
    switch (kindOf(*piece.state, format_)) {
        case DrawKind::any:
            return draw.template operator()<DrawKind::any>();
        case DrawKind::plain:
            return draw.template operator()<DrawKind::plain>();
        case DrawKind::counting:
            return draw.template operator()<DrawKind::counting>();
    }
}

// Calls visit(group, x, y) for groups that cover the piece's box; (x, y) is the group's place in the box.
template <class Visit>
[[gnu::always_inline]] inline void TileRasterizerOfLevel::forEachGroup(const Piece& box, int sample,
                                                                       Visit visit) const {
    size_t line = offsetOf(box.x0, box.y0, sample);
    for (int y = box.y0; y <= box.y1; y += kGroupRows, line += kGroupRows * stride_) {
        size_t offset = line;
        for (int x = box.x0; x <= box.x1; x += kGroupWidth, offset += kGroupWidth)
            visit(Group{x, y, offset}, x - box.x0, y - box.y0);
    }
}

// 32-bit edge values.
template <class Real, DrawKind kKind>
void TileRasterizerOfLevel::drawSmallPiece(const Piece& piece) {
    PieceDepth<Real> depth;
    const int n = format_.subpixelBits;
    int32_t stepX[3], stepY[3];
    GroupInt lanes[3], excluded[3];
    for (size_t i = 0; i < 3; i++) {
        stepX[i] = piece.edges[i].stepX * (1 << n);
        stepY[i] = piece.edges[i].stepY * (1 << n);
        lanes[i] = splat(stepX[i]) * laneX() + splat(stepY[i]) * laneY();
        excluded[i] = splat(piece.edges[i].excluded);
    }
    for (int s = 0; s < format_.samples; s++) {
        const auto [x_subpx, y_subpx] = samplePosition(piece.x0, piece.y0, s);
        int32_t first[3];
        for (size_t i = 0; i < 3; i++) first[i] = static_cast<int32_t>(piece.edges[i].at(x_subpx, y_subpx));
        forEachGroup(piece, s, [&](const Group& group, int x, int y) {
            GroupInt e[3];
            for (int i = 0; i < 3; i++) e[i] = lanes[i] + splat(first[i] + stepX[i] * x + stepY[i] * y);
            const GroupInt outside = (e[0] - excluded[0]) | (e[1] - excluded[1]) | (e[2] - excluded[2]);
            GroupMask covered = outside >= splat(0);
            if (!anyOf(covered)) return;
            if (!holds(group)) covered = covered && insideRectangle(group);
            if (!depth.isSet) depth.set(piece);
            test<Real, kKind>(piece, depth,
                              {convertLanes<Real>(e[0]), convertLanes<Real>(e[1]), convertLanes<Real>(e[2])},
                              group, covered);
        });
    }
}

// Decides each edge for a block first; its groups then look at the undecided edges only. There edge values
// are floored to whole pixels' steps, E >> n, which keeps the sign and fits 32 bits near an undecided edge:
// |step| <= 2^25, so |E >> n| < 7 * 2 * 2^25 < 2^29 in the block. Depth takes E itself, below 2^53, from
// doubles. Blocks whose samples all pass the depth test, or all fail, are counted without their depths.
template <class Real, DrawKind kKind>
void TileRasterizerOfLevel::drawLargePiece(const Piece& piece) {
    PieceDepth<Real> depth;
    depth.set(piece);
    const int n = format_.subpixelBits;
    GroupInt lanes[3];
    GroupDouble laneValues[3];
    double stepX[3], stepY[3];
    int64_t least[3],
        most[3];  // from the block's first pixel to the one with the least, and the largest, value
    for (size_t i = 0; i < 3; i++) {
        const Piece::Edge& edge = piece.edges[i];
        const int64_t acrossX = int64_t{edge.stepX} * (kBlockSize - 1),
                      acrossY = int64_t{edge.stepY} * (kBlockSize - 1);
        least[i] = std::min<int64_t>(acrossX, 0) + std::min<int64_t>(acrossY, 0);
        most[i] = std::max<int64_t>(acrossX, 0) + std::max<int64_t>(acrossY, 0);
        lanes[i] = splat(edge.stepX) * laneX() + splat(edge.stepY) * laneY();
        stepX[i] = static_cast<double>(int64_t{edge.stepX} * (1 << n));
        stepY[i] = static_cast<double>(int64_t{edge.stepY} * (1 << n));
        laneValues[i] = generateDoubles([&](int lane) {
            const int column = lane % kGroupWidth, row = lane / kGroupWidth;
            return stepX[i] * column + stepY[i] * row;
        });
    }
    const double levels = depthLevels(format_.depth), step = levels == 0 ? 0.0 : 1 / levels;
    const BlockDepth blockDepth(piece.z, static_cast<double>(piece.area), stepX, stepY, piece.bias, step);
    const auto drawBlock = [&](const Piece& block, int sample, const std::array<int64_t, 3>& values) {
        const auto [x_subpx, y_subpx] = samplePosition(block.x0, block.y0, sample);
        int undecided[3], undecidedCount = 0;
        int32_t floored[3];
        double first[3];
        for (size_t i = 0; i < 3; i++) {
            const Piece::Edge& edge = piece.edges[i];
            first[i] = static_cast<double>(edge.at(x_subpx, y_subpx));
            if (values[i] + least[i] >= 0) continue;
            floored[i] = static_cast<int32_t>(values[i]);
            undecided[undecidedCount++] = static_cast<int>(i);
        }
        bool isDecided = false;
        int added = 0;
        if constexpr (kKind == DrawKind::counting) {
            if (!ranges_.empty()) {
                const DepthRange drawn = blockDepth.at(first), &stored = rangeOf(block, sample);
                const bool isLess = drawn.largest<stored.smallest, isGreater = drawn.smallest> stored.largest,
                           passes = isReversed() ? isGreater : isLess,
                           fails = isReversed() ? isLess : isGreater;
                isDecided = passes || fails;
                added = passes ? addedBy(piece).onPass : addedBy(piece).onFail;
                if (isDecided && added == 0) return;
            }
        }
        forEachGroup(block, sample, [&](const Group& group, int x, int y) {
            GroupInt outside = splat(0);
            for (int k = 0; k < undecidedCount; k++) {
                const int i = undecided[k];
                const Piece::Edge& edge = piece.edges[static_cast<size_t>(i)];
                outside = outside | (lanes[i] + splat(floored[i] + edge.stepX * x + edge.stepY * y));
            }
            GroupMask covered = outside >= splat(0);
            if (!holds(group)) covered = covered && insideRectangle(group);
            if (!anyOf(covered)) return;
            if (isDecided) return count(group, select(covered, splat(added), splat(0)));
            const auto edgeValue = [&](int i) {
                const PartDouble atGroup(first[i] + (stepX[i] * x + stepY[i] * y));
                GroupDouble e;
                for (size_t part = 0; part < kParts; part++) e[part] = laneValues[i][part] + atGroup;
                return groupOf<Real>(e);
            };
            test<Real, kKind>(piece, depth, {edgeValue(0), edgeValue(1), edgeValue(2)}, group, covered);
        });
    };
    Piece block = piece;
    // Blocks begin where those of the tile do.
    const int x0 = piece.x0 - (piece.x0 - rectangle_.tileX) % kBlockSize,
              y0 = piece.y0 - (piece.y0 - rectangle_.tileY) % kBlockSize;
    for (int s = 0; s < format_.samples; s++) {
        const auto [x_subpx, y_subpx] = samplePosition(x0, y0, s);
        std::array<int64_t, 3> ofRow;
        for (size_t i = 0; i < 3; i++)
            ofRow[i] = (piece.edges[i].at(x_subpx, y_subpx) - piece.edges[i].excluded) >> n;
        for (int y = y0; y <= piece.y1; y += kBlockSize) {
            block.y0 = y, block.y1 = std::min(y + kBlockSize - 1, piece.y1);
            std::array<int64_t, 3> values = ofRow;
            for (int x = x0; x <= piece.x1; x += kBlockSize) {
                block.x0 = x, block.x1 = std::min(x + kBlockSize - 1, piece.x1);
                if (((values[0] + most[0]) | (values[1] + most[1]) | (values[2] + most[2])) >= 0)
                    drawBlock(block, s, values);
                for (size_t i = 0; i < 3; i++) values[i] += int64_t{piece.edges[i].stepX} * kBlockSize;
            }
            for (size_t i = 0; i < 3; i++) ofRow[i] += int64_t{piece.edges[i].stepY} * kBlockSize;
        }
    }
}

GroupMask TileRasterizerOfLevel::insideRectangle(const Group& group) const {
    const GroupInt x = splat(group.x) + laneX(), y = splat(group.y) + laneY();
    return x >= splat(rectangle_.x0) && x < splat(rectangle_.x1) && y >= splat(rectangle_.y0) &&
           y < splat(rectangle_.y1);
}

// A polygon some of whose pieces were turned around by snapping (rule 2): rare and thin, so pixel by pixel.
template <class Real>
void TileRasterizerOfLevel::drawGroup(std::span<const Piece> pieces) {
    Piece box = pieces[0];
    for (const Piece& piece : pieces) {
        box.x0 = std::min(box.x0, piece.x0);
        box.x1 = std::max(box.x1, piece.x1);
        box.y0 = std::min(box.y0, piece.y0);
        box.y1 = std::max(box.y1, piece.y1);
    }
    box.x0 = std::max(box.x0, rectangle_.x0);
    box.y0 = std::max(box.y0, rectangle_.y0);
    box.x1 = std::min(box.x1, rectangle_.x1 - 1);
    box.y1 = std::min(box.y1, rectangle_.y1 - 1);
    const auto visit = [&](const Group& group, int sample) {
        const std::array<int64_t, 2> position = samplePosition(group.x, group.y, sample);
        const int64_t x_subpx = position[0], y_subpx = position[1];
        std::array<int, kGroup> firstCovering;
        const GroupMask covered = winding(pieces, x_subpx, y_subpx, firstCovering) && insideRectangle(group);
        for (size_t k = 0; k < pieces.size(); k++) {
            GroupMask mine = covered;
            for (int i = 0; i < kGroup; i++)
                if (firstCovering[static_cast<size_t>(i)] != static_cast<int>(k)) mine.m[i] = 0;
            if (!anyOf(mine)) continue;
            const auto edgeValue = [&](const Piece::Edge& edge) {
                const int n = format_.subpixelBits;
                return groupOf<Real>(generateDoubles([&](int i) {
                    return edge.at(x_subpx + (int64_t{i % kGroupWidth} << n),
                                   y_subpx + (int64_t{i / kGroupWidth} << n));
                }));
            };
            const auto& edges = pieces[k].edges;
            PieceDepth<Real> depth;
            depth.set(pieces[k]);
            test<Real, DrawKind::any>(pieces[k], depth,
                                      {edgeValue(edges[0]), edgeValue(edges[1]), edgeValue(edges[2])}, group,
                                      mine);
        }
    };
    for (int s = 0; s < format_.samples; s++)
        forEachGroup(box, s, [&](const Group& group, int, int) { visit(group, s); });
}

// Which of the group's samples more pieces of the polygon's sign cover than reversed ones, and the first
// covering piece of the polygon's sign. x_subpx, y_subpx: the first sample.
GroupMask TileRasterizerOfLevel::winding(std::span<const Piece> pieces, int64_t x_subpx, int64_t y_subpx,
                                         std::span<int> firstCovering) const {
    GroupMask covered(false);
    for (int i = 0; i < kGroup; i++) {
        const int64_t x = x_subpx + (int64_t{i % kGroupWidth} << format_.subpixelBits);
        const int64_t y = y_subpx + (int64_t{i / kGroupWidth} << format_.subpixelBits);
        int sum = 0, first = -1;
        for (size_t k = 0; k < pieces.size(); k++) {
            bool inside = true;
            for (const Piece::Edge& edge : pieces[k].edges) inside = inside && edge.at(x, y) >= edge.excluded;
            if (!inside) continue;
            sum += pieces[k].reversed ? -1 : 1;
            if (!pieces[k].reversed && first < 0) first = static_cast<int>(k);
        }
        firstCovering[static_cast<size_t>(i)] = first;
        covered.m[i] = sum > 0 ? -1 : 0;
    }
    return covered;
}

// storedDepth for formats that it computes something for, a register at a time: what is not exact, in double.
template <class S, int N>
[[gnu::always_inline]] inline Lanes<int32_t, N> storedByRegister(DepthFormat format, DepthRounding rounding,
                                                                 Lanes<S, N> z) {
    if constexpr (N > kNativeLanes<double> && N > 1) {
        if (format != DepthFormat::d32f && (rounding != DepthRounding::exact || N > kNativeLanes<S>))
            return joinLanes(storedByRegister(format, rounding, lowerLanes(z)),
                             storedByRegister(format, rounding, upperLanes(z)));
    }
    return storedDepth(format, rounding, z);
}

// Depth and stencil test and the writes. kKind: that of the draw's state, or any.
template <class Real, DrawKind kKind>
[[gnu::always_inline]] inline void TileRasterizerOfLevel::test(const Piece& piece,
                                                               const PieceDepth<Real>& pieceDepth,
                                                               const typename PieceDepth<Real>::vec3& e,
                                                               const Group& group, GroupMask covered) {
    if (kKind != DrawKind::plain && format_.depth == DepthFormat::d64f)
        return testDoubles<Real, kKind>(piece, pieceDepth.at(e), group, covered);
    const DrawState& state = *piece.state;
    const GroupInt stored = loadGroup(&depth_[group.offset], stride_);
    GroupInt depth;
    GroupMask passed;
    if constexpr (kKind == DrawKind::counting) {
        const Added added = addedBy(piece);
        depth = storedByRegister(format_.depth, format_.depthRounding, pieceDepth.at(e));
        const GroupInt ofOutcome = select(isNearer(depth, stored), splat(added.onPass), splat(added.onFail));
        return count(group, select(covered, ofOutcome, splat(0)));
    }
    if constexpr (kKind == DrawKind::plain) {
        depth = storedByRegister(format_.depth, format_.depthRounding, pieceDepth.at(e));
        passed = covered && depth < stored;
    } else {
        depth = storedByRegister(format_.depth, format_.depthRounding, pieceDepth.at(e));
        passed = covered && compareValues(state.depthCompare, depth, stored);
        if (state.stencil.enabled) passed = testStencil(piece, group, covered, passed);
    }
    if (kKind == DrawKind::plain || state.depthWrite)
        storeGroup(select(passed, depth, stored), &depth_[group.offset], stride_);
    if (state.idWrite) {
        int32_t* id = &id_[group.offset];
        storeGroup(select(passed, splat(static_cast<int32_t>(piece.id)), loadGroup(id, stride_)), id,
                   stride_);
    }
}

// The same for depths of 64 bits.
template <class Real, DrawKind kKind>
void TileRasterizerOfLevel::testDoubles(const Piece& piece, const Lanes<Real, kGroup>& z, const Group& group,
                                        GroupMask covered) {
    const DrawState& state = *piece.state;
    const DoubleDepth<kGroup> depth = storedDoubleDepth(z),
                              stored{loadGroup(&depth_[group.offset], stride_),
                                     loadGroup(&lowDepth_[group.offset], stride_)};
    // Below 0, 0 or above it: the depth is less than, equal to or greater than what is stored. The upper halves are not
    // negative, the lower ones have no sign.
    const auto orderOf = [](GroupInt a, GroupInt b, GroupInt whenEqual) {
        return select(a < b, splat(-1), select(a > b, splat(1), whenEqual));
    };
    const auto unsignedOrder = [](GroupInt a) { return GroupInt(a.v ^ splat(INT32_MIN).v); };
    GroupInt order = orderOf(depth.high, stored.high,
                             orderOf(unsignedOrder(depth.low), unsignedOrder(stored.low), splat(0)));
    if (format_.depthOrder == DepthOrder::exact) orderExactly(piece, group, covered, depth, stored, order);
    if constexpr (kKind == DrawKind::counting) {
        const Added added = addedBy(piece);
        const GroupInt ofOutcome =
            select(isNearer(order, splat(0)), splat(added.onPass), splat(added.onFail));
        return count(group, select(covered, ofOutcome, splat(0)));
    }
    GroupMask passed = covered && compareValues(state.depthCompare, order, splat(0));
    if (kKind == DrawKind::any && state.stencil.enabled) passed = testStencil(piece, group, covered, passed);
    if (state.depthWrite) {
        storeGroup(select(passed, depth.high, stored.high), &depth_[group.offset], stride_);
        storeGroup(select(passed, depth.low, stored.low), &lowDepth_[group.offset], stride_);
    }
    if (state.idWrite) {
        int32_t* id = &id_[group.offset];
        storeGroup(select(passed, splat(static_cast<int32_t>(piece.id)), loadGroup(id, stride_)), id,
                   stride_);
    }
}

// The order of depths that are so near that their roundings may have decided.
void TileRasterizerOfLevel::orderExactly(const Piece& piece, const Group& group, GroupMask covered,
                                         const DoubleDepth<kGroup>& depth, const DoubleDepth<kGroup>& stored,
                                         GroupInt& order) const {
    const auto numberOf = [](const DoubleDepth<kGroup>& of, int i) {
        return depthFromStored(DepthFormat::d64f, static_cast<uint32_t>(of.high[i]),
                               static_cast<uint32_t>(of.low[i]));
    };
    for (int i = 0; i < kGroup; i++) {
        const double there = numberOf(stored, i);
        if (!covered[i] || std::fabs(numberOf(depth, i) - there) > undecided_) continue;
        const size_t at = group.offset + static_cast<size_t>(i / kGroupWidth) * stride_ +
                          static_cast<size_t>(i % kGroupWidth);
        const int x = group.x + i % kGroupWidth, y = group.y + i / kGroupWidth;
        const int sample = static_cast<int>(at / stride_) / rows_;
        const auto id = static_cast<uint32_t>(id_[at]);
        ExactDepth before = ExactDepth::of(there);
        if (id != kNoTriangle) {
            ETALON_CHECK(id < work_->target->triangles.size(), "triangle {} is forgotten", id);
            DrawState state;
            state.bias = work_->target->biases[work_->target->triangles[id].draw];
            before = exactDepth(preparePiece(*work_->target, id, state), x, y, sample);
        }
        order.set(i, compareDepths(exactDepth(piece, x, y, sample), before));
    }
}

ExactDepth TileRasterizerOfLevel::exactDepth(const Piece& piece, int x, int y, int sample) const {
    const auto [x_subpx, y_subpx] = samplePosition(x, y, sample);
    ExactDepth depth{{}, piece.z, piece.area, piece.bias};
    for (size_t i = 0; i < 3; i++) depth.e[i] = piece.edges[i].at(x_subpx, y_subpx);
    return depth;
}

// Runs the stencil test and operations; returns the samples that pass both tests.
GroupMask TileRasterizerOfLevel::testStencil(const Piece& piece, const Group& group, GroupMask covered,
                                             GroupMask depthPassed) {
    const StencilState& stencil = piece.state->stencil;
    const StencilFace& face = piece.front ? stencil.front : stencil.back;
    int32_t* at = &stencil_[group.offset];
    const GroupInt stored = loadGroup(at, stride_), readMask = splat(stencil.readMask);
    const GroupMask stencilPassed =
        covered && compareValues(face.compare, splat(stencil.reference) & readMask, stored & readMask);
    const GroupMask passed = stencilPassed && depthPassed;
    GroupInt result = stored;
    const auto apply = [&](StencilOperation operation, GroupMask where) {
        if (operation == StencilOperation::keep) return;
        result = select(where, stencilResult(operation, stored, splat(stencil.reference)), result);
    };
    apply(face.onStencilFail, covered && !stencilPassed);
    apply(face.onDepthFail, stencilPassed && !depthPassed);
    apply(face.onPass, passed);
    const int32_t written = stencil.writeMask;
    storeGroup((stored & splat(~written)) | (result & splat(written)), at, stride_);
    return passed;
}

std::unique_ptr<TileRasterizer> makeTileRasterizer() { return std::make_unique<TileRasterizerOfLevel>(); }

}  // namespace

template <>
constexpr TilePasses kPassesOver<TilePasses, void> = {makeTileRasterizer};
template const TilePasses& ETALON_LEVEL::passesOf<TilePasses>();

}  // namespace etalon
