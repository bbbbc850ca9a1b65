// Rules 5 and 6: the depth of a sample, and what is stored of it.
#include "raster/depth.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <vector>

#include "numeric/text.h"
#include "tests/support/draw_triangles.h"
#include "tests/support/random_triangles.h"
#include "tests/support/reference_replay.h"

using namespace etalon;

namespace {

// Bounds of the error of rule 5, relative to the largest |z_i|, in units of 2^-24 (fp32) and 2^-53 (fp64).
// fp32: E_i, r, z_i, two products and two sums are rounded, seven half units in the last place in all, and
// the eighth allows for the products of these errors. fp64: E_i is exact.
constexpr double kDepthBound_fp32 = 8, kDepthBound_fp64 = 7;

constexpr DepthFormat kFormats[] = {DepthFormat::d16, DepthFormat::d24, DepthFormat::d32f};

template <class S>
uint32_t convert(DepthFormat format, DepthRounding rounding, S z) {
    return static_cast<uint32_t>(
        storedDepth<S, 1>(format, rounding, Lanes<S, 1>::generate([&](int) { return z; }))[0]);
}

// A triangle that covers the centre of one pixel and no other one.
void addPixel(std::vector<ClipVertex>& vertices, const Viewport& viewport, int x, int y, double z) {
    vertices.push_back(vertexAtPixel(viewport, x + 0.125, y + 0.125, 1, z));
    vertices.push_back(vertexAtPixel(viewport, x + 1.125, y + 0.375, 1, z));
    vertices.push_back(vertexAtPixel(viewport, x + 0.375, y + 1.125, 1, z));
}

// z next to the ties of a UNORM format, and the ties themselves where a double is one.
template <class S>
std::vector<S> nearTies(DepthFormat format, int step) {
    const double levels = format == DepthFormat::d16 ? 65535 : 16777215;
    std::vector<S> result;
    for (double j = 0; j < levels; j += step) {
        S z = static_cast<S>((j + 0.5) / levels);
        for (int i = 0; i < 3; i++) z = std::nextafter(z, S(0));
        for (int i = 0; i < 7; i++, z = std::nextafter(z, S(1))) result.push_back(z);
    }
    return result;
}

}  // namespace

TEST_CASE("DepthConversionIsExact") {
    const auto mismatches = [](auto z, DepthFormat format, DepthRounding rounding) {
        return size_t(convert(format, rounding, z) != oracle::storedDepth(format, rounding, z));
    };
    const uint32_t quarter = std::bit_cast<uint32_t>(0.25f), one = std::bit_cast<uint32_t>(1.0f);
    for (DepthFormat format : kFormats) {
        size_t wrong = 0;
        // Every float from 0.25 to 1, and every 1009th below.
        for (uint32_t bits = quarter; bits <= one; bits++)
            wrong += mismatches(std::bit_cast<float>(bits), format, DepthRounding::exact);
        for (uint32_t bits = 0; bits < quarter; bits += 1009)
            wrong += mismatches(std::bit_cast<float>(bits), format, DepthRounding::exact);
        for (uint32_t bits = 0; bits <= one; bits += 997)
            wrong += mismatches(std::bit_cast<float>(bits), format, DepthRounding::driver);
        for (uint32_t bits = 0; bits <= one; bits += 499)
            wrong += mismatches(std::bit_cast<float>(bits), format, DepthRounding::fixedFunction);
        CHECK(wrong == 0);
        // Outside of [0, 1], and the ends.
        for (double z : {-1.0, -0x1p-30, -0.0, 0.0, 0x1p-149, 0x1p-1000, 1 - 0x1p-53, 1.0, 1 + 0x1p-52, 3e30})
            CHECK_MESSAGE(mismatches(z, format, DepthRounding::exact) == 0, z);
        CHECK(convert(format, DepthRounding::exact, 1.0) == storedOne(format));
        CHECK(depthFromStored(format, storedOne(format)) == 1);
        CHECK(depthFromStored(format, 0) == 0);
    }
    for (DepthFormat format : {DepthFormat::d16, DepthFormat::d24}) {
        const int step = format == DepthFormat::d16 ? 1 : 37;
        size_t wrong = 0, roundTrip = 0;
        for (float z : nearTies<float>(format, step)) wrong += mismatches(z, format, DepthRounding::exact);
        for (double z : nearTies<double>(format, step)) wrong += mismatches(z, format, DepthRounding::exact);
        CHECK(wrong == 0);
        for (uint32_t stored = 0; stored <= storedOne(format); stored += static_cast<uint32_t>(step))
            roundTrip += convert(format, DepthRounding::exact, depthFromStored(format, stored)) != stored;
        CHECK(roundTrip == 0);
    }
}

TEST_CASE("DrawnDepthIsTheConvertedDepth") {
    const Viewport viewport{0, 0, 64, 64};
    Random random(3);
    for (DepthFormat format : kFormats)
        for (RasterReal real : {RasterReal::fp32, RasterReal::fp64})
            for (DepthRounding rounding :
                 {DepthRounding::exact, DepthRounding::driver, DepthRounding::fixedFunction}) {
                std::vector<ClipVertex> vertices;
                std::vector<double> z;
                const double levels = format == DepthFormat::d16 ? 65535 : 16777215;
                for (int i = 0; i < 64 * 64; i++) {
                    double value = random.uniform(0, 1);
                    if (random.chance(0.2)) value = std::ldexp(value, -random.integer(0, 60));
                    // Next to a tie of the format.
                    if (random.chance(0.6)) value = (std::floor(value * levels) + 0.5) / levels;
                    z.push_back(real == RasterReal::fp32 ? static_cast<float>(value) : value);
                    addPixel(vertices, viewport, i % 64, i / 64, z.back());
                }
                const RenderTarget target =
                    drawTriangles(viewport, vertices, alwaysState(), {1, 8, format, rounding, real});
                size_t wrong = 0;
                for (size_t i = 0; i < z.size(); i++) {
                    const uint32_t expected =
                        real == RasterReal::fp32
                            ? oracle::storedDepth(format, rounding, static_cast<float>(z[i]))
                            : oracle::storedDepth(format, rounding, z[i]);
                    wrong += target.depth.values()[i] != expected;
                }
                CHECK(wrong == 0);
            }
}

