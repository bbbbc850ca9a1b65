// The worked example of docs/kernels.md.
#include <doctest/doctest.h>

#include <cmath>
#include <vector>

#include "numeric/elementary.h"
#include "numeric/rounded.h"
#include "numeric/truth.h"
#include "tests/support/random_numbers.h"

using namespace etalon;

namespace {

template <class T>
struct LuminanceKernels {
#include "numeric/kernel_scope.inc"
#include "numeric/kernels/vector.glsl"
// The text of the example.
#include "tests/numeric/luminance.glsl"
};

}  // namespace

TEST_CASE("TheWorkedExampleOfTheKernelPageRunsOverEveryNumberType") {
    // Three products, two sums, three rounded constants, each within half a unit of float.
    constexpr double kBound = 5 * 0x1p-24;
    RandomNumbers random(6);
    std::vector<float> red(101), green(101), blue(101), out(101);
    for (size_t i = 0; i < red.size(); i++) {
        red[i] = static_cast<float>(random.uniform(0, 1));
        green[i] = static_cast<float>(random.uniform(0, 1));
        blue[i] = static_cast<float>(random.uniform(0, 1));
    }
    using T = Lanes<float, kLanes>;
    LuminanceKernels<T> kernels;
    forEachLaneGroup<T::size>(out.size(), [&](size_t first, int active) {
        const auto load = [&](const std::vector<float>& plane) {
            return loadActive<float, T::size>(&plane[first], active);
        };
        storeActive(kernels.luminance({load(red), load(green), load(blue)}), &out[first], active);
    });
    LuminanceKernels<float> scalar;
    LuminanceKernels<Lanes<float, 1>> oneLane;
    LuminanceKernels<Truth> truth;
    LuminanceKernels<Rounded<kFp16, double>> half;
    for (size_t i = 0; i < out.size(); i++) {
        CHECK(out[i] == scalar.luminance({red[i], green[i], blue[i]}));
        using One = Lanes<float, 1>;
        CHECK(out[i] == oneLane.luminance({One(red[i]), One(green[i]), One(blue[i])})[0]);
        const double exact = truth.luminance({Truth(red[i]), Truth(green[i]), Truth(blue[i])}).toDouble();
        CHECK(std::fabs(out[i] - exact) <= kBound);
        using Half = Rounded<kFp16, double>;
        CHECK(std::fabs(half.luminance({Half(red[i]), Half(green[i]), Half(blue[i])}).v - exact) <=
              5 * 0x1p-11);
    }
}
