// Rules 5 to 7 where vertex depths are huge, tiny or next to a power of two.
#include <doctest/doctest.h>

#include <bit>
#include <cmath>
#include <vector>

#include "tests/support/draw_triangles.h"
#include "tests/support/random_triangles.h"

using namespace etalon;

namespace {

constexpr Viewport kViewport{0, 0, 64, 64};

bool isSubnormal(uint32_t bits) { return std::fpclassify(std::bit_cast<float>(bits)) == FP_SUBNORMAL; }

std::vector<ClipVertex> flat(double z) { return {{-1, -1, z, 1}, {3, -1, z, 1}, {-1, 3, z, 1}}; }

}  // namespace

TEST_CASE("HugeDepthsAreClampedInBothArithmetics") {
    DrawState state = alwaysState();
    state.depthClamp = true;
    for (double z : {1e3, 1e30, 1e39, 1e60, 0x1p499})
        for (double w : {1.0, 0x1p-79}) {
            // All far in front, all far behind, and both.
            const std::vector<ClipVertex> front = {{-w, -w, -z, w}, {3 * w, -w, -z, w}, {-w, 3 * w, -z, w}};
            const std::vector<ClipVertex> behind = {{-w, -w, z, w}, {3 * w, -w, z, w}, {-w, 3 * w, z, w}};
            const std::vector<ClipVertex> mixed = {{-w, -w, -z, w}, {3 * w, -w, z, w}, {-w, 3 * w, z, w}};
            for (RasterReal real : {RasterReal::fp32, RasterReal::fp64}) {
                const RenderTargetFormat format{1, 8, DepthFormat::d24, DepthRounding::exact, real};
                const RenderTarget a = drawTriangles(kViewport, front, state, format);
                const RenderTarget b = drawTriangles(kViewport, behind, state, format);
                const RenderTarget c = drawTriangles(kViewport, mixed, state, format);
                size_t wrong = 0;
                for (uint32_t depth : a.depth.values()) wrong += depth != 0;
                for (uint32_t depth : b.depth.values()) wrong += depth != storedOne(DepthFormat::d24);
                CHECK(wrong == 0);
                CHECK(c.depth.at(1, 62) == 0);
                CHECK(c.depth.at(62, 1) == storedOne(DepthFormat::d24));
            }
        }
}

TEST_CASE("StoredDepthIsNeverSubnormal") {
    // A sample whose weight of the only vertex with a depth is 2^-48: its edge value is 1.
    constexpr int kUnit = 256;
    const double x = 32.5 * kUnit, y = 32.5 * kUnit;
    const double edge[2][2] = {{x - 8388607, y - 1}, {x - 8388607 + 16777215, y + 1}};
    for (int exponent = -60; exponent > -140; exponent--) {
        const RenderTarget target =
            drawTriangles(kViewport,
                          {vertexAtPixel(kViewport, edge[0][0] / kUnit, edge[0][1] / kUnit, 1, 0),
                           vertexAtPixel(kViewport, edge[1][0] / kUnit, edge[1][1] / kUnit, 1, 0),
                           vertexAtPixel(kViewport, 32, 60000, 1, std::ldexp(1.0, exponent))},
                          alwaysState());
        CHECK(target.id.at(32, 32) != kNoTriangle);
        size_t subnormal = 0;
        for (uint32_t depth : target.depth.values()) subnormal += isSubnormal(depth);
        CHECK_MESSAGE(subnormal == 0, "2^", exponent);
    }
    // The unit of the bias where the depth is 0.
    for (double constant : {1.0, 1000.0, -1000.0}) {
        DrawState state = alwaysState();
        state.bias.constant = constant;
        CHECK_FALSE(isSubnormal(drawTriangles(kViewport, flat(0), state).depth.at(5, 5)));
    }
}

TEST_CASE("BiasUnitIsThatOfTheRoundedVertexDepth") {
    // In fp32 this z is 0.5 or 0.25, whose unit is twice that of the unrounded number.
    for (double z : {0.5 - 0x1p-40, 0.25 - 0x1p-40}) {
        DrawState state = alwaysState();
        state.bias.constant = 8;
        const float shift =
            std::bit_cast<float>(drawTriangles(kViewport, flat(z), state).depth.at(5, 5)) -
            std::bit_cast<float>(drawTriangles(kViewport, flat(z), alwaysState()).depth.at(5, 5));
        CHECK(shift == 8 * static_cast<float>(z) * 0x1p-23f);
    }
}