TEST_CASE("DepthOfAConstantPlaneIsConstant") {
    Random random(5);
    for (int run = 0; run < 200; run++) {
        const Viewport viewport{random.integer(0, 5), 0, random.integer(5, 90), random.integer(5, 70)};
        const RenderTargetFormat format{random.pick({1, 4}), random.integer(4, 8), random.pick(kFormats),
                                        DepthRounding::exact,
                                        random.pick({RasterReal::fp32, RasterReal::fp64})};
        // z / w is the same number at each vertex: w is a power of two, or z = w.
        const bool far = random.chance(0.2);
        const double depth = far ? 1 : static_cast<float>(random.uniform(0, 1));
        std::vector<ClipVertex> vertices;
        for (const auto& corner :
             {std::array{-40.0, -30.0}, std::array{500.0, -7.0}, std::array{-9.0, 400.0}})
            vertices.push_back(
                vertexAtPixel(viewport, corner[0] + random.uniform(-3, 3), corner[1],
                              far ? random.uniform(0.1, 9) : std::ldexp(1.0, random.integer(-9, 9)), depth));
        const RenderTarget target = drawTriangles(viewport, vertices, alwaysState(), format);
        const uint32_t expected = convert(format.depth, DepthRounding::exact, depth);
        size_t wrong = 0, covered = 0;
        for (size_t i = 0; i < target.id.values().size(); i++) {
            if (target.id.values()[i] == kNoTriangle) continue;
            covered++;
            wrong += target.depth.values()[i] != expected;
        }
        CHECK(wrong == 0);
        CHECK(covered > 0);
    }
}

TEST_CASE("DepthErrorStaysInsideTheBound") {
    Random random(17);
    double worst_fp32 = 0, worst_fp64 = 0, worstStored_fp64 = 0;
    size_t samples = 0;
    for (int run = 0; run < 8000; run++) {
        const auto family =
            random.pick({TriangleFamily::normal, TriangleFamily::sliver, TriangleFamily::subPixel,
                         TriangleFamily::nearFar, TriangleFamily::guardBand, TriangleFamily::everything});
        const Viewport viewport{0, 0, 32, 24};
        const auto triangle = randomTriangle(random, family, viewport);
        const oracle::Polygon polygon = oracle::preparePolygon(triangle, viewport, 8, false);
        if (polygon.fate != oracle::Fate::drawn) continue;
        const std::vector<ClipVertex> vertices(triangle.begin(), triangle.end());
        const RenderTarget single = drawTriangles(viewport, vertices, alwaysState());
        const RenderTarget twice =
            drawTriangles(viewport, vertices, alwaysState(),
                          {1, 8, DepthFormat::d32f, DepthRounding::exact, RasterReal::fp64});
        for (int y = 0; y < viewport.height; y++)
            for (int x = 0; x < viewport.width; x++) {
                const auto p = oracle::samplePosition(x, y, 1, 0, 8);
                const auto index = oracle::coveringPiece(polygon, p[0], p[1]);
                if (!index) continue;
                const oracle::Piece& piece = polygon.pieces[*index];
                // 64 or more bits of significand: the error of this truth is below a thousandth of the bound.
                const auto e = oracle::edgeValues(piece, p[0], p[1]);
                long double truth = 0, scale = 0;
                for (size_t i = 0; i < 3; i++) {
                    const long double z = static_cast<long double>(piece.z[i]) / piece.w[i];
                    truth += static_cast<long double>(e[i]) * z / static_cast<long double>(piece.area);
                    scale = std::max(scale, std::abs(z));
                }
                if (scale < 1e-20L) continue;
                const auto error = [&](long double z, double unit) {
                    return static_cast<double>(std::abs(z - truth) / scale / unit);
                };
                samples++;
                worst_fp32 =
                    std::max(worst_fp32, error(std::bit_cast<float>(single.depth.at(x, y)), 0x1p-24));
                worst_fp64 = std::max(worst_fp64,
                                      error(oracle::interpolatedDepth<double>(piece, p[0], p[1]), 0x1p-53));
                worstStored_fp64 =
                    std::max(worstStored_fp64, error(std::bit_cast<float>(twice.depth.at(x, y)), 0x1p-24));
            }
    }
    CHECK(samples > 500000);
    CHECK(worst_fp32 < kDepthBound_fp32);
    CHECK(worst_fp64 < kDepthBound_fp64);
    // Rounding to the stored float dominates.
    CHECK(worstStored_fp64 < 1 + kDepthBound_fp64 * 0x1p-29);
    // A bound several times too wide is no bound.
    CHECK(worst_fp32 > kDepthBound_fp32 / 4);
    MESSAGE(samples, " samples; largest error, fp32: ", worst_fp32, " x 2^-24, fp64: ", worst_fp64,
            " x 2^-53");
}
