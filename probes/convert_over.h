// The passes of probes/convert.h over a number type, for the sources that instantiate them.
#pragma once

#include <array>
#include <optional>

#include "probes/conversion_job.h"
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

// The columns [first, last) of a row whose texels show a direction.
struct ShownColumns {
    int first = 0, last = 0;
};
inline std::vector<ShownColumns> shownColumnsOf(const ProbeShape& shape) {
    std::vector<ShownColumns> rows(static_cast<size_t>(shape.height));
    for (int y = 0; y < shape.height; y++) {
        int first = 0;
        while (first < shape.width && !showsDirection(shape, first, y)) first++;
        // Discs are symmetrical.
        rows[static_cast<size_t>(y)] = {first, shape.width - first};
    }
    return rows;
}

template <class T>
void convertImages(const ConversionJob& job, Probe& result) {
    using Kernel = ConversionKernel<T>;
    using vec3 = typename Kernel::vec3;
    constexpr int kWidth = NumberTraits<T>::lanes;
    const TextureView radiance(job.radiance);
    const TextureView shown = job.shown.empty() ? radiance : TextureView(job.shown);
    const TextureView distance = job.distance_m.empty() ? radiance : TextureView(job.distance_m);
    const bool isNearest = job.resampling == Resampling::nearest;
    typename Kernel::ProbeSampling sampling;
    sampling.source = mappingSettingsOf<Kernel>(job.source);
    sampling.sampling = samplingOf<Kernel>(
        {isNearest ? Filter::nearest : Filter::bilinear, Wrap::clamp, Wrap::clamp, job.fractionBits},
        job.source.width, job.source.height);
    sampling.isMasked = job.shown.empty() ? 0 : 1;
    sampling.whole = T(job.wholeRadius);
    typename Kernel::Sampling nearest = sampling.sampling;
    nearest.filterMode = static_cast<int>(Filter::nearest);
    std::array<vec3, 3> turn;
    for (int row = 0; row < 3; row++)
        turn[static_cast<size_t>(row)] = {T(job.turn[0][row]), T(job.turn[1][row]), T(job.turn[2][row])};

    const int parts = job.resampling == Resampling::area ? job.samplesPerAxis : 1;
    const std::vector<ShownColumns> shownColumns = shownColumnsOf(job.target);
    const LanedDirections<T> centres(job.target, 1), directions(job.target, parts);
    parallelForRowBlocks(job.target.height, job.threads, [&](int y0, int y1) {
        Kernel kernel;
        const typename LanedDirections<T>::Weights weights(directions, y0, y1);
        const auto turned = [&](vec3 d) {
            return job.isTurned ? kernel.turned(d, turn[0], turn[1], turn[2]) : d;
        };
        // The mean of the parts of texels.
        const auto area = [&](int layer, size_t first, int y) {
            typename Kernel::ProbeMean mean{{T(0.0), T(0.0), T(0.0)}, T(0.0)};
            for (int j = 0; j < parts; j++)
                for (int i = 0; i < parts; i++)
                    mean = kernel.addSample(
                        mean,
                        kernel.sampleProbe(radiance, shown,
                                           turned(directions.at(kernel, layer, first, i, y, j)), sampling),
                        weights.at(kernel, first, i, y, j));
            return mean;
        };
        for (int layer = 0; layer < job.target.layers(); layer++) {
            const auto l = static_cast<size_t>(layer);
            forEachLaneGroup<kWidth>(static_cast<size_t>(job.target.width), [&](size_t first, int active) {
                for (int y = y0; y < y1; y++) {
                    typename Kernel::ProbeSample sample;
                    const auto middle = [&] { return turned(centres.at(kernel, layer, first, 0, y, 0)); };
                    if (parts == 1) {
                        sample = kernel.sampleProbe(radiance, shown, middle(), sampling);
                    } else {
                        const auto mean = area(layer, first, y);
                        sample = kernel.probeSample(mean.rgb, mean.weight > T(0.0));
                        if (kernel.isAny(!sample.isShown))
                            sample = kernel.shownOr(sample,
                                                    kernel.sampleProbe(radiance, shown, middle(), sampling));
                    }
                    if (job.hasBlindSpots) {
                        const ShownColumns& on = shownColumns[static_cast<size_t>(y)];
                        const int from = static_cast<int>(first), to = from + active;
                        T isOnImage(1.0);
                        if (from < on.first || to > on.last)
                            isOnImage = generateNumber<T>([&](int lane) {
                                return from + lane >= on.first && from + lane < on.last ? 1.0 : 0.0;
                            });
                        sample = kernel.blackIfHidden(sample, isOnImage);
                        std::array<float, kWidth> isValid;
                        TexelFetch<T>::store(kernel.asNumber(sample.isShown), isValid.data(), active);
                        uint8_t* valid = result.valid[l].row(y).data() + first;
                        for (int lane = 0; lane < active; lane++)
                            valid[lane] = isValid[static_cast<size_t>(lane)] != 0.0f ? 1 : 0;
                    }
                    for (int c = 0; c < 3; c++)
                        TexelFetch<T>::store(sample.rgb[c], result.radiance[l].row(y, c).data() + first,
                                             active);
                    if (job.distance_m.empty()) continue;
                    TexelFetch<T>::store(
                        kernel.nearestDistance(distance, shown, middle(), sampling, nearest, sample.isShown),
                        result.distance_m[l].row(y).data() + first, active);
                }
            });
        }
    });
}

template <class T>
void latLongFromCubeImage(const CubeMap<float>& cube, const LatLongFromCube& options, int threads,
                          Image<float>& latLong) {
    using Kernel = ConversionKernel<T>;
    constexpr int kWidth = NumberTraits<T>::lanes;
    const TextureView texture(cube);
    const auto sampling = samplingOf<Kernel>({options.filter, Wrap::clamp, Wrap::clamp, options.fractionBits},
                                             cube.size(), cube.size());
    const int width = latLong.width(), height = latLong.height();
    const LanedColumns<T> columns(width, 1, [&](int x, int) { return coordinateOf(x, 0, width, 1); });
    parallelForRowBlocks(height, threads, [&](int y0, int y1) {
        Kernel kernel;
        forEachLaneGroup<kWidth>(static_cast<size_t>(width), [&](size_t first, int active) {
            for (int y = y0; y < y1; y++) {
                const auto direction = kernel.listingDirection(columns.at(first, 0),
                                                               T(coordinateOf(height - 1 - y, 0, height, 1)));
                const auto c = kernel.cubeCoordinates(direction);
                const auto rgb = options.edges == CubeEdges::seamless
                                     ? kernel.sampleCubeRgbAt(texture, c, sampling)
                                     : kernel.sampleRgb(texture, c.face, c.s, c.t, sampling);
                for (int channel = 0; channel < 3; channel++)
                    TexelFetch<T>::store(rgb[channel], latLong.row(y, channel).data() + first, active);
            }
        });
    });
}

}  // namespace etalon
