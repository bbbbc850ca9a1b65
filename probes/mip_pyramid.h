// Levels of half the size of a lat-long or cube probe, filtered by solid angle.
#pragma once

#include <vector>

#include "probes/probe.h"

namespace etalon {

// Level 0 is the probe itself; each next one has half the width and height (rounded down, at least 1), down
// to 1x1 per image. A texel is the mean of the radiance of the texels that it covers, weighted with the exact
// solid angle of each one's part in it: where a size is odd, texels are cut. So every level has the same
// solid-angle weighted mean, but for rounding to float. Sums are in double, row by row. A texel of which the
// larger part of the solid angle is not valid is not valid; else the mean is over the valid part. NaN and
// infinities go into the texels that cover them. Distances are not kept: a mean distance belongs to no
// surface. PreconditionError for other mappings.
std::vector<Probe> mipPyramid(const Probe& probe, int threads = 0);

}  // namespace etalon
