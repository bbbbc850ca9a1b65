// Rule 6 in depths of 64 bits: which triangle is visible where stored numbers no longer tell, against numbers of 4096 bits.
#include <doctest/doctest.h>
#include <mpfr.h>

#include <array>
#include <cmath>
#include <vector>

#include "numeric/check.h"
#include "raster/depth.h"
#include "raster/exact_depth.h"
#include "tests/support/draw_triangles.h"
#include "tests/support/random_numbers.h"

using namespace etalon;

namespace {

constexpr int kSize = 32;
constexpr Viewport kViewport{0, 0, kSize, kSize};

RenderTargetFormat formatOf(DepthFormat depth, DepthOrder order, int samples = 1) {
    RenderTargetFormat format;
    format.samples = samples;
    format.depth = depth;
    format.real = RasterReal::fp64;
    format.depthOrder = order;
    return format;
}
DrawState lessState() {
    DrawState state;
    state.cull = CullMode::none;
    return state;
}

// Depth at the sample times the area, exactly; and the area.
class Exact {
  public:
    Exact() { mpfr_inits2(4096, sum_, part_, nullptr); }
    ~Exact() { mpfr_clears(sum_, part_, nullptr); }
    Exact(const Exact&) = delete;
    Exact& operator=(const Exact&) = delete;

    // Whether the sample at (x, y), in subpixels, is inside; then sum() / area is the depth.
    bool set(const TriangleRecord& t, int64_t x, int64_t y) {
        mpfr_set_zero(sum_, 1);
        for (size_t i = 0; i < 3; i++) {
            const size_t a = (i + 1) % 3, b = (i + 2) % 3;
            const int64_t dx = t.x_subpx[b] - t.x_subpx[a], dy = t.y_subpx[b] - t.y_subpx[a];
            const int64_t e = dx * (y - t.y_subpx[a]) - dy * (x - t.x_subpx[a]);
            if (e < 0) return false;
            mpfr_set_d(part_, static_cast<double>(e), MPFR_RNDN);
            mpfr_mul_d(part_, part_, t.z[i], MPFR_RNDN);
            mpfr_add(sum_, sum_, part_, MPFR_RNDN);
        }
        area_ = t.area;
        cut();
        return true;
    }
    // The sign of this depth minus the other one.
    int compare(Exact& other) {
        mpfr_mul_d(part_, sum_, static_cast<double>(other.area_), MPFR_RNDN);
        mpfr_mul_d(other.part_, other.sum_, static_cast<double>(area_), MPFR_RNDN);
        return mpfr_cmp(part_, other.part_);
    }

  private:
    void cut() {
        if (mpfr_sgn(sum_) < 0) mpfr_set_zero(sum_, 1);
        if (mpfr_cmp_d(sum_, static_cast<double>(area_)) > 0)
            mpfr_set_d(sum_, static_cast<double>(area_), MPFR_RNDN);
    }

    mpfr_t sum_, part_;
    int64_t area_ = 0;
};

// Triangles of one plane but for the last bits of their vertices' depths; the vertices are where snapping leaves them,
// up to `extent` half viewports from the centre.
std::vector<ClipVertex> nearlyCoplanar(RandomNumbers& random, int triangles, double extent) {
    const double slopeX = random.uniform(-0.2, 0.2), slopeY = random.uniform(-0.2, 0.2);
    const auto onGrid = [&] {
        return std::floor(random.uniform(-extent, extent) * kSize * 128) / (kSize * 128);
    };
    std::vector<ClipVertex> vertices;
    for (int i = 0; i < 3 * triangles; i++) {
        const double x = onGrid(), y = onGrid();
        const double z = 0.5 + slopeX * x + slopeY * y;
        vertices.push_back({x, y, z * (1 + random.below(3) * 0x1p-52), 1});
    }
    return vertices;
}

}  // namespace

TEST_CASE("DoubleDepthsTellApartWhatFloatsCannot") {
    const auto quad = [](double z) {
        return std::vector<ClipVertex>{{-1, -1, z, 1}, {1, -1, z, 1}, {-1, 1, z, 1},
                                       {1, -1, z, 1},  {1, 1, z, 1},  {-1, 1, z, 1}};
    };
    std::vector<ClipVertex> vertices = quad(0.5 + 0x1p-40);
    for (const ClipVertex& v : quad(0.5)) vertices.push_back(v);
    for (const int samples : {1, 4}) {
        const auto first = [&](DepthFormat depth) {
            return drawTriangles(kViewport, vertices, lessState(),
                                 formatOf(depth, DepthOrder::stored, samples));
        };
        const RenderTarget floats = first(DepthFormat::d32f), doubles = first(DepthFormat::d64f);
        for (const uint32_t id : floats.id.values()) CHECK(id < 2);
        for (size_t i = 0; i < doubles.id.values().size(); i++) {
            CHECK(doubles.id.values()[i] >= 2);
            CHECK(depthFromStored(DepthFormat::d64f, doubles.depth.values()[i],
                                  doubles.lowDepth.values()[i]) == 0.5);
        }
    }
}

