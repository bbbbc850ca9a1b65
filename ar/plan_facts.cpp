#include "ar/plan_facts.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "numeric/text.h"
#include "probes/dominant_lights.h"
#include "shadows/casting_lights.h"
#include "shadows/shadow_map.h"

namespace etalon {
namespace {

// Whether the whole number n > 0 is a number of the format.
bool holds(const Format& format, int n) {
    const int odd = n >> std::countr_zero(static_cast<unsigned>(n));
    return odd >> format.significandBits == 0 && n <= largestFinite(format);
}

}  // namespace

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

uint64_t shadowMapTexels(const ShadowMapSettings& map, bool isDirectional) {
    if (isDirectional) return squared(map.size);
    return kFacesPerCube * squared(map.size + 2 * (filterReach_texels(map) + 1));
}

uint64_t shadowMemory(const LightShadow& shadow, bool isDirectional, size_t receivers) {
    if (shadow.method == ShadowMethod::planar)
        return receivers * squared(shadow.planar.resolution) *
               (kBytesPerSample + sizeof(uint32_t) + sizeof(float));
    if (shadow.method != ShadowMethod::map) return 0;
    // Drawn, and kept where it is an output; what is looked up has a border, numbers of at most 8 bytes, and their
    // ranges in blocks of 8 x 8.
    constexpr int kMostLanes = 16;
    const int border = 2 * filterReach_texels(shadow.map) + 2;
    const uint64_t drawn = shadowMapTexels(shadow.map, isDirectional),
                   faces = isDirectional ? 1 : kFacesPerCube;
    const uint64_t texelsOfFace = drawn / faces;
    const int width = static_cast<int>(std::ceil(std::sqrt(static_cast<double>(texelsOfFace)))) + 2 * border +
                      kMostLanes + 1;
    return drawn * (kBytesPerSample + sizeof(uint32_t)) +
           faces * (squared(width) + 2 * squared(width / 8 + 1)) * sizeof(double);
}

uint64_t volumeMemory(const Scene& scene, const Profile& profile, uint64_t samples) {
    uint64_t volumes = 0;
    for (const SceneLight& light : scene.lights)
        volumes += light.shadow.method == ShadowMethod::volume ? 1 : 0;
    const Environment& environment = scene.environment;
    if (environment.shadow.method == ShadowMethod::volume)
        volumes += static_cast<uint64_t>(
            std::min(environment.shadowShare > 0 ? kMaxShadowLights : environment.shadowLights,
                     std::max(environment.lightCount, DominantLightSearch{}.maxLights)));
    return volumes > 0
               ? samples * (bytesPerVisibleSample(profile) + kBytesOfWideStencil + sizeof(uint32_t) + volumes)
               : 0;
}

void requireSampling(const Scene& scene, const Profile& profile, const Arithmetic& arithmetic,
                     const char* what, int line, int width, int height) {
    if (!arithmetic.format) return;
    for (const int size : {width, height})
        if (size > 0 && !holds(*arithmetic.format, size))
            throw InputError(formatText(
                "{}: {} of {}x{} texels cannot be sampled in the profile {}: its format holds no {}",
                where(scene, line), what, width, height, profile.name, size));
}

std::string castersText(const std::vector<EnvironmentCaster>& casters, size_t lights) {
    double share = 0;
    for (const EnvironmentCaster& caster : casters) share += caster.share;
    return formatText("; {} of its {} lights may cast shadows, with {:.3g} % of the energy", casters.size(),
                      lights, 100 * share);
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
