#include "numeric/lanes.h"

#include <doctest/doctest.h>

#include <cmath>
#include <vector>

using namespace etalon;

TEST_CASE_TEMPLATE("SelectTakesEachLaneFromItsOwnSide", L, Lanes<float, 1>, Lanes<float, 4>, Lanes<float, 8>,
                   Lanes<float, 16>, Lanes<double, 2>, Lanes<double, 8>, Lanes<double, 16>) {
    const L a = L::generate([](int i) { return i % 3 - 1; });
    const L r = select(a < L(0.0), L(7.0), a);
    for (int i = 0; i < L::size; i++) CHECK(r[i] == (i % 3 == 0 ? 7 : i % 3 - 1));
}

TEST_CASE("BroadcastKeepsTheSignOfZero") {
    const Lanes<double, 4> d(-0.0);
    const Lanes<float, 8> f(-0.0);
    for (int i = 0; i < 4; i++) CHECK(std::signbit(d[i]));
    for (int i = 0; i < 8; i++) CHECK(std::signbit(f[i]));
    for (int i = 0; i < 4; i++) CHECK_FALSE(std::signbit(Lanes<double, 4>(0.0)[i]));
}

TEST_CASE("LaneGroupsCoverEveryItemOnceAndStoreNothingBehindTheTail") {
    for (size_t count : {0u, 1u, 3u, 4u, 5u, 17u}) {
        std::vector<float> in(count), out(count + 4, -1.f);
        for (size_t i = 0; i < count; i++) in[i] = static_cast<float>(i);
        forEachLaneGroup<4>(count, [&](size_t first, int active) {
            storeActive(loadActive<float, 4>(&in[first], active) + Lanes<float, 4>(1.0), &out[first], active);
        });
        for (size_t i = 0; i < out.size(); i++)
            CHECK(out[i] == (i < count ? static_cast<float>(i + 1) : -1.f));
    }
}
