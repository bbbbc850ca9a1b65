// Emulated numbers, whose format is a value, against Rounded, whose format is a type, and against MPFR.
#include "numeric/emulated.h"

#include <doctest/doctest.h>
#include <mpfr.h>

#include <array>
#include <atomic>
#include <cmath>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "numeric/arithmetic.h"
#include "numeric/parallel.h"
#include "tests/numeric/format_cases.h"
#include "tests/numeric/mpfr_reference.h"

using namespace etalon;
using namespace etalon::test;

namespace {

constexpr size_t kBlock = 4096;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct Block {
    std::array<double, kBlock> a, b;

    Block(Format format, uint64_t seed) {
        FormatCases generator(format, seed);
        for (size_t i = 0; i < kBlock; i++) {
            const auto [first, second] = generator.pair();
            a[i] = first;
            b[i] = second;
        }
    }
};

// The operations that every number type has, as functions of two numbers.
struct Sum {
    template <class R>
    static R of(R a, R b) {
        return a + b;
    }
};
struct Difference {
    template <class R>
    static R of(R a, R b) {
        return a - b;
    }
};
struct Product {
    template <class R>
    static R of(R a, R b) {
        return a * b;
    }
};
struct Quotient {
    template <class R>
    static R of(R a, R b) {
        return a / b;
    }
};
struct Root {
    template <class R>
    static R of(R a, R) {
        return squareRoot(a);
    }
};
struct Negative {
    template <class R>
    static R of(R a, R) {
        return -a;
    }
};
struct Whole {
    template <class R>
    static R of(R a, R) {
        return floorOf(a);
    }
};
// Every comparison decides somewhere.
struct Selection {
    template <class R>
    static R of(R a, R b) {
        const R lower = select(a < b, a, b), upper = select(a >= b, a, b);
        const R one = select(a == b, R(1.0), R(0.0)), other = select(a != b, R(1.0), -R(1.0));
        return select(lower <= upper, select(a > -b, lower, one), select(a <= b, upper, other));
    }
};
// Through an integer, for values inside int32.
struct ThroughInteger {
    template <class R>
    static R of(R a, R b) {
        const auto isInside = a > R(-1e9) && a < R(1e9);
        return FromInteger<R>::of(toInteger(select(isInside, a, select(b < R(0.0), R(-7.0), R(0.0)))));
    }
};
struct PowerOf {
    template <class R>
    static R of(R a, R b) {
        return powOf(a, b);
    }
};
struct Angle {
    template <class R>
    static R of(R a, R b) {
        return atan2Of(a, b);
    }
};
struct Sine {
    template <class R>
    static R of(R a, R) {
        return ElementaryFunctions<R>::sinOf(a);
    }
};
struct Cosine {
    template <class R>
    static R of(R a, R) {
        return ElementaryFunctions<R>::cosOf(a);
    }
};

template <class Operation, int N>
void computeLanes(const Block& block, std::array<double, kBlock>& results) {
    using L = Lanes<double, N>;
    using E = Emulated<L>;
    for (size_t i = 0; i < kBlock; i += N)
        Operation::of(E::ofRepresentable(L::load(&block.a[i])), E::ofRepresentable(L::load(&block.b[i])))
            .v.store(&results[i]);
}
template <class Operation>
void computeScalars(const Block& block, std::array<double, kBlock>& results) {
    using E = Emulated<double>;
    for (size_t i = 0; i < kBlock; i++)
        results[i] = Operation::of(E::ofRepresentable(block.a[i]), E::ofRepresentable(block.b[i])).v;
}

// Results that differ in bits: as lanes of several widths and one at a time.
template <class Operation>
size_t countDifferences(const Block& block, const std::array<double, kBlock>& expected) {
    std::array<double, kBlock> results;
    size_t differences = 0;
    const auto compare = [&] {
        for (size_t i = 0; i < kBlock; i++) differences += !sameBits(results[i], expected[i]);
    };
    computeScalars<Operation>(block, results);
    compare();
    computeLanes<Operation, 1>(block, results);
    compare();
    computeLanes<Operation, 4>(block, results);
    compare();
    computeLanes<Operation, 8>(block, results);
    compare();
    return differences;
}
template <Format F, class Operation>
size_t differencesFromRounded(const Block& block) {
    using R = Rounded<F>;
    std::array<double, kBlock> expected;
    for (size_t i = 0; i < kBlock; i++)
        expected[i] = Operation::of(R::ofRepresentable(block.a[i]), R::ofRepresentable(block.b[i])).v;
    return countDifferences<Operation>(block, expected);
}
template <Format F, class... Operations>
void checkAgainstRounded(std::string_view name, size_t cases) {
    std::array<std::atomic<size_t>, sizeof...(Operations)> differences{};
    const EmulatedScope scope(F);
    parallelFor(cases / kBlock, 0, [&](size_t index) {
        const Block block(F, index);
        size_t operation = 0;
        ((differences[operation++] += differencesFromRounded<F, Operations>(block)), ...);
    });
    for (size_t i = 0; i < differences.size(); i++) {
        CAPTURE(name);
        CAPTURE(i);  // of the operations named by the caller
        CHECK(differences[i] == 0);
    }
}

// Formats of every number of significand bits, with exponents of several ranges.
std::vector<Format> manyFormats(std::initializer_list<Rounding> roundings) {
    std::vector<Format> formats;
    for (int bits = 2; bits <= kMaxSignificandBits; bits++) {
        const int ranges[][2] = {
            {0, bits - 1}, {-14, 25}, {-126, 127}, {-400, 400}, {-3 * bits, 2 * bits + 7}};
        for (const auto& [lowest, highest] : ranges)
            for (const Rounding rounding : roundings)
                for (const Subnormals subnormals : {Subnormals::keep, Subnormals::flush})
                    for (const Overflow overflow : {Overflow::infinity, Overflow::saturate})
                        formats.push_back({bits, lowest, highest, rounding, subnormals, overflow});
    }
    return formats;
}

// Differences of a block from MPFR's two answers, over lanes.
template <class Operation, class ByMpfr>
size_t differencesFromMpfr(Format format, const Block& block, ByMpfr&& byMpfr) {
    std::array<double, kBlock> results;
    computeLanes<Operation, 4>(block, results);
    size_t differences = 0;
    const auto compare = [&](auto&& reference) {
        for (size_t i = 0; i < kBlock; i++) {
            reference.setOperands(block.a[i], block.b[i]);
            differences += !agree(results[i], byMpfr(reference));
        }
    };
    compare(ExactReference(format));
    if (Reference::has(format.rounding)) compare(Reference(format));
    return differences;
}

}  // namespace

