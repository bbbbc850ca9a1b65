#include "raster/sampler.h"

#include <doctest/doctest.h>

#include <bit>
#include <cmath>
#include <limits>
#include <vector>

#include "numeric/format.h"
#include "numeric/rounded.h"
#include "numeric/truth.h"
#include "tests/support/random_numbers.h"

namespace etalon {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr Wrap kWraps[] = {Wrap::clamp, Wrap::repeat, Wrap::mirror};
constexpr int kFractionBits[] = {kExactFraction, 0, 4, 8, 16};

Image<float> randomImage(int width, int height, int channels, uint64_t seed) {
    RandomNumbers random(seed);
    Image<float> image(width, height, channels);
    for (float& v : image.values()) v = static_cast<float>(random.uniform(-3.0, 40.0));
    return image;
}

// One sample in the number type T, of the first channel.
template <class T = float>
T sampleAt(const Image<float>& image, T u, T v, const SamplerSettings& settings) {
    using Kernel = SamplerKernel<T>;
    return Kernel{}.sampleReal(TextureView(image), typename Kernel::integer(0), u, v,
                               samplingOf<Kernel>(settings, image.width(), image.height()));
}

// Coordinates inside, far outside, at texel borders and non-finite.
std::vector<float> awkwardCoordinates(uint64_t seed, int count) {
    RandomNumbers random(seed);
    std::vector<float> u = {0.0f,      -0.0f,      1.0f,    -1.0f,    2.0f,      0.5f,
                            0x1p-149f, -0x1p-149f, -1e-10f, 1.5e-38f, kInfinity, -kInfinity,
                            kNan,      1e30f,      -1e30f,  3e38f,    -3e38f,    16777217.0f};
    while (static_cast<int>(u.size()) < count) u.push_back(static_cast<float>(random.uniform(-3.0, 4.0)));
    return u;
}

}  // namespace

TEST_CASE("ConstantImageSamplesToExactlyItsConstant") {
    const std::vector<float> coordinates = awkwardCoordinates(1, 300);
    const std::vector<float> others = awkwardCoordinates(2, 300);
    for (float constant : {0.1f, 3.7f, 1e-30f, -65504.3f})
        for (auto [width, height] : {std::pair{1, 1}, {7, 3}, {64, 100}}) {
            Image<float> image(width, height);
            image.fill(constant);
            for (Filter filter : {Filter::nearest, Filter::bilinear})
                for (Wrap wrap : kWraps)
                    for (int bits : kFractionBits)
                        for (size_t i = 0; i < coordinates.size(); i++)
                            REQUIRE(sampleAt(image, coordinates[i], others[i], {filter, wrap, wrap, bits}) ==
                                    constant);
        }
}

TEST_CASE("TexelCentresSampleToExactlyTheirTexel") {
    for (int width = 1; width <= 130; width++) {
        const Image<float> image = randomImage(width, 1, 1, 3);
        const bool isPowerOfTwo = (width & (width - 1)) == 0;
        for (int x = 0; x < width; x++) {
            const float u = (static_cast<float>(x) + 0.5f) / static_cast<float>(width);
            for (Wrap wrap : kWraps) {
                REQUIRE(sampleAt(image, u, 0.5f, {Filter::nearest, wrap, wrap, 8}) == image.at(x, 0));
                REQUIRE(sampleAt(image, u, 0.5f, {Filter::bilinear, wrap, wrap, 8}) == image.at(x, 0));
                if (isPowerOfTwo)
                    REQUIRE(sampleAt(image, u, 0.5f, {Filter::bilinear, wrap, wrap}) == image.at(x, 0));
            }
        }
    }
}

TEST_CASE("LinearRampSamplesToExactlyThePosition") {
    // Texel (x, y) holds x + 100 y; positions are multiples of 1/256 between the centres.
    Image<float> image(64, 32);
    for (int y = 0; y < 32; y++)
        for (int x = 0; x < 64; x++) image.at(x, y) = static_cast<float>(x + 100 * y);
    for (int bits : {kExactFraction, 8, 16})
        for (int i = 0; i <= 63 * 256; i++) {
            const int j = i * 7 % (31 * 256);
            const float px = static_cast<float>(i) / 256.0f, py = static_cast<float>(j) / 256.0f;
            const float value = sampleAt(image, (px + 0.5f) / 64.0f, (py + 0.5f) / 32.0f,
                                         {Filter::bilinear, Wrap::clamp, Wrap::clamp, bits});
            REQUIRE(value == px + 100.0f * py);
        }
}

