// Shadow maps [Williams78]: what a light sees first, and how far away it is.
//
// The map of a light has one layer, or six (the faces of a cube) for point lights and wide spot lights.
// Points of the world are taken to the frame of a layer, q = (right . d, down . d, forward . d) with
// d = p - origin, and from there to texels (u to the right, v downwards, texel (i, j) covers [i, i + 1] x
// [j, j + 1]) and depth:
//   directional:  u = centreU + scale q.x        v = centreV + scale q.y        z = depthOffset + depthScale q.z
//   perspective:  u = centreU + scale q.x / q.z  v = centreV + scale q.y / q.z  z = depthScale - depthOffset / q.z
// z is 0 at the near and 1 at the far plane. Casters nearer than the near plane are drawn at z = 0, not
// clipped.
//
// The faces of a cube have a border of `border` texels around their 90 degrees, so that a filter that crosses
// an edge stays in the face's own plane and compares with its own depths.
//
// What maps do not do:
//   - split a light's space by the distance from the camera (cascades): a directional light has one layer;
//   - filter depths (mip levels, moments): only comparisons are filtered;
//   - let part of the light through: a caster blocks a texel or does not;
//   - know the light's size, but in the filter soft, which takes it from the mean of what it finds: one blocker
//     behind another, and a border that the map does not see, are not told apart.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "lighting/geometry.h"
#include "lighting/surface_scene.h"
#include "lighting/view.h"
#include "raster/profile.h"
#include "raster/rasterizer.h"

namespace etalon {

// What a texel holds: a depth of rule 6, or the distance from the light in metres (float, in the profile's
// arithmetic). The depth of a directional light grows linearly in any case: linear is d32f there.
enum class ShadowDepth : uint8_t { d16, d24, d32f, linear };

// The faces of casters that are drawn.
enum class ShadowFaces : uint8_t { both, front, back };

// How many texels of the map a point is compared with:
//   hard: the one that it falls into
//   pcf: taps x taps, one texel apart, each with bilinear weights [Reeves87]
//   disc: `taps` points of a disc of `radius_texels`, turned by a random angle at each pixel
//   soft: as disc, with the radius from a search for blockers and the light's size [Fernando2005]
enum class ShadowFilter : uint8_t { hard, pcf, disc, soft };

// How the point's depth is compared with a UNORM texel: as a number of the fragment arithmetic, limited to
// [0, 1]; or as that number turned into an integer of the format first.
enum class ShadowReference : uint8_t { clamped, quantised };

inline constexpr double kLinearBiasUnit = 0x1p-20;

inline constexpr int kMaxShadowMapSize = 8192;
inline constexpr int kMaxWindowTaps = 16;           // along an edge (pcf)
inline constexpr int kMaxDiscTaps = 256;            // disc, soft
inline constexpr int kMaxShadowRadius_texels = 64;  // disc, soft
// Near over far of a perspective map at least: below it depth has no precision left. Casters that are nearer
// are drawn on the near plane.
inline constexpr double kShadowNearRatio = 0x1p-10;
// Widest spot light, from its axis, that one layer serves (cosine of 60 degrees); wider ones have a cube.
inline constexpr double kOneLayerCosine = 0.5;

struct ShadowMapSettings {
    int size = 1024;  // texels along an edge of a layer, without the border of cubes
    ShadowDepth depth = ShadowDepth::d24;
    ShadowFaces faces = ShadowFaces::both;
    // Added to what is drawn (rule 7). linear: subtracted at the look-up instead, in units of kLinearBiasUnit
    // of the point's distance, and in changes of the distance of its plane from texel to texel.
    DepthBias bias;

    ShadowFilter filter = ShadowFilter::pcf;
    int taps = 4;              // pcf: along an edge; disc, soft: in all
    double radius_texels = 4;  // disc; the largest of soft
    // soft: the diameter of a point or spot light, in metres; the angle that a directional one subtends, as
    // the tangent of its half.
    double lightSize_m = 0, tangentOfHalfAngle = 0;

