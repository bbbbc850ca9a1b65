#include "numeric/truth.h"

#include <doctest/doctest.h>

#include <bit>
#include <cmath>
#include <limits>
#include <type_traits>
#include <vector>

#include "numeric/parallel.h"

using namespace etalon;

TEST_CASE("TruthHoldsDoublesAndTheirSumsExactly") {
    const Truth big(0x1p100), small(0x1p-80);
    CHECK((big + small) - big == small);  // 181 bits apart
    CHECK((big + small) != big);
    CHECK((Truth(0x1p100) + Truth(0x1p-100)) == Truth(0x1p100));  // beyond 192 bits
    for (double x : {0.0, -0.0, 0.1, -3.5, 0x1p-1074, 1.7976931348623157e308})
        CHECK(std::bit_cast<int64_t>(Truth(x).toDouble()) == std::bit_cast<int64_t>(x));
}

TEST_CASE("TruthRoundsOnlyOnceToDouble") {
    const Truth third = Truth(1.0) / Truth(3.0);
    CHECK(third.toDouble() == 1.0 / 3.0);
    // A tie in double that a later bit decides.
    CHECK((Truth(1.0) + Truth(0x1p-53)).toDouble() == 1.0);
    CHECK((Truth(1.0) + Truth(0x1p-53) + Truth(0x1p-180)).toDouble() == 1.0 + 0x1p-52);
}

TEST_CASE("TruthOperationsAreWithinTheirStatedError") {
    const double bound = std::ldexp(1.0, -Truth::kBits);
    const Truth root = squareRoot(Truth(2.0));
    CHECK(std::abs((root * root - Truth(2.0)).toDouble()) <= 4.0 * 2.0 * bound);
    const Truth seventh = Truth(1.0) / Truth(7.0);
    CHECK(std::abs((seventh * Truth(7.0) - Truth(1.0)).toDouble()) <= 2.0 * bound);
    CHECK((-root + root).toDouble() == 0.0);
    CHECK((Truth(3.0) - Truth(5.0)).toDouble() == -2.0);
}

TEST_CASE("TruthComparesAsIeeeAndRoundsDown") {
    const Truth nan = Truth(0.0) / Truth(0.0), one(1.0), two(2.0);
    CHECK(one < two);
    CHECK(one <= one);
    CHECK_FALSE(two < one);
    CHECK(two > one);
    CHECK(two >= two);
    CHECK(Truth(0.0) == Truth(-0.0));
    CHECK_FALSE(nan < one);
    CHECK_FALSE(nan > one);
    CHECK_FALSE(nan <= nan);
    CHECK_FALSE(nan >= nan);
    CHECK_FALSE(nan == nan);
    CHECK(nan != nan);
    CHECK(squareRoot(Truth(-1.0)) != squareRoot(Truth(-1.0)));
    CHECK(floorOf(Truth(-0.5)) == Truth(-1.0));
    CHECK(floorOf(Truth(2.5)) == two);
    CHECK(std::signbit(floorOf(Truth(-0.0)).toDouble()));
    CHECK(toInteger(Truth(-2.75)) == -2);
    CHECK(toInteger(Truth(2147483647.5)) == 2147483647);
    CHECK(FromInteger<Truth>::of(std::numeric_limits<int32_t>::min()) == Truth(-0x1p31));
    CHECK(select(true, one, two) == one);
    CHECK(select(false, one, two) == two);
}

TEST_CASE("CopiesOfATruthAreIndependent") {
    static_assert(std::is_trivially_copyable_v<Truth> && std::is_trivially_default_constructible_v<Truth>);
    std::vector<Truth> values;
    for (int i = 0; i < 100; i++) values.push_back(Truth(i) / Truth(7.0));  // moves as the vector grows
    Truth copy = values[50];
    values[50] = Truth(0.0);
    CHECK((copy * Truth(7.0) - Truth(50.0)).toDouble() == doctest::Approx(0.0).epsilon(1e-50));
    copy = copy + copy;
    CHECK((values[49] * Truth(7.0)).toDouble() == 49.0);
    CHECK((copy * Truth(7.0)).toDouble() == 100.0);
}

TEST_CASE("ThreadsReadOneCopiedTruth") {
    const std::vector<Truth> shared(4, Truth(1.0) / Truth(3.0));
    std::vector<double> results(64);
    parallelFor(results.size(), 4, [&](size_t i) {
        for (int repeat = 0; repeat < 100; repeat++) results[i] = (shared[i % 4] * Truth(3.0)).toDouble();
    });
    for (double r : results) CHECK(r == 1.0);
}
