// The shadows of a scene while it is rendered.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "ar/plan.h"
#include "lighting/geometry.h"
#include "lighting/light_visibility.h"
#include "lighting/surface_scene.h"
#include "raster/profile.h"
#include "shadows/joint_visibility.h"
#include "shadows/shadow_map.h"

namespace etalon {

class SceneShadows {
  public:
    // What is drawn, with all of its lights. Everything outlives the object. seed: the scene's. progress is
    // called with the name of each pass that begins; it may be empty.
    SceneShadows(const SurfaceScene& surfaces, const std::vector<PlacedMesh>& placed, const Profile& profile,
                 const RasterOptions& raster, uint64_t seed,
                 std::function<void(const std::string&)> progress);

    // For each of a plan's shadows the objects that VisibilityFacts::shadowObjects names; none for those that
    // do not run. receivers: for each instance whether shadows may fall on it. Planar shadows are drawn here:
    // only their images say where they fall.
    std::vector<std::vector<uint32_t>> find(std::span<const PlanShadow> shadows,
                                            const std::vector<bool>& receivers);
    // Draws the maps of the plan's shadows that run: those that find() was called with, in the same order.
    void make(std::span<const PlanShadow> shadows);

    // What stands in the way of the lights for points in any view; null: nothing, or volumes alone.
    const LightVisibility* common() const { return common_.get(); }
    // The same with the shadow volumes of one view; null where no light casts volumes. samples: of its
    // target; excluded: an instance that it does not show, or kNoInstance.
    std::unique_ptr<LightVisibility> ofView(const View& view, int samples, uint32_t excluded) const;

  private:
    const SurfaceScene& surfaces_;
    const std::vector<PlacedMesh>& placed_;
    const Profile& profile_;
    const RasterOptions& raster_;
    uint64_t seed_;
    std::function<void(const std::string&)> progress_;
    std::vector<ShadowFit> fits_;                       // for each shadow; of maps and volumes
    std::vector<std::vector<uint32_t>> volumeCasters_;  // for each light; empty: no light casts volumes
    JointVisibility::Ways ways_;                        // planar shadows, maps
    std::unique_ptr<const JointVisibility> common_;
};

}  // namespace etalon
