// The passes of probes/convert.h over a number type, for the sources that instantiate them.
#pragma once

#include <array>

#include "probes/mirrored_angles.h"
#include "probes/texel_grid.h"

namespace etalon {

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

// Samples the source and writes the texels of the result.
template <class T>
class ConversionWriter {
  public:
    using Kernel = ConversionKernel<T>;
    using Point = typename Kernel::MappingPoint;
    using Sample = typename Kernel::ProbeSample;

    ConversionWriter(const ConversionJob& job, Probe& result)
        : job_(job),
          result_(result),
          shownColumns_(shownColumnsOf(job.target)),
          radiance_(job.radiance),
          shown_(job.shown.empty() ? radiance_ : TextureView(job.shown)),
          distance_m_(job.distance_m.empty() ? radiance_ : TextureView(job.distance_m)) {
        const bool isNearest = job.resampling == Resampling::nearest;
        sampling_.source = mappingSettingsOf<Kernel>(job.source);
        sampling_.sampling = samplingOf<Kernel>({isNearest ? Filter::nearest : Filter::bilinear, Wrap::clamp,
                                                 Wrap::clamp, job.fractionBits, job.rule},
                                                job.source.width, job.source.height);
        sampling_.isMasked = job.shown.empty() ? 0 : 1;
        sampling_.whole = T(job.wholeRadius);
        nearest_ = sampling_.sampling;
        nearest_.filterMode = static_cast<int>(Filter::nearest);
    }

    const typename Kernel::MappingSettings& source() const { return sampling_.source; }
    Sample sampleAt(Kernel& kernel, const Point& p) const {
        if constexpr (Number<T>::isNative)
            return sampleFlattened(kernel, p);
        else
            return kernel.sampleProbe(radiance_, shown_, p, sampling_);
    }
    // Of the overlaps that the kernel holds.
    Sample meanOfOverlaps(Kernel& kernel) const {
        const auto mean = kernel.meanOfOverlaps(radiance_, shown_, sampling_.isMasked,
                                                static_cast<int>(kernel.overlaps.weights.size()));
        return kernel.probeSample(mean.rgb, mean.weight > T(0.0));
    }
    // Texels first ... first + active - 1 of a row, whose centres the source shows at middle().
    template <class Middle>
    void write(Kernel& kernel, int layer, size_t first, int active, int y, Sample sample,
               Middle&& middle) const {
        const auto l = static_cast<size_t>(layer);
        if (job_.hasBlindSpots) {
            const ShownColumns& on = shownColumns_[static_cast<size_t>(y)];
            const int from = static_cast<int>(first), to = from + active;
            T isOnImage(1.0);
            if (from < on.first || to > on.last)
                isOnImage = Number<T>::generate(
                    [&](int lane) { return from + lane >= on.first && from + lane < on.last ? 1.0 : 0.0; });
            sample = kernel.blackIfHidden(sample, isOnImage);
            std::array<float, kWidth> isValid;
            Number<T>::store(kernel.asNumber(sample.isShown), isValid.data(), active);
            uint8_t* valid = result_.valid[l].row(y).data() + first;
            for (int lane = 0; lane < active; lane++)
                valid[lane] = isValid[static_cast<size_t>(lane)] != 0.0f ? 1 : 0;
        }
        for (int c = 0; c < 3; c++)
            Number<T>::store(sample.rgb[c], result_.radiance[l].row(y, c).data() + first, active);
        if (job_.distance_m.empty()) return;
        Number<T>::store(
            kernel.nearestDistance(distance_m_, shown_, middle(), sampling_, nearest_, sample.isShown),
            result_.distance_m[l].row(y).data() + first, active);
    }

  private:
    static constexpr int kWidth = Number<T>::lanes;

    // Texels' coordinates stay in registers: as calls, the steps of the text pass them through memory.
    [[gnu::flatten]] Sample sampleFlattened(Kernel& kernel, const Point& p) const {
        return kernel.sampleProbe(radiance_, shown_, p, sampling_);
    }

