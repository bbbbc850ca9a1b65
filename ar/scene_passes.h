// What the passes of a scene yield, and how they run. The plan (plan.h) says when.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "ar/environment_light.h"
#include "ar/pass.h"
#include "files/frame.h"
#include "lighting/light_visibility.h"
#include "lighting/occlusion.h"
#include "lighting/render_view.h"
#include "scene/scene.h"
#include "shadows/shadow_map.h"

namespace etalon {

// The scene's objects, placed.
struct Geometry {
    SurfaceScene surfaces;  // without lights and environment
    std::vector<PlacedMesh> placed;
    std::vector<std::string> warnings;
};

// What the camera sees.
struct VisibleView {
    std::optional<VisibleScene> scene;
};

struct EnvironmentImage {
    SurfaceEnvironment radiance;
    std::vector<std::string> warnings;
};

// A light of a scene: of its file, or of what its environment is cut into.
struct LightId {
    enum class Of : uint8_t { scene, environment };
    Of of = Of::scene;
    size_t index = 0;  // among those
};
// "light0", "environment light 3"; and in the names of channels and files: "light0", "environment3".
std::string nameOf(const LightId& light);
std::string channelNameOf(const LightId& light);

// All lights, in the order in which they are added up.
class SceneLights {
  public:
    // shows: whether each light of the scene can show; those that cannot are not evaluated.
    void addScene(const Scene& scene, const std::vector<bool>& shows);
    void addEnvironment(const std::vector<ProbeLight>& lights);

    const std::vector<SurfaceLight>& lights() const { return lights_; }
    const std::vector<bool>& shows() const { return shows_; }
    // Of a light, in both; and of all that the environment is cut into.
    size_t numberOf(const LightId& light) const;
    const std::vector<size_t>& ofEnvironment() const { return ofEnvironment_; }

