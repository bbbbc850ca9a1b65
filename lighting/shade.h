// Shading of what a view sees: from a render target with visibility to images.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "lighting/geometry.h"
#include "lighting/light_visibility.h"
#include "lighting/occlusion.h"
#include "lighting/surface_scene.h"
#include "lighting/vertex_lighting.h"
#include "lighting/view.h"
#include "raster/fragments.h"
#include "raster/profile.h"
#include "raster/render_target.h"
#include "raster/texture.h"

namespace etalon {

// The images that shading can make. The radiance components add up to `beauty`, in this order.
enum class ShadeOutput : uint8_t {
    ambient,
    diffuse,
    specular,
    mirror,
    background,
    beauty,
    normals,
    distance,
    depth,
    open,
    bentNormals,
    irradiance,
    environment,
    shadows
};
inline constexpr int kShadeOutputs = 14;
inline constexpr int kRadianceComponents = 5;

// Whether a pixel is the mean of its samples; else it is what sample 0 sees.
inline bool isResolved(ShadeOutput output) {
    return output <= ShadeOutput::beauty || output == ShadeOutput::open || output >= ShadeOutput::irradiance;
}

// Which images to make.
struct ShadeRequest {
    bool wanted[kShadeOutputs] = {};
    // The radiance components that are evaluated; the others are 0, as images and as parts of the beauty.
    bool evaluated[kRadianceComponents] = {true, true, true, true, true};

    bool& operator[](ShadeOutput o) { return wanted[static_cast<size_t>(o)]; }
    bool operator[](ShadeOutput o) const { return wanted[static_cast<size_t>(o)]; }
    // True if a radiance component is evaluated and wanted, for itself or for the beauty.
    bool needs(ShadeOutput component) const {
        return evaluated[static_cast<size_t>(component)] &&
               ((*this)[component] || (*this)[ShadeOutput::beauty]);
    }
};

// The images asked for; the others are empty. Radiance images have three channels, resolved over the samples.
//   normals      three channels, unit length, world space, towards the viewer; 0 where nothing is visible
//   distance     metres from the eye along the ray; infinity where nothing is visible
//   depth        metres from the eye along the optical axis; infinity where nothing is visible
//   open         the part of its surroundings that a surface sees (Occlusion::open); 1 where nothing is visible
//   bentNormals  three channels, Occlusion::bentNormal; 0 where nothing is visible
//   irradiance   three channels: what a surface receives from the environment, W/m^2
//   environment  three channels: what of that it reflects diffusely, radiance
//   shadows      a channel for each of ShadeJob::shadowLights: the part of the light that reaches the surface; 1
//                where nothing is visible, and on surfaces that reflect no lights
// Which of them are those of sample 0: isResolved(). Those from `open` on are found at fragments, also where these
// are lit by their vertices.
struct ShadedImages {
    Image<float> images[kShadeOutputs];

    Image<float>& operator[](ShadeOutput o) { return images[static_cast<size_t>(o)]; }
    const Image<float>& operator[](ShadeOutput o) const { return images[static_cast<size_t>(o)]; }
};

struct ShadeStatistics {
    uint64_t surfaceFragments = 0;  // shaded once each
    uint64_t backgroundFragments = 0;
};

// Everything shading reads. The referenced objects outlive the call.
struct ShadeJob {
    const SurfaceScene* scene = nullptr;
    const View* view = nullptr;
    const RenderTarget* target = nullptr;
    const std::vector<PlacedMesh>* placed = nullptr;
    std::vector<uint32_t> instanceOfDraw;  // for each draw of the target
    LightSources sources;
    const SurfaceEnvironment* environment = nullptr;  // what the background and mirrors of it show
    const CubeMap<float>* environmentCube = nullptr;  // null: mirrors of the environment see its constant
    std::vector<const CubeMap<float>*>
        sceneCubes;  // for each instance: its cube map, or null for the environment
    // What stands between the lights and the fragments; null: nothing.
    const LightVisibility* visibility = nullptr;
    // For each instance what its vertices reflect, to be interpolated (lighting/vertex_lighting.h); null:
    // every fragment is lit by itself.
    const std::vector<VertexRadiance>* vertexRadiance = nullptr;
    // What the fragments see of their surroundings; null: everything. For each tile, row by row. With
    // vertexRadiance, which has its own, for the images that are found at fragments all the same.
    const TileOcclusion* occlusion = nullptr;
    // Numbers of lights: those that the channels of the image `shadows` stand for; those of the environment, which
    // `irradiance` and `environment` count beside sources.environment.
    std::vector<size_t> shadowLights, environmentLights;
    ShadeRequest request;
    // Evaluate also those parts of materials that reflect nothing; as far as no product overflows, this
    // changes no bit.
    bool everyPart = false;
    const Profile* profile = nullptr;
    int threads = 0, tileSize = 64;
};

// Of the image of an output.
int channelsOf(const ShadeJob& job, ShadeOutput output);

// Shades each visible fragment once, in the profile's fragment arithmetic.
ShadedImages shade(const ShadeJob& job, ShadeStatistics* statistics = nullptr);

// The points that the fragments of each tile's surfaces are lit at; tiles row by row, in the order that a
// tile is shaded in.
std::vector<LitPoints> fragmentPoints(const ShadeJob& job);

// Which instances the job's target shows.
std::vector<bool> visibleInstances(const ShadeJob& job);

// Lights the vertices of every instance that the job's target shows; the others stay empty. occlusion: of the
// vertices of each of these; empty: all see everything.
std::vector<VertexRadiance> lightVerticesOf(const ShadeJob& job,
                                            const std::vector<VertexOcclusion>& occlusion = {});

// The cube map of a lat-long environment for its mirrors, without its rotation: a quarter of the image's
// width along a face, so that texels subtend about what they do in the image, one sample each.
CubeMap<float> environmentCube(const SurfaceEnvironment& environment, const Profile& profile, int threads);

}  // namespace etalon
