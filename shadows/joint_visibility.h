// Several ways to find what stands between lights and points, together: maps for some lights, planar shadows
// or volumes for others.
#pragma once

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

#include "lighting/light_visibility.h"

namespace etalon {

// A light's visibility is that of the first way in which it casts.
class JointVisibility final : public LightVisibility {
  public:
    using Ways = std::vector<std::shared_ptr<const LightVisibility>>;
    explicit JointVisibility(Ways ways) : ways_(std::move(ways)) {}

    bool casts(size_t light) const override { return wayOf(light) != ways_.end(); }
    void find(size_t light, const LitPoints& points, std::span<double> visibility) const override {
        (*wayOf(light))->find(light, points, visibility);
    }

  private:
    Ways::const_iterator wayOf(size_t light) const {
        return std::ranges::find_if(ways_, [&](const auto& way) { return way->casts(light); });
    }
    Ways ways_;
};

}  // namespace etalon
