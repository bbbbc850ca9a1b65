// Lights from a lat-long probe by median cut [Debevec05] [Pedersen2008, sec. 5.3.1]: the image is cut in two
// parts of about the same energy along its longer side, each part likewise, and so on; every part becomes a
// light with the part's energy.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "numeric/arithmetic.h"
#include "probes/probe.h"
#include "probes/probe_light.h"
#include "probes/summed_area.h"

namespace etalon {

// The weight of a texel in a row, and so what its energy is times its radiance. Rows are numbered from the
// pole +Y; theta is the angle from there, D the steps of longitude and theta.
//   exact: the texel's solid angle; all add up to 4 pi
//   midpoint: D D sin(theta) at the texel's centre; sums to 4 pi (1 + pi^2 / (24 H^2)) to first order
//   edge: D D sin(theta) at its edge towards +Y, where the first row weighs nothing; the sum is
//     4 pi (1 - pi^2 / (12 H^2)) to first order
//   uniform: the same for every row, 4 pi in all: as if the sine were forgotten
enum class TexelWeight : uint8_t { exact, midpoint, edge, uniform };
std::vector<double> texelWeights(int width, int height, TexelWeight weight);

// Which side of a region is the longer one.
//   angle: its extents in longitude and latitude are compared as angles: texels, if the image is twice as
//     wide as high
//   arc: the extent in longitude is that of the parallel through its middle, the angle times the cosine of
//     the latitude
enum class LongerSide : uint8_t { angle, arc };

// Where the light of a region lies in the image.
//   centre: in the middle of its rectangle
//   centroid: in the mean of its texels' centres, weighted by their energy
//   median: in the centre of the texel in whose column and row the energy of the columns before it, and the
//     rows, reaches half of the region's
//   centroidTwice: as centroid, with the row's weight taken twice: as of an image that had been multiplied by
//     the weights before; of the tested ways the one nearest to the means that [Pedersen2008, Table 7.1]
//     prints (docs/experiments/lights.md)
enum class LightPlace : uint8_t { centre, centroid, median, centroidTwice };

// K beyond which nothing changes: no image has more texels.
inline constexpr int kMaxLog2Lights = 32;

struct MedianCut {
    int log2Count = 6;  // K >= 0: 2^K lights
    LongerSide side = LongerSide::arc;
    LightPlace place = LightPlace::centroid;
    TexelWeight weight = TexelWeight::exact;
    // A region whose sides are of the same length is cut into a left and a right part, else into an upper and
    // a lower one.
    bool cutsSquaresInColumns = false;
};

struct LightsOfProbe {
    std::vector<ProbeLight> lights;
    // Negative, infinite and NaN values of the radiance, which count as 0.
    size_t uncountedValues = 0;
};

// The lights of a lat-long probe: 2^K, or fewer, because a region of one texel stays whole. So an image has
// no more lights than texels, and a probe with a sun of one texel soon has fewer than 2^K. Left and upper
// parts come before right and lower ones. PreconditionError for other mappings and log2Count < 0.
//
// Cut: between two columns, or two rows, so that the energies of the parts (from an EnergyTable) differ
// least; of several such places the first one. A region whose energy is not known from 0
// (EnergyTable::noise), as in a black probe, is cut in the middle, and its light is at the centre; an odd
// texel falls to the right or lower part. A region one texel wide or high is cut along its other side,
// whichever is longer.
//
// Each light's energy is the sum over its texels of weight times counted radiance (probes/energy_passes.h),
// not taken from the table: exactly 0 for black regions, relative error at most (width + height of the
// region) 2^-53 per channel; texels marked invalid count as black. So the lights' energies sum to the probe's
// energy within (width + height of the image + number of lights) 2^-53 relative, whatever the options but the
// weight.
//
// position_m: where the probe has distances, of the texel that the light lies in, if that distance is finite
// and above 0. `threads` as in parallelFor; neither it nor the instruction set changes a bit.
LightsOfProbe medianCutLights(const Probe& probe, const MedianCut& options = {}, int threads = 0);

// The same with the texels' energies, their summed-area table (summedArea) and the lights' energies in an arithmetic;
// differences of the table's entries, places and solid angles stay in double.
LightsOfProbe medianCutLights(const Probe& probe, const MedianCut& options, Arithmetic arithmetic,
                              int threads = 0);

// Its two steps, for tables of another arithmetic: the regions, and their lights. The table and the regions
// are of the probe's size.
std::vector<TexelRegion> medianCutRegions(const EnergyTable& table, const MedianCut& options);
LightsOfProbe lightsOfRegions(const Probe& probe, const EnergyTable& table,
                              std::span<const TexelRegion> regions, const MedianCut& options,
                              int threads = 0);

}  // namespace etalon
