#include "raster/rasterizer.h"

#include <algorithm>
#include <memory>
#include <mutex>

#include "numeric/check.h"
#include "numeric/parallel.h"
#include "raster/setup.h"
#include "raster/tile.h"

namespace etalon {
namespace {

constexpr size_t kTrianglesPerChunk = 4096;

struct Chunk {
    uint32_t draw;
    size_t first, last;
};

// Cuts the draws into chunks of triangles; their order is the submission order.
std::vector<Chunk> cutIntoChunks(std::span<const Draw> draws) {
    std::vector<Chunk> chunks;
    for (size_t d = 0; d < draws.size(); d++) {
        ETALON_CHECK(draws[d].indices.size() % 3 == 0, "draw {} has {} indices", d, draws[d].indices.size());
        const size_t triangles = draws[d].indices.size() / 3;
        for (size_t first = 0; first < triangles; first += kTrianglesPerChunk)
            chunks.push_back(
                {static_cast<uint32_t>(d), first, std::min(first + kTrianglesPerChunk, triangles)});
    }
    return chunks;
}

void checkIndices(const Draw& draw, const Chunk& chunk) {
    for (size_t i = 3 * chunk.first; i < 3 * chunk.last; i++)
        ETALON_CHECK(draw.indices[i] < draw.vertices.size(), "index {} of draw {} is {}, vertices: {}", i,
                     chunk.draw, draw.indices[i], draw.vertices.size());
}

void add(RasterStatistics& sum, const RasterStatistics& part) {
    sum.triangles += part.triangles;
    sum.droppedNonFinite += part.droppedNonFinite;
    sum.rejected += part.rejected;
    sum.clipped += part.clipped;
    sum.zeroArea += part.zeroArea;
    sum.culled += part.culled;
    sum.records += part.records;
}

// Sets the triangles up in parallel and appends their records to the target in submission order.
RasterStatistics setUp(RenderTarget& target, const Viewport& viewport, std::span<const Draw> draws,
                       int threads) {
    const std::vector<Chunk> chunks = cutIntoChunks(draws);
    std::vector<TriangleSetup> setups(chunks.size(), TriangleSetup(viewport, target.format.subpixelBits));
    parallelFor(chunks.size(), threads, [&](size_t c) {
        const Draw& draw = draws[chunks[c].draw];
        checkIndices(draw, chunks[c]);
        setups[c].process(draw, target.drawCount + chunks[c].draw, chunks[c].first, chunks[c].last);
    });
    RasterStatistics statistics;
    for (TriangleSetup& setup : setups) {
        const auto clippedBase = static_cast<int32_t>(target.clippedCorners.size());
        for (TriangleRecord& record : setup.records)
            if (record.clipped >= 0) record.clipped += clippedBase;
        ETALON_CHECK(target.triangles.size() + setup.records.size() < kNoTriangle,
                     "more than 2^32 - 1 triangles");
        target.triangles.insert(target.triangles.end(), setup.records.begin(), setup.records.end());
        target.clippedCorners.insert(target.clippedCorners.end(), setup.clippedCorners.begin(),
                                     setup.clippedCorners.end());
        add(statistics, setup.statistics);
        setup = TriangleSetup(viewport, target.format.subpixelBits);
    }
    return statistics;
}

struct Tiles {
    int size, firstX, firstY, columns, rows;
};

Tiles tilesOf(const Viewport& viewport, int tileSize) {
    const int firstX = viewport.x / tileSize, firstY = viewport.y / tileSize;
    const int lastX = (viewport.x + viewport.width - 1) / tileSize;
    const int lastY = (viewport.y + viewport.height - 1) / tileSize;
    return {tileSize, firstX, firstY, lastX - firstX + 1, lastY - firstY + 1};
}

// Lists for each tile the records whose bounding box touches it, in submission order. A group is listed once,
// by its first record, in every tile that one of its pieces touches.
std::vector<std::vector<uint32_t>> bin(const RenderTarget& target, const Tiles& tiles, size_t firstRecord) {
    std::vector<std::vector<uint32_t>> lists(static_cast<size_t>(tiles.columns) *
                                             static_cast<size_t>(tiles.rows));
    const int n = target.format.subpixelBits;
    for (size_t r = firstRecord; r < target.triangles.size();) {
        const size_t count = std::max<size_t>(target.triangles[r].groupSize, 1);
        int32_t xMin = INT32_MAX, xMax = INT32_MIN, yMin = INT32_MAX, yMax = INT32_MIN;
        for (size_t k = r; k < r + count; k++) {
            for (size_t i = 0; i < 3; i++) {
                xMin = std::min(xMin, target.triangles[k].x_subpx[i]);
                xMax = std::max(xMax, target.triangles[k].x_subpx[i]);
                yMin = std::min(yMin, target.triangles[k].y_subpx[i]);
                yMax = std::max(yMax, target.triangles[k].y_subpx[i]);
            }
        }
        const auto tileOf = [&](int32_t subpx, int first, int last) {
            const int pixel = subpx >> n;
            return std::clamp(pixel < 0 ? -1 : pixel / tiles.size - first, -1, last);
        };
        const int x0 = std::max(tileOf(xMin, tiles.firstX, tiles.columns), 0);
        const int x1 = std::min(tileOf(xMax, tiles.firstX, tiles.columns), tiles.columns - 1);
        const int y0 = std::max(tileOf(yMin, tiles.firstY, tiles.rows), 0);
        const int y1 = std::min(tileOf(yMax, tiles.firstY, tiles.rows), tiles.rows - 1);
        for (int y = y0; y <= y1; y++)
            for (int x = x0; x <= x1; x++)
                lists[static_cast<size_t>(y) * static_cast<size_t>(tiles.columns) + static_cast<size_t>(x)]
                    .push_back(static_cast<uint32_t>(r));
        r += count;
    }
    return lists;
}

// Keeps one TileRasterizer per thread that is at work, so that buffers are reused.
class TileRasterizerPool {
  public:
    explicit TileRasterizerPool(int tileSize) : tileSize_(tileSize) {}