// Of samples that several triangles cover, the nearest one, and of equal ones the first.
TEST_CASE("TheExactOrderIsThatOfRationalNumbers") {
    RandomNumbers random(1);
    int samplesOfSeveral = 0, wrongWhenStored = 0;
    Exact nearest, other;
    for (int scene = 0; scene < 120; scene++) {
        const int samples = scene % 2 == 0 ? 1 : 4;
        // Every third scene's depths reach far beyond [0, 1], where double is coarser.
        DrawState state = lessState();
        state.depthClamp = scene % 3 == 0;
        const std::vector<ClipVertex> vertices = nearlyCoplanar(random, 5, state.depthClamp ? 900 : 1.25);
        const RenderTarget exact = drawTriangles(kViewport, vertices, state,
                                                 formatOf(DepthFormat::d64f, DepthOrder::exact, samples));
        const RenderTarget stored = drawTriangles(kViewport, vertices, state,
                                                  formatOf(DepthFormat::d64f, DepthOrder::stored, samples));
        const auto positions = samplePositions(samples);
        for (int s = 0; s < samples; s++)
            for (int y = 0; y < kSize; y++)
                for (int x = 0; x < kSize; x++) {
                    const int64_t x_subpx = x * 256 + positions[static_cast<size_t>(s)][0] * 16,
                                  y_subpx = y * 256 + positions[static_cast<size_t>(s)][1] * 16;
                    uint32_t expected = kNoTriangle;
                    int covering = 0;
                    bool isOnEdge = false;
                    for (uint32_t id = 0; id < exact.triangleCount(); id++) {
                        if (!other.set(exact.triangle(id), x_subpx, y_subpx)) continue;
                        covering++;
                        if (expected != kNoTriangle && other.compare(nearest) >= 0) continue;
                        expected = id;
                        nearest.set(exact.triangle(id), x_subpx, y_subpx);
                    }
                    // Which of two triangles has an edge is rule 4's matter.
                    const uint32_t id = exact.id.at(x, y, s);
                    isOnEdge = (id == kNoTriangle) != (expected == kNoTriangle);
                    if (covering < 2 || isOnEdge) continue;
                    samplesOfSeveral++;
                    CHECK(id == expected);
                    wrongWhenStored += stored.id.at(x, y, s) != expected;
                }
    }
    CHECK(samplesOfSeveral > 20000);
    CHECK(wrongWhenStored > 100);  // else nothing was decided here
}

// A plane whose depths are doubles at every vertex, in two ways of cutting it: everywhere the first one.
TEST_CASE("OfEqualDepthsTheFirstTriangleIsVisible") {
    const auto corner = [](double x, double y) { return ClipVertex{x, y, 0.5 + x * 0.25 + y * 0.125, 1}; };
    const std::vector<ClipVertex> vertices = {corner(-1, -1), corner(1, -1),  corner(-1, 1),  corner(1, -1),
                                              corner(1, 1),   corner(-1, 1),  corner(-1, -1), corner(1, -1),
                                              corner(1, 1),   corner(-1, -1), corner(1, 1),   corner(-1, 1)};
    const RenderTarget exact =
        drawTriangles(kViewport, vertices, lessState(), formatOf(DepthFormat::d64f, DepthOrder::exact));
    for (const uint32_t id : exact.id.values()) CHECK(id < 2);
}

// What is behind all depths stays behind those that are cut to 1.
TEST_CASE("ExactDepthsAreCutButStoredOnesAreNot") {
    const auto constant = [](double z) { return ExactDepth{{3, 4, 5}, {z, z, z}, 12, 0}; };
    CHECK(compareDepths(constant(7), ExactDepth::of(1)) == 0);
    CHECK(compareDepths(constant(-7), ExactDepth::of(0)) == 0);
    CHECK(compareDepths(constant(7), ExactDepth::of(2)) == -1);
    CHECK(compareDepths(constant(0.5), constant(0.5)) == 0);
    CHECK(compareDepths(constant(0.5), ExactDepth::of(0.5 + 0x1p-53)) == -1);
    ExactDepth raised = constant(0.5);
    raised.bias = 0x1p-150;
    CHECK(compareDepths(raised, constant(0.5)) == 1);
}

TEST_CASE("AnExactOrderNeedsDoublesAndIds") {
    RenderTargetFormat format = formatOf(DepthFormat::d32f, DepthOrder::exact);
    CHECK_THROWS_AS(RenderTarget(4, 4, format), PreconditionError);
    format = formatOf(DepthFormat::d64f, DepthOrder::exact);
    format.real = RasterReal::fp32;
    CHECK_THROWS_AS(RenderTarget(4, 4, format), PreconditionError);
    RenderTarget target(kSize, kSize, formatOf(DepthFormat::d64f, DepthOrder::exact));
    DrawState state = lessState();
    state.idWrite = false;
    CHECK_THROWS_AS(drawInto(target, kViewport, {{-1, -1, 0.5, 1}, {1, -1, 0.5, 1}, {-1, 1, 0.5, 1}}, state),
                    PreconditionError);
}
