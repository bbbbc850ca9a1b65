// Rule 22 against its statement in integers, and against words that the hardware gave (tests/raster/README.md).
#include "raster/texture_unit.h"

#include <doctest/doctest.h>

#include <bit>
#include <cmath>
#include <fstream>
#include <limits>
#include <vector>

#include "numeric/emulated.h"
#include "numeric/rounded.h"
#include "numeric/truth.h"
#include "raster/cube_face.h"
#include "raster/depth.h"
#include "raster/sampler.h"
#include "raster/stored_sample.h"
#include "tests/support/random_numbers.h"

namespace etalon {
namespace {

// The rule in integers. Every float is an integer times 2^-149.
using Wide = __int128;

int64_t floorDivided(int64_t a, int64_t b) { return a / b - (a % b != 0 && (a < 0) != (b < 0) ? 1 : 0); }
int64_t modulo(int64_t a, int64_t b) { return a - b * floorDivided(a, b); }
int ceilLog2(int64_t a) { return a <= 1 ? 0 : 64 - std::countl_zero(static_cast<uint64_t>(a - 1)); }
int bitLength(Wide a) {
    int bits = 0;
    for (; a > 0; a >>= 1) bits++;
    return bits;
}

struct Steps {
    int64_t count;  // floor(u 2^bits)
    int bits;
};
Steps stepsOf(float u, int size) {
    const int bits = std::max(21, ceilLog2(size) + 8);
    int exponent;
    const auto significand = static_cast<int64_t>(std::ldexp(std::frexp(u, &exponent), 24));
    const int shift = exponent - 24 + bits;
    if (shift >= 0) return {significand << shift, bits};
    return {shift < -62 ? (significand < 0 ? -1 : 0) : significand >> -shift, bits};
}
int wrappedIndex(int64_t i, int size, Wrap wrap) {
    if (wrap == Wrap::repeat) return static_cast<int>(modulo(i, size));
    if (wrap == Wrap::mirror) {
        const int64_t turn = modulo(i, 2 * size);
        return static_cast<int>(turn < size ? turn : 2 * size - 1 - turn);
    }
    return static_cast<int>(std::clamp<int64_t>(i, 0, size - 1));
}
struct LinearTexels {
    int first, next, fraction;
};
LinearTexels linearTexels(float u, int size, Wrap wrap) {
    const Steps t = stepsOf(u, size);
    const Wide p = ((Wide(256) * t.count * size + (Wide(1) << (t.bits - 1))) >> t.bits) - 128;
    const auto first = static_cast<int64_t>(p >> 8);
    return {wrappedIndex(first, size, wrap), wrappedIndex(first + 1, size, wrap), static_cast<int>(p & 255)};
}
int nearestIndex(float u, int size, Wrap wrap) {
    const Steps t = stepsOf(u, size);
    return wrappedIndex(static_cast<int64_t>((Wide(t.count) * size) >> t.bits), size, wrap);
}

std::array<int, 4> weightsOf(int x, int y) {
    const int both = (x * y + 128) >> 8;
    return {256 - x - y + both, x - both, y - both, both};
}

// A float format of `bits` significand bits and least exponent `least`: the sum of the weighted texels.
float sumOfFloats(const std::array<float, 4>& v, const std::array<int, 4>& w, int bits, int least) {
    // Texels as integers times 2^-149, and the exponent of the largest one that has a weight, as a bit of them.
    std::array<int, 4> exponent{};
    std::array<int64_t, 4> significand{};
    int largest = -200;
    for (size_t k = 0; k < 4; k++) {
        significand[k] = static_cast<int64_t>(std::ldexp(std::frexp(std::fabs(v[k]), &exponent[k]), 24));
        if (w[k] > 0 && v[k] != 0) largest = std::max(largest, exponent[k]);
    }
    // In units of 2^(largest - bits - 4), toward zero.
    Wide sum = 0;
    for (size_t k = 0; k < 4; k++) {
        const int shift = exponent[k] - 24 - (largest - bits - 4);
        int64_t part = shift >= 0    ? significand[k] << std::min(shift, 20)
                       : shift < -62 ? 0
                                     : significand[k] >> -shift;
        if (w[k] == 0 || v[k] == 0) part = 0;
        sum += Wide(v[k] < 0 ? -part : part) * w[k];
    }
    const Wide magnitude = sum < 0 ? -sum : sum;
    // The sum's unit is 2^unit; the result is a multiple of 2^result.
    const int unit = largest - bits - 4 - 8;
    const int result = std::max(unit + bitLength(magnitude) - bits, least - bits + 1);
    const int cut = result - unit;
    const Wide rounded = cut <= 0 ? magnitude << -cut : (magnitude + (Wide(1) << (cut - 1))) >> cut;
    const double value = std::ldexp(static_cast<double>(rounded), result);
    return static_cast<float>(sum < 0 ? -value : value);
}

constexpr FilterRule kUnit{FilterPosition::fixedPoint, FilterWeights::bits8, FilterSum::fixedFunction};
SamplerSettings settingsOf(Wrap wrap, Filter filter, TexelFormat texels = TexelFormat::float32) {
    SamplerSettings settings{filter, wrap, wrap, 8, kUnit};
    settings.rule.texels = texels;
    return settings;
}
template <class T>
float sampled(const TextureView& texture, float u, float v, const SamplerSettings& settings) {
    using Kernel = SamplerKernel<T>;
    return static_cast<float>(
        numberLane(Kernel{}.sampleReal(texture, typename Kernel::integer(0), T(static_cast<double>(u)),
                                       T(static_cast<double>(v)),
                                       samplingOf<Kernel>(settings, texture.width(), texture.height())),
                   0));
}
// Texel i holds i.
Image<float> numberedRow(int width) {
    Image<float> row(width, 1);
    for (int i = 0; i < width; i++) row.at(i, 0) = static_cast<float>(i);
    return row;
}
// Coordinates in and around [0, 1], many next to the borders of 1/256 of a texel.
float coordinate(RandomNumbers& random, int size, int i) {
    if (i % 4 == 0) return static_cast<float>(random.uniform(-3.0, 4.0));
    const double position = random.below(256 * size) + 0.5 * random.below(2);
    float u = static_cast<float>(position / (256.0 * size)) +
              static_cast<float>(i % 4 == 1 ? random.below(7) - 3 : 0);
    for (int step = random.below(5); step > 0; step--) u = std::nextafter(u, i % 2 == 0 ? -10.0f : 10.0f);
    return std::fabs(u) < 0x1p-126f ? 0 : u;  // profiles that flush
}

}  // namespace

TEST_CASE_TEMPLATE("TapWeightsAreTheRuleInIntegers", T, float, double, Lanes<float, 4>, Rounded<kFp16>,
                   Rounded<kBf16>, Truth) {
    TapWeightTexts<T> kernel;
    for (int x = 0; x < 256; x++)
        for (int y = 0; y < 256; y++) {
            const auto w = kernel.tapWeights(T(x / 256.0), T(y / 256.0));
            const std::array<int, 4> expected = weightsOf(x, y);
            const std::array<const T*, 4> found = {&w.w00, &w.w10, &w.w01, &w.w11};
            for (size_t k = 0; k < 4; k++) REQUIRE(numberLane(*found[k], 0) == expected[k] / 256.0);
        }
}

TEST_CASE_TEMPLATE("FixedPointPositionsAreTheRuleInIntegers", T, float, double, Emulated<double>,
                   Lanes<float, 8>) {
    const EmulatedScope scope(kFp32Flush);
    RandomNumbers random(1);
    for (int size : {1, 2, 3, 7, 60, 64, 100, 1000, 1024, 2047, 4097, 8192, 8193, 16384, 32768})
        for (Wrap wrap : {Wrap::clamp, Wrap::repeat, Wrap::mirror})
            for (int i = 0; i < 2000; i++) {
                const float u = coordinate(random, size, i);
                const int mode = static_cast<int>(wrap);
                CAPTURE(size);
                CAPTURE(mode);
                CAPTURE(u);
                SamplerKernel<T> kernel;
                using Integer = typename SamplerKernel<T>::integer;
                const T number(static_cast<double>(u));
                const auto texel = kernel.unitTexelPair(number, size, mode);
                const auto indexOf = [&](const Integer& at) {
                    return numberLane(kernel.wrapTexel(at, size, mode), 0);
                };
                const LinearTexels expected = linearTexels(u, size, wrap);
                REQUIRE(indexOf(texel.first) == expected.first);
                REQUIRE(indexOf(texel.first + Integer(1)) == expected.next);
                // Beyond the border both texels are the same and the fraction is that of the border.
                if (wrap != Wrap::clamp || (u >= 0 && u <= 1))
                    REQUIRE(numberLane(texel.fraction, 0) * 256 == expected.fraction);
                REQUIRE(indexOf(kernel.unitNearestTexel(number, size, mode)) == nearestIndex(u, size, wrap));
            }
}

TEST_CASE("CoordinatesThatAreNoNumbersHaveATexel") {
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    const Image<float> row = numberedRow(7);
    for (Wrap wrap : {Wrap::clamp, Wrap::repeat, Wrap::mirror})
        for (Filter filter : {Filter::nearest, Filter::bilinear}) {
            const auto at = [&](float u) {
                return sampled<float>(TextureView(row), u, 0.5f, settingsOf(wrap, filter));
            };
            CHECK(at(std::numeric_limits<float>::quiet_NaN()) == at(0.0f));
            CHECK(at(-kInfinity) == at(0.0f));
            CHECK(at(kInfinity) == (wrap == Wrap::clamp ? 6 : at(0.0f)));
            for (float u : {3e38f, -3e38f, 0x1p-149f, -0x1p-149f}) {
                const float value = at(u);
                CHECK(value >= 0);
                CHECK(value <= 6);
            }
        }
}

TEST_CASE_TEMPLATE("SumsOfFloatTexelsAreTheRuleInIntegers", T, float, double, Emulated<double>,
                   Lanes<float, 4>) {
    const EmulatedScope scope(kFp32);
    RandomNumbers random(2);
    TextureUnitTexts<double> texts;
    for (int i = 0; i < 40000; i++) {
        const int x = random.below(256), y = random.below(256);
        const bool isHalf = i % 2 == 1;
        const int range = std::array{0, 3, 12, 40}[static_cast<size_t>(i / 2 % 4)];
        std::array<float, 4> v{};
        for (float& value : v) {
            value = static_cast<float>(random.uniform(-1.0, i % 3 == 0 ? 0.0 : 1.0));
            value = std::ldexp(value, random.below(range + 1) - range / 2);
            if (random.below(9) == 0) value = std::ldexp(value, isHalf ? -12 : -120);
            if (random.below(9) == 0) value = 0;
            if (isHalf) value = static_cast<float>(texts.halfWritten(value));
        }
        const std::array<int, 4> w = weightsOf(x, y);
        const auto weight = [&](size_t k) { return T(w[k] / 256.0); };
        const auto texel = [&](size_t k) { return T(static_cast<double>(v[k])); };
        const T sum = TextureUnit<T>::weighted({texel(0), texel(1), texel(2), texel(3)},
                                               {weight(0), weight(1), weight(2), weight(3)}, isHalf ? 1 : 0);
        const float expected = isHalf ? sumOfFloats(v, w, 11, -14) : sumOfFloats(v, w, 24, -126);
        REQUIRE(numberLane(sum, 0) == expected);
    }
}

TEST_CASE("SumsOfCodesAreTheRuleInIntegers") {
    RandomNumbers random(3);
    for (int i = 0; i < 40000; i++) {
        const bool isByte = i % 2 == 1;
        const int x = random.below(256), y = random.below(256);
        std::array<float, 4> v{}, w{};
        int64_t sum = 0;
        for (size_t k = 0; k < 4; k++) {
            const int code = random.below(isByte ? 256 : 65536);
            v[k] =
                isByte ? floatOfCode(static_cast<uint8_t>(code)) : floatOfCode(static_cast<uint16_t>(code));
            w[k] = static_cast<float>(weightsOf(x, y)[k]) / 256.0f;
            sum += int64_t{weightsOf(x, y)[k]} * (isByte ? 257 * code : code);
        }
        REQUIRE(TextureUnit<float>::weighted(v, w, isByte ? 3 : 2) ==
                static_cast<float>((sum + 128) >> 8) / 65535.0f);
    }
}

// The first input that writes k + 1 is the least multiple t / 2^(n + 4) above (k + 1/2) / (2^n - 1).
TEST_CASE("UnormWritesHaveTheThresholdsOfTheRuleInIntegers") {
    TextureUnitTexts<double> texts;
    for (int bits : {7, 8, 10, 15, 16}) {  // 7 and 15: magnitudes of SNORM
        const int64_t levels = (int64_t{1} << bits) - 1, steps = int64_t{1} << (bits + 4);
        const auto code = [&](float x) {
            return static_cast<int64_t>(
                texts.unormCode(x, static_cast<double>(levels), static_cast<double>(steps)));
        };
        for (int64_t k = 0; k < levels; k++) {
            const int64_t t = floorDivided((2 * k + 1) * steps, 2 * levels) + 1;
            const float first = static_cast<float>(t) / static_cast<float>(steps);
            REQUIRE(code(first) == k + 1);
            REQUIRE(code(std::nextafter(first, 0.0f)) == k);
            if (bits == 16) {
                const auto stored = [](float x) {
                    return storedDepth(DepthFormat::d16, DepthRounding::fixedFunction, Lanes<float, 1>(x))[0];
                };
                REQUIRE(stored(first) == k + 1);
                REQUIRE(stored(std::nextafter(first, 0.0f)) == k);
            }
        }
        CHECK(code(-1.0f) == 0);
        CHECK(code(2.0f) == levels);
        CHECK(code(std::numeric_limits<float>::quiet_NaN()) == 0);
        CHECK(code(std::numeric_limits<float>::infinity()) == levels);
        CHECK(code(0.5f) == levels / 2);  // a tie, down
    }
}

TEST_CASE_TEMPLATE("Depth24WritesAreTheRuleInIntegers", S, float, double) {
    RandomNumbers random(4);
    const int64_t levels = 16777215;
    for (int i = 0; i < 400000; i++) {
        // x = m / 2^40, m of at most 24 bits; every fourth in the middle between two multiples of 2^-24.
        int64_t m = random.below(1 << 24);
        const int shift = random.below(17);
        if (i % 4 == 0) m = (m >> 1) | 1;
        const int64_t numerator = i % 4 == 0 ? (m % (1 << 20)) * 2 * 32768 + 32768 : m << shift;
        const auto x = static_cast<S>(std::ldexp(static_cast<double>(numerator), -40));
        REQUIRE(static_cast<float>(x) == x);
        const Wide product = Wide(numerator) * levels, one = Wide(1) << 40;
        Wide k = product >> 40;
        const Wide rest = product - (k << 40);
        const bool isMiddle = numerator % 65536 == 32768 && numerator < one / 16;
        if (2 * rest > one || (2 * rest == one && k % 2 == 1) || isMiddle) k++;
        REQUIRE(storedDepth(DepthFormat::d24, DepthRounding::fixedFunction,
                            Lanes<S, 1>(static_cast<double>(x)))[0] == static_cast<int32_t>(k));
    }
}

TEST_CASE("WritesToHalfTruncateAndStayFinite") {
    TextureUnitTexts<double> texts;
    for (uint32_t code = 0; code < 0x7c00; code++) {
        const float half = floatOfHalf(static_cast<uint16_t>(code));
        const float next = code == 0x7bff ? std::numeric_limits<float>::infinity()
                                          : floatOfHalf(static_cast<uint16_t>(code + 1));
        for (float x : {half, std::nextafter(half, next), std::nextafter(next, half)}) {
            REQUIRE(texts.halfWritten(x) == half);
            REQUIRE(texts.halfWritten(-x) == -half);
        }
    }
    CHECK(texts.halfWritten(3e38) == 65504);
    CHECK(texts.halfWritten(std::numeric_limits<double>::infinity()) ==
          std::numeric_limits<double>::infinity());
    CHECK(std::isnan(texts.halfWritten(std::numeric_limits<double>::quiet_NaN())));
}

// What raster/sampler.h promises of filters holds for the hardware's.
TEST_CASE("HardwareFiltersKeepConstantsAndIgnoreTexelsWithoutWeight") {
    constexpr float kNan = std::numeric_limits<float>::quiet_NaN(),
                    kInfinity = std::numeric_limits<float>::infinity();
    FilterRule weightsOnly;
    weightsOnly.weights = FilterWeights::bits8;
    RandomNumbers random(5);
    for (const FilterRule& rule : {weightsOnly, kUnit}) {
        const SamplerSettings settings{Filter::bilinear, Wrap::clamp, Wrap::clamp, 8, rule};
        const auto at = [&](const Image<float>& image, float u, float v) {
            return sampled<float>(TextureView(image), u, v, settings);
        };
        for (int i = 0; i < 3000; i++) {
            Image<float> image(2, 2);
            const float constant =
                std::ldexp(static_cast<float>(random.uniform(-1.0, 1.0)), random.below(200) - 100);
            image.fill(constant);
            const float u = static_cast<float>(random.uniform(0.0, 1.0)),
                        v = static_cast<float>(random.uniform(0.0, 1.0));
            REQUIRE(at(image, u, v) == constant);
            for (float& texel : image.values()) texel = static_cast<float>(random.uniform(-3.0, 40.0));
            const auto [lo, hi] = std::minmax_element(image.values().begin(), image.values().end());
            const float value = at(image, u, v);
            REQUIRE(value >= *lo - 1e-5f);
            REQUIRE(value <= *hi);
        }
        for (float other : {kNan, kInfinity}) {
            Image<float> image(2, 2);
            image.fill(other), image.at(0, 0) = 3.5f;
            CHECK(at(image, 0.25f, 0.25f) == 3.5f);
            const float mixed = at(image, 0.5f, 0.5f);
            CHECK(std::isnan(mixed) == std::isnan(other));
            CHECK(std::isinf(mixed) == std::isinf(other));
        }
    }
}

TEST_CASE("TexelsAreThoseOfTheFormat") {
    Image<float> image(2, 1);
    image.at(0, 0) = 0.3f, image.at(1, 0) = 1.7f;
    const auto texel = [&](int i, TexelFormat format) {
        return sampled<float>(TextureView(image), i == 0 ? 0.25f : 0.75f, 0.5f,
                              settingsOf(Wrap::clamp, Filter::nearest, format));
    };
    CHECK(texel(0, TexelFormat::float32) == 0.3f);
    CHECK(texel(0, TexelFormat::float16) == floatOfHalf(0x34cc));
    CHECK(texel(0, TexelFormat::unorm8) == floatOfCode(uint8_t{76}));  // 76.5 but for what is cut
    CHECK(texel(0, TexelFormat::unorm16) == floatOfCode(uint16_t{19660}));
    CHECK(texel(1, TexelFormat::float32) == 1.7f);
    CHECK(texel(1, TexelFormat::unorm8) == 1);
    // Cube maps read them too.
    CubeMap<float> cube(4, 3);
    for (Image<float>& face : cube.faces) face.fill(0.3f);
    CubeFaceKernel<float> kernel;
    for (Filter filter : {Filter::nearest, Filter::bilinear}) {
        const auto sampling =
            samplingOf<CubeFaceKernel<float>>(settingsOf(Wrap::clamp, filter, TexelFormat::unorm8), 4, 4);
        CHECK(kernel.sampleCubeRgb(TextureView(cube), glm::vec3(0.3f, 0.9f, -1.0f), sampling).y ==
              floatOfCode(uint8_t{76}));
    }
}

TEST_CASE("FilterRulesThatDoNotGoTogetherAreFaults") {
    CHECK(filterFault({}, kExactFraction, 2).field.empty());
    CHECK(filterFault(kUnit, 8, 24).field.empty());
    CHECK(filterFault(kUnit, 7, 24).field == "filter_position");
    CHECK(filterFault(kUnit, kExactFraction, 24).field == "filter_weights");
    CHECK(filterFault(kUnit, 9, 24).field == "filter_weights");
    CHECK(filterFault(kUnit, 8, 23).field == "filter_position");
    FilterRule rule;
    rule.sum = FilterSum::fixedFunction;
    CHECK(filterFault(rule, 8, 24).field == "filter_sum");
    rule.weights = FilterWeights::bits8;
    CHECK(filterFault(rule, 4, 24).field.empty());
    CHECK(filterFault(rule, 4, 17).field == "filter_sum");
    rule.sum = FilterSum::arithmetic;
    CHECK(filterFault(rule, 4, 11).field.empty());
}

// ---- words of the hardware

namespace {

// The tables of tests/raster/h100_units.bin, by number: rows of words.
using Rows = std::vector<std::vector<uint32_t>>;
std::vector<Rows> recordings() {
    std::ifstream file("tests/raster/h100_units.bin", std::ios::binary);
    std::vector<Rows> tables;
    const auto word = [&] {
        std::array<unsigned char, 4> bytes{};
        file.read(reinterpret_cast<char*>(bytes.data()), 4);
        return uint32_t{bytes[0]} | uint32_t{bytes[1]} << 8 | uint32_t{bytes[2]} << 16 |
               uint32_t{bytes[3]} << 24;
    };
    while (file.peek() != std::ifstream::traits_type::eof()) {
        REQUIRE(word() == tables.size());
        const uint32_t rows = word(), columns = word();
        Rows table(rows, std::vector<uint32_t>(columns));
        for (auto& row : table)
            for (uint32_t& value : row) value = word();
        tables.push_back(std::move(table));
    }
    REQUIRE(tables.size() == 8);
    return tables;
}
float floatOf(uint32_t word) { return std::bit_cast<float>(word); }
uint32_t wordOf(float value) { return std::bit_cast<uint32_t>(value); }
float fractionOf(uint32_t word) { return static_cast<float>(word) / 256.0f; }

// Coordinates in an image of two texels whose fraction is the word's.
float betweenTwo(uint32_t word) { return (0.5f + fractionOf(word)) / 2; }

}  // namespace

TEST_CASE_TEMPLATE("RecordedPositionsAndAddressesAreReproduced", T, float, Emulated<double>) {
    const EmulatedScope scope(kFp32Flush);
    const std::vector<Rows> tables = recordings();
    for (const auto& row : tables[0])
        REQUIRE(wordOf(sampled<T>(TextureView(numberedRow(static_cast<int>(row[0]))), floatOf(row[2]), 0.5f,
                                  settingsOf(static_cast<Wrap>(row[1]), Filter::bilinear))) == row[3]);
    for (const auto& row : tables[1]) {
        const Image<float> image = numberedRow(static_cast<int>(row[0]));
        const auto wrap = static_cast<Wrap>(row[1]);
        const auto at = [&](Filter filter) {
            return wordOf(sampled<T>(TextureView(image), floatOf(row[2]), 0.5f, settingsOf(wrap, filter)));
        };
        REQUIRE(at(Filter::nearest) == row[3]);
        REQUIRE(at(Filter::bilinear) == row[4]);
    }
}

TEST_CASE_TEMPLATE("RecordedBilinearSamplesAreReproduced", T, float, Emulated<double>) {
    const EmulatedScope scope(kFp32Flush);
    const std::vector<Rows> tables = recordings();
    const auto at = [](const std::array<float, 4>& texels, uint32_t x, uint32_t y, TexelFormat format) {
        Image<float> image(2, 2);
        std::copy(texels.begin(), texels.end(), image.values().begin());
        return wordOf(sampled<T>(TextureView(image), betweenTwo(x), betweenTwo(y),
                                 settingsOf(Wrap::clamp, Filter::bilinear, format)));
    };
    for (const auto& row : tables[2])
        for (size_t k = 0; k < 4; k++) {
            std::array<float, 4> texels{};
            texels[k] = 1;
            REQUIRE(at(texels, row[0], row[1], TexelFormat::float32) == row[2 + k]);
        }
    for (const auto& row : tables[3]) {
        const auto format = static_cast<TexelFormat>(row[0]);
        std::array<float, 4> texels{};
        for (size_t k = 0; k < 4; k++) {
            const uint32_t code = row[3 + k];
            texels[k] = format == TexelFormat::float32   ? floatOf(code)
                        : format == TexelFormat::float16 ? floatOfHalf(static_cast<uint16_t>(code))
                        : format == TexelFormat::unorm16 ? floatOfCode(static_cast<uint16_t>(code))
                                                         : floatOfCode(static_cast<uint8_t>(code));
        }
        REQUIRE(at(texels, row[1], row[2], format) == row[7]);
    }
}

// A comparison gives 1 or 0, which are weighted: one texel of four is lit.
TEST_CASE("RecordedComparisonsAreReproduced") {
    TapWeightTexts<float> kernel;
    const std::vector<Rows> tables = recordings();
    for (const auto& row : tables[4])
        for (size_t k = 0; k < 4; k++) {
            std::array<float, 4> lit{};
            lit[k] = 1;
            REQUIRE(wordOf(kernel.weightedSum(lit[0], lit[1], lit[2], lit[3],
                                              kernel.tapWeights(fractionOf(row[1]), fractionOf(row[2])))) ==
                    row[3 + k]);
        }
}

TEST_CASE("RecordedWritesAreReproduced") {
    TextureUnitTexts<double> texts;
    const std::vector<Rows> tables = recordings();
    const auto unorm = [&](float x, uint32_t bits) {
        return static_cast<uint32_t>(texts.unormCode(x, std::ldexp(1.0, static_cast<int>(bits)) - 1,
                                                     std::ldexp(1.0, static_cast<int>(bits) + 4)));
    };
    const auto depth = [](float x, DepthFormat format) {
        return static_cast<uint32_t>(
            storedDepth(format, DepthRounding::fixedFunction, Lanes<float, 1>(x))[0]);
    };
    // Offsets in codes from k + 1/2 of the first input that writes k + 1, to within a float or a thousandth.
    constexpr double kGrid = 0.001;
    for (const auto& row : tables[5]) {
        const uint32_t kind = row[0], bits = kind & 31;
        const double levels = std::ldexp(1.0, static_cast<int>(bits)) - 1;
        const auto codeOf = [&](double offset, float towards) {
            const auto x = std::nextafter(static_cast<float>((row[1] + 0.5 + offset) / levels), towards);
            return kind == 48   ? depth(x, DepthFormat::d16)
                   : kind == 56 ? depth(x, DepthFormat::d24)
                                : unorm(x, bits);
        };
        CAPTURE(kind);
        CAPTURE(row[1]);
        CHECK(codeOf(floatOf(row[2]) + kGrid, 2.0f) == row[1] + 1);
        CHECK(codeOf(floatOf(row[2]) - kGrid, 0.0f) == row[1]);
    }
    for (const auto& row : tables[6]) REQUIRE(depth(floatOf(row[0]), DepthFormat::d24) == row[1]);
    for (const auto& row : tables[7]) {
        const uint32_t kind = row[0];
        const float x = floatOf(row[1]);
        if (kind == 0) {
            REQUIRE(wordOf(static_cast<float>(texts.halfWritten(x))) ==
                    wordOf(floatOfHalf(static_cast<uint16_t>(row[2]))));
            continue;
        }
        const bool isSigned = kind > 128;
        const uint32_t bits = kind & 127, mask = (1u << bits) - 1;
        const uint32_t code = isSigned ? unorm(std::fabs(x), bits - 1) : unorm(x, bits);
        REQUIRE((isSigned && x < 0 ? (0 - code) & mask : code) == row[2]);
    }
}

}  // namespace etalon
