#include "raster/setup.h"

#include <algorithm>
#include <cmath>

namespace etalon {
namespace {

constexpr double kMaxClipCoordinate = 0x1p500;
constexpr double kGuardBandHalfWidth_px = 65536.0;

// False for NaN and for magnitudes that clipping could overflow with. Negated on purpose: NaN fails every
// test.
bool isUsable(double c) { return std::fabs(c) < kMaxClipCoordinate; }

bool isUsable(const ClipVertex& p) {
    return isUsable(p.x) && isUsable(p.y) && isUsable(p.z) && isUsable(p.w);
}

// Adding 0 turns -0 into +0 and leaves every other value.
ClipVertex withoutNegativeZero(const ClipVertex& p) { return {p.x + 0.0, p.y + 0.0, p.z + 0.0, p.w + 0.0}; }

// Nearest whole number, ties to even, for |v| < 2^51: the sum with 1.5 * 2^52 has no fraction bits.
int32_t roundEven(double v) {
    constexpr double kToWhole = 6755399441055744.0;
    return static_cast<int32_t>((v + kToWhole) - kToWhole);
}

}  // namespace

std::array<EdgeFunction, 3> edgeFunctions(const TriangleRecord& record) {
    std::array<EdgeFunction, 3> edges;
    for (size_t i = 0; i < 3; i++) {
        const size_t a = (i + 1) % 3, b = (i + 2) % 3;
        const int64_t dx = int64_t{record.x_subpx[b]} - record.x_subpx[a];
        const int64_t dy = int64_t{record.y_subpx[b]} - record.y_subpx[a];
        const bool topOrLeft = dy < 0 || (dy == 0 && dx > 0);
        edges[i] = {-dy, dx, dy * record.x_subpx[a] - dx * record.y_subpx[a], topOrLeft};
    }
    return edges;
}

TriangleSetup::TriangleSetup(const Viewport& viewport, int subpixelBits)
    : guard_(viewport),
      centreX_px_(viewport.x + viewport.width / 2.0),
      centreY_px_(viewport.y + viewport.height / 2.0),
      halfWidth_px_(viewport.width / 2.0),
      halfHeight_px_(viewport.height / 2.0),
      subpixels_(static_cast<double>(1 << subpixelBits)) {}

void TriangleSetup::process(const Draw& draw, uint32_t drawIndex, size_t first, size_t last) {
    for (size_t t = first; t < last; t++) {
        std::array<ClipVertex, 3> triangle;
        for (size_t i = 0; i < 3; i++) triangle[i] = draw.vertices[draw.indices[3 * t + i]];
        addTriangle(triangle, draw.state, drawIndex, static_cast<uint32_t>(t));
    }
}

TriangleSetup::SnappedVertex TriangleSetup::snap(const ClipVertex& p) const {
    const double x_px = p.x / p.w * halfWidth_px_ + centreX_px_;
    const double y_px = p.y / p.w * -halfHeight_px_ + centreY_px_;
    const double x_guarded =
        std::clamp(x_px, centreX_px_ - kGuardBandHalfWidth_px, centreX_px_ + kGuardBandHalfWidth_px);
    const double y_guarded =
        std::clamp(y_px, centreY_px_ - kGuardBandHalfWidth_px, centreY_px_ + kGuardBandHalfWidth_px);
    return {roundEven(x_guarded * subpixels_), roundEven(y_guarded * subpixels_), p.z / p.w, 1.0 / p.w};
}

namespace {

// Twice the signed area in subpixels; negative is counter-clockwise on the screen.
template <class V>
int64_t signedArea(const V& a, const V& b, const V& c) {
    return (int64_t{b.x_subpx} - a.x_subpx) * (int64_t{c.y_subpx} - a.y_subpx) -
           (int64_t{c.x_subpx} - a.x_subpx) * (int64_t{b.y_subpx} - a.y_subpx);
}

bool isFront(int64_t area, const DrawState& state) { return (area < 0) != state.frontIsClockwise; }

}  // namespace

// Also counts what is culled.
bool TriangleSetup::isCulled(int64_t area, const DrawState& state) {
    const bool culled = area == 0 || (state.cull == CullMode::back && !isFront(area, state)) ||
                        (state.cull == CullMode::front && isFront(area, state));
    if (area == 0)
        statistics.zeroArea++;
    else if (culled)
        statistics.culled++;
    return culled;
}

TriangleRecord TriangleSetup::makeRecord(const std::array<SnappedVertex, 3>& v, int64_t area,
                                         bool front) const {
    TriangleRecord record{};
    const std::array<uint8_t, 3> order =
        area > 0 ? std::array<uint8_t, 3>{0, 1, 2} : std::array<uint8_t, 3>{0, 2, 1};
    for (size_t i = 0; i < 3; i++) {
        const SnappedVertex& vertex = v[order[i]];
        record.x_subpx[i] = vertex.x_subpx;
        record.y_subpx[i] = vertex.y_subpx;
        record.z[i] = vertex.z;
        record.reciprocalW[i] = vertex.reciprocalW;
    }
    record.corner = order;
    record.area = area > 0 ? area : -area;
    record.front = front;
    record.clipped = -1;
    return record;
}

void TriangleSetup::addTriangle(const std::array<ClipVertex, 3>& source, const DrawState& state,
                                uint32_t draw, uint32_t index) {
    statistics.triangles++;
    std::array<ClipVertex, 3> triangle;
    for (size_t i = 0; i < 3; i++) {
        if (!isUsable(source[i])) {
            statistics.droppedNonFinite++;
            return;
        }
        triangle[i] = withoutNegativeZero(source[i]);
    }
    Polygon polygon;
    switch (clipTriangle(triangle, guard_, state.depthClamp, polygon)) {
        case ClipResult::rejected:
            statistics.rejected++;
            return;
        case ClipResult::clipped:
            statistics.clipped++;
            addPolygon(polygon, state, draw, index);
            return;
        case ClipResult::inside:
            break;
    }
    const std::array<SnappedVertex, 3> v = {snap(triangle[0]), snap(triangle[1]), snap(triangle[2])};
    const int64_t area = signedArea(v[0], v[1], v[2]);
    if (isCulled(area, state)) return;
    TriangleRecord record = makeRecord(v, area, isFront(area, state));
    record.draw = draw;
    record.triangle = index;
    records.push_back(record);
    statistics.records++;
}

void TriangleSetup::addPolygon(const Polygon& polygon, const DrawState& state, uint32_t draw,
                               uint32_t index) {
    std::array<SnappedVertex, kMaxPolygonVertices> v;
    const size_t count = static_cast<size_t>(polygon.count);
    for (size_t i = 0; i < count; i++) v[i] = snap(polygon.vertices[i].position);
    int64_t area = 0;
    bool hasPositive = false, hasNegative = false;
    for (size_t i = 1; i + 1 < count; i++) {
        const int64_t piece = signedArea(v[0], v[i], v[i + 1]);
        area += piece;
        hasPositive = hasPositive || piece > 0;
        hasNegative = hasNegative || piece < 0;
    }
    if (isCulled(area, state)) return;

    const size_t firstRecord = records.size();
    for (size_t i = 1; i + 1 < count; i++) {
        const int64_t piece = signedArea(v[0], v[i], v[i + 1]);
        if (piece == 0) continue;
        TriangleRecord record = makeRecord({v[0], v[i], v[i + 1]}, piece, isFront(area, state));
        record.draw = draw;
        record.triangle = index;
        record.reversed = (piece > 0) != (area > 0);
        record.clipped = static_cast<int32_t>(clippedCorners.size());
        const std::array<size_t, 3> source = {0, i, i + 1};
        ClippedCorners corners;
        for (size_t k = 0; k < 3; k++) corners[k] = polygon.vertices[source[record.corner[k]]].barycentric;
        clippedCorners.push_back(corners);
        records.push_back(record);
        statistics.records++;
    }
    if (hasPositive && hasNegative)
        records[firstRecord].groupSize = static_cast<uint8_t>(records.size() - firstRecord);
}

}  // namespace etalon
