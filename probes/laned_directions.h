// Directions of the texels of a probe's images, in lanes of a number type.
#pragma once

#include <optional>
#include <vector>

#include "probes/laned_columns.h"
#include "probes/mapping.h"
#include "probes/texel_grid.h"

namespace etalon {

template <class T>
class LanedDirections;

// The overlaps of the texels of a row from a column on, in lanes. Lanes with fewer of them have some of weight 0
// behind.
template <class T>
struct LanedOverlaps {
    std::vector<typename NumberTraits<T>::Integer> layers, columns, rows;
    std::vector<T> weights;
};

// What texel_points.glsl and texel_overlaps.glsl read, and the texts, over T. The texel is the one that
// LanedDirections::select chose.
template <class T>
struct ConversionKernel {
#include "numeric/kernel_scope.inc"
#include "raster/texture_scope.inc"
#include "raster/kernels/sampler.glsl"
#include "raster/kernels/cube_face.glsl"
#include "probes/kernels/latlong.glsl"
#include "probes/kernels/mapping.glsl"
#include "probes/kernels/probe_sampler.glsl"
    struct Texels {
        const LanedDirections<T>* directions = nullptr;
        size_t column = 0;
        int row = 0;
    };
    Texels texels;
    LanedOverlaps<T> overlaps;

    real texelColumn(int k) const { return texels.directions->column(texels.column, k); }
    real texelRow(int k) const { return texels.directions->row(texels.row, k); }
    CubeTexel overlapTexel(int k) {
        const auto i = static_cast<size_t>(k);
        return cubeTexel(overlaps.layers[i], overlaps.columns[i], overlaps.rows[i]);
    }
    real overlapWeight(int k) const { return overlaps.weights[static_cast<size_t>(k)]; }
#include "probes/kernels/texel_points.glsl"
#include "probes/kernels/texel_overlaps.glsl"
};

// Directions of the centres of texels.
template <class T>
class LanedDirections {
  public:
    using Kernel = ConversionKernel<T>;
    using vec3 = typename Kernel::vec3;

    explicit LanedDirections(const ProbeShape& shape)
        : shape_(shape), settings_(mappingSettingsOf<Kernel>(shape)) {
        if (isLatLong(shape.mapping)) grid_.emplace(shape.width, shape.height);
        const auto column = [&](auto value) { return LanedColumns<T>(shape.width, 1, value); };
        if (grid_) {
            first_.emplace(column([&](int x, int) { return grid_->sinLongitude(x); }));
            second_.emplace(column([&](int x, int) { return grid_->cosLongitude(x); }));
        } else {
            first_.emplace(column([&](int x, int) { return coordinateOf(x, 0, shape.width, 1); }));
        }
    }

    const typename Kernel::MappingSettings& settings() const { return settings_; }
    // Numbers of the texels from column `first` on, and of row y: 0 is the sine of longitude or latitude, 1 the
    // cosine; or 0 is u or v.
    const T& column(size_t first, int k) const {
        return k == 0 ? first_->at(first, 0) : second_->at(first, 0);
    }
    T row(int y, int k) const {
        if (!grid_) return T(coordinateOf(y, 0, shape_.height, 1));
        return T(k == 0 ? grid_->sinLatitude(y) : grid_->cosLatitude(y));
    }
    // The kernel's texels are those of row y from column `first` on.
    void select(Kernel& kernel, size_t first, int y) const {
        kernel.texels.directions = this;
        kernel.texels.column = first;
        kernel.texels.row = y;
    }
    vec3 at(Kernel& kernel, int layer, size_t first, int y) const {
        select(kernel, first, y);
        kernel.conversion.target = settings_;
        return kernel.texelDirection(typename Kernel::integer(layer));
    }

  private:
    ProbeShape shape_;
    typename Kernel::MappingSettings settings_;
    std::optional<LatLongGrid> grid_;
    // Sines and cosines of longitudes; else u.
    std::optional<LanedColumns<T>> first_, second_;
};

}  // namespace etalon
