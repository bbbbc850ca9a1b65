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
template <class T>
class ConversionWriter;

// What texel_parts.glsl reads, and the texts, over T. The texel's parts are those that LanedDirections::select chose.
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
        const LanedColumns<T>* solidAngles = nullptr;  // of the row's parts, if the result is a cube
        size_t column = 0;
        int row = 0;
    };
    Texels texels;
    const ConversionWriter<T>* writer = nullptr;  // of sourceSample

    real partColumn(int i, int k) const { return texels.directions->column(texels.column, i, k); }
    real partRow(int j, int k) const { return texels.directions->row(texels.row, j, k); }
    real partSolidAngle(int i, int j) const { return texels.solidAngles[j].at(texels.column, i); }
    ProbeSample sourceSample(const MappingPoint& p) { return writer->sampleAt(*this, p); }
#include "probes/kernels/texel_parts.glsl"
};

// Directions of the centres of the equal parts of texels, and weights in proportion to the parts' solid
// angles.
template <class T>
class LanedDirections {
  public:
    using Kernel = ConversionKernel<T>;
    using vec3 = typename Kernel::vec3;

    LanedDirections(const ProbeShape& shape, int parts)
        : shape_(shape), parts_(parts), settings_(mappingSettingsOf<Kernel>(shape)) {
        if (isLatLong(shape.mapping)) grid_.emplace(shape.width * parts, shape.height * parts);
        const auto column = [&](auto value) { return LanedColumns<T>(shape.width, parts, value); };
        if (grid_) {
            first_.emplace(column([&](int x, int part) { return grid_->sinLongitude(x * parts + part); }));
            second_.emplace(column([&](int x, int part) { return grid_->cosLongitude(x * parts + part); }));
        } else {
            first_.emplace(
                column([&](int x, int part) { return coordinateOf(x, part, shape.width, parts); }));
        }
    }

    const typename Kernel::MappingSettings& settings() const { return settings_; }
    // Numbers of part i of the texels from column `first` on, and of part j of those of row y: 0 is the sine of
    // longitude or latitude, 1 the cosine; or 0 is u or v.
    const T& column(size_t first, int i, int k) const {
        return k == 0 ? first_->at(first, i) : second_->at(first, i);
    }
    T row(int y, int j, int k) const {
        if (!grid_) return T(coordinateOf(y, j, shape_.height, parts_));
        const int row = y * parts_ + j;
        return T(k == 0 ? grid_->sinLatitude(row) : grid_->cosLatitude(row));
    }
    // The kernel's texels are those of row y from column `first` on.
    void select(Kernel& kernel, size_t first, int y) const {
        kernel.texels.directions = this;
        kernel.texels.column = first;
        kernel.texels.row = y;
    }
    vec3 at(Kernel& kernel, int layer, size_t first, int i, int y, int j) const {
        select(kernel, first, y);
        kernel.conversion.target = settings_;
        return kernel.partDirection(typename Kernel::integer(layer), i, j);
    }

    // The solid angles of the parts of a block of rows of a cube, where there are several.
    class SolidAngles {
      public:
        SolidAngles(const LanedDirections& of, int y0, int y1) : parts_(of.parts_), y0_(y0) {
            if (of.shape_.mapping != Mapping::cube || parts_ == 1) return;
            const int size = of.shape_.width * parts_;
            for (int row = y0 * parts_; row < y1 * parts_; row++) {
                const std::vector<double> solidAngle_sr = cubeRowSolidAngles_sr(size, row);
                // Near 4 / size^2 in the middle of the face.
                const double scale = 0.25 * size * size;
                rows_.emplace_back(of.shape_.width, parts_, [&](int x, int part) {
                    return scale * solidAngle_sr[static_cast<size_t>(x * parts_ + part)];
                });
            }
        }
        // Of the parts of row y of texels; null where there are none.
        const LanedColumns<T>* of(int y) const {
            return rows_.empty() ? nullptr : &rows_[static_cast<size_t>((y - y0_) * parts_)];
        }

      private:
        int parts_, y0_;
        std::vector<LanedColumns<T>> rows_;
    };

  private:
    ProbeShape shape_;
    int parts_;
    typename Kernel::MappingSettings settings_;
    std::optional<LatLongGrid> grid_;
    // Sines and cosines of longitudes; else u.
    std::optional<LanedColumns<T>> first_, second_;
};

}  // namespace etalon