    std::unique_ptr<TileRasterizer> take() {
        const std::lock_guard lock(mutex_);
        if (free_.empty()) return std::make_unique<TileRasterizer>(tileSize_);
        auto rasterizer = std::move(free_.back());
        free_.pop_back();
        return rasterizer;
    }
    void giveBack(std::unique_ptr<TileRasterizer> rasterizer) {
        const std::lock_guard lock(mutex_);
        free_.push_back(std::move(rasterizer));
    }

  private:
    int tileSize_;
    std::mutex mutex_;
    std::vector<std::unique_ptr<TileRasterizer>> free_;
};

}  // namespace

RasterStatistics rasterize(RenderTarget& target, const Viewport& viewport, std::span<const Draw> draws,
                           const RasterOptions& options) {
    ETALON_CHECK(viewport.width >= 1 && viewport.height >= 1 && viewport.x >= 0 && viewport.y >= 0 &&
                     viewport.x <= target.width() - viewport.width &&
                     viewport.y <= target.height() - viewport.height,
                 "viewport {},{} {}x{} of a {}x{} target", viewport.x, viewport.y, viewport.width,
                 viewport.height, target.width(), target.height());
    ETALON_CHECK(options.tileSize >= 8 && options.tileSize <= 256 && options.tileSize % kBlockSize == 0,
                 "tileSize = {}", options.tileSize);

    // Set up, bin, then replay each tile.
    const size_t firstRecord = target.triangles.size();
    const RasterStatistics statistics = setUp(target, viewport, draws, options.threads);
    const Tiles tiles = tilesOf(viewport, options.tileSize);
    const auto lists = bin(target, tiles, firstRecord);
    TileRasterizerPool pool(options.tileSize);
    parallelFor(lists.size(), options.threads, [&](size_t t) {
        const int tileX = (tiles.firstX + static_cast<int>(t) % tiles.columns) * tiles.size;
        const int tileY = (tiles.firstY + static_cast<int>(t) / tiles.columns) * tiles.size;
        const TileRectangle rectangle = {tileX,
                                         tileY,
                                         std::max(tileX, viewport.x),
                                         std::max(tileY, viewport.y),
                                         std::min(tileX + tiles.size, viewport.x + viewport.width),
                                         std::min(tileY + tiles.size, viewport.y + viewport.height)};
        auto rasterizer = pool.take();
        rasterizer->run(target, rectangle, draws, target.drawCount, lists[t]);
        pool.giveBack(std::move(rasterizer));
    });
    target.drawCount += static_cast<uint32_t>(draws.size());
    return statistics;
}

}  // namespace etalon
