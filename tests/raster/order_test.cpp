// Rules 5, 6, 10 and 11 together: a scene gives the bits of drawing one triangle after the other, however the
// work is cut.
#include <doctest/doctest.h>

#include <array>
#include <vector>

#include "numeric/text.h"
#include "tests/support/draw_triangles.h"
#include "tests/support/random_triangles.h"
#include "tests/support/reference_replay.h"

using namespace etalon;

namespace {

struct Scene {
    std::vector<std::vector<ClipVertex>> vertices;
    std::vector<std::vector<uint32_t>> indices;
    std::vector<DrawState> states;

    std::vector<Draw> draws() const {
        std::vector<Draw> result;
        for (size_t i = 0; i < states.size(); i++) result.push_back({vertices[i], indices[i], states[i]});
        return result;
    }
};

template <class Enum>
Enum anyOf(Random& random, Enum last) {
    return static_cast<Enum>(random.integer(0, static_cast<int>(last)));
}

StencilFace randomFace(Random& random) {
    const auto last = StencilOperation::decrementWrap;
    return {random.chance(0.5) ? Compare::always : anyOf(random, Compare::always), anyOf(random, last),
            anyOf(random, last), anyOf(random, last)};
}

DrawState randomState(Random& random) {
    DrawState state;
    state.cull = anyOf(random, CullMode::back);
    state.frontIsClockwise = random.chance(0.3);
    state.depthCompare = random.chance(0.5) ? Compare::less : anyOf(random, Compare::always);
    state.depthWrite = random.chance(0.8);
    state.idWrite = random.chance(0.8);
    state.depthClamp = random.chance(0.3);
    if (random.chance(0.3)) state.bias = {random.uniform(-1e4, 1e4), 0, random.pick({0.0, 1e-4, -1e-4})};
    state.stencil.enabled = random.chance(0.6);
    state.stencil.reference = static_cast<uint8_t>(random.next());
    state.stencil.readMask = random.chance(0.5) ? 0xff : static_cast<uint8_t>(random.next());
    state.stencil.writeMask = random.chance(0.5) ? 0xff : static_cast<uint8_t>(random.next());
    state.stencil.front = randomFace(random);
    state.stencil.back = randomFace(random);
    return state;
}

// Draws of indexed triangles that overlap each other, with shared and repeated vertices.
Scene randomScene(Random& random, const Viewport& viewport, int draws, int triangles) {
    static constexpr TriangleFamily kFamilies[] = {
        TriangleFamily::normal,    TriangleFamily::normal,    TriangleFamily::nearFar,
        TriangleFamily::sliver,    TriangleFamily::subPixel,  TriangleFamily::negativeW,
        TriangleFamily::guardBand, TriangleFamily::nonFinite, TriangleFamily::onSamples};
    Scene scene;
    for (int d = 0; d < draws; d++) {
        std::vector<ClipVertex> vertices;
        for (int t = 0; t < triangles; t++)
            for (const ClipVertex& v : randomTriangle(random, random.pick(kFamilies), viewport))
                vertices.push_back(v);
        std::vector<uint32_t> indices;
        for (uint32_t i = 0; i < vertices.size(); i++)
            indices.push_back(random.chance(0.05) ? static_cast<uint32_t>(random.next() % vertices.size())
                                                  : i);
        scene.vertices.push_back(std::move(vertices));
        scene.indices.push_back(std::move(indices));
        scene.states.push_back(randomState(random));
    }
    return scene;
}

RenderTargetFormat randomFormat(Random& random, std::initializer_list<int> samples) {
    RenderTargetFormat format;
    format.samples = samples.begin()[random.next() % samples.size()];
    format.subpixelBits = random.integer(4, 8);
    format.depth = anyOf(random, DepthFormat::d64f);
    format.real = anyOf(random, RasterReal::fp64);
    format.depthRounding =
        format.real == RasterReal::fp32 ? anyOf(random, DepthRounding::fixedFunction) : DepthRounding::exact;
    format.biasUnit = anyOf(random, BiasUnit::driver);
    format.depthDirection = anyOf(random, DepthDirection::reversed);
    return format;
}

bool samePlanes(const RenderTarget& a, const RenderTarget& b) {
    return a.depth == b.depth && a.lowDepth == b.lowDepth && a.stencil == b.stencil && a.id == b.id &&
           a.triangleCount() == b.triangleCount();
}

}  // namespace

