// The shadow maps of a scene's lights, as what stands between the lights and the points.
#pragma once

#include <memory>
#include <vector>

#include "lighting/light_visibility.h"
#include "shadows/lookup_passes.h"

namespace etalon {

class ShadowMaps final : public LightVisibility {
  public:
    // Lights without a map reach every point.
    explicit ShadowMaps(size_t lights) : entries_(lights) {}

    // The map of a light, looked up in the profile's fragment arithmetic with its fraction bits.
    void set(size_t light, ShadowMap map, const Profile& profile, int threads);

    // That look-ups hold.
    uint64_t memory_bytes() const;

    bool casts(size_t light) const override { return entries_[light].lookup != nullptr; }
    void find(size_t light, const LitPoints& points, std::span<double> visibility) const override {
        entries_[light].lookup->find(points, visibility);
    }

  private:
    struct Entry {
        std::unique_ptr<ShadowMap> map;
        std::unique_ptr<ShadowLookup> lookup;
    };
    std::vector<Entry> entries_;
};

}  // namespace etalon