TEST_CASE("EmulatedNumbersHaveTheBitsOfRoundedInEveryNamedFormat") {
    forEachNamedFormat([]<Format F>(std::string_view name) {
        checkAgainstRounded<F, Sum, Difference, Product, Quotient, Root, Negative, Whole, Selection,
                            ThroughInteger>(name, kCases / 4);
        checkAgainstRounded<F, PowerOf, Angle, Sine, Cosine>(name, kCases / 32);
    });
}

TEST_CASE("ConversionsHaveTheBitsOfRoundedInEveryNamedFormat") {
    forEachNamedFormat([]<Format F>(std::string_view name) {
        const EmulatedScope scope(F);
        FormatCases generator(F, 17);
        using L = Lanes<double, 8>;
        size_t differences = 0;
        for (size_t i = 0; i < kCases / 16; i += L::size) {
            const L x = L::generate([&](int) { return generator.anyDouble(); });
            const Emulated<L> lanes(x);
            for (int k = 0; k < L::size; k++) {
                const double expected = Rounded<F>(x[k]).v;
                differences += !sameBits(lanes.v[k], expected) +
                               !sameBits(Emulated<double>(x[k]).v, expected) +
                               !sameBits(Emulated<L>(x[k]).v[7 - k], expected);
            }
        }
        CAPTURE(name);
        CHECK(differences == 0);
    });
}

