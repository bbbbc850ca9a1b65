#include "raster/exact_depth.h"

#include "numeric/truth.h"

namespace etalon {
namespace {

// The depth times its area.
Truth scaledDepth(const ExactDepth& depth) {
    const Truth area(static_cast<double>(depth.area)), zero(0.0);
    Truth sum = Truth(depth.bias) * area;
    for (size_t i = 0; i < 3; i++) sum = sum + Truth(static_cast<double>(depth.e[i])) * Truth(depth.z[i]);
    if (!depth.isCut) return sum;
    return sum < zero ? zero : area < sum ? area : sum;
}

}  // namespace

int compareDepths(const ExactDepth& a, const ExactDepth& b) {
    const Truth left = scaledDepth(a) * Truth(static_cast<double>(b.area)),
                right = scaledDepth(b) * Truth(static_cast<double>(a.area));
    return left < right ? -1 : right < left ? 1 : 0;
}

}  // namespace etalon