TEST_CASE("WrapModesFollowTheTable") {
    constexpr int kFirst = -5, kCount = 14, kWidth = 4;
    constexpr int kTable[3][kCount] = {
        {0, 0, 0, 0, 0, 0, 1, 2, 3, 3, 3, 3, 3, 3},  // clamp
        {3, 0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3, 0},  // repeat
        {3, 3, 2, 1, 0, 0, 1, 2, 3, 3, 2, 1, 0, 0},  // mirror
    };
    Image<float> row(kWidth, 1), column(1, kWidth);
    for (int i = 0; i < kWidth; i++) row.at(i, 0) = column.at(0, i) = static_cast<float>(i);
    for (Filter filter : {Filter::nearest, Filter::bilinear})
        for (int w = 0; w < 3; w++)
            for (int i = 0; i < kCount; i++) {
                const float u = (static_cast<float>(kFirst + i) + 0.5f) / kWidth;
                CAPTURE(w);
                CAPTURE(u);
                CHECK(sampleAt(row, u, 0.5f, {filter, kWraps[w], Wrap::clamp}) ==
                      static_cast<float>(kTable[w][i]));
                CHECK(sampleAt(column, 0.5f, u, {filter, Wrap::clamp, kWraps[w]}) ==
                      static_cast<float>(kTable[w][i]));
                // Between two centres: the mean of the two entries.
                if (filter == Filter::nearest || i + 1 == kCount) continue;
                const float mean = 0.5f * static_cast<float>(kTable[w][i] + kTable[w][i + 1]);
                const float between = static_cast<float>(kFirst + i + 1) / kWidth;
                CHECK(sampleAt(row, between, 0.5f, {filter, kWraps[w], Wrap::clamp}) == mean);
                CHECK(sampleAt(column, 0.5f, between, {filter, Wrap::clamp, kWraps[w]}) == mean);
            }
}

TEST_CASE("FractionsOfNBitsEqualTheDefinitionInIntegers") {
    // Positions m 2^-s that float holds exactly, ties and their neighbours among them.
    RandomNumbers random(4);
    SamplerKernel<float> kernel;
    for (int bits : {0, 1, 4, 8, 12, 16})
        for (int i = 0; i < 20000; i++) {
            const int shift = random.below(24);
            int64_t m = static_cast<int64_t>(random.bits() % (int64_t{1} << 24));
            if (i % 4 == 0 && shift > bits) {  // one step around a tie
                m = (((m >> (shift - bits)) << (shift - bits)) | int64_t{1} << (shift - bits - 1)) +
                    random.below(3) - 1;
            }
            if (i % 16 == 1) m = -1 - m % ((int64_t{1} << shift) / 2 + 1);  // down to -1/2
            const auto position = static_cast<float>(std::ldexp(static_cast<double>(m), -shift));
            // floor(m 2^(bits - s) + 1/2)
            const int64_t rounded = ((m << (bits + 1)) + (int64_t{1} << shift)) >> (shift + 1);
            const auto pair = kernel.texelPair(position, bits);
            CAPTURE(position);
            CAPTURE(bits);
            REQUIRE(pair.first == rounded >> bits);
            REQUIRE(pair.fraction ==
                    std::ldexp(static_cast<float>(rounded & ((int64_t{1} << bits) - 1)), -bits));
        }
}

TEST_CASE_TEMPLATE("SamplingInLanesGivesTheBitsOfScalars", L, Lanes<float, 4>, Lanes<float, 16>,
                   Lanes<double, 8>) {
    using S = typename L::Scalar;
    using Bits = std::conditional_t<sizeof(S) == 8, uint64_t, uint32_t>;
    const Image<float> image = randomImage(13, 6, 3, 5);
    const TextureView view(image);
    const std::vector<float> coordinates = awkwardCoordinates(6, 480), others = awkwardCoordinates(7, 480);
    for (Filter filter : {Filter::nearest, Filter::bilinear})
        for (Wrap wrapX : kWraps)
            for (Wrap wrapY : kWraps)
                for (int bits : kFractionBits) {
                    const SamplerSettings settings{filter, wrapX, wrapY, bits};
                    for (size_t i = 0; i < coordinates.size(); i += L::size) {
                        auto u = [&](int k) { return coordinates[i + static_cast<size_t>(k)]; };
                        auto v = [&](int k) {
                            return others[others.size() - 1 - i - static_cast<size_t>(k)];
                        };
                        const auto lanes = SamplerKernel<L>{}.sampleRgb(
                            view, Lanes<int32_t, L::size>(0), L::generate(u), L::generate(v),
                            samplingOf<SamplerKernel<L>>(settings, image.width(), image.height()));
                        for (int k = 0; k < L::size; k++) {
                            const auto scalar = SamplerKernel<S>{}.sampleRgb(
                                view, 0, S(u(k)), S(v(k)),
                                samplingOf<SamplerKernel<S>>(settings, image.width(), image.height()));
                            for (int c = 0; c < 3; c++)
                                REQUIRE(std::bit_cast<Bits>(lanes[c][k]) == std::bit_cast<Bits>(scalar[c]));
                        }
                    }
                }
}

TEST_CASE("NonFiniteCoordinatesHaveADefinedTexel") {
    Image<float> image(4, 1);
    for (int x = 0; x < 4; x++) image.at(x, 0) = static_cast<float>(x);
    for (Filter filter : {Filter::nearest, Filter::bilinear}) {
        auto at = [&](float u, Wrap wrap) { return sampleAt(image, u, 0.5f, {filter, wrap, Wrap::clamp}); };
        CHECK(at(kNan, Wrap::clamp) == 0.0f);
        CHECK(at(-kInfinity, Wrap::clamp) == 0.0f);
        CHECK(at(kInfinity, Wrap::clamp) == 3.0f);
        for (Wrap wrap : {Wrap::repeat, Wrap::mirror})
            for (float u : {kNan, kInfinity, -kInfinity}) CHECK(at(u, wrap) == at(0.0f, wrap));
    }
}

