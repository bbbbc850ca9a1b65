#include "lighting/tone_map.h"

#include "numeric/check.h"
#include "numeric/door.h"
#include "numeric/format.h"

namespace etalon {

double exposureScale(double stops) {
    ETALON_CHECK(stops >= -kMaxExposureStops && stops <= kMaxExposureStops, "{} stops", stops);
    const double whole = floorOf(stops);
    return powerOfTwo(static_cast<int>(whole)) * powOf(2.0, stops - whole);
}

Image<uint8_t> toneMap(const Image<float>& radiance, ToneMap operation, double exposureStops, int threads) {
    return levelPasses<ToneMapPasses>().toneMap(radiance, operation, exposureStops, threads);
}

}  // namespace etalon
