#include "probes/latlong.h"

#include "numeric/check.h"
#include "numeric/door.h"
#include "numeric/vectors.h"
#include "probes/mapping_passes.h"

namespace etalon {

namespace {

// The double next to pi.

}  // namespace

LatLongGrid::LatLongGrid(int width, int height) {
    ETALON_CHECK(width >= 1 && height >= 1, "{}x{}", width, height);
    for (int x = 0; x < width; x++) {
        // longitude = 2 pi (1/2 - u)
        const double longitude_rad = kPi * ((width - 1.0 - 2.0 * x) / width);
        sinLongitude_.push_back(sinOf(longitude_rad));
        cosLongitude_.push_back(cosOf(longitude_rad));
    }
    // sin(upper border) - sin(lower border) = 2 cos(centre) sin(half the height)
    const double halfHeight_rad = 0.5 * kPi / height;
    const double perCosine_sr = 2.0 * kPi / width * (2.0 * sinOf(halfHeight_rad));
    for (int y = 0; y < height; y++) {
        const double latitude_rad = 0.5 * kPi * ((height - 1.0 - 2.0 * y) / height);
        sinLatitude_.push_back(sinOf(latitude_rad));
        cosLatitude_.push_back(cosOf(latitude_rad));
        solidAngle_sr_.push_back(perCosine_sr * cosLatitude_.back());
    }
}

CubeMap<float> cubeFromLatLong(const Image<float>& latLong, int size, const CubeFromLatLong& options,
                               int threads) {
    return passesIn<MappingPasses>(Arithmetic::fp32)->cubeFromLatLong(latLong, size, options, threads);
}

}  // namespace etalon
