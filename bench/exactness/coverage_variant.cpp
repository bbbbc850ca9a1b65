#include "bench/exactness/coverage_variant.h"

#include <algorithm>

#include "numeric/lanes.h"

namespace etalon::bench {
namespace {

constexpr int kSubpixels = 256, kCentre = kSubpixels / 2;

// The pixels x0 <= x < x1, y0 <= y < y1 whose centres may be inside.
struct Box {
    int x0, y0, x1, y1;
};

Box boxOf(const SnappedTriangle& t, int width, int height) {
    const auto [left, right] = std::minmax({t.x[0], t.x[1], t.x[2]});
    const auto [top, bottom] = std::minmax({t.y[0], t.y[1], t.y[2]});
    return {std::max(0, left / kSubpixels), std::max(0, top / kSubpixels),
            std::min(width, right / kSubpixels + 1), std::min(height, bottom / kSubpixels + 1)};
}

// Edges over the scalar S: value at the centre of the box's first pixel, and steps per pixel, each converted
// once to S. Samples on an edge belong to top and left edges; the others start one lower.
template <class S>
struct Edges {
    S start[3], stepX[3], stepY[3];

    Edges(const SnappedTriangle& t, const Box& box) {
        const int64_t x = int64_t{box.x0} * kSubpixels + kCentre, y = int64_t{box.y0} * kSubpixels + kCentre;
        for (int i = 0; i < 3; i++) {
            const int j = (i + 1) % 3;
            const int64_t dx = t.x[j] - t.x[i], dy = t.y[j] - t.y[i];
            const int64_t value = dx * (y - t.y[i]) - dy * (x - t.x[i]);
            const bool ownsZero = dy < 0 || (dy == 0 && dx > 0);
            start[i] = static_cast<S>(value - (ownsZero ? 0 : 1));
            stepX[i] = static_cast<S>(-dy * kSubpixels);
            stepY[i] = static_cast<S>(dx * kSubpixels);
        }
    }
};

template <class S>
uint32_t countCovered(const SnappedTriangle& t, const Box& box) {
    constexpr int N = kNativeLanes<S>;
    using L = Lanes<S, N>;
    const Edges<S> edges(t, box);
    const L lane = L::generate([](int i) { return i; });
    const L zero = L(typename L::Vector{});
    typename Mask<S, N>::Vector count{};
    for (int y = box.y0; y < box.y1; y++) {
        L e[3], step[3];
        for (int i = 0; i < 3; i++) {
            const S row = edges.start[i] + edges.stepY[i] * static_cast<S>(y - box.y0);
            e[i] = L(row + edges.stepX[i] * lane.v);
            step[i] = L(edges.stepX[i] * static_cast<S>(N) - typename L::Vector{});
        }
        for (int x = box.x0; x < box.x1; x += N) {
            auto inside = (e[0] >= zero) && (e[1] >= zero) && (e[2] >= zero);
            if (box.x1 - x < N)
                inside = inside && (lane < L(typename L::Vector{} + static_cast<S>(box.x1 - x)));
            count -= inside.m;
            for (int i = 0; i < 3; i++) e[i] = e[i] + step[i];
        }
    }
    uint32_t total = 0;
    for (int i = 0; i < N; i++) total += static_cast<uint32_t>(count[i]);
    return total;
}

// Every value is below 2^31: an edge's is at most twice the product of the sides of the triangle's own box,
// which the lanes behind its right border leave by at most kLanes pixels.
bool fitsInteger32(const SnappedTriangle& t) {
    const auto [left, right] = std::minmax({t.x[0], t.x[1], t.x[2]});
    const auto [top, bottom] = std::minmax({t.y[0], t.y[1], t.y[2]});
    const int64_t width = int64_t{right} - left + (kLanes + 1) * kSubpixels,
                  height = int64_t{bottom} - top + kSubpixels;
    return 2 * width * height < int64_t{1} << 31;
}

}  // namespace
}  // namespace etalon::bench

extern "C" __attribute__((visibility("default"))) void etalonCountCovered(
    const etalon::bench::SnappedTriangle* triangles, size_t count, int width, int height,
    etalon::bench::EdgeArithmetic arithmetic, uint32_t* covered) {
    using namespace etalon::bench;
    for (size_t i = 0; i < count; i++) {
        const Box box = boxOf(triangles[i], width, height);
        switch (arithmetic) {
            case EdgeArithmetic::integer64:
                covered[i] = countCovered<int64_t>(triangles[i], box);
                break;
            case EdgeArithmetic::integer32:
                covered[i] = fitsInteger32(triangles[i]) ? countCovered<int32_t>(triangles[i], box)
                                                         : countCovered<int64_t>(triangles[i], box);
                break;
            case EdgeArithmetic::real32:
                covered[i] = countCovered<float>(triangles[i], box);
                break;
        }
    }
}