TEST_CASE("OperationsEqualMpfrForEveryRoundingSubnormalsAndOverflow") {
    REQUIRE(mpfr_buildopt_tls_p() != 0);
    const std::vector<Format> formats = manyFormats(
        {Rounding::nearestEven, Rounding::nearestAway, Rounding::towardZero, Rounding::up, Rounding::down});
    // Some blocks for every format in an optimised build, for every 32nd elsewhere.
    const size_t stride = kCases < (size_t{1} << 20) ? 32 : 1;
    std::vector<size_t> differences(formats.size());
    parallelFor(formats.size() / stride, 0, [&](size_t index) {
        index *= stride;
        const Format format = formats[index];
        REQUIRE(isSupported(format));
        const EmulatedScope scope(format);
        const Block block(format, index);
        differences[index] =
            differencesFromMpfr<Sum>(format, block, [](auto& m) { return m.binary(mpfr_add); }) +
            differencesFromMpfr<Difference>(format, block, [](auto& m) { return m.binary(mpfr_sub); }) +
            differencesFromMpfr<Product>(format, block, [](auto& m) { return m.binary(mpfr_mul); }) +
            differencesFromMpfr<Quotient>(format, block, [](auto& m) { return m.binary(mpfr_div); }) +
            differencesFromMpfr<Root>(format, block, [](auto& m) { return m.root(); });
        FormatCases generator(format, index);
        ExactReference exact(format);
        for (size_t i = 0; i < kBlock; i++) {
            const double x = generator.anyDouble();
            differences[index] += !agree(Emulated<double>(x).v, exact.converted(x));
        }
    });
    for (size_t i = 0; i < formats.size(); i++) {
        CAPTURE(arithmeticName(Arithmetic(formats[i])));
        CHECK(differences[i] == 0);
    }
}

TEST_CASE("DirectedRoundingsKeepExactResultsSignsAndTheSideOfOverflow") {
    using E = Emulated<double>;
    constexpr double kLargest = largestFinite(kFp16);
    const auto formatOf = [](Rounding rounding, Overflow overflow = Overflow::infinity) {
        return Format{11, -14, 15, rounding, Subnormals::keep, overflow};
    };
    struct Row {
        Rounding rounding;
        double aboveRange, belowRange;  // what +-65536 becomes
        double difference;              // 1 - 1
        double tie, negativeTie;        // +-(1 + 2^-11)
        double tiny, negativeTiny;      // +-2^-25, half of the smallest number
    };
    constexpr double kNext = 1.0 + 0x1p-10;
    const Row rows[] = {
        {Rounding::nearestEven, kInfinity, -kInfinity, 0.0, 1.0, -1.0, 0.0, -0.0},
        {Rounding::nearestAway, kInfinity, -kInfinity, 0.0, kNext, -kNext, 0x1p-24, -0x1p-24},
        {Rounding::towardZero, kLargest, -kLargest, 0.0, 1.0, -1.0, 0.0, -0.0},
        {Rounding::up, kInfinity, -kLargest, 0.0, kNext, -1.0, 0x1p-24, -0.0},
        {Rounding::down, kLargest, -kInfinity, -0.0, 1.0, -kNext, 0.0, -0x1p-24},
    };
    for (const Row& row : rows) {
        CAPTURE(static_cast<int>(row.rounding));
        const EmulatedScope scope(formatOf(row.rounding));
        CHECK(sameBits((E(256.0) * E(256.0)).v, row.aboveRange));
        CHECK(sameBits((E(-256.0) * E(256.0)).v, row.belowRange));
        CHECK(sameBits((E(1.0) - E(1.0)).v, row.difference));
        CHECK(sameBits((E(-1.0) + E(1.0)).v, row.difference));
        CHECK(sameBits((E(0.0) + E(0.0)).v, 0.0));
        CHECK(sameBits((E(-0.0) - E(0.0)).v, -0.0));
        CHECK(sameBits((E(-0.0) + E(0.0)).v, row.difference));
        CHECK(sameBits((E(1.0) + E(0x1p-11)).v, row.tie));
        CHECK(sameBits((E(-1.0) - E(0x1p-11)).v, row.negativeTie));
        CHECK(sameBits((E(0x1p-24) * E(0.5)).v, row.tiny));
        CHECK(sameBits((E(0x1p-24) * E(-0.5)).v, row.negativeTiny));
        CHECK(sameBits((E(0.0) * E(-1.0)).v, -0.0));
        CHECK(sameBits((E(0.0) / E(0.0)).v, kCanonicalNan));
        CHECK(sameBits(squareRoot(E(-0.0)).v, -0.0));
        CHECK(sameBits(squareRoot(E(-1.0)).v, kCanonicalNan));
        CHECK(E(kInfinity).v == kInfinity);
        CHECK((E(1.0) / E(-0.0)).v == -kInfinity);
        const EmulatedScope saturated(formatOf(row.rounding, Overflow::saturate));
        CHECK((E(256.0) * E(256.0)).v == kLargest);
        CHECK((E(-1.0) / E(0.0)).v == -kLargest);
        CHECK(sameBits((E(0.0) / E(0.0)).v, 0.0));
    }
}

