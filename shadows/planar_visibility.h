// Planar shadows as what stands between lights and points, and as images of a receiver.
#pragma once

#include <span>
#include <vector>

#include "lighting/light_visibility.h"
#include "raster/profile.h"
#include "shadows/planar_passes.h"
#include "shadows/planar_shadow.h"

namespace etalon {

// Shadows of lights on instances that are planes (planarReceiverOf). A point of such an instance gets 1 -
// shadow from the texture, bilinear or as the profile samples float textures; points of other instances, and
// those of receivers without a texel of shadow, get exactly 1.
class PlanarVisibility final : public LightVisibility {
  public:
    struct Entry {
        size_t light = 0;
        uint32_t instance = 0;  // the receiver
        PlanarShadow shadow;
    };
    // The profile outlives the object. Several entries of one light and instance: their product, in
    // the fragment arithmetic.
    PlanarVisibility(std::vector<Entry> entries, const Profile& profile);

    bool casts(size_t light) const override;
    void find(size_t light, const LitPoints& points, std::span<double> visibility) const override;

  private:
    std::vector<Entry> entries_;
    const Profile* profile_;
};

// One light of a composition: its shadow, and its part of what the receiver gets without shadows
// (irradiance), >= 0.
struct WeightedShadow {
    const PlanarShadow* shadow = nullptr;
    double irradiance = 0;
};

// What remains of the lights' irradiance at the centres of a grid's texels: 1 - sum(E_i shadow_i) / sum(E_i),
// in double in the order of the lights, so that each shadow takes away no more than its own light's share;
// exactly 1 where no light has a shadow, and everywhere outside the receiver's polygon. 1 if the sum of the
// shares is 0. The shadows are read as PlanarVisibility reads them.
Image<float> composeShadows(const PlanarReceiver& receiver, const PlanarGrid& grid,
                            std::span<const WeightedShadow> lights, const Profile& profile,
                            const RasterOptions& raster);

}  // namespace etalon
