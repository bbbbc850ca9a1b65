// The texels of an image that is computed in lanes along its rows, some rows at a time.
#pragma once

#include <algorithm>
#include <vector>

#include "numeric/number.h"
#include "numeric/parallel.h"

namespace etalon {

// The coordinate in [0, 1] of the centre of part `part` of texel i.
inline double coordinateOf(int i, int part, int size, int parts) {
    return (static_cast<double>(i) * parts + part + 0.5) / (static_cast<double>(size) * parts);
}

// A number per texel of a row and part of it, in lanes.
template <class T>
class LanedColumns {
  public:
    // value(x, part) is a double; it is rounded once to T.
    template <class F>
    LanedColumns(int width, int parts, F&& value) : parts_(parts) {
        for (int first = 0; first < width; first += Number<T>::lanes)
            for (int part = 0; part < parts; part++)
                values_.push_back(Number<T>::generate(
                    [&](int lane) { return value(first + lane < width ? first + lane : width - 1, part); }));
    }
    // Of the texels from `first` on, a multiple of the number of lanes. Lanes behind the row repeat its last
    // texel.
    const T& at(size_t first, int part) const {
        return values_[first / kLanes * static_cast<size_t>(parts_) + static_cast<size_t>(part)];
    }

  private:
    static constexpr auto kLanes = static_cast<size_t>(Number<T>::lanes);
    int parts_;
    std::vector<T> values_;
};

// Calls body(y0, y1) for blocks of rows, from the first to behind the last one. Blocks are bands of the
// image, so that neighbouring texels of the source are used again while they are in the cache: the higher,
// the better, but there shall be enough of them for all threads.
template <class F>
void parallelForRowBlocks(int height, int threads, F&& body) {
    constexpr int kLeastRows = 8, kMostRows = 32, kBlocks = 16;
    const int rows = std::clamp(height / kBlocks, kLeastRows, kMostRows);
    const int blocks = (height + rows - 1) / rows;
    parallelFor(static_cast<size_t>(blocks), threads, [&](size_t block) {
        const int y0 = static_cast<int>(block) * rows;
        body(y0, std::min(y0 + rows, height));
    });
}

}  // namespace etalon
