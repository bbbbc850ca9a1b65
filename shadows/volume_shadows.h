// Shadows of a view by shadow volumes: the volumes are counted in the stencil, pixel by pixel.
//
// What they do not do:
//   - soft borders: a light is a place or a direction without extent;
//   - points that the view does not show, those in mirrors among them: they have the mask of their pixel;
//   - keep to one side of an open mesh: without a closed surface every triangle casts, whichever way it faces;
//   - let part of the light through: a triangle blocks it.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "lighting/light_visibility.h"
#include "lighting/render_view.h"
#include "shadows/shadow_volume.h"

namespace etalon {

// What is counted at each sample.
//   zFail: volume faces behind what is visible: leaving less entering. Right wherever the eye and the near
//          plane are; needs both caps.
//   zPass: volume faces in front of it: entering less leaving, from the eye on (depth clamp: the near plane
//          does not cut sides). Right if the eye is in no volume and no caster comes between eye and near
//          plane.
enum class VolumeCounting : uint8_t { zFail, zPass };

struct VolumeShadowOptions {
    VolumeCounting counting = VolumeCounting::zFail;
    const std::vector<SurfaceLight>* lights = nullptr;  // null: those of the scene
    // For each light the instances that cast its shadows, each once; none: it has no shadows. Not given: all.
    std::optional<std::vector<std::vector<uint32_t>>> casters;
    uint32_t excluded = kNoInstance;  // an instance that the view does not show; it may cast
    int samples = 1;                  // of the render target: 1, 4 or 16 per pixel
};

struct VolumeShadowStatistics {
    uint64_t openEdges = 0, crowdedEdges = 0, discordantEdges = 0;  // of all casters (MeshTopology)
    uint64_t leftOut = 0;                                           // triangles that cannot cast
    uint64_t caps = 0, sides = 0, silhouetteEdges = 0;              // drawn for all lights; triangles, edges
    RasterStatistics raster;                                        // of the last light
};

// The masks of a view. Where the mask and the depths differ from the truth:
//   - Depths are compared after the rounding of the depth format and the raster arithmetic. The light cap of
//     a triangle has the bits of the triangle itself, which therefore never shadows itself. A surface within
//     some steps of depth of a volume's face may be on the wrong side of it.
//   - The vertices are snapped to subpixels (rule 3), so borders are off by up to 2^-n of a pixel.
//   - With the profile's VolumeStencil::bits8 the counts are modulo 256: a point behind a multiple of 256 casting
//     triangles counts as lit. Else they have 32 bits where there are more triangles.
// The view is drawn with an infinite far plane (withInfiniteFar), so that no volume is cut behind.
class VolumeShadows final : public LightVisibility {
  public:
    // The view is a perspective one. Throws PreconditionError for a light that is not finite.
    VolumeShadows(const SurfaceScene& scene, const std::vector<PlacedMesh>& placed, const View& view,
                  const Profile& profile, const VolumeShadowOptions& options, const RasterOptions& raster);

    bool casts(size_t light) const override { return !lit_[light].empty(); }
    // The part of the pixel's samples that is lit: of those that show the point's instance, or, where none
    // does, of all. 0 or 1 with one sample.
    void find(size_t light, const LitPoints& points, std::span<double> visibility) const override;

    // width x height x samples: 0 where what is visible is in shadow, else 1. Empty: nothing casts.
    const Image<uint8_t>& mask(size_t light) const { return lit_[light]; }
    const VolumeShadowStatistics& statistics() const { return statistics_; }
    uint64_t memory_bytes() const;

  private:
    std::vector<Image<uint8_t>> lit_;  // for each light
    Image<uint32_t> instance_;         // visible at each sample
    VolumeShadowStatistics statistics_;
};

}  // namespace etalon
