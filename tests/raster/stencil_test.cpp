// Rule 11: stencil.
#include <doctest/doctest.h>

#include <array>
#include <cstdint>
#include <vector>

#include "tests/support/draw_triangles.h"
#include "tests/support/random_triangles.h"

using namespace etalon;

namespace {

constexpr Viewport kViewport{0, 0, 16, 16};  // one pixel for each of the 256 stored values

// Covers the viewport; counter-clockwise, so a front.
std::vector<ClipVertex> fullScreen(double depth) {
    return {{-1, -1, depth, 1}, {3, -1, depth, 1}, {-1, 3, depth, 1}};
}

// What the operation's name says, in whole numbers.
int byName(StencilOperation operation, int stored, int reference) {
    switch (operation) {
        case StencilOperation::keep:
            return stored;
        case StencilOperation::zero:
            return 0;
        case StencilOperation::replace:
            return reference;
        case StencilOperation::incrementClamp:
            return stored < 255 ? stored + 1 : 255;
        case StencilOperation::decrementClamp:
            return stored > 0 ? stored - 1 : 0;
        case StencilOperation::invert:
            return ~stored & 255;
        case StencilOperation::incrementWrap:
            return (stored + 1) & 255;
        case StencilOperation::decrementWrap:
            return (stored - 1) & 255;
    }
    return -1;
}

bool compareByName(Compare compare, int a, int b) {
    const std::array<bool, 8> results = {false, a<b, a == b, a <= b, a> b, a != b, a >= b, true};
    return results[static_cast<size_t>(compare)];
}

// Draws a front over the stored values 0 to 255; the depth test passes when `depthPasses`.
RenderTarget drawOverAllValues(const StencilState& stencil, bool depthPasses) {
    RenderTarget target(16, 16, {});
    for (size_t i = 0; i < 256; i++) target.stencil.values()[i] = static_cast<uint8_t>(i);
    DrawState state;
    state.depthCompare = depthPasses ? Compare::less : Compare::greater;
    state.stencil = stencil;
    state.stencil.enabled = true;
    drawInto(target, kViewport, fullScreen(0.5), state);
    return target;
}

}  // namespace

TEST_CASE("StencilOperationsFollowTheTable") {
    const uint32_t farthest = storedOne(DepthFormat::d32f);
    for (int operation = 0; operation < 8; operation++)
        for (uint8_t reference : {0x00, 0x01, 0x5a, 0x80, 0xff})
            for (uint8_t writeMask : {0xff, 0x00, 0x0f, 0xa5}) {
                const auto op = static_cast<StencilOperation>(operation);
                const auto expected = [&](int stored) {
                    return (stored & ~writeMask & 255) | (byName(op, stored, reference) & writeMask);
                };
                size_t wrong = 0;
                StencilState stencil{true, reference, 0xff, writeMask, {}, {}};
                // Back faces must not matter here.
                stencil.back = {Compare::never, StencilOperation::invert, StencilOperation::invert,
                                StencilOperation::invert};
                const auto compareAll = [&](const RenderTarget& target, bool drawn) {
                    for (size_t i = 0; i < 256; i++) {
                        wrong += target.stencil.values()[i] != expected(static_cast<int>(i));
                        wrong += (target.id.values()[i] != kNoTriangle) != drawn;
                        wrong += (target.depth.values()[i] != farthest) != drawn;
                    }
                };
                stencil.front = {Compare::never, op, StencilOperation::keep, StencilOperation::keep};
                compareAll(drawOverAllValues(stencil, true), false);
                compareAll(drawOverAllValues(stencil, false), false);
                stencil.front = {Compare::always, StencilOperation::keep, op, StencilOperation::keep};
                compareAll(drawOverAllValues(stencil, false), false);
                stencil.front = {Compare::always, StencilOperation::keep, StencilOperation::keep, op};
                compareAll(drawOverAllValues(stencil, true), true);
                CHECK(wrong == 0);
            }
}

TEST_CASE("StencilComparesTheMaskedReferenceWithTheMaskedValue") {
    for (int compare = 0; compare < 8; compare++)
        for (int reference = 0; reference < 256; reference += 5)
            for (uint8_t readMask : {0xff, 0x00, 0x0f, 0xa5}) {
                StencilState stencil{true, static_cast<uint8_t>(reference), readMask, 0xff, {}, {}};
                stencil.front = {static_cast<Compare>(compare), StencilOperation::zero,
                                 StencilOperation::keep, StencilOperation::keep};
                const RenderTarget target = drawOverAllValues(stencil, true);
                size_t wrong = 0;
                for (int i = 0; i < 256; i++) {
                    const bool passes =
                        compareByName(static_cast<Compare>(compare), reference & readMask, i & readMask);
                    const auto index = static_cast<size_t>(i);
                    wrong += (target.id.values()[index] != kNoTriangle) != passes;
                    wrong += target.stencil.values()[index] != (passes ? i : 0);
                }
                CHECK(wrong == 0);
            }
}

