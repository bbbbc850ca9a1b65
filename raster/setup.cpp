#include "raster/setup.h"

namespace etalon {
namespace {

using Kernel = Projection<double>;

// Twice the signed area in subpixels; negative is counter-clockwise on the screen.
int64_t signedArea(const ProjectedVertex& a, const ProjectedVertex& b, const ProjectedVertex& c) {
    return (int64_t{b.x_subpx} - a.x_subpx) * (int64_t{c.y_subpx} - a.y_subpx) -
           (int64_t{c.x_subpx} - a.x_subpx) * (int64_t{b.y_subpx} - a.y_subpx);
}

bool isFront(int64_t area, const DrawState& state) { return (area < 0) != state.frontIsClockwise; }

ProjectedVertex project(const ClipVertex& v, const ViewportTransform& transform) {
    const Kernel::vec4 p(v.x, v.y, v.z, v.w);
    return {static_cast<int32_t>(Kernel::snapX(p, transform)),
            static_cast<int32_t>(Kernel::snapY(p, transform)), Kernel::depth(p, transform), 1.0 / v.w};
}

EdgeFunction edgeBetween(int64_t xa_subpx, int64_t ya_subpx, int64_t xb_subpx, int64_t yb_subpx) {
    const int64_t dx = xb_subpx - xa_subpx, dy = yb_subpx - ya_subpx;
    const bool topOrLeft = dy < 0 || (dy == 0 && dx > 0);
    return {-dy, dx, dy * xa_subpx - dx * ya_subpx, topOrLeft};
}
EdgeFunction edgeBetween(const ProjectedVertex& a, const ProjectedVertex& b) {
    return edgeBetween(a.x_subpx, a.y_subpx, b.x_subpx, b.y_subpx);
}

std::array<EdgeFunction, 3> edgesOf(const ProjectedVertex& a, const ProjectedVertex& b,
                                    const ProjectedVertex& c) {
    return {edgeBetween(b, c), edgeBetween(c, a), edgeBetween(a, b)};
}

// Orientation made positive.
StoredTriangle storedTriangle(std::array<uint32_t, 3> vertex, int64_t area, bool front) {
    StoredTriangle t{};
    t.exchanged = area < 0;
    if (t.exchanged) std::swap(vertex[1], vertex[2]);
    t.vertex = vertex;
    t.front = front;
    return t;
}

}  // namespace

std::array<EdgeFunction, 3> edgeFunctions(const TriangleRecord& record) {
    std::array<EdgeFunction, 3> edges;
    for (size_t i = 0; i < 3; i++) {
        const size_t a = (i + 1) % 3, b = (i + 2) % 3;
        edges[i] = edgeBetween(record.x_subpx[a], record.y_subpx[a], record.x_subpx[b], record.y_subpx[b]);
    }
    return edges;
}

void TriangleSetup::begin(const ViewportTransform& transform, const TileGrid& grid) {
    transform_ = &transform;
    grid_ = &grid;
    triangles.clear();
    tiles.clear();
    endOfTiles.clear();
    clippedVertices.clear();
    countOfTile.assign(grid.count(), 0);
    statistics = {};
}

void TriangleSetup::process(const DrawInput& input, size_t first, size_t last) {
    const DrawState& state = input.draw->state;
    const int planes = state.depthClamp ? ~kDepthPlanes : ~0;
    for (size_t k = first; k < last; k++) {
        const size_t t = input.draw->triangleNumber(k);
        ETALON_CHECK(3 * t + 2 < input.draw->indices.size(), "triangle {} of draw {}, which has {} indices",
                     t, input.number, input.draw->indices.size());
        std::array<uint32_t, 3> corners;
        for (size_t i = 0; i < 3; i++) {
            corners[i] = input.draw->indices[3 * t + i];
            ETALON_CHECK(corners[i] < input.projected.size(), "index {} of draw {} is {}, vertices: {}",
                         3 * t + i, input.number, corners[i], input.projected.size());
        }
        const int code0 = input.outcodes[corners[0]] & planes, code1 = input.outcodes[corners[1]] & planes,
                  code2 = input.outcodes[corners[2]] & planes;
        const int outsideAny = code0 | code1 | code2;
        if (outsideAny == 0) {
            addTriangle(input, static_cast<uint32_t>(t), corners);
        } else if ((outsideAny & kUnusableVertex) != 0) {
            statistics.droppedNonFinite++;
        } else if ((code0 & code1 & code2) != 0) {
            statistics.rejected++;
        } else {
            addClipped(input, static_cast<uint32_t>(t), corners, outsideAny);
        }
    }
    statistics.triangles += last - first;
}

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

void TriangleSetup::addTriangle(const DrawInput& input, uint32_t index,
                                const std::array<uint32_t, 3>& corners) {
    const ProjectedVertex &a = input.projected[corners[0]], &b = input.projected[corners[1]],
                          &c = input.projected[corners[2]];
    const int64_t area = signedArea(a, b, c);
    if (isCulled(area, input.draw->state)) return;
    const TileGrid::PixelBox box = grid_->pixelsOf(
        std::min({a.x_subpx, b.x_subpx, c.x_subpx}), std::min({a.y_subpx, b.y_subpx, c.y_subpx}),
        std::max({a.x_subpx, b.x_subpx, c.x_subpx}), std::max({a.y_subpx, b.y_subpx, c.y_subpx}));
    if (box.empty() || (area > 0 ? missesAll(box, a, b, c) : missesAll(box, a, c, b))) {
        statistics.missed++;
        return;
    }
    StoredTriangle t = storedTriangle(
        {input.firstVertex + corners[0], input.firstVertex + corners[1], input.firstVertex + corners[2]},
        area, isFront(area, input.draw->state));
    t.draw = input.number;
    t.triangle = index;
    triangles.push_back(t);
    addTilesInside(grid_->tilesOf(box), a, area > 0 ? b : c, area > 0 ? c : b);
    endTiles();
    statistics.records++;
}

// True if the triangle is small and covers none of the samples in its box. Positive orientation.
bool TriangleSetup::missesAll(const TileGrid::PixelBox& box, const ProjectedVertex& a,
                              const ProjectedVertex& b, const ProjectedVertex& c) const {
    constexpr int kFewPixels = 4;
    if (!grid_->hasOneSample() || (box.x1 - box.x0 + 1) * (box.y1 - box.y0 + 1) > kFewPixels) return false;
    const auto [bc, ca, ab] = edgesOf(a, b, c);
    for (int y = box.y0; y <= box.y1; y++)
        for (int x = box.x0; x <= box.x1; x++) {
            const int64_t px = grid_->sampleX_subpx(x), py = grid_->sampleY_subpx(y);
            if (bc.covers(px, py) && ca.covers(px, py) && ab.covers(px, py)) return false;
        }
    return true;
}

void TriangleSetup::addTile(size_t tile) {
    tiles.push_back(static_cast<uint32_t>(tile));
    countOfTile[tile]++;
}

void TriangleSetup::addTiles(const TileBox& box) {
    for (int y = box.y0; y <= box.y1; y++)
        for (int x = box.x0; x <= box.x1; x++) addTile(grid_->index(x, y));
}

// The tiles of the box but for those that are beyond one of the edges as a whole. Positive orientation.
void TriangleSetup::addTilesInside(const TileBox& box, const ProjectedVertex& a, const ProjectedVertex& b,
                                   const ProjectedVertex& c) {
    constexpr int kFewTiles = 4;
    if ((box.x1 - box.x0 + 1) * (box.y1 - box.y0 + 1) <= kFewTiles) return addTiles(box);
    const std::array<EdgeFunction, 3> edges = edgesOf(a, b, c);
    // The largest E - 1 + ownsZero of each edge among the samples of a tile.
    const auto columns = grid_->samplesOfColumn(box.x0), rows = grid_->samplesOfRow(box.y0);
    std::array<int64_t, 3> ofRow, stepX, stepY;
    for (size_t i = 0; i < 3; i++) {
        const EdgeFunction& edge = edges[i];
        ofRow[i] =
            edge.at(edge.stepX > 0 ? columns.last : columns.first, edge.stepY > 0 ? rows.last : rows.first) -
            (edge.ownsZero ? 0 : 1);
        stepX[i] = edge.stepX * grid_->tileSize_subpx();
        stepY[i] = edge.stepY * grid_->tileSize_subpx();
    }
    for (int y = box.y0; y <= box.y1; y++) {
        std::array<int64_t, 3> largest = ofRow;
        for (int x = box.x0; x <= box.x1; x++) {
            if ((largest[0] | largest[1] | largest[2]) >= 0) addTile(grid_->index(x, y));
            for (size_t i = 0; i < 3; i++) largest[i] += stepX[i];
        }
        for (size_t i = 0; i < 3; i++) ofRow[i] += stepY[i];
    }
}

void TriangleSetup::addClipped(const DrawInput& input, uint32_t index, const std::array<uint32_t, 3>& corners,
                               int planes) {
    // Cut; -0 becomes +0 as in the vertex stage.
    std::array<ClipVertex, 3> source;
    for (size_t i = 0; i < 3; i++) {
        const ClipVertex& v = input.draw->vertices[corners[i]];
        source[i] = {v.x + 0.0, v.y + 0.0, v.z + 0.0, v.w + 0.0};
    }
    Polygon polygon;
    if (!clipTriangle(source, *transform_, planes, polygon)) {
        statistics.rejected++;
        return;
    }
    statistics.clipped++;

    // The whole polygon's area decides about it.
    std::array<ProjectedVertex, kMaxPolygonVertices> v;
    const size_t count = static_cast<size_t>(polygon.count);
    for (size_t i = 0; i < count; i++) v[i] = project(polygon.vertices[i].position, *transform_);
    int64_t area = 0;
    bool hasPositive = false, hasNegative = false;
    for (size_t i = 1; i + 1 < count; i++) {
        const int64_t piece = signedArea(v[0], v[i], v[i + 1]);
        area += piece;
        hasPositive = hasPositive || piece > 0;
        hasNegative = hasNegative || piece < 0;
    }
    if (isCulled(area, input.draw->state)) return;

    // A fan of pieces.
    const auto firstVertex = static_cast<uint32_t>(clippedVertices.size());
    for (size_t i = 0; i < count; i++) clippedVertices.push_back({v[i], polygon.vertices[i].barycentric});
    const size_t firstPiece = triangles.size();
    const bool isGroup = hasPositive && hasNegative;
    int32_t xMin = INT32_MAX, yMin = INT32_MAX, xMax = INT32_MIN, yMax = INT32_MIN;
    for (size_t i = 1; i + 1 < count; i++) {
        const int64_t piece = signedArea(v[0], v[i], v[i + 1]);
        if (piece == 0) continue;
        StoredTriangle t = storedTriangle(
            {firstVertex, firstVertex + static_cast<uint32_t>(i), firstVertex + static_cast<uint32_t>(i + 1)},
            piece, isFront(area, input.draw->state));
        t.draw = input.number;
        t.triangle = index;
        t.clipped = true;
        t.reversed = (piece > 0) != (area > 0);
        triangles.push_back(t);
        statistics.records++;
        if (!isGroup) xMin = yMin = INT32_MAX, xMax = yMax = INT32_MIN;
        for (const size_t k : {size_t{0}, i, i + 1}) {
            xMin = std::min(xMin, v[k].x_subpx), xMax = std::max(xMax, v[k].x_subpx);
            yMin = std::min(yMin, v[k].y_subpx), yMax = std::max(yMax, v[k].y_subpx);
        }
        if (isGroup) continue;
        const size_t second = piece > 0 ? i : i + 1, third = piece > 0 ? i + 1 : i;
        addTilesInside(grid_->tilesOf(grid_->pixelsOf(xMin, yMin, xMax, yMax)), v[0], v[second], v[third]);
        endTiles();
    }
    if (!isGroup) return;
    triangles[firstPiece].groupSize = static_cast<uint8_t>(triangles.size() - firstPiece);
    addTiles(grid_->tilesOf(grid_->pixelsOf(xMin, yMin, xMax, yMax)));
    while (endOfTiles.size() < triangles.size()) endTiles();
}

}  // namespace etalon
