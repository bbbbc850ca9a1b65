// Rules 1 to 4: which samples a triangle covers.
#include <doctest/doctest.h>

#include <utility>
#include <vector>

#include "numeric/text.h"
#include "raster/rasterizer.h"
#include "tests/support/draw_triangles.h"
#include "tests/support/random_triangles.h"
#include "tests/support/reference_replay.h"

using namespace etalon;

namespace {

// Triangles that CoverageEqualsTheBigIntegerOracle draws at the least.
constexpr int kOracleTriangles = 150000;

struct Setting {
    int width, height;
    Viewport viewport;
    RenderTargetFormat format;
    RasterOptions options;
    DrawState state;
};

Setting randomSetting(Random& random) {
    Setting s;
    s.format.samples = random.pick({1, 1, 1, 1, 4, 16});
    s.format.subpixelBits = random.integer(4, 8);
    const bool large = s.format.samples == 1 && random.chance(0.02);
    s.viewport.width = large ? random.integer(100, 200) : random.integer(1, s.format.samples == 16 ? 20 : 48);
    s.viewport.height = large ? random.integer(60, 120) : random.integer(1, s.format.samples == 16 ? 16 : 40);
    s.width = s.viewport.width, s.height = s.viewport.height;
    if (random.chance(0.5)) {
        s.viewport.x = random.integer(0, 19), s.viewport.y = random.integer(0, 19);
        s.width += s.viewport.x + random.integer(0, 9), s.height += s.viewport.y + random.integer(0, 9);
    }
    s.options.threads = random.chance(0.1) ? 2 : 1;
    s.options.tileSize = random.pick({8, 16, 24, 32, 64, 128, 256});
    s.state.cull = CullMode::none;
    s.state.depthCompare = Compare::always;
    s.state.depthWrite = false;
    s.state.depthClamp = random.chance(0.25);
    // Counts how often each sample is covered; without it other paths of the implementation are taken.
    s.state.stencil.enabled = random.chance(0.7);
    s.state.stencil.front.onPass = s.state.stencil.back.onPass = StencilOperation::incrementWrap;
    return s;
}

struct Outcome {
    std::string difference;
    RasterStatistics statistics;
};

// Draws `triangles` with the rasterizer and with the oracle.
Outcome compareWithOracle(const Setting& s, const std::vector<ClipVertex>& vertices) {
    const std::vector<uint32_t> indices = consecutiveIndices(vertices.size());
    const Draw draw{vertices, indices, s.state};
    RenderTarget actual(s.width, s.height, s.format);
    oracle::Target expected(s.width, s.height, s.format);
    const RasterStatistics a = rasterize(actual, s.viewport, {&draw, 1}, s.options);
    const RasterStatistics e = oracle::replay(expected, s.viewport, {&draw, 1});
    std::string difference = oracle::firstDifference(actual, expected);
    // Pieces of zero area are records of the oracle's. A polygon that clipping leaves nothing of may count as
    // rejected, or as clipped and of zero area.
    if (difference.empty() &&
        (a.triangles != e.triangles || a.droppedNonFinite != e.droppedNonFinite ||
         a.rejected + a.clipped != e.rejected + e.clipped ||
         a.rejected + a.zeroArea != e.rejected + e.zeroArea || a.records != actual.triangleCount() ||
         (e.clipped == 0 && a.records + a.missed != expected.records.size())))
        difference =
            formatText("statistics: dropped {} rejected {} clipped {} zero {} instead of {} {} {} {}",
                       a.droppedNonFinite, a.rejected, a.clipped, a.zeroArea, e.droppedNonFinite, e.rejected,
                       e.clipped, e.zeroArea);
    return {difference, e};
}

std::string describe(const Setting& s, const std::vector<ClipVertex>& vertices) {
    std::string text = formatText(
        "target {}x{}, viewport {} {} {}x{}, {} samples, {} subpixel bits, tile {}, threads {}, depth clamp "
        "{}, "
        "stencil {}\n",
        s.width, s.height, s.viewport.x, s.viewport.y, s.viewport.width, s.viewport.height, s.format.samples,
        s.format.subpixelBits, s.options.tileSize, s.options.threads, s.state.depthClamp,
        s.state.stencil.enabled);
    for (const ClipVertex& v : vertices)
        text += formatText("  {{{:a}, {:a}, {:a}, {:a}}}\n", v.x, v.y, v.z, v.w);
    return text;
}

// The shortest of the triangles' runs that still differs: one triangle where possible.
void reportDifference(const Setting& s, const std::vector<ClipVertex>& vertices,
                      const std::string& difference) {
    for (size_t i = 0; i + 2 < vertices.size(); i += 3) {
        const std::vector<ClipVertex> one(vertices.begin() + static_cast<long>(i),
                                          vertices.begin() + static_cast<long>(i) + 3);
        const std::string alone = compareWithOracle(s, one).difference;
        if (!alone.empty()) {
            FAIL_CHECK(describe(s, one) << alone);
            return;
        }
    }
    FAIL_CHECK(describe(s, vertices) << difference);
}

}  // namespace

