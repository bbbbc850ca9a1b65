#include "numeric/format.h"

#include <doctest/doctest.h>

#include <limits>
#include <set>

#include "numeric/arithmetic.h"

using namespace etalon;

TEST_CASE("LimitsOfFp32AreThoseOfFloat") {
    using Limits = std::numeric_limits<float>;
    CHECK(largestFinite(kFp32) == static_cast<double>(Limits::max()));
    CHECK(smallestNormal(kFp32) == static_cast<double>(Limits::min()));
    CHECK(smallestPositive(kFp32) == static_cast<double>(Limits::denorm_min()));
    CHECK(smallestPositive(kFp32Flush) == static_cast<double>(Limits::min()));
    CHECK(epsilonOf(kFp32) == static_cast<double>(Limits::epsilon()));
}

// The limits that IEEE 754-2008 (binary16) and the layouts of the other formats imply.
TEST_CASE("LimitsOfNarrowFormatsAreTheDocumentedOnes") {
    CHECK(largestFinite(kFp16) == 65504.0);
    CHECK(smallestNormal(kFp16) == 0x1p-14);
    CHECK(smallestPositive(kFp16) == 0x1p-24);
    CHECK(largestFinite(kBf16) == 0x1.fep127);
    CHECK(epsilonOf(kBf16) == 0x1p-7);
    CHECK(largestFinite(kFp24R300) == 0x1.ffffp64);
    CHECK(smallestPositive(kFp24R300) == 0x1p-62);
}

// However an arithmetic came to its format: made of it, or set later.
TEST_CASE("TheTypeOfAnArithmeticFollowsItsFormat") {
    CHECK(Arithmetic::fp32.type() == NumberType::fp32);
    CHECK(Arithmetic::fp64.type() == NumberType::fp64);
    CHECK(Arithmetic::truth.type() == NumberType::truth);
    for (Arithmetic arithmetic : {Arithmetic::fp64, Arithmetic::fp24R300, Arithmetic::bf16}) {
        arithmetic.format = kFp16;
        CHECK(arithmetic.type() == NumberType::narrow);
        CHECK(arithmetic == Arithmetic::fp16);
        arithmetic.format->rounding = Rounding::towardZero;
        CHECK(arithmetic.type() == NumberType::emulated);
    }
}

TEST_CASE("NamedFormatsAreSupportedAndNamedOnce") {
    std::set<std::string_view> names;
    for (const NamedFormat& named : namedFormats()) {
        CHECK_MESSAGE(isSupported(named.format), named.name);
        CHECK_MESSAGE(names.insert(named.name).second, named.name);
    }
}

TEST_CASE("FormatsThatDoubleCannotEmulateAreNotSupported") {
    const auto with = [](int significandBits, int minExponent, int maxExponent) {
        return Format{significandBits,       minExponent,      maxExponent,
                      Rounding::nearestEven, Subnormals::keep, Overflow::infinity};
    };
    CHECK(isSupported(with(24, -126, 127)));
    CHECK_FALSE(isSupported(with(25, -126, 127)));
    CHECK_FALSE(isSupported(with(53, -1022, 1023)));
    CHECK_FALSE(isSupported(with(1, -126, 127)));
    CHECK_FALSE(isSupported(with(24, -126, 22)));
    CHECK_FALSE(isSupported(with(24, 1, 127)));
    CHECK_FALSE(isSupported(with(8, -500, 127)));
}
