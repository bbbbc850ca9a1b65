// What the passes of probes/convert.h work on.
#pragma once

#include <span>
#include <vector>

#include "probes/convert.h"
#include "probes/texel_overlaps.h"

namespace etalon {

struct ConversionJob {
    ProbeShape source, target;
    std::span<const Image<float>> radiance;
    // Empty if every texel of the source is shown; else one channel of 1 and 0 per layer.
    std::span<const Image<float>> shown;
    std::span<const Image<float>> distance_m;  // or empty
    // Of a disc: within this radius all texels of a bilinear sample are shown. 0: unknown.
    double wholeRadius = 0;
    // From directions of the result to directions of the source.
    glm::dmat3 turn{1};
    bool isTurned = false;
    // A texel of the result may have no radiance.
    bool hasBlindSpots = false;
    Resampling resampling = Resampling::bilinear;
    const TexelOverlaps* overlaps = nullptr;  // of area
    int fractionBits = kExactFraction;
    FilterRule rule = {};
    int threads = 0;
};

}  // namespace etalon