TEST_CASE("ScopesOfFormatsNestAndRestore") {
    using E = Emulated<double>;
    const double third = 1.0 / 3.0;
    const auto inFloat = static_cast<double>(static_cast<float>(third));
    CHECK(E(third).v == inFloat);
    {
        const EmulatedScope half(kFp16);
        CHECK(E(third).v == Rounded<kFp16>(third).v);
        {
            const EmulatedScope brain(kBf16);
            CHECK(E(third).v == Rounded<kBf16>(third).v);
        }
        CHECK(E(third).v == Rounded<kFp16>(third).v);
        const auto fail = [] {
            const EmulatedScope old(kFp24R300);
            throw 1;
        };
        CHECK_THROWS(fail());
        CHECK(E(third).v == Rounded<kFp16>(third).v);
        // What was kept of a format is entered again elsewhere.
        const KeptFormat<E> kept;
        const EmulatedScope brain(kBf16);
        const auto scope = kept.enter();
        CHECK(E(third).v == Rounded<kFp16>(third).v);
    }
    CHECK(E(third).v == inFloat);
}

TEST_CASE("ThreadsComputeInTheFormatOfTheirCaller") {
    const double third = 1.0 / 3.0;
    for (const int threads : {1, 2, 5}) {
        const auto check = [&](Format format, double expected) {
            const EmulatedScope scope(format);
            std::atomic<int> differences = 0;
            parallelFor(256, threads, [&](size_t item) {
                differences += Emulated<double>(third).v != expected;
                // An item's own format ends with it.
                if (item % 3 == 0) {
                    const EmulatedScope own(kBf16);
                    differences += Emulated<double>(third).v != Rounded<kBf16>(third).v;
                }
                // Threads that a thread starts.
                if (item % 64 == 0)
                    parallelFor(4, 2, [&](size_t) { differences += Emulated<double>(third).v != expected; });
            });
            CAPTURE(threads);
            CHECK(differences == 0);
        };
        check(kFp16, Rounded<kFp16>(third).v);
        check(kFp24R300, Rounded<kFp24R300>(third).v);
        check(kFp32, Rounded<kFp32>(third).v);
    }
}

