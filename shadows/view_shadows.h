// The shadows of one view: volumes for some lights, another method for the others.
#pragma once

#include <utility>

#include "shadows/volume_shadows.h"

namespace etalon {

class ViewShadows final : public LightVisibility {
  public:
    // others: asked about lights without volumes; outlives this. Null: nothing else casts.
    ViewShadows(VolumeShadows volumes, const LightVisibility* others)
        : volumes_(std::move(volumes)), others_(others) {}

    bool casts(size_t light) const override {
        return volumes_.casts(light) || (others_ && others_->casts(light));
    }
    void find(size_t light, const LitPoints& points, std::span<double> visibility) const override {
        const LightVisibility* method = &volumes_;
        if (!volumes_.casts(light)) method = others_;
        method->find(light, points, visibility);
    }

  private:
    VolumeShadows volumes_;
    const LightVisibility* others_;
};

}  // namespace etalon
