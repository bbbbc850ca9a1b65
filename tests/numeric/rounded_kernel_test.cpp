// Kernel texts over the number formats and the truth.
#include <doctest/doctest.h>

#include <bit>
#include <cmath>
#include <glm/vec3.hpp>

#include "numeric/rounded.h"
#include "numeric/truth.h"
#include "tests/numeric/format_cases.h"

using namespace etalon;
using namespace etalon::test;

namespace {

template <class T>
struct VectorKernels {
#include "numeric/kernel_scope.inc"
#include "numeric/kernels/vector.glsl"
};

template <class T>
glm::vec<3, T> vectorOf(double x, double y, double z) {
    return {T(x), T(y), T(z)};
}

// unit3 in a format: the square sum errs by 3 roundings, which the root halves, then root, division and
// scaling round once each: below 5 roundings to first order, 6 with the second; a rounding is half an epsilon
// to nearest, a whole one toward zero.
template <Format F>
constexpr double unitVectorBound() {
    return 6.0 * epsilonOf(F) * (F.rounding == Rounding::nearestEven ? 0.5 : 1.0);
}

// The largest error of unit3 in F against Truth, for vectors with components in [1/4, 4] of either sign.
template <Format F>
double largestUnitVectorError() {
    using R = Rounded<F>;
    Random random(7);
    double largest = 0.0;
    for (int i = 0; i < 2000; i++) {
        double c[3];
        for (double& x : c)
            x = R((random.integer(0, 1) ? 1.0 : -1.0) * (0.25 + 3.75 * 0x1p-30 * random.integer(0, 1 << 30)))
                    .v;
        const auto u = VectorKernels<R>{}.unit3(vectorOf<R>(c[0], c[1], c[2]));
        const auto t = VectorKernels<Truth>{}.unit3(vectorOf<Truth>(c[0], c[1], c[2]));
        largest = std::fmax(largest, std::abs((Truth(u.x.v) / t.x - Truth(1.0)).toDouble()));
        largest = std::fmax(largest, std::abs((Truth(u.y.v) / t.y - Truth(1.0)).toDouble()));
        largest = std::fmax(largest, std::abs((Truth(u.z.v) / t.z - Truth(1.0)).toDouble()));
    }
    return largest;
}

}  // namespace

TEST_CASE("Dot3OverHalfFollowsTheWrittenOrder") {
    using R = Rounded<kFp16>;
    const auto a = vectorOf<R>(1.0, 2048.0, 1.0), b = vectorOf<R>(1.0, 1.0, 1.0);
    // y + z first: 2048 + 1 is a tie and goes to 2048, then the same with x. Any other order with x + z first
    // gives 2050.
    CHECK(VectorKernels<R>{}.dot3(a, b).v == 2048.0);
    CHECK(VectorKernels<Truth>{}.dot3(vectorOf<Truth>(1.0, 2048.0, 1.0), vectorOf<Truth>(1.0, 1.0, 1.0)) ==
          Truth(2050.0));
}

TEST_CASE("UnitVectorsOfEveryFormatAreWithinTheirBoundOfTheTruth") {
    forEachNamedFormat([]<Format F>(std::string_view name) {
        const double error = largestUnitVectorError<F>();
        CAPTURE(name);
        CHECK(error <= unitVectorBound<F>());
        CHECK(error > 0.2 * epsilonOf(F));  // the format is really computed in
    });
}

TEST_CASE("LanesOfAKernelEqualTheScalarInstanceAndTheZeroVectorStaysZero") {
    constexpr int kWidth = 8;
    using L = Lanes<double, kWidth>;
    using R = Rounded<kFp24R300, L>;
    using S = Rounded<kFp24R300>;
    FormatCases generator(kFp24R300, 3);
    for (int repeat = 0; repeat < 2000; repeat++) {
        double c[3][kWidth];
        for (auto& component : c)
            for (double& x : component) x = generator.pair().first;
        for (auto& component : c) component[repeat % kWidth] = 0.0;
        const glm::vec<3, R> v(R(L::load(c[0])), R(L::load(c[1])), R(L::load(c[2])));
        const auto u = VectorKernels<R>{}.unit3(v);
        for (int i = 0; i < kWidth; i++) {
            const auto s = VectorKernels<S>{}.unit3(vectorOf<S>(c[0][i], c[1][i], c[2][i]));
            REQUIRE(std::bit_cast<int64_t>(u.x.v[i]) == std::bit_cast<int64_t>(s.x.v));
            REQUIRE(std::bit_cast<int64_t>(u.y.v[i]) == std::bit_cast<int64_t>(s.y.v));
            REQUIRE(std::bit_cast<int64_t>(u.z.v[i]) == std::bit_cast<int64_t>(s.z.v));
        }
        REQUIRE(u.x.v[repeat % kWidth] == 0.0);
    }
}
