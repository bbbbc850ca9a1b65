// Views of a surface scene: visibility, then shading; one view, or the six of a cube map.
#pragma once

#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <span>

#include "lighting/geometry.h"
#include "lighting/shade.h"
#include "raster/rasterizer.h"

namespace etalon {

// What a view sees: its render target, and the instance that each draw of the target drew.
struct VisibleScene {
    RenderTarget target;
    std::vector<uint32_t> instanceOfDraw;
    RasterStatistics statistics;
    std::vector<UninitializedVector<ClipVertex>> vertices;  // of each draw: kept for the next frame's
};

inline constexpr uint32_t kNoInstance = std::numeric_limits<uint32_t>::max();

// Rasterizes every instance but `excluded` with the profile's fixed function; samples: 1, 4 or 16 per pixel.
VisibleScene findVisible(const SurfaceScene& scene, const std::vector<PlacedMesh>& placed, const View& view,
                         const Profile& profile, int samples, const RasterOptions& options,
                         uint32_t excluded = kNoInstance);
// The same into what an earlier frame left: its memory serves again where the size and the format are the
// same. `only`: for each instance the triangles that are drawn (Draw::only); empty: all.
void findVisible(VisibleScene& visible, const SurfaceScene& scene, const std::vector<PlacedMesh>& placed,
                 const View& view, const Profile& profile, int samples, const RasterOptions& options,
                 uint32_t excluded = kNoInstance, std::span<const std::vector<uint32_t>> only = {});

// The job of shading what is visible: nothing asked for yet, no cube maps, each fragment lit by itself. All
// arguments outlive it.
ShadeJob shadeJobOf(const VisibleScene& visible, const SurfaceScene& scene,
                    const std::vector<PlacedMesh>& placed, const View& view, const Profile& profile,
                    const RasterOptions& options);

// Six faces with what is seen from a point: radiance (three channels) and the distance along the ray in
// metres (infinity where nothing is).
struct CubeRender {
    CubeMap<float> radiance, distance;
};

struct CubeRenderRequest {
    glm::dvec3 centre{0};  // world space
    int size = 0;          // texels along a face
    double near_m = 0, far_m = 0;
    uint32_t excluded = kNoInstance;  // an instance that the cube map does not show (the one that it is for)
    std::function<void(ShadeJob&)> prepare;       // sets what else each face is shaded with
    const LightVisibility* visibility = nullptr;  // as in ShadeJob
    // Where it depends on the view: that of each face, instead.
    std::function<std::shared_ptr<const LightVisibility>(const View&)> visibilityOf;
    // Of the fragments of each face, from its job; empty: they see all of their surroundings.
    std::function<TileOcclusion(const ShadeJob&)> occlusionOf;
};

// Renders the six faces around a point in one call. Mirrors seen in them reflect the environment alone, but for those that
// request.prepare gives a cube map.
CubeRender renderCubeMap(const SurfaceScene& scene, const std::vector<PlacedMesh>& placed,
                         const CubeRenderRequest& request, const CubeMap<float>* environmentCube,
                         const Profile& profile, const RasterOptions& options);

}  // namespace etalon
