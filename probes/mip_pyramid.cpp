#include "probes/mip_pyramid.h"

#include <algorithm>
#include <cmath>

#include "numeric/check.h"
#include "numeric/elementary.h"
#include "numeric/kernel_types.h"
#include "numeric/parallel.h"
#include "numeric/vectors.h"
#include "probes/texel_grid.h"

namespace etalon {
namespace {

// A part of a texel of the finer level inside a texel of the coarser one: borders in units of 1 / (fine
// coarse).
struct Part {
    int texel;
    int64_t from, to;
};

// Per coarse texel, its parts in order.
std::vector<std::vector<Part>> partsOf(int fine, int coarse) {
    std::vector<std::vector<Part>> parts(static_cast<size_t>(coarse));
    for (int c = 0; c < coarse; c++) {
        const int64_t from = static_cast<int64_t>(c) * fine, to = from + fine;
        for (int64_t f = from / coarse; f * coarse < to; f++)
            parts[static_cast<size_t>(c)].push_back(
                {static_cast<int>(f), std::max(from, f * coarse), std::min(to, (f + 1) * coarse)});
    }
    return parts;
}

// Solid angles of rectangles of a level, borders in units of 1 / columns and 1 / rows of the image.
class Rectangles {
  public:
    Rectangles(Mapping mapping, int64_t columns, int64_t rows)
        : mapping_(mapping), columns_(columns), rows_(rows) {}

    double solidAngle_sr(const Part& x, const Part& y) const {
        if (mapping_ == Mapping::cube)
            return (corner(x.to, y.to) - corner(x.from, y.to)) -
                   (corner(x.to, y.from) - corner(x.from, y.from));
        // sin(upper) - sin(lower) = 2 sin(middle colatitude) sin(half the height)
        const double perRow_rad = kPi / static_cast<double>(rows_);
        const double middle_rad = 0.5 * perRow_rad * static_cast<double>(y.from + y.to);
        const double half_rad = 0.5 * perRow_rad * static_cast<double>(y.to - y.from);
        const double width_rad =
            2.0 * kPi * (static_cast<double>(x.to - x.from) / static_cast<double>(columns_));
        return width_rad * (2.0 * sinOf(middle_rad) * sinOf(half_rad));
    }

  private:
    double corner(int64_t i, int64_t j) const {
        const double s = static_cast<double>(2 * i - columns_) / static_cast<double>(columns_),
                     t = static_cast<double>(2 * j - rows_) / static_cast<double>(rows_);
        return atan2Of(s * t, std::sqrt(s * s + (t * t + 1.0)));
    }

    Mapping mapping_;
    int64_t columns_, rows_;
};

// What mip.glsl reads, and the text, over T: one texel's parts in a layer of the finer level.
template <class T>
struct MipKernel {
#include "numeric/kernel_scope.inc"
#include "numeric/kernels/vector.glsl"
    const Probe* fine;
    size_t layer;
    const std::vector<Part>*across, *down;
    const std::vector<double>* weights_sr;  // row by row

    int x(int column) const { return (*across)[static_cast<size_t>(column)].texel; }
    int y(int row) const { return (*down)[static_cast<size_t>(row)].texel; }
    real partWeight_sr(int column, int row) const {
        return T((*weights_sr)[static_cast<size_t>(row) * across->size() + static_cast<size_t>(column)]);
    }
    boolean partIsValid(int column, int row) const {
        return fine->valid.empty() || fine->valid[layer].at(x(column), y(row)) != 0;
    }
    vec3 partRadiance(int column, int row) const {
        const auto channel = [&](int c) {
            return T(static_cast<double>(fine->radiance[layer].at(x(column), y(row), c)));
        };
        return {channel(0), channel(1), channel(2)};
    }
#include "probes/kernels/mip.glsl"
};

Probe halved(const Probe& fine, int threads) {
    Probe coarse;
    coarse.shape = fine.shape;
    coarse.shape.width = std::max(1, fine.shape.width / 2);
    coarse.shape.height = std::max(1, fine.shape.height / 2);
    coarse.rotation = fine.rotation;
    coarse.position_m = fine.position_m;
    const int width = coarse.shape.width, height = coarse.shape.height;
    for (int layer = 0; layer < coarse.shape.layers(); layer++) {
        coarse.radiance.emplace_back(width, height, 3);
        if (!fine.valid.empty()) coarse.valid.emplace_back(width, height, 1);
    }
    const auto columns = partsOf(fine.shape.width, width), rows = partsOf(fine.shape.height, height);
    const Rectangles rectangles(fine.shape.mapping, static_cast<int64_t>(fine.shape.width) * width,
                                static_cast<int64_t>(fine.shape.height) * height);
    parallelFor(static_cast<size_t>(height), threads, [&](size_t y) {
        for (int x = 0; x < width; x++) {
            const std::vector<Part>& across = columns[static_cast<size_t>(x)];
            std::vector<double> weights;
            for (const Part& row : rows[y])
                for (const Part& column : across) weights.push_back(rectangles.solidAngle_sr(column, row));
            for (size_t layer = 0; layer < coarse.radiance.size(); layer++) {
                MipKernel<double> kernel{&fine, layer, &across, &rows[y], &weights};
                const auto texel =
                    kernel.meanOfParts(static_cast<int>(across.size()), static_cast<int>(rows[y].size()));
                for (int c = 0; c < 3; c++)
                    coarse.radiance[layer].at(x, static_cast<int>(y), c) = static_cast<float>(texel.rgb[c]);
                if (!fine.valid.empty())
                    coarse.valid[layer].at(x, static_cast<int>(y)) = texel.isValid ? 1 : 0;
            }
        }
    });
    return coarse;
}

}  // namespace

std::vector<Probe> mipPyramid(const Probe& probe, int threads) {
    checkProbe(probe);
    ETALON_CHECK(isLatLong(probe.shape.mapping) || probe.shape.mapping == Mapping::cube, "mapping {}",
                 static_cast<int>(probe.shape.mapping));
    std::vector<Probe> levels = {probe};
    while (levels.back().shape.width > 1 || levels.back().shape.height > 1)
        levels.push_back(halved(levels.back(), threads));
    return levels;
}

}  // namespace etalon
