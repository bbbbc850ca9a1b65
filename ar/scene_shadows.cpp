#include "ar/scene_shadows.h"

#include "shadows/planar_lights.h"
#include "shadows/shadow_maps.h"
#include "shadows/volume_shadows.h"

namespace etalon {

SceneShadows::SceneShadows(const SurfaceScene& surfaces, const std::vector<PlacedMesh>& placed,
                           const Profile& profile, const RasterOptions& raster, uint64_t seed,
                           std::function<void(const std::string&)> progress)
    : surfaces_(surfaces),
      placed_(placed),
      profile_(profile),
      raster_(raster),
      seed_(seed),
      progress_(std::move(progress)) {}

std::vector<std::vector<uint32_t>> SceneShadows::find(std::span<const PlanShadow> shadows,
                                                      const std::vector<bool>& receivers) {
    std::vector<std::vector<uint32_t>> objects(shadows.size());
    fits_.resize(shadows.size());
    std::vector<PlanarVisibility::Entry> planar;
    for (size_t i = 0; i < shadows.size(); i++) {
        const PlanShadow& shadow = shadows[i];
        if (!shadow.runs) continue;
        if (shadow.shadow->method != ShadowMethod::planar) {
            fits_[i] = fitShadowMap(placed_, surfaces_.lights[shadow.index], receivers, shadow.shadow->map);
            objects[i] = fits_[i].casters;
            continue;
        }
        if (progress_) progress_("planar shadows");
        PlanarLightSettings settings = shadow.shadow->planar;
        settings.seed = seed_;
        for (auto& entry :
             planarShadowsOf(surfaces_, placed_, shadow.index, settings, receivers, profile_, raster_)) {
            objects[i].push_back(entry.instance);
            planar.push_back(std::move(entry));
        }
    }
    if (!planar.empty()) ways_.push_back(std::make_shared<PlanarVisibility>(std::move(planar), profile_));
    return objects;
}

void SceneShadows::make(std::span<const PlanShadow> shadows) {
    std::shared_ptr<ShadowMaps> maps;
    for (size_t i = 0; i < shadows.size(); i++) {
        const PlanShadow& shadow = shadows[i];
        if (!shadow.runs) continue;
        if (shadow.shadow->method == ShadowMethod::volume) {
            volumeCasters_.resize(surfaces_.lights.size());
            volumeCasters_[shadow.index] = fits_[i].casters;
        }
        if (shadow.shadow->method != ShadowMethod::map) continue;
        if (progress_) progress_("shadow map");
        ShadowMapSettings settings = shadow.shadow->map;
        settings.seed = seed_;
        if (!maps) maps = std::make_shared<ShadowMaps>(surfaces_.lights.size());
        maps->set(shadow.index, renderShadowMap(surfaces_, placed_, fits_[i], settings, profile_, raster_),
                  profile_, raster_.threads);
    }
    if (maps) ways_.push_back(std::move(maps));
    if (!ways_.empty()) common_ = std::make_unique<JointVisibility>(ways_);
}

std::unique_ptr<LightVisibility> SceneShadows::ofView(const View& view, int samples,
                                                      uint32_t excluded) const {
    if (volumeCasters_.empty()) return nullptr;
    if (progress_) progress_("shadow volumes");
    VolumeShadowOptions options;
    options.samples = samples;
    options.excluded = excluded;
    options.casters = volumeCasters_;
    JointVisibility::Ways ways = ways_;
    ways.push_back(std::make_shared<VolumeShadows>(surfaces_, placed_, view, profile_, options, raster_));
    return std::make_unique<JointVisibility>(std::move(ways));
}

}  // namespace etalon
