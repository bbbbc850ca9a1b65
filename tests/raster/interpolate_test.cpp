// Rule 5: interpolation weights and attributes.
#include <doctest/doctest.h>

#include <algorithm>

#include "numeric/number.h"
#include "numeric/rounded.h"
#include "numeric/truth.h"
#include "raster/raster_kernels.h"
#include "tests/support/random_numbers.h"

using namespace etalon;

namespace {

template <class T>
typename RasterKernels<T>::vec3 numbers(double a, double b, double c) {
    return {T(a), T(b), T(c)};
}

// Random weights as the rasterizer makes them: e in [0, 2) with a sum in [1, 2), q with the largest in [1,
// 2).
struct RandomWeights {
    double e[3], q[3];
    explicit RandomWeights(RandomNumbers& random, double wRatio) {
        const double a = random.uniform(0, 1), b = random.uniform(0, 1) * (1 - a);
        e[0] = a, e[1] = b, e[2] = 1 - a - b;
        for (double& value : q) value = 1.0 / random.uniform(1, wRatio);
        q[random.below(3)] = random.uniform(1, 2);
    }
};

}  // namespace

TEST_CASE_TEMPLATE("ConstantAttributeSurvivesAWRatioOfAMillion", T, float, double, Lanes<float, 4>,
                   Rounded<kFp16, double>, Rounded<kBf16, double>, Rounded<kFp24R300, double>) {
    RasterKernels<T> kernels;
    RandomNumbers random(1);
    for (int i = 0; i < 20000; i++) {
        const RandomWeights w(random, 1e6);
        const auto b = kernels.perspectiveWeights(numbers<T>(w.e[0], w.e[1], w.e[2]),
                                                  numbers<T>(w.q[0], w.q[1], w.q[2]));
        const T a(random.uniform(-10, 10));
        REQUIRE(numberLane(kernels.interpolateAttribute(b, {a, a, a}), 0) == numberLane(a, 0));
    }
}

TEST_CASE_TEMPLATE("AttributesStayInsideTheHull", T, float, double, Rounded<kFp16, double>,
                   Rounded<kBf16, double>, Rounded<kFp24R300, double>) {
    RasterKernels<T> kernels;
    RandomNumbers random(2);
    for (int i = 0; i < 20000; i++) {
        const RandomWeights w(random, 1e3);
        const auto b = kernels.perspectiveWeights(numbers<T>(w.e[0], w.e[1], w.e[2]),
                                                  numbers<T>(w.q[0], w.q[1], w.q[2]));
        const auto a = numbers<T>(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
        const double value = numberLane(kernels.interpolateAttribute(b, a), 0);
        const auto [lo, hi] = std::minmax({numberLane(a.x, 0), numberLane(a.y, 0), numberLane(a.z, 0)});
        REQUIRE(value >= lo);
        REQUIRE(value <= hi);
    }
}

// Weights add up to 1 within a few roundings each: three products, two sums, a division.
TEST_CASE("InterpolatedAttributesAreCloseToTheTruth") {
    constexpr double kFloatBound = 8 * 0x1p-24;
    RasterKernels<float> kernels;
    RasterKernels<Truth> truth;
    RandomNumbers random(3);
    double worst = 0;
    for (int i = 0; i < 20000; i++) {
        const RandomWeights w(random, 1e6);
        float e[3], q[3], a[3];
        for (int k = 0; k < 3; k++) {
            e[k] = static_cast<float>(w.e[k]);
            q[k] = static_cast<float>(w.q[k]);
            a[k] = static_cast<float>(random.uniform(-1, 1));
        }
        const float value = kernels.interpolateAttribute(
            kernels.perspectiveWeights({e[0], e[1], e[2]}, {q[0], q[1], q[2]}), {a[0], a[1], a[2]});
        const Truth exact = truth.interpolateAttribute(
            truth.perspectiveWeights(numbers<Truth>(e[0], e[1], e[2]), numbers<Truth>(q[0], q[1], q[2])),
            numbers<Truth>(a[0], a[1], a[2]));
        worst = std::max(worst, std::fabs(value - exact.toDouble()));
    }
    CHECK(worst <= kFloatBound);
    CHECK(worst > 0);
}

TEST_CASE("VanishingWeightsGiveTheFirstVertex") {
    using T = Rounded<kFp16, double>;
    RasterKernels<T> kernels;
    // Both products fall below the smallest half.
    const auto b = kernels.perspectiveWeights(numbers<T>(0x1p-14, 0, 0), numbers<T>(0x1p-14, 1, 1));
    CHECK(b.x.v == 1);
    CHECK(b.y.v == 0);
    CHECK(b.z.v == 0);
}