    // Against self-shadowing, at the look-up: subtracted from the point's depth (linear: from its distance,
    // metres); the point moved along its normal by so many texels times the sine of the angle of incidence;
    // and each texel compared with the depth of the triangle's plane there.
    double depthOffset = 0, normalOffset_texels = 0;
    bool receiverPlane = false;

    ShadowReference reference = ShadowReference::clamped;
    bool snap = true;   // of a fitted layer: texels stay where they are in the light's frame when it moves
    uint64_t seed = 0;  // of disc and soft
};

// From the world to a layer; lengths in metres, scale in texels (per metre, or per unit of tangent).
struct ShadowProjection {
    bool isPerspective = false, isCube = false;
    glm::dvec3 origin{0}, right{1, 0, 0}, down{0, -1, 0}, forward{0, 0, -1};  // the axes: not of a cube
    double centreU = 0, centreV = 0, scale = 1;
    double depthScale = 1, depthOffset = 0;
    double near_m = 0, far_m = 1;  // along forward from the origin
    int width = 0;                 // texels of a layer along an edge, with borders
    int border = 0;                // of a cube's faces
};

// What a light's map shows of a scene.
struct ShadowFit {
    ShadowProjection projection;
    std::vector<uint32_t> casters;  // the instances that are drawn; none: every point is lit
    std::vector<bool> layerDrawn;   // for each layer whether any caster may be seen in it
};

// Finds the casters that matter, and the layer (or cube) that holds them. A caster matters if a receiver may
// lie behind it: their outlines, seen from the light, overlap as boxes, and the receiver's farthest point is
// behind the caster's nearest one. A flat caster (all vertices in one plane, to rounding) shadows nothing
// that lies on the light's side of it, itself included. The layer covers what casters and receivers have in
// common, in both directions of the layer, and in depth goes from the nearest caster to the farthest
// receiver; it does not depend on the camera. receivers: for each instance whether anything on it is looked
// up; empty: all. A light whose numbers are not finite has no casters.
ShadowFit fitShadowMap(std::span<const PlacedMesh> placed, const SurfaceLight& light,
                       const std::vector<bool>& receivers, const ShadowMapSettings& settings);

// Texels that a filter may reach to each side of a point, rounded up.
int filterReach_texels(const ShadowMapSettings& settings);

// The view that draws a layer (0, or a CubeFace).
View shadowView(const ShadowProjection& projection, int layer);

struct ShadowLayer {
    Image<uint32_t> stored;   // integers of rule 6; empty: nothing drawn
    Image<float> distance_m;  // linear: instead, infinity where nothing is
};

struct ShadowMap {
    ShadowMapSettings settings;
    ShadowProjection projection;
    std::vector<ShadowLayer> layers;                     // none: every point is lit
    DepthRounding depthRounding = DepthRounding::exact;  // of what is stored
    uint64_t triangles = 0;                              // submitted to the rasterizer, over all layers

    // linear and perspective: the texels are distances.
    bool holdsDistance() const { return settings.depth == ShadowDepth::linear && projection.isPerspective; }
    DepthFormat format() const {
        return settings.depth == ShadowDepth::d16   ? DepthFormat::d16
               : settings.depth == ShadowDepth::d24 ? DepthFormat::d24
                                                    : DepthFormat::d32f;
    }
};

// Draws the map. settings are checked: PreconditionError for a number outside the limits above.
ShadowMap renderShadowMap(const SurfaceScene& scene, const std::vector<PlacedMesh>& placed,
                          const SurfaceLight& light, const std::vector<bool>& receivers,
                          const ShadowMapSettings& settings, const Profile& profile,
                          const RasterOptions& options);
// With a projection and casters of the caller's choice.
ShadowMap renderShadowMap(const SurfaceScene& scene, const std::vector<PlacedMesh>& placed,
                          const ShadowFit& fit, const ShadowMapSettings& settings, const Profile& profile,
                          const RasterOptions& options);

}  // namespace etalon