TEST_CASE("DivisionByReciprocalRoundsEachStepOnce") {
    const std::vector<Format> formats = manyFormats(
        {Rounding::nearestEven, Rounding::nearestAway, Rounding::towardZero, Rounding::up, Rounding::down});
    const size_t stride = kCases < (size_t{1} << 20) ? 64 : 4;
    std::vector<size_t> differences(formats.size());
    parallelFor(formats.size() / stride, 0, [&](size_t index) {
        index *= stride;
        Format format = formats[index];
        format.division = Division::reciprocal;
        const EmulatedScope scope(format);
        const Block block(format, index);
        ExactReference exact(format);
        const auto reciprocal = [&](double a) {
            exact.setOperands(1.0, a);
            return exact.binary(mpfr_div);
        };
        std::array<double, kBlock> quotients, roots;
        for (size_t i = 0; i < kBlock; i++) {
            const double a = block.a[i], inverse = reciprocal(block.b[i]);
            exact.setOperands(a, inverse);
            quotients[i] = exact.binary(mpfr_mul);
            exact.setOperands(a, 0.0);
            // MPFR gives +infinity for -0.
            roots[i] = reciprocal(a == 0.0 ? reciprocal(a) : exact.unary(mpfr_rec_sqrt));
        }
        differences[index] =
            countDifferences<Quotient>(block, quotients) + countDifferences<Root>(block, roots);
    });
    for (size_t i = 0; i < formats.size(); i++) {
        CAPTURE(arithmeticName(Arithmetic(formats[i])));
        CHECK(differences[i] == 0);
    }
    // It shows: 9 / 3 in 17 bits that are cut off is one step below 3.
    Format old = kFp24R300;
    old.division = Division::reciprocal;
    using E = Emulated<double>;
    const EmulatedScope scope(old);
    CHECK((E(9.0) / E(3.0)).v == 3.0 - 0x1p-15);
    CHECK(squareRoot(E(0.0)).v == 0.0);
    CHECK((E(1.0) / E(0.0)).v == largestFinite(old));
}

TEST_CASE("PowersInStepsRoundEachStepOnce") {
    constexpr Format kFormats[] = {
        kFp16, kBf16, kFp24R300, {14, -30, 31, Rounding::nearestAway, Subnormals::keep, Overflow::infinity}};
    for (Format format : kFormats) {
        // What a value in double is rounded to is that of MPFR's unless the two lie on different sides of a bound: with
        // so few bits, not in so many cases. Truncation has its bounds where results near 1 lie.
        format.rounding = format.rounding == Rounding::towardZero ? Rounding::nearestEven : format.rounding;
        format.power = Power::exp2log2;
        const EmulatedScope scope(format);
        ExactReference exact(format);
        size_t differences = 0;
        for (size_t index = 0; index < kCases / 32 / kBlock; index++) {
            const Block block(format, index);
            std::array<double, kBlock> expected;
            for (size_t i = 0; i < kBlock; i++) {
                exact.setOperands(block.a[i], 0.0);
                const double logarithm = block.a[i] == 0.0 && format.overflow == Overflow::saturate
                                             ? -largestFinite(format)
                                             : exact.unary(mpfr_log2);
                exact.setOperands(block.b[i], logarithm);
                const double exponent = exact.binary(mpfr_mul);
                exact.setOperands(exponent, 0.0);
                expected[i] = exact.unary(mpfr_exp2);
            }
            differences += countDifferences<PowerOf>(block, expected);
        }
        CAPTURE(arithmeticName(Arithmetic(format)));
        CHECK(differences == 0);
    }
    // The steps show: 3^5 in 11 bits.
    Format half = kFp16;
    half.power = Power::exp2log2;
    using E = Emulated<double>;
    const EmulatedScope scope(half);
    CHECK(powOf(E(3.0), E(5.0)).v != 243.0);
    CHECK(powOf(E(2.0), E(5.0)).v == 32.0);
    CHECK(std::isnan(powOf(E(0.0), E(0.0)).v));
    CHECK(powOf(E(0.0), E(2.0)).v == 0.0);
    CHECK(std::isnan(powOf(E(-1.0), E(2.0)).v));
}
