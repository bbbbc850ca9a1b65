#include "shadows/planar_lights.h"

#include <algorithm>
#include <cmath>

#include "numeric/random.h"
#include "shadows/light_samples.h"

namespace etalon {
namespace {

glm::dvec4 centreOf(const SurfaceLight& light) {
    return light.kind == LightKind::directional ? glm::dvec4(light.toLight, 0)
                                                : glm::dvec4(light.position_m, 1);
}

}  // namespace

std::vector<glm::dvec4> planarLightSamples(const SurfaceLight& light, const PlanarLightSettings& settings,
                                           const glm::dvec3& towards_m) {
    DiscPatch disc;
    disc.centre = centreOf(light);
    if (light.kind == LightKind::directional) {
        disc.axis = light.toLight;
        disc.radius = settings.tangentOfHalfAngle;
    } else {
        const glm::dvec3 p = light.position_m;
        const glm::dvec3 axis(towards_m.x - p.x, towards_m.y - p.y, towards_m.z - p.z);
        if (axis.x != 0 || axis.y != 0 || axis.z != 0) disc.axis = axis;
        disc.radius = settings.lightSize_m / 2;
    }
    return lightSamples(disc, settings.samples, settings.seed);
}

std::vector<PlanarVisibility::Entry> planarShadowsOf(const SurfaceLight& light, size_t number,
                                                     std::span<const PlacedMesh> placed,
                                                     const PlanarLightSettings& settings,
                                                     const std::vector<bool>& receivers,
                                                     const Profile& profile, const RasterOptions& raster) {
    std::vector<PlanarVisibility::Entry> entries;
    const glm::dvec4 centre = centreOf(light);
    if (!(std::isfinite(centre.x) && std::isfinite(centre.y) && std::isfinite(centre.z))) return entries;
    PlanarLightSettings own = settings;
    own.seed = Random(settings.seed + number).next();
    PlanarShadowOptions options;
    options.resolution = settings.resolution;
    options.blurSigma_m = settings.blurSigma_m;
    for (size_t i = 0; i < placed.size(); i++) {
        if (!receivers.empty() && !receivers[i]) continue;
        auto receiver = planarReceiverOf(placed[i]);
        if (!receiver) continue;
        if (receiver->frame.toFrame(centre).z < 0) receiver = receiver->reversed();
        std::vector<const PlacedMesh*> others;
        for (size_t k = 0; k < placed.size(); k++)
            if (k != i) others.push_back(&placed[k]);
        const PlanarCasters casters = castersAbove(receiver->frame, others, options.contact_m);
        const glm::dvec2 lowest = receiver->lowest_m(), highest = receiver->highest_m();
        const glm::dvec3 middle =
            receiver->frame.toWorld((lowest.x + highest.x) / 2, (lowest.y + highest.y) / 2);
        PlanarShadow shadow = planarShadow(*receiver, casters, planarLightSamples(light, own, middle),
                                           options, profile, raster);
        const auto texels = shadow.shadow.values();
        if (std::any_of(texels.begin(), texels.end(), [](float v) { return v > 0; }))
            entries.push_back({number, static_cast<uint32_t>(i), std::move(shadow)});
    }
    return entries;
}

}  // namespace etalon
