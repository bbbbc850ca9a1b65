// How much bias a plane needs that is drawn into its own shadow map.
#pragma once

#include "shadows/shadow_map.h"

namespace etalon {

// The least bias with which every point of an unoccluded plane is lit exactly (visibility 1), with the
// filters hard and pcf in fp32 or better, whatever the angle of the light up to 89.9 degrees from the normal.
//
// With the receiver's plane the reference at each texel is the plane's own depth there; what is left are the
// snapping of the vertices (2^-9 texels each, rule 3), their fp32 positions, and one unit of the depth
// format. Without it, the reference is that of the point, and a texel of the window lies up to (taps + 1) / 2
// texels away on each axis, where the plane may be nearer by that much of each slope: the larger slope twice.
inline constexpr double kPlaneConstantBias = 4, kPlaneSlopeBias = 1.0 / 16;
inline DepthBias leastBias(const ShadowMapSettings& settings) {
    const int taps = settings.filter == ShadowFilter::hard ? 1 : settings.taps;
    return {kPlaneConstantBias, settings.receiverPlane ? kPlaneSlopeBias : taps + 1 + kPlaneSlopeBias, 0};
}

}  // namespace etalon
