// Which of a probe's lights cast shadows, where shadows of all would cost too much.
#pragma once

#include <span>
#include <vector>

#include "probes/probe_light.h"

namespace etalon {

// The indices of the `count` lights that stand for the smallest solid angles, smallest first: median cut
// gives lights of about the same energy, of which these are the most concentrated and their shadows the
// sharpest [Pedersen2008, sec. 5.3.1]. Of equal solid angles the light of the larger energy comes first, then
// the one that comes first in `lights`. All of them, so ordered, if there are no more than `count`. Black
// lights, and those whose energy is not a finite number, are left out.
std::vector<size_t> lightsOfSmallestRegion(std::span<const ProbeLight> lights, size_t count);

// The indices of the lights whose energy is at least `share` of the sum over the lights (energyOf), largest
// first; of equal energies the one that comes first in `lights`. share is in (0, 1]; there are at most
// 1 / share of them, rounding aside. None where the sum is not above 0; lights are left out as above.
std::vector<size_t> lightsOfLargestShare(std::span<const ProbeLight> lights, double share);

}  // namespace etalon