TEST_CASE("StencilThatIsNotEnabledChangesNothing") {
    StencilState stencil;
    stencil.front = stencil.back = {Compare::never, StencilOperation::zero, StencilOperation::zero,
                                    StencilOperation::zero};
    RenderTarget target(16, 16, {});
    target.stencil.fill(77);
    DrawState state;
    state.stencil = stencil;
    drawInto(target, kViewport, fullScreen(0.5), state);
    for (uint8_t value : target.stencil.values()) CHECK(value == 77);
    for (uint32_t id : target.id.values()) CHECK(id != kNoTriangle);
}

TEST_CASE("TwoSidedStencilCountsBothFaces") {
    // Boxes seen from outside, drawn where a surface at depth 0.5 is already there. Counting fronts up and
    // backs down where the depth test fails leaves 1 for each box that the surface's point is inside of.
    struct Box {
        double x0, x1, y0, y1, z0, z1;  // in pixels and depth
    };
    Random random(41);
    size_t counted = 0, nested = 0;
    for (int run = 0; run < 200; run++) {
        const int samples = random.pick({1, 4});
        RenderTarget target(16, 16,
                            {samples, 8, random.pick({DepthFormat::d16, DepthFormat::d24, DepthFormat::d32f}),
                             DepthRounding::exact, RasterReal::fp32});
        drawInto(target, kViewport, fullScreen(0.5), DrawState{});
        std::vector<Box> boxes;
        std::vector<ClipVertex> vertices;
        std::vector<uint32_t> indices;
        for (int b = random.integer(1, 6); b > 0; b--) {
            const double x = random.integer(-2, 14), y = random.integer(-2, 14), z = random.uniform(0.1, 0.9);
            boxes.push_back(
                {x, x + random.integer(1, 9), y, y + random.integer(1, 9), z, z + random.uniform(0.05, 0.4)});
            if (boxes.back().z0 < 0.5 && boxes.back().z1 > 0.95) boxes.back().z1 = 0.95;
            const Box& box = boxes.back();
            const auto base = static_cast<uint32_t>(vertices.size());
            for (int i = 0; i < 8; i++) {
                // The far side is smaller, as in a perspective view, so that the sides of the box are seen
                // too.
                const double shrink = i & 4 ? 0.25 : 0;
                const double px = i & 1 ? box.x1 - shrink : box.x0 + shrink,
                             py = i & 2 ? box.y1 - shrink : box.y0 + shrink;
                vertices.push_back(vertexAtPixel(kViewport, px, py, 1, i & 4 ? box.z1 : box.z0));
            }
            // Counter-clockwise from outside: bit 0 is x to the right, bit 1 is y down, bit 2 is away.
            static constexpr uint32_t kQuads[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 4, 6, 2},
                                                      {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}};
            for (const auto& q : kQuads)
                for (uint32_t i : {q[0], q[1], q[2], q[0], q[2], q[3]}) indices.push_back(base + i);
        }
        DrawState state;
        state.cull = CullMode::none;
        state.depthWrite = state.idWrite = false;
        state.depthClamp = true;
        state.stencil.enabled = true;
        // Behind the surface: backs up, fronts down, wrapping below 0 on the way.
        state.stencil.back.onDepthFail = StencilOperation::incrementWrap;
        state.stencil.front.onDepthFail = StencilOperation::decrementWrap;
        const Image<uint32_t> idBefore = target.id;
        const Draw draw{vertices, indices, state};
        rasterize(target, kViewport, {&draw, 1}, {1, 8});
        size_t wrong = 0;
        for (int s = 0; s < samples; s++)
            for (int y = 0; y < 16; y++)
                for (int x = 0; x < 16; x++) {
                    const auto offset = samplePositions(samples)[static_cast<size_t>(s)];
                    const double px = x + offset[0] / 16.0, py = y + offset[1] / 16.0;
                    int lowest = 0, highest = 0;
                    for (const Box& b : boxes) {
                        if (!(b.z0 < 0.5 && b.z1 > 0.5)) continue;
                        // Within the wider and the narrower end: only between them the sides decide.
                        highest += px >= b.x0 && px <= b.x1 && py >= b.y0 && py <= b.y1;
                        lowest +=
                            px > b.x0 + 0.25 && px < b.x1 - 0.25 && py > b.y0 + 0.25 && py < b.y1 - 0.25;
                    }
                    const int stored = target.stencil.at(x, y, s);
                    wrong += stored < lowest || stored > highest;
                    counted += stored > 0;
                    nested += lowest > 1;
                }
        CHECK(wrong == 0);
        CHECK(target.id == idBefore);
    }
    CHECK(counted > 1000);
    CHECK(nested > 100);
}