    const ConversionJob& job_;
    Probe& result_;
    std::vector<ShownColumns> shownColumns_;
    TextureView radiance_, shown_, distance_m_;
    typename Kernel::ProbeSampling sampling_;
    typename Kernel::Sampling nearest_;
};

// The texels of a row from a column on as means of what they cover of the source.
template <class T>
void selectOverlaps(ConversionKernel<T>& kernel, const RowOverlaps& row, size_t first, int active) {
    using Integer = typename ConversionKernel<T>::integer;
    size_t count = 0;
    const auto countOf = [&](size_t x) { return row.first[x + 1] - row.first[x]; };
    for (size_t x = first; x < first + static_cast<size_t>(active); x++) count = std::max(count, countOf(x));
    LanedOverlaps<T>& overlaps = kernel.overlaps;
    overlaps.layers.resize(count);
    overlaps.columns.resize(count);
    overlaps.rows.resize(count);
    overlaps.weights.resize(count);
    for (size_t k = 0; k < count; k++) {
        const auto overlapOf = [&](int lane) -> TexelOverlap {
            const size_t x = first + static_cast<size_t>(std::min(lane, active - 1));
            return k < countOf(x) ? row.overlaps[row.first[x] + k] : TexelOverlap{0, 0, 0, 0.0};
        };
        const auto integers = [&](auto member) -> Integer {
            if constexpr (Number<T>::lanes == 1)
                return overlapOf(0).*member;
            else
                return Integer::generate([&](int lane) { return overlapOf(lane).*member; });
        };
        overlaps.layers[k] = integers(&TexelOverlap::layer);
        overlaps.columns[k] = integers(&TexelOverlap::x);
        overlaps.rows[k] = integers(&TexelOverlap::y);
        overlaps.weights[k] = Number<T>::generate([&](int lane) { return overlapOf(lane).weight; });
    }
}

// Texel by texel.
template <class T>
void convertTexels(const ConversionJob& job, const ConversionWriter<T>& writer) {
    using Kernel = ConversionKernel<T>;
    using vec3 = typename Kernel::vec3;
    constexpr int kWidth = Number<T>::lanes;
    const LanedDirections<T> centres(job.target);
    const auto turnRow = [&](int row) {
        return vec3(T(job.turn[0][row]), T(job.turn[1][row]), T(job.turn[2][row]));
    };
    const typename Kernel::TexelConversion conversion{
        centres.settings(), writer.source(), job.isTurned ? 1 : 0, turnRow(0), turnRow(1), turnRow(2)};
    parallelForRowBlocks(job.target.height, job.threads, [&](int y0, int y1) {
        Kernel kernel;
        kernel.conversion = conversion;
        std::vector<RowOverlaps> overlaps(static_cast<size_t>(y1 - y0));
        for (int layer = 0; layer < job.target.layers(); layer++) {
            if (job.overlaps != nullptr)
                for (int y = y0; y < y1; y++)
                    overlaps[static_cast<size_t>(y - y0)] = job.overlaps->ofRow(layer, y);
            forEachLaneGroup<kWidth>(static_cast<size_t>(job.target.width), [&](size_t first, int active) {
                for (int y = y0; y < y1; y++) {
                    const auto middle = [&] {
                        centres.select(kernel, first, y);
                        return kernel.texelPoint(typename Kernel::integer(layer));
                    };
                    typename Kernel::ProbeSample sample;
                    if (job.overlaps == nullptr) {
                        sample = writer.sampleAt(kernel, middle());
                    } else {
                        selectOverlaps(kernel, overlaps[static_cast<size_t>(y - y0)], first, active);
                        sample = writer.meanOfOverlaps(kernel);
                    }
                    writer.write(kernel, layer, first, active, y, sample, middle);
                }
            });
        }
    });
}

// The same bits for a lat-long source that is not turned, from fewer angles (mirrored_angles.h).
template <class T>
void convertMirrored(const ConversionJob& job, const ConversionWriter<T>& writer) {
    using Kernel = ConversionKernel<T>;
    using Stored = typename Number<T>::Stored;
    constexpr int kWidth = Number<T>::lanes;
    const MirroredAngles<T> angles(job.target);
    const int size = job.target.width;
    parallelForRowBlocks(size / 2, job.threads, [&](int y0, int y1) {
        Kernel kernel;
        std::vector<typename MirroredAngles<T>::Rows> rows;
        for (int y = y0; y < y1; y++) rows.push_back(angles.rowsAt(y));
        for (int layer = 0; layer < job.target.layers(); layer++)
            for (const bool isLower : {false, true})
                forEachLaneGroup<kWidth>(static_cast<size_t>(size), [&](size_t first, int active) {
                    for (int y = y0; y < y1; y++) {
                        const auto of = angles.rowOf(rows[static_cast<size_t>(y - y0)], layer, isLower);
                        const T latitude_rad = loadActive<Stored, kWidth>(of.latitude_rad + first, active);
                        const auto p = kernel.pointOfLatLong(kernel.coordinatesOfAngles(
                            loadActive<Stored, kWidth>(of.longitude_rad + first, active),
                            of.isBelow ? -latitude_rad : latitude_rad));
                        writer.write(kernel, layer, first, active, isLower ? size - 1 - y : y,
                                     writer.sampleAt(kernel, p), [&] { return p; });
                    }
                });
    });
}

template <class T>
void convertImages(const ConversionJob& job, Probe& result) {
    const ConversionWriter<T> writer(job, result);
    if constexpr (MirroredAngles<T>::kIsAvailable)
        if (MirroredAngles<T>::applies(job)) return convertMirrored<T>(job, writer);
    convertTexels<T>(job, writer);
}

template <class T>
void latLongFromCubeImage(const CubeMap<float>& cube, const LatLongFromCube& options, int threads,
                          Image<float>& latLong) {
    using Kernel = ConversionKernel<T>;
    constexpr int kWidth = Number<T>::lanes;
    const TextureView texture(cube);
    const auto sampling =
        samplingOf<Kernel>({options.filter, Wrap::clamp, Wrap::clamp, options.fractionBits, options.rule},
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
                    Number<T>::store(rgb[channel], latLong.row(y, channel).data() + first, active);
            }
        });
    });
}

}  // namespace etalon
