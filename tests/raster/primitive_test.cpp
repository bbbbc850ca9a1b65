// Rules 1, 3 and 4: which primitives are drawn, where their vertices land, and where samples are.
#include <doctest/doctest.h>

#include <array>
#include <cfloat>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "raster/rasterizer.h"
#include "tests/support/draw_triangles.h"
#include "tests/support/random_triangles.h"

using namespace etalon;

TEST_CASE("SnappingRoundsToNearestEven") {
    for (int bits = 4; bits <= 8; bits++) {
        const int unit = 1 << bits;
        const Viewport viewport{0, 0, 16, 16};
        // {position in subpixels, its snapped value}; with w = 1 and a power-of-two viewport the transform is
        // exact.
        const std::pair<double, int> cases[] = {
            {2.5, 2},   {3.5, 4},    {2.5 + 0x1p-20, 3}, {3.5 - 0x1p-20, 3}, {-0.5, 0},
            {-1.5, -2}, {0.5, 0},    {1.5, 2},           {-2.5, -2},         {7.25, 7},
            {7.75, 8},  {-7.75, -8}, {4095.5, 4096}};
        for (const auto& [position, snapped] : cases) {
            const double ndc = position / unit / 8 - 1;
            // Far corners keep the area positive: the tested vertex is the first one.
            const std::vector<ClipVertex> vertices = {{ndc, -ndc, 0.5, 1}, {4, 1, 0.5, 1}, {-1, -20, 0.5, 1}};
            RenderTargetFormat format;
            format.subpixelBits = bits;
            const RenderTarget target = drawTriangles(viewport, vertices, alwaysState(), format);
            REQUIRE(target.triangleCount() == 1);
            const TriangleRecord record = target.triangle(0);
            for (size_t i = 0; i < 3; i++)
                if (record.corner[i] == 0) {
                    CHECK(record.x_subpx[i] == snapped);
                    CHECK(record.y_subpx[i] == snapped);
                }
        }
    }
}

TEST_CASE("FacingComesFromTheSnappedPositions") {
    const Viewport viewport{0, 0, 16, 16};
    // Counter-clockwise as given; the middle vertex snaps to the other side of the line between the others.
    const double unit = 1.0 / 256;
    const std::vector<ClipVertex> flips = {
        vertexAtPixel(viewport, 1, 1.5, 1, 0.5),
        vertexAtPixel(viewport, 15 + 0.4 * unit, 1.5 + 1.4 * unit, 1, 0.5),
        vertexAtPixel(viewport, 8 + 0.49 * unit, 1.5 + 0.51 * unit, 1, 0.5)};
    const auto area = [](const std::vector<ClipVertex>& v) {
        return (v[1].x - v[0].x) * (v[2].y - v[0].y) - (v[2].x - v[0].x) * (v[1].y - v[0].y);
    };
    REQUIRE(area(flips) > 0);  // y up: counter-clockwise, the front
    DrawState state = alwaysState();
    RenderTarget target = drawTriangles(viewport, flips, state);
    REQUIRE(target.triangleCount() == 1);
    CHECK_FALSE(target.triangle(0).front);
    RasterStatistics statistics;
    state.cull = CullMode::back;
    drawTriangles(viewport, flips, state, {}, &statistics);
    CHECK(statistics.culled == 1);
    CHECK(statistics.records == 0);
    // A plain counter-clockwise triangle is the front, unless the draw says otherwise; w < 0 never turns it.
    const std::vector<ClipVertex> front = {{-1, -1, 0.5, 1}, {1, -1, 0.5, 1}, {0, 1, 0.5, 1}};
    for (CullMode cull : {CullMode::none, CullMode::front, CullMode::back})
        for (bool clockwise : {false, true}) {
            state.cull = cull;
            state.frontIsClockwise = clockwise;
            target = drawTriangles(viewport, front, state, {}, &statistics);
            const bool culled = cull == (clockwise ? CullMode::back : CullMode::front);
            CHECK(statistics.culled == (culled ? 1 : 0));
            CHECK((target.id.at(8, 8) == kNoTriangle) == culled);
            if (!culled) CHECK(target.triangle(0).front == !clockwise);
        }
}

