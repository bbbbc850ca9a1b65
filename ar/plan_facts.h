// What passes find out that the plan of those behind them depends on, and what the plan counts with.
#pragma once

#include <optional>
#include <vector>

#include "ar/scene_passes.h"
#include "lighting/render_view.h"
#include "probes/probe_light.h"
#include "scene/scene.h"

namespace etalon {

// What a view shows.
struct VisibilityFacts {
    std::vector<bool> objectVisible;  // for each of sceneObjects
    bool backgroundVisible = true;
};

// A light of the environment that casts shadows.
struct EnvironmentCaster {
    size_t light = 0;          // among those of the environment
    double solidAngle_sr = 0;  // that it stands for
    double share = 0;          // of the energy of all of them
    SurfaceLight source;
};

// What passes have found.
struct PlanFacts {
    const Geometry* geometry = nullptr;
    std::optional<VisibilityFacts> visibility;
    std::optional<std::vector<EnvironmentCaster>> casters;
};

VisibilityFacts visibilityFacts(const VisibleScene& visible, size_t objects);

// Sizes, for what passes say of their memory.
inline constexpr int kFacesPerCube = 6;
inline constexpr uint64_t kBytesPerSample = 4 + 4 + 1;  // depth, id, stencil
inline uint64_t bytesPerVisibleSample(const Profile& profile) {
    return kBytesPerSample + (profile.depth == DepthFormat::d64f ? 4 : 0);
}
inline constexpr uint64_t kBytesOfWideStencil = 4;  // per sample, where volumes have many triangles
inline uint64_t squared(int size) { return static_cast<uint64_t>(size) * static_cast<uint64_t>(size); }
// Of the images that a light's shadows are looked up in, and of what they are drawn into, in bytes, at most. receivers:
// the objects that planar shadows may fall on.
uint64_t shadowMemory(const LightShadow& shadow, bool isDirectional, size_t receivers);
// Of the shadow volumes of a view: its depths, and a mask for each light.
uint64_t volumeMemory(const Scene& scene, const Profile& profile, uint64_t samples);
// Of a shadow map as it is kept, in texels.
uint64_t shadowMapTexels(const ShadowMapSettings& map, bool isDirectional);

// Images are sampled with their sizes as numbers of the arithmetic, of the profile's fragments mostly: InputError for one
// that it does not hold. An empty image is none.
void requireSampling(const Scene& scene, const Profile& profile, const Arithmetic& arithmetic,
                     const char* what, int line, int width, int height);

// What a plan says of them: how many of the environment's lights they are, with what part of its energy.
std::string castersText(const std::vector<EnvironmentCaster>& casters, size_t lights);
// Which of the environment's lights cast shadows.
std::vector<EnvironmentCaster> castersOf(const Environment& environment,
                                         const std::vector<ProbeLight>& lights);

}  // namespace etalon