TEST_CASE_TEMPLATE("SamplesStayInsideTheHullOfTheTexels", R, float, double, Rounded<kFp16>, Rounded<kBf16>,
                   Rounded<kFp24R300>, Rounded<kFp32Flush>) {
    // Differences of texels of very different magnitude round up; every second fraction is the last before 1.
    RandomNumbers random(8);
    SamplerKernel<R> kernel;
    R beforeOne(0.5);
    for (int k = 2; k <= 53; k++) {
        const R next = beforeOne + R(std::ldexp(1.0, -k));
        if (next < R(1.0)) beforeOne = next;
    }
    for (int i = 0; i < 100000; i++) {
        const R a(random.uniform(-1.0, 1.0));
        const R b(random.uniform(-1.0, 1.0) * std::ldexp(1.0, -random.below(40)));
        const R f = i % 2 == 0 ? beforeOne : R(random.uniform(0.0, 1.0)) * beforeOne;
        const R x = kernel.lerpInside(a, b, f);
        REQUIRE(x >= (a < b ? a : b));
        REQUIRE(x <= (a < b ? b : a));
    }
}

TEST_CASE("TexelsOfWeightZeroHaveNoInfluence") {
    for (float bad : {kNan, kInfinity, -kInfinity}) {
        Image<float> image(4, 4);
        image.fill(bad);
        image.at(1, 2) = 7.0f;
        CHECK(sampleAt(image, 1.5f / 4.0f, 2.5f / 4.0f, {}) == 7.0f);
        CHECK_FALSE(std::isfinite(sampleAt(image, 1.75f / 4.0f, 2.5f / 4.0f, {})));
        CHECK_FALSE(std::isfinite(sampleAt(image, 1.5f / 4.0f, 2.25f / 4.0f, {})));
    }
}

TEST_CASE("FloatErrorOfBilinearStaysBelowItsBound") {
    RandomNumbers random(9);
    double worst = 0.0;
    for (auto [width, height] : {std::pair{5, 3}, {100, 37}, {1000, 2}}) {
        const Image<float> image = randomImage(width, height, 1, 10);
        const double bound = bilinearFloatErrorBound(width, height, 43.0, 43.0, 40.0);
        for (Wrap wrap : kWraps)
            for (int i = 0; i < 2000; i++) {
                const auto u = static_cast<float>(random.uniform(0.0, 1.0));
                const auto v = static_cast<float>(random.uniform(0.0, 1.0));
                const SamplerSettings settings{Filter::bilinear, wrap, wrap};
                const double truth = sampleAt<Truth>(image, Truth(u), Truth(v), settings).toDouble();
                worst = std::max(worst, std::abs(sampleAt(image, u, v, settings) - truth) / bound);
            }
    }
    CHECK(worst <= 1.0);
    CHECK(worst >= 0.05);
}

TEST_CASE_TEMPLATE("SmallFormatsSampleAConstantExactlyToo", R, Rounded<kFp16>, Rounded<kBf16>,
                   Rounded<kFp24R300>, Rounded<kFp16, Lanes<double, 4>>, Rounded<kFp32Flush>) {
    // The widths that the format holds; coordinates of every size, NaN and infinity where it has them.
    for (auto [width, height] : {std::pair{1, 1}, {7, 3}, {128, 256}}) {
        Image<float> image(width, height);
        image.fill(0.7f);
        for (Filter filter : {Filter::nearest, Filter::bilinear})
            for (Wrap wrap : kWraps)
                for (int bits : {kExactFraction, 4, 8})
                    for (float u : awkwardCoordinates(11, 200)) {
                        const R v = sampleAt(image, R(u), R(1.3 - u), {filter, wrap, wrap, bits});
                        if constexpr (Number<R>::lanes == 1)
                            REQUIRE(v == R(0.7f));
                        else
                            REQUIRE(v.v[1] == R(0.7f).v[1]);
                    }
    }
    CHECK_FALSE(holdsInteger<Rounded<kFp16>>(2049));
    CHECK_THROWS_AS(samplingOf<SamplerKernel<Rounded<kFp16>>>({}, 2049, 4), PreconditionError);
}

TEST_CASE("BadSamplerSettingsAreRejected") {
    using Kernel = SamplerKernel<float>;
    CHECK_THROWS_AS(samplingOf<Kernel>({}, 0, 4), PreconditionError);
    CHECK_THROWS_AS(samplingOf<Kernel>({Filter::bilinear, Wrap::clamp, Wrap::clamp, 17}, 4, 4),
                    PreconditionError);
    CHECK_THROWS_AS(TextureView(Image<float>()), PreconditionError);
}

}  // namespace etalon
