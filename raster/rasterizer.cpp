#include "raster/rasterizer.h"

#include <algorithm>
#include <atomic>
#include <cmath>

#include "numeric/check.h"
#include "numeric/parallel.h"
#include "raster/depth.h"
#include "raster/raster_scratch.h"
#include "raster/vertex_stage.h"

namespace etalon {
namespace {

constexpr size_t kVerticesPerTask = 8192;
constexpr size_t kTrianglesPerChunk = 4096;
// Chunks grow beyond this, so that the counts of each chunk and tile stay small beside the images.
constexpr size_t kMaxChunkCounts = size_t{1} << 23;

// A part of a draw's vertices or triangles.
struct Part {
    uint32_t draw;
    size_t first, last;
};

template <class Count>
std::vector<Part> cut(std::span<const Draw> draws, size_t perPart, Count count) {
    std::vector<Part> parts;
    for (size_t d = 0; d < draws.size(); d++)
        for (size_t first = 0, last = count(draws[d]); first < last; first += perPart)
            parts.push_back({static_cast<uint32_t>(d), first, std::min(first + perPart, last)});
    return parts;
}

void add(RasterStatistics& sum, const RasterStatistics& part) {
    sum.triangles += part.triangles;
    sum.droppedNonFinite += part.droppedNonFinite;
    sum.rejected += part.rejected;
    sum.clipped += part.clipped;
    sum.zeroArea += part.zeroArea;
    sum.culled += part.culled;
    sum.missed += part.missed;
    sum.records += part.records;
}

// One call of rasterize; each step fills what later ones read. The parts' order is the submission order, and
// nothing depends on how the work was cut.
class Rasterization {
  public:
    Rasterization(RenderTarget& target, const Viewport& viewport, std::span<const Draw> draws,
                  const RasterOptions& options)
        : target_(target),
          draws_(draws),
          options_(options),
          scratch_(target.scratch.get()),
          transform_(viewport, target.format.subpixelBits, target.format.real),
          grid_(viewport, options.tileSize, target.format) {}

    RasterStatistics run() {
        projectAll();
        setUpAll();
        listTriangles();
        if (target_.format.depthOrder == DepthOrder::exact) boundDepths();
        drawTiles();
        target_.drawCount += static_cast<uint32_t>(draws_.size());
        return statistics_;
    }

  private:
    void projectAll() {
        size_t count = 0;
        const size_t base = target_.vertices.size();
        target_.biases.resize(target_.drawCount);  // without those of a call that failed
        for (const Draw& draw : draws_) {
            ETALON_CHECK(target_.format.depthOrder == DepthOrder::stored || draw.state.idWrite ||
                             !draw.state.depthWrite,
                         "draw {} writes depths without ids, which an exact order needs", inputs_.size());
            target_.biases.push_back(draw.state.bias);
            ETALON_CHECK(draw.indices.size() % 3 == 0, "draw {} has {} indices", inputs_.size(),
                         draw.indices.size());
            inputs_.push_back({&draw,
                               {},
                               {},
                               target_.drawCount + static_cast<uint32_t>(inputs_.size()),
                               static_cast<uint32_t>(base + count)});
            count += draw.vertices.size();
        }
        ETALON_CHECK(base + count < UINT32_MAX, "more than 2^32 - 1 vertices");
        target_.vertices.resize(base + count);
        scratch_.outcodes.resize(count);
        const std::vector<Part> parts =
            cut(draws_, kVerticesPerTask, [](const Draw& draw) { return draw.vertices.size(); });
        const auto project = levelPasses<VertexPasses>().project;
        parallelFor(parts.size(), options_.threads, [&](size_t p) {
            const Part& part = parts[p];
            const size_t first = inputs_[part.draw].firstVertex + part.first, size = part.last - part.first;
            project(transform_, draws_[part.draw].vertices.subspan(part.first, size),
                    std::span(target_.vertices).subspan(first, size),
                    std::span(scratch_.outcodes).subspan(first - base, size));
        });
        for (DrawInput& input : inputs_) {
            const size_t size = input.draw->vertices.size();
            input.projected = std::span(target_.vertices).subspan(input.firstVertex, size);
            input.outcodes = std::span(scratch_.outcodes).subspan(input.firstVertex - base, size);
        }
    }

    void setUpAll() {
        size_t total = 0;
        for (const Draw& draw : draws_) total += draw.triangleCount();
        const size_t perChunk = std::max(kTrianglesPerChunk, total * grid_.count() / kMaxChunkCounts);
        chunks_ = cut(draws_, perChunk, [](const Draw& draw) { return draw.triangleCount(); });
        if (scratch_.setups.size() < chunks_.size()) scratch_.setups.resize(chunks_.size());
        parallelFor(chunks_.size(), options_.threads, [&](size_t c) {
            scratch_.setups[c].begin(transform_, grid_);
            scratch_.setups[c].process(inputs_[chunks_[c].draw], chunks_[c].first, chunks_[c].last);
        });
    }

