#include "ar/plan_facts.h"

#include <algorithm>
#include <bit>

#include "shadows/casting_lights.h"

namespace etalon {

VisibilityFacts visibilityFacts(const VisibleScene& visible, size_t objects) {
    VisibilityFacts facts;
    facts.objectVisible.assign(objects, false);
    facts.backgroundVisible = false;
    for (const uint32_t id : visible.target.id.values()) {
        if (id == kNoTriangle)
            facts.backgroundVisible = true;
        else
            facts.objectVisible[visible.instanceOfDraw[visible.target.triangles[id].draw]] = true;
    }
    return facts;
}

uint64_t shadowMemory(const LightShadow& shadow, bool isDirectional) {
    if (shadow.method == ShadowMethod::map)
        return (isDirectional ? 1 : kFacesPerCube) * squared(shadow.map.size) *
               (kBytesPerSample + 2 * sizeof(double));
    if (shadow.method == ShadowMethod::planar)
        return squared(shadow.planar.resolution) * (kBytesPerSample + sizeof(uint32_t) + sizeof(float));
    return 0;
}

bool holds(const Format& format, int n) {
    const int odd = n >> std::countr_zero(static_cast<unsigned>(n));
    return odd >> format.significandBits == 0 && n <= largestFinite(format);
}

std::vector<EnvironmentCaster> castersOf(const Environment& environment,
                                         const std::vector<ProbeLight>& lights) {
    std::vector<size_t> found =
        environment.shadowShare > 0
            ? lightsOfLargestShare(lights, environment.shadowShare)
            : lightsOfSmallestRegion(lights, static_cast<size_t>(environment.shadowLights));
    found.resize(std::min(found.size(), size_t{kMaxShadowLights}));
    const double total = energyOf(totalEnergy(lights));
    std::vector<EnvironmentCaster> casters;
    for (const size_t i : found)
        casters.push_back(
            {i, lights[i].solidAngle_sr, energyOf(lights[i].energy) / total, surfaceLightOf(lights[i])});
    return casters;
}

}  // namespace etalon
