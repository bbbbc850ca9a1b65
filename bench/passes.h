// The passes that are measured, through Etalon's own interface.
#pragma once

#include "bench/workloads.h"
#include "lighting/render_view.h"
#include "probes/convert.h"
#include "shadows/planar_shadow.h"
#include "shadows/shadow_maps.h"

namespace etalon::bench {

// A workload with its vertices in world space, in the profile's vertex arithmetic.
struct PlacedWorkload {
    const Workload* workload = nullptr;
    const Profile* profile = nullptr;
    std::vector<PlacedMesh> placed;
};

// The profile's name is one of profileNames().
PlacedWorkload place(const Workload& workload, const std::string& profile);

// Vertices to clip space, visibility; the second one draws over an earlier frame, whose memory it uses.
VisibleScene drawDepth(const PlacedWorkload& work, int samples, const RasterOptions& options);
void drawDepth(VisibleScene& visible, const PlacedWorkload& work, int samples, const RasterOptions& options);

// The beauty of what is visible: Lambert and Blinn-Phong with all lights of the scene, background black.
ShadedImages shadeVisible(const PlacedWorkload& work, const VisibleScene& visible,
                          const RasterOptions& options);

// The map of the first light, kShadowMapSize texels along an edge, D24; look-ups of 4 x 4 taps in it.
inline constexpr int kShadowMapSize = 1024;
ShadowMapSettings shadowSettings();
ShadowMap drawShadowMap(const PlacedWorkload& work, const RasterOptions& options);
ShadowMaps readyForLookUp(const PlacedWorkload& work, ShadowMap map, const RasterOptions& options);
ShadedImages shadeVisible(const PlacedWorkload& work, const VisibleScene& visible,
                          const LightVisibility& shadows, const RasterOptions& options);
// One point per pixel, of the surfaces that are visible.
LitPoints visiblePoints(const PlacedWorkload& work, const VisibleScene& visible);

// Radiance and distance around the point between the knot's arms, kCubeSize texels along a face.
inline constexpr int kCubeSize = 512;
CubeRenderRequest cubeRequest();
CubeRender drawCube(const PlacedWorkload& work, const RasterOptions& options);

// A workload's knot above the plane of its ground, under a square light of 1 m: planar shadows of `samples`
// samples, fitted into kPlanarResolution^2 texels. The blur's standard deviation is kPlanarBlur_m, or 0.
inline constexpr int kPlanarResolution = 1024;
inline constexpr double kPlanarBlur_m = 0.05;
struct PlanarWork {
    PlanarReceiver receiver;
    PlanarCasters casters;
    std::vector<glm::dvec4> lights;
    const Profile* profile = nullptr;
};
PlanarWork planarWork(const PlacedWorkload& work, int samples);
PlanarShadow drawPlanarShadow(const PlanarWork& work, double blur_m, const RasterOptions& options);

// The blur that is measured: one channel of kBlurSize^2 random pixels.
inline constexpr int kBlurSize = 1024, kBlurRadius = 10;
inline constexpr double kBlurSigma = 5;
Image<float> blurInput();

// The lat-long image that becomes a cube map: three channels of random texels.
inline constexpr int kLatLongWidth = 1024, kLatLongHeight = 512, kLatLongCubeSize = 256;
Image<float> latLongInput();

// 2^this many lights are made of a probe.
inline constexpr int kLog2Lights = 8;

// A probe of random texels, and the shapes that are converted: 6 to 8 million texels each.
Probe probeInput(const ProbeShape& shape);
inline constexpr ProbeShape kLargeLatLong{Mapping::latLong, 4096, 2048},
    kLargeCube{Mapping::cube, 1024, 1024}, kLargeAngular{Mapping::angular, 2048, 2048},
    kLargeBall{Mapping::mirrorBall, 2048, 2048}, kLargeNearBall{Mapping::mirrorBall, 2048, 2048, 20},
    kLargeOctahedral{Mapping::octahedral, 2048, 2048};

}  // namespace etalon::bench
