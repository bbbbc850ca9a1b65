#include "shadows/casting_lights.h"

#include <algorithm>
#include <cmath>

#include "numeric/check.h"

namespace etalon {
namespace {

std::vector<size_t> lightsThatShine(std::span<const ProbeLight> lights) {
    std::vector<size_t> found;
    for (size_t i = 0; i < lights.size(); i++) {
        const double energy = energyOf(lights[i].energy);
        if (energy > 0 && std::isfinite(energy)) found.push_back(i);
    }
    return found;
}

}  // namespace

std::vector<size_t> lightsOfSmallestRegion(std::span<const ProbeLight> lights, size_t count) {
    std::vector<size_t> found = lightsThatShine(lights);
    std::ranges::stable_sort(found, [&](size_t a, size_t b) {
        if (lights[a].solidAngle_sr != lights[b].solidAngle_sr)
            return lights[a].solidAngle_sr < lights[b].solidAngle_sr;
        return energyOf(lights[a].energy) > energyOf(lights[b].energy);
    });
    found.resize(std::min(found.size(), count));
    return found;
}

std::vector<size_t> lightsOfLargestShare(std::span<const ProbeLight> lights, double share) {
    ETALON_CHECK(share > 0 && share <= 1, "{}", share);
    std::vector<size_t> found = lightsThatShine(lights);
    double total = 0;
    for (const size_t i : found) total += energyOf(lights[i].energy);
    std::erase_if(found, [&](size_t i) { return !(energyOf(lights[i].energy) >= share * total); });
    std::ranges::stable_sort(
        found, [&](size_t a, size_t b) { return energyOf(lights[a].energy) > energyOf(lights[b].energy); });
    return found;
}

}  // namespace etalon