TEST_CASE("SamplePatternsAreTheStandardOnes") {
    // [D3D11.3, sec. 19.2.4], in sixteenths of a pixel from the centre.
    const std::vector<std::array<int, 2>> one = {{0, 0}}, four = {{-2, -6}, {6, -2}, {-6, 2}, {2, 6}};
    const std::vector<std::array<int, 2>> sixteen = {{1, 1},  {-1, -3}, {-3, 2}, {4, -1}, {-5, -2}, {2, 5},
                                                     {5, 3},  {3, -5},  {-2, 6}, {0, -7}, {-4, -6}, {-6, 4},
                                                     {-8, 0}, {7, -4},  {6, 7},  {-7, -8}};
    for (const auto& pattern : {one, four, sixteen}) {
        const int samples = static_cast<int>(pattern.size());
        const auto positions = samplePositions(samples);
        REQUIRE(positions.size() == pattern.size());
        // Drawn: a square of a sixteenth around the sample covers that sample alone.
        const Viewport viewport{0, 0, 8, 8};
        for (size_t s = 0; s < pattern.size(); s++) {
            CHECK(positions[s] == std::array<int, 2>{pattern[s][0] + 8, pattern[s][1] + 8});
            const double x = 3.5 + pattern[s][0] / 16.0, y = 4.5 + pattern[s][1] / 16.0, r = 1.0 / 32;
            RenderTargetFormat format;
            format.samples = samples;
            const RenderTarget target = drawTriangles(
                viewport,
                {vertexAtPixel(viewport, x - r, y - r, 1, 0.5), vertexAtPixel(viewport, x + 2 * r, y, 1, 0.5),
                 vertexAtPixel(viewport, x - r, y + r, 1, 0.5)},
                alwaysState(), format);
            size_t covered = 0;
            for (uint32_t id : target.id.values()) covered += id != kNoTriangle;
            CHECK(covered == 1);
            CHECK(target.id.at(3, 4, static_cast<int>(s)) != kNoTriangle);
        }
    }
}

TEST_CASE("NonFiniteAndHugeTrianglesAreDroppedAndCounted") {
    const Viewport viewport{0, 0, 8, 8};
    const std::vector<ClipVertex> good = {{-1, -1, 0.5, 1}, {3, -1, 0.5, 1}, {-1, 3, 0.5, 1}};
    const double infinity = std::numeric_limits<double>::infinity(),
                 nan = std::numeric_limits<double>::quiet_NaN();
    for (size_t vertex = 0; vertex < 3; vertex++)
        for (double ClipVertex::*coordinate :
             {&ClipVertex::x, &ClipVertex::y, &ClipVertex::z, &ClipVertex::w}) {
            RasterStatistics statistics;
            for (double bad : {nan, -nan, infinity, -infinity, 0x1p500, -0x1p500, 1e300, -DBL_MAX}) {
                std::vector<ClipVertex> triangle = good;
                triangle[vertex].*coordinate = bad;
                const RenderTarget target = drawTriangles(viewport, triangle, alwaysState(), {}, &statistics);
                CHECK(statistics.droppedNonFinite == 1);
                CHECK(target.triangleCount() == 0);
                CHECK(target.id.at(4, 4) == kNoTriangle);
            }
            // The largest magnitude that is not dropped.
            std::vector<ClipVertex> triangle = good;
            triangle[vertex].*coordinate = std::nextafter(0x1p500, 0.0);
            drawTriangles(viewport, triangle, alwaysState(), {}, &statistics);
            CHECK(statistics.droppedNonFinite == 0);
        }
    // -0 is +0.
    const std::vector<ClipVertex> minus = {{-0.0, -1, -0.0, 1}, {3, -0.0, -0.0, 1}, {-0.0, 3, -0.0, 1}};
    std::vector<ClipVertex> plus = minus;
    for (auto& v : plus) v = {v.x + 0.0, v.y + 0.0, v.z + 0.0, v.w};
    const RenderTarget a = drawTriangles(viewport, minus, alwaysState()),
                       b = drawTriangles(viewport, plus, alwaysState());
    CHECK(a.id == b.id);
    CHECK(a.depth == b.depth);
}
