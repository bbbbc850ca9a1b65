// Directions of the texels of a probe's images, in lanes of a number type.
#pragma once

#include <optional>
#include <vector>

#include "probes/laned_columns.h"
#include "probes/mapping.h"
#include "probes/texel_grid.h"

namespace etalon {

template <class T>
struct ConversionKernel {
#include "numeric/kernel_scope.inc"
#include "raster/texture_scope.inc"
#include "raster/kernels/sampler.glsl"
#include "raster/kernels/cube_face.glsl"
#include "probes/kernels/latlong.glsl"
#include "probes/kernels/mapping.glsl"
#include "probes/kernels/probe_sampler.glsl"
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

    vec3 at(Kernel& kernel, int layer, size_t first, int i, int y, int j) const {
        if (grid_) {
            const int row = y * parts_ + j;
            const vec3 d = kernel.latLongDirection(first_->at(first, i), second_->at(first, i),
                                                   T(grid_->sinLatitude(row)), T(grid_->cosLatitude(row)));
            return shape_.mapping == Mapping::latLong ? d : kernel.listingAxes(d);
        }
        return kernel.mappingDirection(typename Kernel::integer(layer), first_->at(first, i),
                                       T(coordinateOf(y, j, shape_.height, parts_)), settings_);
    }

    // The weights of the parts of a block of rows, where there are several.
    class Weights {
      public:
        Weights(const LanedDirections& of, int y0, int y1) : of_(of), y0_(y0) {
            if (of.shape_.mapping != Mapping::cube || of.parts_ == 1) return;
            const int parts = of.parts_, size = of.shape_.width * parts;
            for (int row = y0 * parts; row < y1 * parts; row++) {
                const std::vector<double> solidAngle_sr = cubeRowSolidAngles_sr(size, row);
                // Near 4 / size^2 in the middle of the face.
                const double scale = 0.25 * size * size;
                cube_.emplace_back(of.shape_.width, parts, [&](int x, int part) {
                    return scale * solidAngle_sr[static_cast<size_t>(x * parts + part)];
                });
            }
        }
        T at(Kernel& kernel, size_t first, int i, int y, int j) const {
            const int row = y * of_.parts_ + j;
            if (of_.grid_) return T(of_.grid_->cosLatitude(row));
            if (!cube_.empty()) return cube_[static_cast<size_t>(row - y0_ * of_.parts_)].at(first, i);
            const T v(coordinateOf(y, j, of_.shape_.height, of_.parts_));
            return kernel.discWeight(of_.first_->at(first, i), v, of_.settings_);
        }

      private:
        const LanedDirections& of_;
        int y0_;
        std::vector<LanedColumns<T>> cube_;
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
