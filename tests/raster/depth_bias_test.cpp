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
                  DepthFormat format, RasterReal real, BiasUnit unit = BiasUnit::step) {
    return drawTriangles(kViewport, vertices, biased(bias), {1, 8, format, DepthRounding::exact, real, unit})
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
            // UNORM: a step of the format, or of the driver's 2^-(n - 1), which is nearly two.
            for (const auto& [format, levels] :
                 {std::pair{DepthFormat::d16, 65535.0}, {DepthFormat::d24, 16777215.0}})
                for (double k : {-1000.0, -64.0, -1.0, 1.0, 2.0, 64.0, 1000.0}) {
                    // A depth between two steps may round to either, with a step added in the raster arithmetic.
                    const auto steps = [&](BiasUnit unit) {
                        return static_cast<double>(
                            int64_t{storedAt(5, 6, flat, {k, 0, 0}, format, real, unit)} - stored(format, 0));
                    };
                    CHECK(std::abs(steps(BiasUnit::step) - k) <= (depth == 0.5 ? 1 : 0));
                    const double exact = (depth + k * 2 / (levels + 1)) * levels;
                    const double found = steps(BiasUnit::driver) + static_cast<double>(stored(format, 0));
                    CHECK(std::abs(found - exact) <= 0.5 + 0x1p-20);
                }
            // D32F: units in the last place of the plane's depth.
            for (int k : {-7, -1, 1, 2, 100}) {
                const bool crosses =
                    depth == 0.125 || depth == 0.5;  // below a power of two the floats are denser
                if (!crosses || k > 0)
                    CHECK(stored(DepthFormat::d32f, k) - stored(DepthFormat::d32f, 0) == k);
            }
            // The limit holds from above or from below, by its sign.
            constexpr double kTenSteps = 10 / 65535.0;
            CHECK(stored(DepthFormat::d16, 100, kTenSteps) == stored(DepthFormat::d16, 10));
            CHECK(stored(DepthFormat::d16, -100, -kTenSteps) == stored(DepthFormat::d16, -10));
            CHECK(stored(DepthFormat::d16, -100, kTenSteps) == stored(DepthFormat::d16, -100));
            CHECK(stored(DepthFormat::d16, 100, -kTenSteps) == stored(DepthFormat::d16, 100));
            // The sum is clamped to [0, 1].
            CHECK(stored(DepthFormat::d24, 1e9) == storedOne(DepthFormat::d24));
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
