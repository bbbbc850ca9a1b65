// Shadows as a mask in the image [Karlsson2005, sec. 3.2.3]: the shadow map is compared once per pixel, the
// lit parts are an image, the image is blurred, and its pixels are multiplied with the light.
//
// The blur has the same width in pixels everywhere and knows nothing of surfaces: it runs over the outlines
// of objects, grows on a surface with its distance from the eye, and is narrower where the surface is seen at
// an angle. Percentage-closer filtering blurs in the map instead: over what the light sees, whatever the eye
// sees.
#pragma once

#include <vector>

#include "lighting/light_visibility.h"
#include "lighting/shade.h"
#include "raster/image.h"

namespace etalon {

// The lit part of each pixel, from job.visibility; 1 where nothing is visible and where the light is not
// blocked. One sample per pixel.
Image<float> screenMask(const ShadeJob& job, size_t light);

// Looks masks up by pixel; lights without one reach every point.
class ScreenMasks final : public LightVisibility {
  public:
    explicit ScreenMasks(size_t lights) : masks_(lights) {}

    void set(size_t light, Image<float> mask) { masks_[light] = std::move(mask); }

    bool casts(size_t light) const override { return !masks_[light].empty(); }
    void find(size_t light, const LitPoints& points, std::span<double> visibility) const override;

  private:
    std::vector<Image<float>> masks_;
};

}  // namespace etalon