// Whole blocks pass or fail here, next to others that do not; depths behind all stand where nothing is drawn.
TEST_CASE("CountingEqualsTheScalarReplay") {
    Random random(32);
    static constexpr StencilOperation kAdding[] = {StencilOperation::keep, StencilOperation::incrementWrap,
                                                   StencilOperation::decrementWrap};
    static constexpr TriangleFamily kLarge[] = {TriangleFamily::normal, TriangleFamily::nearFar,
                                                TriangleFamily::guardBand, TriangleFamily::sliver,
                                                TriangleFamily::everything};
    for (int run = 0; run < 200; run++) {
        const Viewport viewport{random.integer(0, 9), random.integer(0, 9), random.integer(1, 90),
                                random.integer(1, 70)};
        const RenderTargetFormat format = randomFormat(random, {1, 1, 4});
        RenderTarget actual(viewport.x + viewport.width, viewport.y + viewport.height, format);
        oracle::Target expected(actual.width(), actual.height(), format);
        Scene surfaces = randomScene(random, viewport, 2, 3);
        for (DrawState& state : surfaces.states) {
            state = {};
            state.cull = CullMode::none;
            state.depthCompare = nearerThan(format.depthDirection);
        }
        const auto drawBoth = [&](const Scene& scene) {
            const std::vector<Draw> draws = scene.draws();
            rasterize(actual, viewport, draws, {1, random.pick({8, 16, 64})});
            oracle::replay(expected, viewport, draws);
        };
        drawBoth(surfaces);
        for (int s = 0; s < format.samples; s++)
            for (int y = 0; y < actual.height(); y++)
                for (int x = 0; x < actual.width(); x++)
                    if (expected.id.at(x, y, s) == kNoTriangle) {
                        actual.depth.at(x, y, s) = depthBehindAll(format);
                        expected.depth.at(x, y, s) = oracle::storedDepth(actual, x, y, s);
                    }
        Scene counted;
        for (int d = 0; d < 2; d++) {
            std::vector<ClipVertex> vertices;
            for (int t = 0; t < 12; t++)
                for (const ClipVertex& v : randomTriangle(random, random.pick(kLarge), viewport))
                    vertices.push_back(v);
            std::vector<uint32_t> indices;
            for (uint32_t i = 0; i < vertices.size(); i++) indices.push_back(i);
            counted.vertices.push_back(std::move(vertices));
            counted.indices.push_back(std::move(indices));
            DrawState state;
            state.cull = CullMode::none;
            state.depthWrite = state.idWrite = false;
            state.depthCompare = nearerThan(format.depthDirection);
            state.depthClamp = random.chance(0.5);
            if (random.chance(0.3)) state.bias = {random.uniform(-1e4, 1e4), 0, 0};
            state.stencil.enabled = true;
            for (StencilFace* face : {&state.stencil.front, &state.stencil.back})
                face->onPass = random.pick(kAdding), face->onDepthFail = random.pick(kAdding);
            counted.states.push_back(state);
        }
        drawBoth(counted);
        const std::string difference = oracle::firstDifference(actual, expected);
        CHECK_MESSAGE(difference.empty(), "run ", run, ": ", difference);
    }
}

TEST_CASE("DrawingEqualsTheScalarReplay") {
    Random random(31);
    for (int run = 0; run < 600; run++) {
        const Viewport viewport{random.integer(0, 9), random.integer(0, 9), random.integer(1, 40),
                                random.integer(1, 30)};
        const RenderTargetFormat format = randomFormat(random, {1, 1, 4, 16});
        const int width = viewport.x + viewport.width + random.integer(0, 3);
        const int height = viewport.y + viewport.height + random.integer(0, 3);
        RenderTarget actual(width, height, format);
        oracle::Target expected(width, height, format);
        // Two calls: the second one starts from what the first one left.
        for (int call = 0; call < 2; call++) {
            const Scene scene = randomScene(random, viewport, random.integer(1, 4), random.integer(1, 12));
            const std::vector<Draw> draws = scene.draws();
            const RasterStatistics a = rasterize(actual, viewport, draws, {1, random.pick({8, 16, 64})});
            const RasterStatistics e = oracle::replay(expected, viewport, draws);
            const std::string difference = oracle::firstDifference(actual, expected);
            CHECK_MESSAGE(difference.empty(), "run ", run, ": ", difference);
            CHECK(a.culled == e.culled);
        }
    }
}

TEST_CASE("TilesThreadsAndLanesChangeNoBit") {
    Random random(37);
    for (int run = 0; run < 12; run++) {
        const int width = random.integer(130, 300), height = random.integer(100, 200);
        const Viewport viewport{random.integer(0, 30), random.integer(0, 30), width - 40, height - 40};
        const RenderTargetFormat format = randomFormat(random, {1, 4});
        const Scene scene = randomScene(random, viewport, 5, 60);
        const std::vector<Draw> draws = scene.draws();
        RenderTarget first(width, height, format);
        const RasterStatistics statistics = rasterize(first, viewport, draws, {1, 64});
        for (int threads : {1, 2, 7})
            for (int tileSize : {8, 16, 32, 64, 128}) {
                RenderTarget other(width, height, format);
                const RasterStatistics otherStatistics =
                    rasterize(other, viewport, draws, {threads, tileSize});
                CHECK_MESSAGE(samePlanes(first, other), "run ", run, ", threads ", threads, ", tile ",
                              tileSize);
                CHECK(statistics == otherStatistics);
            }
    }
}

TEST_CASE("SubmissionOrderDecidesEqualDepths") {
    const Viewport viewport{0, 0, 70, 40};
    // One triangle twice in each of two draws, in each of two calls.
    const std::vector<ClipVertex> vertices = {{-1, -1, 0.3, 1}, {3, -1, 0.6, 2}, {-1, 3, 0.2, 1}};
    const std::vector<uint32_t> indices = {0, 1, 2, 0, 1, 2};
    for (DepthFormat format : {DepthFormat::d16, DepthFormat::d24, DepthFormat::d32f})
        for (Compare compare : {Compare::less, Compare::lessEqual, Compare::equal, Compare::always}) {
            DrawState state;
            state.cull = CullMode::none;
            state.depthCompare = compare;
            RenderTarget target(70, 40, {1, 8, format, DepthRounding::exact, RasterReal::fp32});
            std::vector<Draw> draws = {{vertices, indices, state}, {vertices, indices, state}};
            if (compare == Compare::equal) draws[0].state.depthCompare = Compare::less;
            for (int call = 0; call < 2; call++) rasterize(target, viewport, draws, {2, 16});
            const bool firstWins = compare == Compare::less;
            size_t wrong = 0, covered = 0;
            for (uint32_t id : target.id.values()) {
                if (id == kNoTriangle) continue;
                covered++;
                const TriangleRecord record = target.triangle(id);
                wrong += record.draw != (firstWins ? 0u : 3u) || record.triangle != (firstWins ? 0u : 1u);
            }
            CHECK(wrong == 0);
            CHECK(covered > 1000);
        }
}
