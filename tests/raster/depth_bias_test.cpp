// Rule 7: depth bias.
#include <doctest/doctest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <vector>

#include "tests/support/draw_triangles.h"
#include "tests/support/random_triangles.h"
#include "tests/support/reference_replay.h"

using namespace etalon;

namespace {

constexpr Viewport kViewport{0, 0, 16, 16};
constexpr RasterReal kReals[] = {RasterReal::fp32, RasterReal::fp64};

// A plane over the viewport with the depth z_0 at pixel (0, 0) and the given slopes per pixel.
std::vector<ClipVertex> plane(double z_0, double dzdx, double dzdy) {
    std::vector<ClipVertex> vertices;
    for (const auto& p : {std::array{-8.0, -8.0}, std::array{40.0, -8.0}, std::array{-8.0, 40.0}})
        vertices.push_back(
            vertexAtPixel(kViewport, p[0], p[1], p[0] > 0 ? 2 : 0.5, z_0 + p[0] * dzdx + p[1] * dzdy));
    return vertices;
}

DrawState biased(const DepthBias& bias) {
    DrawState state = alwaysState();
    state.bias = bias;
    return state;
}

uint32_t storedAt(int x, int y, const std::vector<ClipVertex>& vertices, const DepthBias& bias,
                  DepthFormat format, RasterReal real) {
    return drawTriangles(kViewport, vertices, biased(bias), {1, 8, format, DepthRounding::exact, real})
        .depth.at(x, y);
}

}  // namespace

TEST_CASE("DepthBiasIsInUnitsOfTheFormat") {
    for (RasterReal real : kReals)
        for (double depth : {0.125, 0.3125, 0.5, 0.75, 0.9375}) {
            const auto flat = plane(depth, 0, 0);
            const auto stored = [&](DepthFormat format, double constant, double clamp = 0) {
                return static_cast<int64_t>(storedAt(5, 6, flat, {constant, 0, clamp}, format, real));
            };
            // UNORM: 2^-n per unit, where a step of the format is 1 / (2^n - 1).
            for (const auto& [format, levels] :
                 {std::pair{DepthFormat::d16, 65535.0}, {DepthFormat::d24, 16777215.0}})
                for (double k : {-1000.0, -64.0, -1.0, 1.0, 2.0, 64.0, 1000.0}) {
                    const double expected = std::floor((depth + k / (levels + 1)) * levels + 0.5);
                    CHECK(static_cast<double>(stored(format, k)) == expected);
                    // one less only where the unbiased depth is a tie
                    CHECK(stored(format, k) - stored(format, 0) ==
                          static_cast<int64_t>(k) - (depth == 0.5 && k > 0));
                }
            // D32F: units in the last place of the plane's depth.
            for (int k : {-7, -1, 1, 2, 100}) {
                const bool crosses =
                    depth == 0.125 || depth == 0.5;  // below a power of two the floats are denser
                if (!crosses || k > 0)
                    CHECK(stored(DepthFormat::d32f, k) - stored(DepthFormat::d32f, 0) == k);
            }
            // The limit holds from above or from below, by its sign.
            CHECK(stored(DepthFormat::d16, 100, 10 * 0x1p-16) == stored(DepthFormat::d16, 10));
            CHECK(stored(DepthFormat::d16, -100, -10 * 0x1p-16) == stored(DepthFormat::d16, -10));
            CHECK(stored(DepthFormat::d16, -100, 10 * 0x1p-16) == stored(DepthFormat::d16, -100));
            CHECK(stored(DepthFormat::d16, 100, -10 * 0x1p-16) == stored(DepthFormat::d16, 100));
            // The sum is clamped to [0, 1].
            CHECK(stored(DepthFormat::d24, 1e9) == farthestDepth(DepthFormat::d24));
            CHECK(stored(DepthFormat::d32f, -1e9) == 0);
        }
    // D32F: the exponent of the largest depth of the triangle decides for all of it.
    const auto steep = plane(0.05, 1.0 / 64, 1.0 / 64);  // -0.2 to 0.675: cut at the near plane
    const auto gentle = plane(0.25, 1.0 / 64, 0);        // 0.125 to 0.875
    const auto difference = [](const std::vector<ClipVertex>& vertices, int x, double k) {
        const auto depthAt = [&](double constant) {
            return std::bit_cast<float>(
                storedAt(x, 3, vertices, {constant, 0, 0}, DepthFormat::d32f, RasterReal::fp64));
        };
        return depthAt(k) - depthAt(0);
    };
    for (int x : {0, 3, 15}) {
        CHECK(difference(gentle, x, 1024) == 1024 * 0x1p-24f);
        CHECK(std::abs(difference(steep, x, 1024) - 1024 * 0x1p-24f) < 0x1p-24f);
    }
}

TEST_CASE("SlopeScaledBiasIsTheLargerSlope") {
    Random random(23);
    for (RasterReal real : kReals)
        for (int run = 0; run < 300; run++) {
            const double dzdx = random.uniform(-1, 1) / 128, dzdy = random.uniform(-1, 1) / 128;
            const double scale = random.uniform(-4, 4), larger = std::max(std::abs(dzdx), std::abs(dzdy));
            const auto vertices = plane(0.5, dzdx, dzdy);
            const auto shift = [&](const DepthBias& bias) {
                const auto depthAt = [&](const DepthBias& b) {
                    return double(std::bit_cast<float>(storedAt(2, 9, vertices, b, DepthFormat::d32f, real)));
                };
                return depthAt(bias) - depthAt({});
            };
            // Positions are snapped to 1/256 pixel, here exactly; what is left are roundings of z to float.
            constexpr double kTolerance = 4 * 0x1p-24;
            CHECK(std::abs(shift({0, scale, 0}) - scale * larger) < kTolerance);
            // Constant and slope add up before the limit.
            const double sum = 65536 * 0x1p-24 + scale * larger, limit = 0x1p-9;
            CHECK(std::abs(shift({65536, scale, limit}) - std::min(sum, limit)) < kTolerance);
            CHECK(std::abs(shift({65536, scale, -limit}) - std::max(sum, -limit)) < kTolerance);
        }
    // Slopes are per pixel, whatever the subpixel bits.
    for (int bits = 4; bits <= 8; bits++) {
        const RenderTargetFormat format{1, bits, DepthFormat::d24, DepthRounding::exact, RasterReal::fp64};
        const auto vertices = plane(0.5, 0x1p-8, -0x1p-7);
        const int64_t with = drawTriangles(kViewport, vertices, biased({0, 1, 0}), format).depth.at(4, 4);
        const int64_t without = drawTriangles(kViewport, vertices, biased({}), format).depth.at(4, 4);
        CHECK(with - without == doctest::Approx(0x1p-7 * 16777215).epsilon(1e-5));
    }
}
