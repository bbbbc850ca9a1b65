// Soft shadows on a plane by projection: the casters are drawn into a texture once per sample of the light,
// and the texture tells for each texel how many samples are blocked [Karlsson2005, sec. 3.2; Heckbert1997].
//
// Steps of planarShadow:
//  1. Samples at the plane's height or below do not light its front and are left out; without any other,
//     nothing is in shadow. Samples must be finite: PreconditionError.
//  2. The casters are cut at the plane (castersAbove), once for all samples, and below each sample that is
//     lower than the highest caster, at 1 - kNearestToLight of its height. False shadows and anti-shadows
//     are impossible.
//  3. The texture is fitted to the rectangle around all shadows, at most the one around the receiver, both
//     widened by the blur's reach. Texels are squares of 4, 5, 6 or 7 times a power of two metres and lie on
//     a grid around the frame's origin: while a light or a caster moves a little they stay where they are.
//  4. For each sample the casters are projected in the profile's vertex arithmetic (planeShadowMatrix, with
//     the light divided by its height, so that points on the plane stay to the bit) and drawn with the
//     rasterizer's rules. Blocked samples are counted as integers, so that neither order, threads nor tiles
//     change a bit.
//  5. shadow = blocked / samples, rounded to float; then the Gaussian blur of raster/blur.h in the profile's
//     fragment arithmetic, limited to 1. What no sample's shadow reaches is exactly 0.
//
// What planar shadows do not do:
//   - fall on anything but the plane: casters are not shadowed, neither by others nor by themselves;
//   - let part of the light through: a caster blocks a sample or does not;
//   - adapt: each texel has the same samples, and the blur is as wide near the caster as far from it.
#pragma once

#include <cstdint>
#include <span>

#include "raster/image.h"
#include "raster/profile.h"
#include "raster/rasterizer.h"
#include "shadows/planar_casters.h"
#include "shadows/planar_receiver.h"

namespace etalon {

// Casters closer to the height of the light than this part of it cast no shadow.
inline constexpr double kNearestToLight = 0x1p-20;
inline constexpr int kMinPlanarResolution = 16, kMaxPlanarResolution = 8192;
// The blur's kernel ends at this many standard deviations.
inline constexpr double kPlanarBlurReach = 3;

struct PlanarShadowOptions {
    int resolution =
        1024;  // most texels along a side; a fitted texture uses 3/4 or more along the longer one
    double texel_m =
        0;  // size of a texel; 0: fitted. Doubled until the texture has no more than `resolution`
    double blurSigma_m = 0;   // standard deviation of the blur on the plane; 0: none
    int samplesPerTexel = 1;  // positions in a texel that a sample of the light is decided at: 1, 4 or 16
    double contact_m = 1e-5;  // heights up to this are on the plane (castersAbove)
};

// A texture in the plane of a frame. Texel (0, 0) has its corner at (s, t) = corner_m.
struct PlanarGrid {
    PlaneFrame frame;
    glm::dvec2 corner_m{0};
    double texel_m = 1;
    int width = 0, height = 0;  // 0: no shadow anywhere

    // World space; x and y in texels from the corner.
    glm::dvec3 toWorld(double x, double y) const;
};

// How many samples are blocked at each texel, of how many.
struct BlockedSamples {
    PlanarGrid grid;
    Image<uint32_t> blocked;
    uint32_t samples = 0;  // light samples in front of the plane, times samplesPerTexel
};
BlockedSamples countBlocked(const PlanarReceiver& receiver, const PlanarCasters& casters,
                            std::span<const glm::dvec4> lights, const PlanarShadowOptions& options,
                            const Profile& profile, const RasterOptions& raster);

// shadow: one channel, the part of the light that is blocked, 0 to 1.
struct PlanarShadow {
    PlanarGrid grid;
    Image<float> shadow;
};
PlanarShadow planarShadow(const PlanarReceiver& receiver, const PlanarCasters& casters,
                          std::span<const glm::dvec4> lights, const PlanarShadowOptions& options,
                          const Profile& profile, const RasterOptions& raster);

// 1 for texels whose centre is on the receiver's polygon, by the rasterizer's rules, else 0.
Image<uint8_t> receiverMask(const PlanarReceiver& receiver, const PlanarGrid& grid, const Profile& profile,
                            const RasterOptions& raster);

}  // namespace etalon
