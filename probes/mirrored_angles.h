// Longitudes and latitudes of the texels of a cube, disc or octahedral image from those of a quarter of it.
//
// Columns x and size - 1 - x of an image lie at coordinates of opposite sign, if these are exact, and so do
// rows. Then the directions of mirrored texels differ by the sign of a component only, to the bit. The
// kernel's longitude is odd in x and its latitude odd in y and even in x and z, again to the bit, but where a
// component vanishes. So each angle here is the one that the kernel gives for the texel's own direction. On a
// cube besides: a column of a side face has one longitude, the side faces share latitudes, and the faces +Y
// and -Y have each other's rows upside down.
#pragma once

#include <algorithm>
#include <vector>

#include "probes/conversion_job.h"
#include "probes/laned_directions.h"

namespace etalon {

template <class T>
class MirroredAngles {
    static constexpr int kWidth = Number<T>::lanes;

  public:
    using Stored = typename Number<T>::Stored;
    // Formats that are emulated have rules of their own for small numbers.
    static constexpr bool kIsAvailable = std::is_same_v<T, Lanes<Stored, kWidth>>;

    static bool applies(const ConversionJob& job) {
        return job.source.mapping == Mapping::latLong && !job.isTurned && !isLatLong(job.target.mapping) &&
               job.resampling != Resampling::area && isMirrored(job.target.width);
    }

    // The columns of the target's side faces, if it is a cube.
    explicit MirroredAngles(const ProbeShape& target)
        : target_(target), directions_(target), size_(static_cast<size_t>(target.width)) {
        if (!isCube()) return;
        Kernel kernel;
        for (int layer = 0; layer < kCubeFaces; layer++) {
            std::vector<Stored>& columns = ofColumns_.emplace_back(size_);
            if (isSide(layer))
                forEachLaneGroup<kWidth>(size_, [&](size_t first, int active) {
                    storeActive(kernel.longitudeOf(directions_.at(kernel, layer, first, 0)),
                                columns.data() + first, active);
                });
        }
    }

    // The angles of row y, in the upper half, and of its mirror image.
    struct Rows {
        // Of a cube's face +Y; of other images the upper one serves both rows.
        std::vector<Stored> upperLongitude_rad, lowerLongitude_rad;
        std::vector<Stored> latitude_rad;
        // Of the side faces.
        std::vector<Stored> sideLatitude_rad;
    };
    Rows rowsAt(int y) const {
        const int layer = isCube() ? kUpperFace : 0;
        Rows rows;
        rows.upperLongitude_rad = longitudes(layer, y);
        rows.latitude_rad = latitudes(layer, y);
        if (isCube()) {
            rows.lowerLongitude_rad = longitudes(layer, target_.width - 1 - y);
            rows.sideLatitude_rad = latitudes(kFrontFace, y);
        }
        return rows;
    }

    // Where the angles of a layer's row lie, and whether its latitudes are of the other sign.
    struct Row {
        const Stored* longitude_rad;
        const Stored* latitude_rad;
        bool isBelow;
    };
    Row rowOf(const Rows& rows, int layer, bool isLower) const {
        if (!isCube()) return {rows.upperLongitude_rad.data(), rows.latitude_rad.data(), isLower};
        if (isSide(layer))
            return {ofColumns_[static_cast<size_t>(layer)].data(), rows.sideLatitude_rad.data(), isLower};
        const bool isUpper = layer == kUpperFace;
        const std::vector<Stored>& longitude_rad =
            isUpper == isLower ? rows.lowerLongitude_rad : rows.upperLongitude_rad;
        return {longitude_rad.data(), rows.latitude_rad.data(), !isUpper};
    }

  private:
    using Kernel = ConversionKernel<T>;
    static constexpr int kUpperFace = 2, kLowerFace = 3, kFrontFace = 4;

    static bool isMirrored(int size) {
        if (size % 2 != 0) return false;
        for (int i = 0; 2 * i < size; i++) {
            const auto at = [&](int x) {
                return Stored(2.0) * static_cast<Stored>(coordinateOf(x, 0, size, 1)) - Stored(1.0);
            };
            if (at(i) != -at(size - 1 - i)) return false;
        }
        return true;
    }
    bool isCube() const { return target_.mapping == Mapping::cube; }
    static bool isSide(int layer) { return layer != kUpperFace && layer != kLowerFace; }

    // value(direction, angle, mirrored) of the left half of a row.
    template <class Value>
    std::vector<Stored> mirrored(int layer, int y, Value&& value) const {
        std::vector<Stored> angles(size_), right(size_ / 2);
        Kernel kernel;
        forEachLaneGroup<kWidth>(size_ / 2, [&](size_t first, int active) {
            T left, mirror;
            value(kernel, directions_.at(kernel, layer, first, y), left, mirror);
            storeActive(left, angles.data() + first, active);
            storeActive(mirror, right.data() + first, active);
        });
        std::reverse_copy(right.begin(), right.end(), angles.begin() + static_cast<ptrdiff_t>(size_ / 2));
        return angles;
    }
    std::vector<Stored> longitudes(int layer, int y) const {
        return mirrored(layer, y, [](Kernel& kernel, const auto& d, T& left, T& mirror) {
            left = kernel.longitudeOf(d);
            // 0 has no sign: what looks along -z has the longitude pi on both sides.
            mirror = kernel.select(d.x == T(0.0), left, -left);
        });
    }
    std::vector<Stored> latitudes(int layer, int y) const {
        return mirrored(layer, y, [](Kernel& kernel, const auto& d, T& left, T& mirror) {
            left = mirror = kernel.latitudeOf(d);
        });
    }

    ProbeShape target_;
    LanedDirections<T> directions_;
    size_t size_;
    std::vector<std::vector<Stored>> ofColumns_;
};

}  // namespace etalon
