#include "numeric/rounded.h"

#include <doctest/doctest.h>
#include <mpfr.h>

#include <array>
#include <atomic>
#include <bit>
#include <cmath>
#include <limits>
#include <mutex>
#include <string_view>

#include "numeric/parallel.h"
#include "tests/numeric/format_cases.h"
#include "tests/numeric/mpfr_reference.h"

using namespace etalon;
using namespace etalon::test;

namespace {

constexpr size_t kBlock = 4096;
constexpr int kWidth = 8;

// Formats that no profile names: other corners of what Format can say.
constexpr Format kNarrowNearestFlushSaturate{
    9, -20, 20, Rounding::nearestEven, Subnormals::flush, Overflow::saturate};
constexpr Format kTinyTruncateKeepSaturate{
    4, -6, 8, Rounding::towardZero, Subnormals::keep, Overflow::saturate};
constexpr Format kOddTruncateFlushInfinity{
    13, -40, 33, Rounding::towardZero, Subnormals::flush, Overflow::infinity};

// The operations: `of` is what is tested, `reference` says what MPFR does instead.
struct Sum {
    static constexpr const char* kName = "+";
    template <class R>
    static R of(R a, R b) {
        return a + b;
    }
    static double reference(Reference& m) { return m.binary(mpfr_add); }
};
struct Difference {
    static constexpr const char* kName = "-";
    template <class R>
    static R of(R a, R b) {
        return a - b;
    }
    static double reference(Reference& m) { return m.binary(mpfr_sub); }
};
struct Product {
    static constexpr const char* kName = "*";
    template <class R>
    static R of(R a, R b) {
        return a * b;
    }
    static double reference(Reference& m) { return m.binary(mpfr_mul); }
};
struct Quotient {
    static constexpr const char* kName = "/";
    template <class R>
    static R of(R a, R b) {
        return a / b;
    }
    static double reference(Reference& m) { return m.binary(mpfr_div); }
};
struct Root {
    static constexpr const char* kName = "sqrt";
    template <class R>
    static R of(R a, R) {
        return squareRoot(a);
    }
    static double reference(Reference& m) { return m.root(); }
};
// Addition as it must not be done toward zero: rounded to nearest in double, then truncated.
struct NaiveSum {
    template <Format F, class D>
    static Rounded<F, D> of(Rounded<F, D> a, Rounded<F, D> b) {
        return Rounded<F, D>::ofRepresentable(roundTo<F>(a.v + b.v));
    }
    static double reference(Reference& m) { return m.binary(mpfr_add); }
};

struct Tally {
    size_t mismatches = 0;       // lanes against MPFR
    size_t laneDifferences = 0;  // lanes against scalar
};

using Block = std::array<double, kBlock>;

template <Format F, class Operation>
Tally countBlock(const Block& a, const Block& b, Reference& reference) {
    using Scalar = Rounded<F>;
    using L = Lanes<double, kWidth>;
    using Vector = Rounded<F, L>;
    Block result;
    for (size_t i = 0; i < kBlock; i += kWidth) {
        const auto x = Vector::ofRepresentable(L::load(&a[i])), y = Vector::ofRepresentable(L::load(&b[i]));
        Operation::of(x, y).v.store(&result[i]);
    }
    Tally tally;
    for (size_t i = 0; i < kBlock; i++) {
        reference.setOperands(a[i], b[i]);
        tally.mismatches += !agree(result[i], Operation::reference(reference));
        const Scalar scalar = Operation::of(Scalar::ofRepresentable(a[i]), Scalar::ofRepresentable(b[i]));
        tally.laneDifferences += !sameBits(scalar.v, result[i]);
    }
    return tally;
}

// Counts the differences for `cases` pairs and each of the operations, the same pairs for all.
template <Format F, class... Operations>
std::array<Tally, sizeof...(Operations)> countDifferences(size_t cases) {
    constexpr size_t kOperations = sizeof...(Operations);
    std::array<Tally, kOperations> totals;
    std::mutex mutex;
    parallelFor(cases / kBlock, 0, [&](size_t block) {
        FormatCases generator(F, block);
        Block a, b;
        for (size_t i = 0; i < kBlock; i++) {
            const auto [first, second] = generator.pair();
            a[i] = first;
            b[i] = second;
        }
        Reference reference(F);
        const std::array<Tally, kOperations> tallies{countBlock<F, Operations>(a, b, reference)...};
        const std::lock_guard lock(mutex);
        for (size_t i = 0; i < kOperations; i++) {
            totals[i].mismatches += tallies[i].mismatches;
            totals[i].laneDifferences += tallies[i].laneDifferences;
        }
    });
    return totals;
}

template <Format F>
void checkAllOperations(std::string_view name, size_t cases) {
    const auto tallies = countDifferences<F, Sum, Difference, Product, Quotient, Root>(cases);
    const char* operations[] = {Sum::kName, Difference::kName, Product::kName, Quotient::kName, Root::kName};
    for (size_t i = 0; i < tallies.size(); i++) {
        CAPTURE(name);
        CAPTURE(operations[i]);
        CHECK(tallies[i].mismatches == 0);
        CHECK(tallies[i].laneDifferences == 0);
    }
}

}  // namespace

TEST_CASE("OperationsEqualMpfrInEveryNamedFormatAndLanesEqualScalar") {
    REQUIRE(mpfr_buildopt_tls_p() != 0);
    forEachNamedFormat([]<Format F>(std::string_view name) { checkAllOperations<F>(name, kCases); });
}

