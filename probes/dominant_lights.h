// The dominant lights of a probe by their brightness in a coarse image, after [Karlsson2005, sec. 3.1]: what
// is brighter than a threshold in an image of low resolution, connected parts together, is a light.
//
// Named differences to the paper: several lights, not only the brightest; directions by the solid angle of
// the texels of any mapping, where the paper reflects at the ball (for a mirror ball the same directions).
#pragma once

#include <vector>

#include "probes/probe.h"
#include "probes/probe_light.h"

namespace etalon {

struct DominantLightSearch {
    // Texels along the width of the coarse image, each the mean of a block of the probe's texels (no more
    // than the probe's own width); the height is in proportion, at least 1.
    int width = 32;
    // A texel belongs to a light if its brightness R + G + B is at least this fraction of the brightest
    // texel's and above 0. In (0, 1].
    double threshold = 0.5;
    // Above 0: at least this brightness as well, in W/(m^2 sr).
    double minBrightness = 0.0;
    // Only directions with y > 0 in the world, as in the paper: lights that cast shadows on a floor.
    bool upperHalf = false;
    int maxLights = 8;  // at least 1
};

struct DominantLight {
    // Direction: the mean of its coarse texels' directions, weighted with brightness and solid angle (that of
    // the brightest texel, should they cancel). Energy, solid angle: sums over them. Region: the smallest
    // rectangle of the coarse image that holds them; across the left and right border of a lat-long image it
    // is the whole width. Position: by the distance of the probe's texel in the brightest coarse texel's
    // middle, if that is finite and above 0.
    ProbeLight light;
    double peakBrightness = 0;     // of its brightest coarse texel, W/(m^2 sr)
    double angularRadius_rad = 0;  // of a cone of the same solid angle
    int texels = 0;                // of the coarse image
};

// The lights, those of the largest energy (energyOf) first; of equal ones that whose first texel comes first.
// None for a black probe. Texels that touch along a side or at a corner are connected; in a lat-long image
// also across the left and right border and over the poles; in the other mappings not across borders of
// images. Values that do not count are black (probes/energy_passes.h), as are texels marked invalid.
// PreconditionError for a cube map and for settings outside their ranges.
std::vector<DominantLight> dominantLights(const Probe& probe, const DominantLightSearch& search = {});

}  // namespace etalon