TEST_CASE("CoverageEqualsTheBigIntegerOracle") {
    Random random(2024);
    int triangles = 0, failures = 0;
    RasterStatistics seen;
    while (triangles < kOracleTriangles && failures < 5) {
        const Setting setting = randomSetting(random);
        const int count = random.integer(1, 24);
        std::vector<ClipVertex> vertices;
        for (int i = 0; i < count; i++) {
            const auto family =
                static_cast<TriangleFamily>(random.integer(0, int(TriangleFamily::count) - 1));
            for (const ClipVertex& v : randomTriangle(random, family, setting.viewport))
                vertices.push_back(v);
        }
        triangles += count;
        const Outcome outcome = compareWithOracle(setting, vertices);
        if (!outcome.difference.empty()) {
            failures++;
            reportDifference(setting, vertices, outcome.difference);
        }
        seen.droppedNonFinite += outcome.statistics.droppedNonFinite;
        seen.rejected += outcome.statistics.rejected;
        seen.clipped += outcome.statistics.clipped;
        seen.zeroArea += outcome.statistics.zeroArea;
    }
    // The families must keep reaching every way through the rules.
    CHECK(seen.droppedNonFinite > kOracleTriangles / 100);
    CHECK(seen.rejected > kOracleTriangles / 200);
    CHECK(seen.clipped > kOracleTriangles / 10);
    CHECK(seen.zeroArea > kOracleTriangles / 100);
    MESSAGE(triangles, " triangles: ", seen.droppedNonFinite, " non-finite, ", seen.rejected, " rejected, ",
            seen.clipped, " clipped, ", seen.zeroArea, " of zero area");
}

TEST_CASE("CoverageInTheLargestTargetsEqualsTheOracle") {
    Random random(99);
    for (bool wide : {false, true})
        for (int run = 0; run < 4; run++) {
            Setting setting = randomSetting(random);
            setting.width = setting.viewport.width = wide ? kMaxImageSize : 5;
            setting.height = setting.viewport.height = wide ? 5 : kMaxImageSize;
            setting.viewport.x = setting.viewport.y = 0;
            setting.format.samples = 1;
            std::vector<ClipVertex> vertices;
            for (auto family : {TriangleFamily::normal, TriangleFamily::sliver, TriangleFamily::nearFar,
                                TriangleFamily::negativeW, TriangleFamily::everything})
                for (const ClipVertex& v : randomTriangle(random, family, setting.viewport))
                    vertices.push_back(v);
            const Outcome outcome = compareWithOracle(setting, vertices);
            if (!outcome.difference.empty()) reportDifference(setting, vertices, outcome.difference);
        }
}

namespace {

// The top-left rule in another form, for whole-number vertices: every edge owns the rows from its top end
// (included) to its bottom end, and a point is inside when an odd number of crossings lies left of it or on
// it.
bool insideByCrossings(const std::array<std::array<int64_t, 2>, 3>& v, int64_t x, int64_t y) {
    int crossings = 0;
    for (size_t i = 0; i < 3; i++) {
        auto top = v[i], bottom = v[(i + 1) % 3];
        if (top[1] > bottom[1]) std::swap(top, bottom);
        if (y < top[1] || y >= bottom[1]) continue;
        // crossing x = top.x + (y - top.y) dx / dy, compared after multiplication by dy > 0
        crossings += (y - top[1]) * (bottom[0] - top[0]) <= (x - top[0]) * (bottom[1] - top[1]);
    }
    return crossings % 2 == 1;
}

}  // namespace

TEST_CASE("HardwareCoverageOfSnappedTriangles") {
    constexpr int kSubpixels = 256;
    Random random(7);
    size_t wrong = 0, onEdge = 0;
    for (int run = 0; run < 4000; run++) {
        const Viewport viewport{0, 0, 1 << random.integer(3, 6), 1 << random.integer(3, 6)};
        // A coarse lattice puts many vertices and edges exactly on pixel centres.
        const int step = random.pick({1, 64, 128, 128});
        std::array<std::array<int64_t, 2>, 3> v;
        std::vector<ClipVertex> vertices;
        for (auto& p : v) {
            p = {int64_t(step) * random.integer(-20 * kSubpixels / step, 84 * kSubpixels / step),
                 int64_t(step) * random.integer(-20 * kSubpixels / step, 84 * kSubpixels / step)};
            vertices.push_back({static_cast<double>(p[0]) / (kSubpixels * viewport.width / 2) - 1,
                                1 - static_cast<double>(p[1]) / (kSubpixels * viewport.height / 2), 0.5, 1});
        }
        const RenderTarget target = drawTriangles(viewport, vertices, alwaysState());
        for (int y = 0; y < viewport.height; y++)
            for (int x = 0; x < viewport.width; x++) {
                const int64_t px = x * kSubpixels + kSubpixels / 2, py = y * kSubpixels + kSubpixels / 2;
                wrong += (target.id.at(x, y) != kNoTriangle) != insideByCrossings(v, px, py);
                onEdge += insideByCrossings(v, px, py) != insideByCrossings(v, px - 1, py);
            }
    }
    CHECK(wrong == 0);
    CHECK(onEdge > 500);
}