    // Moves the chunks' triangles to the target and lists them for each tile, in submission order.
    void listTriangles() {
        // Where each chunk's triangles and clipped vertices go, and its part of each tile's list.
        const size_t tiles = grid_.count();
        std::vector<size_t> firstTriangle;
        std::vector<uint32_t> firstClipped;
        size_t triangles = firstTriangle_;
        std::vector<uint32_t> listedOfTile(tiles, 0);
        for (size_t c = 0; c < chunks_.size(); c++) {
            TriangleSetup& setup = scratch_.setups[c];
            firstTriangle.push_back(triangles);
            triangles += setup.triangles.size();
            firstClipped.push_back(static_cast<uint32_t>(target_.clippedVertices.size()));
            target_.clippedVertices.insert(target_.clippedVertices.end(), setup.clippedVertices.begin(),
                                           setup.clippedVertices.end());
            add(statistics_, setup.statistics);
            for (size_t t = 0; t < tiles; t++) {
                const uint32_t count = setup.countOfTile[t];
                setup.countOfTile[t] = listedOfTile[t];
                listedOfTile[t] += count;
            }
        }
        ETALON_CHECK(triangles < kNoTriangle && target_.clippedVertices.size() < UINT32_MAX,
                     "more than 2^32 - 1 triangles");
        target_.triangles.resize(triangles);
        scratch_.firstListed.assign(1, 0);
        for (size_t t = 0; t < tiles; t++)
            scratch_.firstListed.push_back(scratch_.firstListed[t] + listedOfTile[t]);
        scratch_.listed.resize(scratch_.firstListed[tiles]);

        parallelFor(chunks_.size(), options_.threads, [&](size_t c) {
            TriangleSetup& setup = scratch_.setups[c];
            size_t listed = 0;
            for (size_t k = 0; k < setup.triangles.size(); k++) {
                StoredTriangle& triangle = target_.triangles[firstTriangle[c] + k];
                triangle = setup.triangles[k];
                if (triangle.clipped)
                    for (uint32_t& v : triangle.vertex) v += firstClipped[c];
                for (; listed < setup.endOfTiles[k]; listed++) {
                    const size_t tile = setup.tiles[listed];
                    scratch_.listed[scratch_.firstListed[tile] + setup.countOfTile[tile]++] =
                        static_cast<uint32_t>(firstTriangle[c] + k);
                }
            }
        });
    }

    // Depth clamp and bias make depths beyond 1, whose roundings are larger.
    void boundDepths() {
        double largest = target_.largestDepth;
        for (size_t id = firstTriangle_; id < target_.triangleCount(); id++) {
            const TriangleRecord record = target_.triangle(static_cast<uint32_t>(id));
            const double bias = depthBias(target_.biases[record.draw], target_.format, record);
            for (const double z : record.z) largest = std::max(largest, std::fabs(z) + std::fabs(bias));
        }
        target_.largestDepth = largest;
    }

    void drawTiles() {
        TileWork work{&target_, draws_, target_.drawCount, options_.clear, false, false, false};
        for (const Draw& draw : draws_) {
            work.usesId = work.usesId || draw.state.idWrite || target_.format.depthOrder == DepthOrder::exact;
            work.usesStencil = work.usesStencil || draw.state.stencil.enabled;
            work.writesDepth = work.writesDepth || draw.state.depthWrite;
        }
        parallelFor(grid_.count(), options_.threads, [&](size_t t) {
            const size_t first = scratch_.firstListed[t], size = scratch_.firstListed[t + 1] - first;
            if (size == 0 && !work.clear) return;
            auto rasterizer = scratch_.take();
            rasterizer->run(work, grid_.rectangle(t), std::span(scratch_.listed).subspan(first, size));
            scratch_.giveBack(std::move(rasterizer));
        });
    }

    RenderTarget& target_;
    std::span<const Draw> draws_;
    const RasterOptions& options_;
    RasterScratch& scratch_;
    const size_t firstTriangle_ = target_.triangleCount();  // of this call
    ViewportTransform transform_;
    TileGrid grid_;
    std::vector<DrawInput> inputs_;
    std::vector<Part> chunks_;
    RasterStatistics statistics_;
};

}  // namespace

RasterStatistics rasterize(RenderTarget& target, const Viewport& viewport, std::span<const Draw> draws,
                           const RasterOptions& options) {
    ETALON_CHECK(viewport.width >= 1 && viewport.height >= 1 && viewport.x >= 0 && viewport.y >= 0 &&
                     viewport.x <= target.width() - viewport.width &&
                     viewport.y <= target.height() - viewport.height,
                 "viewport {},{} {}x{} of a {}x{} target", viewport.x, viewport.y, viewport.width,
                 viewport.height, target.width(), target.height());
    ETALON_CHECK(options.tileSize >= 8 && options.tileSize <= 256 && options.tileSize % 8 == 0,
                 "tileSize = {}", options.tileSize);
    if (options.clear) {
        ETALON_CHECK(viewport.width == target.width() && viewport.height == target.height(),
                     "a viewport of {}x{} clears only a part of {}x{}", viewport.width, viewport.height,
                     target.width(), target.height());
        target.forgetTriangles();
    }
    return Rasterization(target, viewport, draws, options).run();
}

RasterScratchHolder::RasterScratchHolder() = default;
RasterScratchHolder::~RasterScratchHolder() = default;
RasterScratchHolder::RasterScratchHolder(const RasterScratchHolder&) {}
RasterScratchHolder& RasterScratchHolder::operator=(const RasterScratchHolder&) { return *this; }
RasterScratchHolder::RasterScratchHolder(RasterScratchHolder&&) noexcept = default;
RasterScratchHolder& RasterScratchHolder::operator=(RasterScratchHolder&&) noexcept = default;
RasterScratch& RasterScratchHolder::get() {
    if (!scratch_) scratch_ = std::make_unique<RasterScratch>();
    return *scratch_;
}

}  // namespace etalon