TEST_CASE("OperationsEqualMpfrInFormatsThatNoProfileNames") {
    checkAllOperations<kNarrowNearestFlushSaturate>("narrow, nearest, flush, saturate", kCases / 8);
    checkAllOperations<kTinyTruncateKeepSaturate>("tiny, toward zero, keep, saturate", kCases / 8);
    checkAllOperations<kOddTruncateFlushInfinity>("toward zero, flush, infinity", kCases / 8);
}

TEST_CASE("ConversionOfAnyDoubleRoundsOnceInEveryNamedFormat") {
    forEachNamedFormat([]<Format F>(std::string_view name) {
        std::atomic<size_t> mismatches = 0;
        parallelFor(kCases / kBlock, 0, [&](size_t block) {
            FormatCases generator(F, block);
            Reference reference(F);
            size_t found = 0;
            for (size_t i = 0; i < kBlock; i++) {
                const double x = generator.anyDouble();
                found += !agree(Rounded<F>(x).v, reference.converted(x));
            }
            mismatches += found;
        });
        CAPTURE(name);
        CHECK(mismatches == 0);
    });
}

TEST_CASE("NaiveTruncationOfADoubleSumIsFoundWrong") {
    CHECK(countDifferences<kFp24R300, NaiveSum>(kCases)[0].mismatches > 0);
    CHECK(countDifferences<kFp32TowardZero, NaiveSum>(kCases)[0].mismatches > 0);
    CHECK(countDifferences<kFp16TowardZero, NaiveSum>(kCases)[0].mismatches ==
          0);  // 11-bit sums fit in 53 bits
}

TEST_CASE("Fp32EqualsNativeFloatBitForBit") {
    FormatCases generator(kFp32, 1);
    size_t mismatches = 0;
    const auto compare = [&](Rounded<kFp32> r, float expected) {
        if (std::isnan(expected))
            mismatches += !std::isnan(r.v);
        else
            mismatches +=
                std::bit_cast<int32_t>(static_cast<float>(r.v)) != std::bit_cast<int32_t>(expected) ||
                !sameBits(r.v, static_cast<double>(expected));
    };
    for (size_t i = 0; i < kCases; i++) {
        const auto [a, b] = generator.pair();
        const float x = static_cast<float>(a), y = static_cast<float>(b);
        const auto rx = Rounded<kFp32>::ofRepresentable(a), ry = Rounded<kFp32>::ofRepresentable(b);
        compare(rx + ry, x + y);
        compare(rx - ry, x - y);
        compare(rx * ry, x * y);
        compare(rx / ry, x / y);
        compare(squareRoot(rx), squareRoot(x));
        compare(floorOf(rx), floorOf(x));
        compare(-rx, -x);
        const double any = generator.anyDouble();
        compare(Rounded<kFp32>(any), static_cast<float>(any));
        mismatches += (rx < ry) != (x < y) || (rx <= ry) != (x <= y) || (rx == ry) != (x == y);
        mismatches += (rx > ry) != (x > y) || (rx >= ry) != (x >= y) || (rx != ry) != (x != y);
    }
    CHECK(mismatches == 0);
}

TEST_CASE("ResultsWithoutAValueAreDefined") {
    const double infinity = std::numeric_limits<double>::infinity();
    using Half = Rounded<kFp16>;
    using Old = Rounded<kFp24R300>;
    CHECK(sameBits((Half(0.0) / Half(0.0)).v, kCanonicalNan));
    CHECK(sameBits(squareRoot(Half(-1.0)).v, kCanonicalNan));
    CHECK((Half(1.0) / Half(-0.0)).v == -infinity);
    CHECK(Half(65520.0).v == infinity);  // halfway to 2^16
    CHECK(Half(65519.0).v == 65504.0);
    CHECK(Rounded<kFp16TowardZero>(1e9).v == 65504.0);
    CHECK(Rounded<kFp16TowardZero>(infinity).v == infinity);
    CHECK(sameBits((Old(0.0) / Old(0.0)).v, 0.0));
    CHECK(sameBits(squareRoot(Old(-1.0)).v, 0.0));
    CHECK(sameBits(Old(-infinity / infinity).v, 0.0));
    CHECK((Old(-1.0) / Old(0.0)).v == -largestFinite(kFp24R300));
    CHECK(Old(infinity).v == largestFinite(kFp24R300));
    CHECK(sameBits(Old(-0x1.fffp-63).v, -0.0));
    CHECK(sameBits(Rounded<kFp32Flush>(-0x1p-127).v, -0.0));
    CHECK(Rounded<kFp32Flush>(0x1.ffffffp-127).v == 0x1p-126);  // rounds up to a normal number: not flushed
}

TEST_CASE("IntegersConvertByTruncationAndOneRounding") {
    using L = Lanes<double, 4>;
    using R = Rounded<kFp16, L>;
    const R x(L::generate([](int i) { return 1.5 * i - 2.0; }));  // -2, -0.5, 1, 2.5
    const Lanes<int32_t, 4> whole = toInteger(x);
    const int expected[] = {-2, 0, 1, 2};
    for (int i = 0; i < 4; i++) {
        CHECK(whole[i] == expected[i]);
        CHECK(FromInteger<R>::of(whole).v[i] == expected[i]);
        CHECK(toInteger(Rounded<kFp16>(x.v[i])) == expected[i]);
    }
    CHECK(FromInteger<Rounded<kFp16>>::of(2049).v == 2048.0);
    CHECK(FromInteger<Rounded<kFp16>>::of(2051).v == 2052.0);
    CHECK(FromInteger<Rounded<kFp16TowardZero>>::of(2051).v == 2050.0);
}
