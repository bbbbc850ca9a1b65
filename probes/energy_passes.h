// Energies of counted radiance: a radiance counts if it is finite and not negative; other values count as 0.
#pragma once

#include <cstddef>

#include "probes/probe_light.h"
#include "raster/image.h"

namespace etalon {

// What a region of an image holds: per channel the sum of row weight times counted radiance, and the number
// of values that do not count.
//
// Each row is summed in 8 partial sums of every 8th value from the left, which are multiplied by the row's weight and
// added from above; then partial sum i + 4 is added to i, i + 2 to i, and 1 to 0. LightPasses::regionSums does so in
// every arithmetic; radiance beyond the largest finite number of the arithmetic counts as that number.
struct RegionSums {
    glm::dvec3 energy{0};
    size_t uncountedValues = 0;
};

// In double, once per instruction set level, with the same bits at every level.
struct EnergyPasses {
    // The summed-area table of rows [firstRow, lastRow) on their own; table holds them, row after row. Each
    // row is summed from the left, then these sums from above.
    void (*bandOfTable)(const Image<float>& radiance, int firstRow, int lastRow, const double* rowWeights,
                        double* table);
};

}  // namespace etalon
