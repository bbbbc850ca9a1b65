// The kernel texts over the number types of a level, on tables of arguments.
#include <array>
#include <bit>
#include <limits>
#include <string>
#include <utility>

#include "bitcheck/number_tables.h"
#include "numeric/door.h"
#include "numeric/lanes.h"
#include "numeric/number.h"
#include "probes/latlong.h"
#include "raster/cube_face.h"
#include "raster/sampler.h"

namespace etalon {
namespace {

using EmulatedLanes = Emulated<Native<double>>;
using NarrowLanes = Narrow<Native<float>>;

// A plane with a layer for each of f's results. f(first) returns the results of one group of lanes.
template <class T, size_t Layers, class F>
BitPlane tabulate(std::string name, size_t count, F&& f) {
    constexpr int kWidth = Number<T>::lanes;
    static_assert(kTableWidth % kWidth == 0);
    BitPlane plane{
        std::move(name),          WordKind::float64, kTableWidth, static_cast<int>(count) / kTableWidth,
        static_cast<int>(Layers), "function",        {}};
    plane.words.resize(Layers * count);
    for (size_t first = 0; first < count; first += kWidth) {
        const std::array<T, Layers> results = f(first);
        for (size_t layer = 0; layer < Layers; layer++)
            for (int i = 0; i < kWidth; i++)
                plane.words[layer * count + first + static_cast<size_t>(i)] =
                    std::bit_cast<uint64_t>(numberLane(results[layer], i));
    }
    return plane;
}

template <class T>
T load(const std::vector<double>& values, size_t first) {
    return Number<T>::generate([&](int i) { return values[first + static_cast<size_t>(i)]; });
}

template <class T>
struct Operations {
#include "numeric/kernel_scope.inc"
};

template <class T>
BitPlane arithmeticPlane(std::string name, const ArgumentTable& table) {
    using Op = Operations<T>;
    return tabulate<T, 9>(std::move(name), table.a.size(), [&](size_t first) {
        const T a = load<T>(table.a, first), b = load<T>(table.b, first);
        return std::array<T, 9>{a,
                                a + b,
                                a - b,
                                a * b,
                                a / b,
                                Op::sqrt(Op::absOf(a)),
                                Op::floor(b),
                                Op::minOf(a, b),
                                Op::clampOf(a, T(-1.0), T(1.0))};
    });
}

BitPlane emulatedPlane(Format format, std::string name, const ArgumentTable& table) {
    const EmulatedScope scope(format);
    if (Arithmetic(format).type() == NumberType::narrow)
        return arithmeticPlane<NarrowLanes>(std::move(name), table);
    return arithmeticPlane<EmulatedLanes>(std::move(name), table);
}

std::vector<BitPlane> arithmetic(const NumberTables& tables) {
    return {arithmeticPlane<Native<float>>("float", tables.plain),
            arithmeticPlane<Native<double>>("double", tables.plain),
            emulatedPlane(kFp32, "fp32", tables.special),
            emulatedPlane(kFp32Flush, "fp32-flush", tables.special),
            emulatedPlane(kFp32TowardZero, "fp32-toward-zero", tables.special),
            emulatedPlane(kFp16, "fp16", tables.special),
            emulatedPlane(kFp16TowardZero, "fp16-toward-zero", tables.special),
            emulatedPlane(kBf16, "bf16", tables.special),
            emulatedPlane(kFp24R300, "fp24-r300", tables.special)};
}

template <class T>
BitPlane elementaryPlane(std::string name, const NumberTables& tables) {
    const ArgumentTable &angles = tables.angles, &powers = tables.powers;
    return tabulate<T, 2>(std::move(name), angles.a.size(), [&](size_t first) {
        return std::array<T, 2>{atan2Of(load<T>(angles.a, first), load<T>(angles.b, first)),
                                powOf(load<T>(powers.a, first), load<T>(powers.b, first))};
    });
}

BitPlane emulatedElementaryPlane(Format format, std::string name, const NumberTables& tables) {
    const EmulatedScope scope(format);
    if (Arithmetic(format).type() == NumberType::narrow)
        return elementaryPlane<NarrowLanes>(std::move(name), tables);
    return elementaryPlane<EmulatedLanes>(std::move(name), tables);
}

std::vector<BitPlane> elementary(const NumberTables& tables) {
    return {elementaryPlane<Native<float>>("float", tables),
            elementaryPlane<Native<double>>("double", tables), emulatedElementaryPlane(kFp16, "fp16", tables),
            emulatedElementaryPlane(kBf16, "bf16", tables),
            emulatedElementaryPlane(kFp24R300, "fp24-r300", tables)};
}

constexpr std::pair<const char*, int> kFractions[] = {{"exact", kExactFraction}, {"8-bit", 8}, {"0-bit", 0}};

template <class T>
void addSampling(std::vector<BitPlane>& planes, const std::string& type, const NumberTables& tables,
                 const TextureView& image) {
    using Kernel = SamplerKernel<T>;
    for (const auto& [bitsName, bits] : kFractions) {
        const auto settings = [&, count = bits](Filter filter, Wrap x, Wrap y) {
            return samplingOf<Kernel>({filter, x, y, count}, image.width(), image.height());
        };
        planes.push_back(tabulate<T, 9>(type + "-" + bitsName, tables.texture.a.size(), [&](size_t first) {
            const T u = load<T>(tables.texture.a, first), v = load<T>(tables.texture.b, first);
            Kernel kernel;
            std::array<T, 9> results;
            size_t layer = 0;
            for (const Filter filter : {Filter::nearest, Filter::bilinear})
                for (const Wrap wrap : {Wrap::clamp, Wrap::repeat, Wrap::mirror})
                    results[layer++] = kernel.sampleReal(image, typename Kernel::integer(0), u, v,
                                                         settings(filter, wrap, wrap));
            const auto rgb = kernel.sampleRgb(image, typename Kernel::integer(0), u, v,
                                              settings(Filter::bilinear, Wrap::repeat, Wrap::mirror));
            for (int c = 0; c < 3; c++) results[layer++] = rgb[c];
            return results;
        }));
    }
}

std::vector<BitPlane> sampling(const NumberTables& tables, const TextureView& image) {
    std::vector<BitPlane> planes;
    addSampling<Native<float>>(planes, "float", tables, image);
    addSampling<Native<double>>(planes, "double", tables, image);
    {
        const EmulatedScope scope(kFp16);
        addSampling<NarrowLanes>(planes, "fp16", tables, image);
    }
    {
        const EmulatedScope scope(kFp24R300);
        addSampling<EmulatedLanes>(planes, "fp24-r300", tables, image);
    }
    return planes;
}

template <class T>
void addDirections(std::vector<BitPlane>& planes, const std::string& type, const NumberTables& tables,
                   const TextureView& cube, const TextureView& latLong) {
    using Kernel = LatLongKernel<T>;
    for (const auto& [bitsName, bits] : kFractions) {
        const auto settings = [count = bits](Filter filter, const TextureView& texture) {
            return samplingOf<Kernel>({filter, Wrap::repeat, Wrap::clamp, count}, texture.width(),
                                      texture.height());
        };
        planes.push_back(
            tabulate<T, 17>(type + "-" + bitsName, tables.directions[0].size(), [&](size_t first) {
                typename Kernel::vec3 direction;
                for (int c = 0; c < 3; c++)
                    direction[c] = load<T>(tables.directions[static_cast<size_t>(c)], first);
                Kernel kernel;
                const auto onCube = kernel.cubeCoordinates(direction);
                const auto onImage = kernel.latLongCoordinates(direction);
                std::array<T, 17> results = {Kernel::toReal(onCube.face), onCube.s, onCube.t, onImage.u,
                                             onImage.v};
                size_t layer = 5;
                for (const Filter filter : {Filter::nearest, Filter::bilinear}) {
                    const auto a = kernel.sampleCubeRgb(cube, direction, settings(filter, cube));
                    const auto b = kernel.sampleLatLong(latLong, direction, settings(filter, latLong));
                    for (int c = 0; c < 3; c++) results[layer++] = a[c];
                    for (int c = 0; c < 3; c++) results[layer++] = b[c];
                }
                return results;
            }));
    }
}

std::vector<BitPlane> cubeSampling(const NumberTables& tables, const TextureView& cube,
                                   const TextureView& latLong) {
    std::vector<BitPlane> planes;
    addDirections<Native<float>>(planes, "float", tables, cube, latLong);
    addDirections<Native<double>>(planes, "double", tables, cube, latLong);
    {
        const EmulatedScope scope(kFp16);
        addDirections<NarrowLanes>(planes, "fp16", tables, cube, latLong);
    }
    {
        const EmulatedScope scope(kFp24R300);
        addDirections<EmulatedLanes>(planes, "fp24-r300", tables, cube, latLong);
    }
    return planes;
}

// The number of a 16-bit pattern of F: a sign, 16 - p exponent bits, p - 1 fraction bits.
template <Format F>
double numberOfPattern(uint32_t pattern) {
    constexpr int kFractionBits = F.significandBits - 1;
    constexpr uint32_t kFractionMask = (1u << kFractionBits) - 1, kExponentMask = 0x7fffu >> kFractionBits;
    const uint32_t code = pattern >> kFractionBits & kExponentMask, fraction = pattern & kFractionMask;
    double magnitude = fraction * powerOfTwo(F.minExponent - kFractionBits);
    if (code == kExponentMask)
        magnitude = fraction == 0 ? std::numeric_limits<double>::infinity() : kCanonicalNan;
    else if (code != 0)
        magnitude = (1.0 + fraction * powerOfTwo(-kFractionBits)) *
                    powerOfTwo(F.minExponent + static_cast<int>(code) - 1);
    return pattern >> 15 != 0 && magnitude == magnitude ? -magnitude : magnitude;
}

// A number of the format and the middle between it and the next pattern's, and the doubles next to both: what a
// conversion may get wrong.
constexpr int kConversions = 6;
template <Format F>
double numberToConvert(uint32_t pattern, int which) {
    const double number = numberOfPattern<F>(pattern), next = numberOfPattern<F>((pattern + 1) & 0xffff);
    const double beyond = std::copysign(powerOfTwo(F.maxExponent + 1), number);
    const double middle = (number + (std::isinf(next) ? beyond : next)) / 2;
    const double start = which < kConversions / 2 ? number : middle;
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    const std::array<double, 3> values = {start, std::nextafter(start, kInfinity),
                                          std::nextafter(start, -kInfinity)};
    return values[static_cast<size_t>(which % 3)];
}

template <Format F>
size_t mismatchesOf(uint32_t first, uint32_t last, uint32_t step) {
    constexpr uint32_t kPatterns = 1u << 16;
    constexpr int kWidth = Number<NarrowLanes>::lanes;
    using R = Rounded<F, Lanes<double, kWidth>>;
    const EmulatedScope scope(F);
    size_t mismatches = 0;
    const auto compare = [&](const NarrowLanes& narrow, const R& rounded) {
        for (int i = 0; i < kWidth; i++)
            mismatches +=
                std::bit_cast<uint64_t>(numberLane(narrow, i)) != std::bit_cast<uint64_t>(rounded.v[i]);
    };
    for (uint32_t pattern = first; pattern < last; pattern += kWidth) {
        const auto values = [&](int i) { return numberOfPattern<F>(pattern + static_cast<uint32_t>(i)); };
        const auto a = Number<NarrowLanes>::generate(values);
        const auto exactA = Number<R>::generate(values);
        compare(a, exactA);
        compare(squareRoot(a), squareRoot(exactA));
        compare(floorOf(a), floorOf(exactA));
        for (int which = 0; which < kConversions; which++) {
            const auto toConvert = [&](int i) {
                return numberToConvert<F>(pattern + static_cast<uint32_t>(i), which);
            };
            compare(Number<NarrowLanes>::generate(toConvert), Number<R>::generate(toConvert));
            compare(NarrowLanes(toConvert(0)), R(toConvert(0)));
        }
        for (uint32_t other = 0; other < kPatterns; other += step) {
            const double value = numberOfPattern<F>(other);
            const NarrowLanes b(value);
            const R exactB(value);
            compare(a + b, exactA + exactB);
            compare(a - b, exactA - exactB);
            compare(a * b, exactA * exactB);
            compare(a / b, exactA / exactB);
            compare(powOf(a, b), powOf(exactA, exactB));
        }
    }
    return mismatches;
}

std::array<size_t, 2> narrowMismatches(uint32_t first, uint32_t last, uint32_t step) {
    return {mismatchesOf<kFp16>(first, last, step), mismatchesOf<kBf16>(first, last, step)};
}

}  // namespace

template <>
constexpr NumberPasses kPassesOver<NumberPasses, void> = {arithmetic, elementary, sampling, cubeSampling,
                                                          narrowMismatches};
template const NumberPasses& ETALON_LEVEL::passesOf<NumberPasses>();

}  // namespace etalon