  private:
    std::vector<SurfaceLight> lights_;
    std::vector<bool> shows_;
    std::vector<size_t> ofScene_, ofEnvironment_;
};

LightSources sourcesOf(const SceneLights& lights, const EnvironmentIllumination& environment);

// What stands in the way of one light.
struct CastShadow {
    std::shared_ptr<const LightVisibility> visibility;  // in every view; null: nothing, or volumes
    struct Volume {
        size_t light = 0;  // its number
        std::vector<uint32_t> casters;
    };
    std::optional<Volume> volume;
    std::vector<std::string> fallsOn;      // the objects that planar shadows fall on
    std::shared_ptr<const ShadowMap> map;  // what `visibility` looks up, where it is kept
    uint64_t memory_bytes = 0;             // that `visibility` holds
};

// What stands in the way of the lights in one view; null: nothing.
struct ViewShadows {
    std::shared_ptr<const LightVisibility> visibility;
    uint64_t memory_bytes = 0;  // of the masks of volumes
};

// What surfaces see of their surroundings: at fragments, or at vertices. Both empty: everything.
struct SurfaceOcclusion {
    TileOcclusion fragments;
    std::vector<VertexOcclusion> vertices;
};

// One part of what shading makes: it asks the job for its image, and lends it what the part reads.
struct ShadeTerm {
    std::function<void(ShadeJob&)> addTo;  // empty: nothing
};

struct Shading {
    ShadedImages images;
    ShadeStatistics statistics;
};

// The channels of an output that shading does not make.
struct OutputChannels {
    std::string_view output;
    std::vector<Channel> channels;
};

// A file beside the image: "a.NAME.exr" beside "a.exr".
struct OutputFile {
    std::string name;
    Frame frame;
};

// What every pass of a scene runs with.
struct SceneSettings {
    const Scene* scene = nullptr;
    View view;                       // of the camera
    SurfaceEnvironment environment;  // its rotation, and its constant radiance
    RasterOptions raster;            // threads and tile size; change no bit
    bool strict = false;             // questionable input is an error
    bool everything = false;         // evaluate also what cannot show
};

Geometry placeGeometry(const SceneSettings& settings, const PassContext& context);
VisibleView findVisibleInView(const SceneSettings& settings, const PassContext& context,
                              const Geometry& geometry);

// What the outputs say (scene/outputs.h).
OutputChannels windowDepthChannels(const VisibleView& visible);
OutputChannels idChannels(const VisibleView& visible);
OutputChannels coverageChannels(const VisibleView& visible);
OutputChannels alphaChannels(const VisibleView& visible);

// The map of the light, or its volumes' casters. fit: what it is fitted to. isKept: also CastShadow::map.
CastShadow castByMap(const SceneSettings& settings, const PassContext& context, const Geometry& geometry,
                     const SceneLights& lights, const LightId& light, const ShadowFit& fit,
                     const ShadowMapSettings& map, bool isKept);
CastShadow castByVolumes(const SceneLights& lights, const LightId& light, std::vector<uint32_t> casters);
CastShadow castOnPlanes(const SceneSettings& settings, const PassContext& context, const Geometry& geometry,
                        const SceneLights& lights, const LightId& light, const std::vector<bool>& receivers,
                        const PlanarLightSettings& planar);
// Together, with the volumes of one view. excluded: an instance that the view does not show, or kNoInstance.
ViewShadows shadowsOfView(const SceneSettings& settings, const PassContext& context, const Geometry& geometry,
                          const SceneLights& lights, const std::vector<const CastShadow*>& shadows,
                          const View& view, int samples, uint32_t excluded);

// ofVertices: else of fragments.
SurfaceOcclusion occlusionInView(const SceneSettings& settings, const PassContext& context, bool ofVertices,
                                 const Geometry& geometry, const VisibleView& visible);

std::vector<VertexRadiance> lightVertices(const SceneSettings& settings, const PassContext& context,
                                          const Geometry& geometry, const VisibleView& visible,
                                          const SceneLights& lights,
                                          const EnvironmentIllumination& environment,
                                          const SurfaceOcclusion& occlusion);

// As of an image (ar/plan_facts.h), of the environment's.
void requireSampling(const Scene& scene, const Profile& profile, const Arithmetic& arithmetic,
                     const EnvironmentImage& image);
// environmentIllumination(), where its maps can be sampled.
EnvironmentIllumination lightOfEnvironment(const SceneSettings& settings, const PassContext& context,
                                           const EnvironmentImage& image);

// Cube maps that mirrors show, by their instances.
using ObjectCubes = std::vector<std::pair<uint32_t, const CubeMap<float>*>>;

// The cube map around an instance. hasOcclusion: its faces are shaded with what they see of their surroundings. cubes: of
// mirrors that it shows; others show the environment.
CubeRender renderObjectCube(const SceneSettings& settings, const PassContext& context, uint32_t instance,
                            bool hasOcclusion, const Geometry& geometry, const SceneLights& lights,
                            const EnvironmentImage& image, const EnvironmentIllumination& environment,
                            const std::optional<CubeMap<float>>& environmentCube,
                            const std::vector<const CastShadow*>& shadows, const ObjectCubes& cubes);

Shading shadeView(const SceneSettings& settings, const PassContext& context, const Geometry& geometry,
                  const VisibleView& visible, const std::vector<const ShadeTerm*>& terms);

// The outputs in the order of their table (scene/outputs.h): those that are made, and of shading; what shading has not
// made is OutputPart::missing. casting: the lights whose shadows are an output. InputError if no output has a channel.
Frame frameOf(const SceneSettings& settings, const PassContext& context,
              const std::vector<std::string>& outputs, const std::vector<LightId>& casting,
              const std::vector<const OutputChannels*>& made, const Shading& shading);

// The cube maps of instances, and the shadow maps of lights, as files. A map that is empty or not kept has none.
std::vector<OutputFile> cubeMapFiles(const SceneSettings& settings, const PassContext& context,
                                     const Geometry& geometry, const std::vector<uint32_t>& instances,
                                     const std::vector<const CubeRender*>& cubes);
std::vector<OutputFile> shadowMapFiles(const SceneSettings& settings, const PassContext& context,
                                       const std::vector<LightId>& lights,
                                       const std::vector<const CastShadow*>& shadows);

// The tone mapped beauty as a PNG holds it.
Image<uint8_t> toneMapped(const SceneSettings& settings, const Shading& shading);

}  // namespace etalon
