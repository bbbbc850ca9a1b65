#include "ar/scene_passes.h"

#include <algorithm>
#include <cmath>

#include "ar/plan_facts.h"
#include "ar/surface_builder.h"
#include "files/probe_file.h"
#include "lighting/cube_faces.h"
#include "lighting/tone_map.h"
#include "numeric/text.h"
#include "numeric/vectors.h"
#include "raster/depth.h"
#include "raster/rules.h"
#include "scene/outputs.h"
#include "shadows/joint_visibility.h"
#include "shadows/planar_lights.h"
#include "shadows/shadow_maps.h"
#include "shadows/surface_occlusion.h"
#include "shadows/volume_shadows.h"

namespace etalon {
namespace {

DirectionalOptions occlusionOptions(const SceneSettings& settings) {
    const Render& render = settings.scene->render;
    return {render.occlusionDirections, render.occlusionMapSize, settings.raster};
}

ShadeJob viewJob(const SceneSettings& settings, const PassContext& context, const Geometry& geometry,
                 const VisibleView& visible) {
    ShadeJob job = shadeJobOf(*visible.scene, geometry.surfaces, geometry.placed, settings.view,
                              context.profile, settings.raster);
    job.environment = &settings.environment;
    job.everyPart = settings.everything;
    return job;
}

// The channels of an image that shading makes, or where it has made none of what is missing.
void addPlanes(Frame& frame, const Image<float>& image, const std::vector<std::string>& names,
               float missing) {
    for (size_t c = 0; c < names.size(); c++) {
        Image<float> plane(frame.width, frame.height);
        if (image.empty())
            plane.fill(missing);
        else
            std::ranges::copy(image.plane(static_cast<int>(c)), plane.values().begin());
        frame.channels.push_back({names[c], std::move(plane)});
    }
}

std::vector<std::string> channelsOf(const OutputPart& part, const std::vector<LightId>& casting) {
    if (part.image != ShadeOutput::shadows) return {part.channels.begin(), part.channels.end()};
    std::vector<std::string> names;
    for (const LightId& light : casting) names.push_back("shadow." + channelNameOf(light));
    return names;
}

void addMetadata(Frame& frame, const SceneSettings& settings, const PassContext& context) {
    frame.metadata["etalon.scene"] = settings.scene->file.filename().string();
    frame.metadata["etalon.profile"] = std::string(context.profile.name);
    frame.metadata["etalon.rules"] = std::to_string(kRulesVersion);
}

// How points of the world fall on a shadow map.
std::string projectionText(const ShadowProjection& p, const glm::dvec3& origin_m) {
    const auto of = [](const glm::dvec3& v) { return formatText("{} {} {}", v.x, v.y, v.z); };
    std::string text = formatText("{}; origin {}",
                                  p.isCube          ? "cube"
                                  : p.isPerspective ? "perspective"
                                                    : "parallel",
                                  of(origin_m + p.origin));
    if (!p.isCube)
        text += formatText("; right {}; down {}; forward {}", of(p.right), of(p.down), of(p.forward));
    return text + formatText("; centre {} {}; scale {}; depth {} {}; near {}; far {}; border {}", p.centreU,
                             p.centreV, p.scale, p.depthScale, p.depthOffset, p.near_m, p.far_m, p.border);
}

// The fraction of a pixel's samples that objects cover.
Image<float> coverageOf(const VisibleView& visible) {
    const Image<uint32_t>& id = visible.scene->target.id;
    Image<float> coverage(id.width(), id.height());
    for (size_t i = 0; i < coverage.pixelCount(); i++) {
        int covered = 0;
        for (int s = 0; s < id.channels(); s++) covered += id.plane(s)[i] != kNoTriangle ? 1 : 0;
        coverage.values()[i] = static_cast<float>(covered) / static_cast<float>(id.channels());
    }
    return coverage;
}

OutputFile cubeMapFile(const SceneSettings& settings, const PassContext& context, uint32_t instance,
                       const Geometry& geometry, const CubeRender& cube) {
    Probe probe;
    const int size = cube.radiance.faces[0].width();
    probe.shape = {Mapping::cube, size, size};
    probe.radiance.assign(cube.radiance.faces.begin(), cube.radiance.faces.end());
    probe.distance_m.assign(cube.distance.faces.begin(), cube.distance.faces.end());
    probe.position_m = settings.scene->origin_m + geometry.surfaces.instances[instance].cubeCentre_m;
    OutputFile file{formatText("cube_map.{}", instance + 1), frameOfProbe(probe)};
    addMetadata(file.frame, settings, context);
    file.frame.metadata["etalon.object"] = sceneObjects(*settings.scene)[instance].name;
    return file;
}

OutputFile shadowMapFile(const SceneSettings& settings, const PassContext& context, const LightId& light,
                         const ShadowMap& map) {
    const int width = map.projection.width;
    Image<float> plane(width, width * static_cast<int>(map.layers.size()));
    plane.fill(map.holdsDistance() ? std::numeric_limits<float>::infinity() : 1);
    for (size_t l = 0; l < map.layers.size(); l++) {
        const ShadowLayer& layer = map.layers[l];
        const size_t first = l * static_cast<size_t>(width) * static_cast<size_t>(width);
        for (size_t i = 0; i < layer.stored.values().size(); i++)
            plane.values()[first + i] =
                static_cast<float>(depthFromStored(map.format(), layer.stored.values()[i]));
        std::ranges::copy(layer.distance_m.values(),
                          plane.values().begin() + static_cast<std::ptrdiff_t>(first));
    }
    OutputFile file{"shadow_map." + channelNameOf(light), {}};
    file.frame.width = plane.width();
    file.frame.height = plane.height();
    file.frame.channels.push_back({map.holdsDistance() ? "distance" : "depth", std::move(plane)});
    addMetadata(file.frame, settings, context);
    file.frame.metadata["etalon.light"] = nameOf(light);
    file.frame.metadata["etalon.projection"] = projectionText(map.projection, settings.scene->origin_m);
    return file;
}

}  // namespace

LightSources sourcesOf(const SceneLights& lights, const EnvironmentIllumination& environment) {
    return {&lights.lights(), &lights.shows(), &environment.diffuse};
}

std::string nameOf(const LightId& light) {
    return light.of == LightId::Of::scene ? formatText("light{}", light.index)
                                          : formatText("environment light {}", light.index);
}
std::string channelNameOf(const LightId& light) {
    return formatText("{}{}", light.of == LightId::Of::scene ? "light" : "environment", light.index);
}

void SceneLights::addScene(const Scene& scene, const std::vector<bool>& shows) {
    for (const SceneLight& light : scene.lights) {
        shows_.push_back(shows[ofScene_.size()]);
        ofScene_.push_back(lights_.size());
        lights_.push_back(light);
    }
}
void SceneLights::addEnvironment(const std::vector<ProbeLight>& lights) {
    for (const ProbeLight& light : lights) {
        shows_.push_back(true);
        ofEnvironment_.push_back(lights_.size());
        lights_.push_back(surfaceLightOf(light));
    }
}
size_t SceneLights::numberOf(const LightId& light) const {
    return (light.of == LightId::Of::scene ? ofScene_ : ofEnvironment_).at(light.index);
}

namespace {

// Names the objects whose placed positions are far apart for their size.
void warnOfCoarsePositions(const Scene& scene, Geometry& geometry) {
    constexpr double kFineEnough = 256, kSmallPart = 4;  // steps along an object, and in a pixel
    const std::vector<SceneObject> objects = sceneObjects(scene);
    for (size_t i = 0; i < geometry.placed.size(); i++) {
        const PlacedMesh& mesh = geometry.placed[i];
        if (mesh.arithmetic != RasterReal::fp32 || scene.render.origin == Origin::eye) continue;
        glm::dvec3 low(HUGE_VAL), high(-HUGE_VAL);
        for (const glm::dvec3& p : mesh.positions)
            for (int c = 0; c < 3; c++) low[c] = std::min(low[c], p[c]), high[c] = std::max(high[c], p[c]);
        double size_m = 0, largest_m = 0;
        for (int c = 0; c < 3; c++) {
            size_m = std::max(size_m, high[c] - low[c]);
            largest_m = std::max({largest_m, std::fabs(low[c]), std::fabs(high[c])});
        }
        if (!std::isfinite(largest_m) || !(largest_m > 0)) continue;
        const double step_m = std::ldexp(1.0, std::ilogb(largest_m) + 1 - kFp32.significandBits);
        const glm::dvec3 centre = scaledBy(low + high, 0.5), eye(scene.camera.cameraToWorld[3]);
        const double pixel_m = lengthOf(centre - eye) / scene.camera.intrinsics.fx;
        if (step_m * kFineEnough <= size_m || step_m * kSmallPart <= pixel_m) continue;
        geometry.warnings.push_back(
            formatText("{}: {}: positions in fp32 are {:.3g} m apart here, of an object of {:.3g} m; "
                       "[render] origin = \"eye\" "
                       "makes them relative to the camera, the profile f64 has finer ones",
                       where(scene, scene.render.line), objects[i].name, step_m, size_m));
    }
}

}  // namespace

Geometry placeGeometry(const SceneSettings& settings, const PassContext& context) {
    Geometry geometry;
    geometry.surfaces = buildSurfaces(*settings.scene, geometry.warnings);
    geometry.placed = placeMeshes(geometry.surfaces, context.profile.vertex, settings.raster.threads);
    warnOfCoarsePositions(*settings.scene, geometry);
    return geometry;
}

void requireSampling(const Scene& scene, const Profile& profile, const Arithmetic& arithmetic,
                     const EnvironmentImage& image) {
    const Image<float>& latLong = image.radiance.latLong;
    requireSampling(scene, profile, arithmetic, "an environment", scene.environment.line, latLong.width(),
                    latLong.height());
}

EnvironmentIllumination lightOfEnvironment(const SceneSettings& settings, const PassContext& context,
                                           const EnvironmentImage& image) {
    const Scene& scene = *settings.scene;
    const Environment& environment = scene.environment;
    if (isLightMap(environment.lighting))
        requireSampling(scene, context.profile, context.profile.fragment, "a map of irradiance",
                        environment.line, environment.mapSize, environment.mapSize);
    return environmentIllumination(environment, image.radiance, context.profile, settings.raster.threads);
}

VisibleView findVisibleInView(const SceneSettings& settings, const PassContext& context,
                              const Geometry& geometry) {
    VisibleView visible;
    visible.scene.emplace(findVisible(geometry.surfaces, geometry.placed, settings.view, context.profile,
                                      settings.scene->render.samples, settings.raster));
    // No other frame is drawn with it.
    visible.scene->target.scratch = RasterScratchHolder();
    visible.scene->vertices.clear();
    return visible;
}

OutputChannels windowDepthChannels(const VisibleView& visible) {
    const RenderTarget& target = visible.scene->target;
    Image<float> depth(target.width(), target.height());
    for (size_t i = 0; i < depth.pixelCount(); i++)
        depth.values()[i] =
            static_cast<float>(depthFromStored(target.format.depth, target.depth.plane(0)[i],
                                               target.lowDepth.empty() ? 0 : target.lowDepth.plane(0)[i]));
    return {"window_depth", {{"depth.window", std::move(depth)}}};
}

OutputChannels idChannels(const VisibleView& visible) {
    const RenderTarget& target = visible.scene->target;
    Image<uint32_t> objects(target.width(), target.height()), triangles(target.width(), target.height());
    for (size_t i = 0; i < objects.pixelCount(); i++) {
        const uint32_t id = target.id.plane(0)[i];
        if (id == kNoTriangle) continue;
        objects.values()[i] = visible.scene->instanceOfDraw[target.triangles[id].draw] + 1;
        triangles.values()[i] = target.triangles[id].triangle + 1;
    }
    return {"ids", {{"id.object", std::move(objects)}, {"id.triangle", std::move(triangles)}}};
}

OutputChannels coverageChannels(const VisibleView& visible) {
    return {"coverage", {{"coverage", coverageOf(visible)}}};
}

OutputChannels alphaChannels(const VisibleView& visible) { return {"alpha", {{"A", coverageOf(visible)}}}; }

CastShadow castByMap(const SceneSettings& settings, const PassContext& context, const Geometry& geometry,
                     const SceneLights& lights, const LightId& light, const ShadowFit& fit,
                     const ShadowMapSettings& map, bool isKept) {
    ShadowMapSettings seeded = map;
    seeded.seed = settings.scene->render.seed;
    const auto maps = std::make_shared<ShadowMaps>(lights.lights().size());
    ShadowMap drawn =
        renderShadowMap(geometry.surfaces, geometry.placed, fit, seeded, context.profile, settings.raster);
    CastShadow cast;
    if (isKept) cast.map = std::make_shared<const ShadowMap>(drawn);
    maps->set(lights.numberOf(light), std::move(drawn), context.profile, settings.raster.threads);
    cast.memory_bytes = maps->memory_bytes();
    cast.visibility = maps;
    return cast;
}

CastShadow castByVolumes(const SceneLights& lights, const LightId& light, std::vector<uint32_t> casters) {
    CastShadow cast;
    cast.volume = {lights.numberOf(light), std::move(casters)};
    return cast;
}

CastShadow castOnPlanes(const SceneSettings& settings, const PassContext& context, const Geometry& geometry,
                        const SceneLights& lights, const LightId& light, const std::vector<bool>& receivers,
                        const PlanarLightSettings& planar) {
    PlanarLightSettings seeded = planar;
    seeded.seed = settings.scene->render.seed;
    const size_t number = lights.numberOf(light);
    std::vector<PlanarVisibility::Entry> entries =
        planarShadowsOf(lights.lights()[number], number, geometry.placed, seeded, receivers, context.profile,
                        settings.raster);
    CastShadow cast;
    const std::vector<SceneObject> objects = sceneObjects(*settings.scene);
    for (const PlanarVisibility::Entry& entry : entries) {
        cast.fallsOn.push_back(objects[entry.instance].name);
        cast.memory_bytes += entry.shadow.shadow.values().size_bytes();
    }
    if (!entries.empty())
        cast.visibility = std::make_shared<PlanarVisibility>(std::move(entries), context.profile);
    return cast;
}

ViewShadows shadowsOfView(const SceneSettings& settings, const PassContext& context, const Geometry& geometry,
                          const SceneLights& lights, const std::vector<const CastShadow*>& shadows,
                          const View& view, int samples, uint32_t excluded) {
    JointVisibility::Ways ways;
    std::vector<std::vector<uint32_t>> casters;
    uint64_t volumes_bytes = 0;
    for (const CastShadow* shadow : shadows) {
        if (shadow->visibility) ways.push_back(shadow->visibility);
        if (!shadow->volume) continue;
        casters.resize(lights.lights().size());
        casters[shadow->volume->light] = shadow->volume->casters;
    }
    if (!casters.empty()) {
        VolumeShadowOptions options;
        options.lights = &lights.lights();
        options.samples = samples;
        options.excluded = excluded;
        options.casters = std::move(casters);
        const auto volumes = std::make_shared<VolumeShadows>(geometry.surfaces, geometry.placed, view,
                                                             context.profile, options, settings.raster);
        volumes_bytes = volumes->memory_bytes();
        ways.push_back(volumes);
    }
    if (ways.empty()) return {};
    return {std::make_shared<JointVisibility>(std::move(ways)), volumes_bytes};
}

SurfaceOcclusion occlusionInView(const SceneSettings& settings, const PassContext& context, bool ofVertices,
                                 const Geometry& geometry, const VisibleView& visible) {
    const ShadeJob job = viewJob(settings, context, geometry, visible);
    if (ofVertices) return {{}, vertexOcclusion(job, occlusionOptions(settings))};
    return {fragmentOcclusion(job, occlusionOptions(settings)), {}};
}

std::vector<VertexRadiance> lightVertices(const SceneSettings& settings, const PassContext& context,
                                          const Geometry& geometry, const VisibleView& visible,
                                          const SceneLights& lights,
                                          const EnvironmentIllumination& environment,
                                          const SurfaceOcclusion& occlusion) {
    ShadeJob job = viewJob(settings, context, geometry, visible);
    job.sources = sourcesOf(lights, environment);
    return lightVerticesOf(job, occlusion.vertices);
}

CubeRender renderObjectCube(const SceneSettings& settings, const PassContext& context, uint32_t instance,
                            bool hasOcclusion, const Geometry& geometry, const SceneLights& lights,
                            const EnvironmentImage& image, const EnvironmentIllumination& environment,
                            const std::optional<CubeMap<float>>& environmentCube,
                            const std::vector<const CastShadow*>& shadows, const ObjectCubes& cubes) {
    const SurfaceInstance& object = geometry.surfaces.instances[instance];
    CubeRenderRequest request;
    request.centre = object.cubeCentre_m;
    request.size = object.cubeSize;
    const CubeDepths depths =
        cubeDepthsOf(geometry.placed, request.centre, instance, settings.raster.threads);
    request.near_m = depths.near_m;
    request.far_m = depths.far_m;
    request.excluded = instance;
    request.prepare = [&](ShadeJob& job) {
        job.sources = sourcesOf(lights, environment);
        job.environment = &image.radiance;
        job.everyPart = settings.everything;
        for (const auto& [mirror, cube] : cubes) job.sceneCubes[mirror] = cube;
    };
    request.visibilityOf = [&](const View& face) {
        return shadowsOfView(settings, context, geometry, lights, shadows, face, 1, instance).visibility;
    };
    if (hasOcclusion)
        request.occlusionOf = [&](const ShadeJob& face) {
            return fragmentOcclusion(face, occlusionOptions(settings));
        };
    return renderCubeMap(geometry.surfaces, geometry.placed, request,
                         environmentCube ? &*environmentCube : nullptr, context.profile, settings.raster);
}

Shading shadeView(const SceneSettings& settings, const PassContext& context, const Geometry& geometry,
                  const VisibleView& visible, const std::vector<const ShadeTerm*>& terms) {
    ShadeJob job = viewJob(settings, context, geometry, visible);
    std::ranges::fill(job.request.evaluated, false);
    for (const ShadeTerm* term : terms)
        if (term->addTo) term->addTo(job);
    Shading shading;
    shading.images = shade(job, &shading.statistics);
    return shading;
}

Frame frameOf(const SceneSettings& settings, const PassContext& context,
              const std::vector<std::string>& outputs, const std::vector<LightId>& casting,
              const std::vector<const OutputChannels*>& made, const Shading& shading) {
    Frame frame;
    frame.width = settings.view.width;
    frame.height = settings.view.height;
    addMetadata(frame, settings, context);
    for (const OutputDescription& output : outputDescriptions()) {
        if (std::ranges::find(outputs, output.name) == outputs.end()) continue;
        for (const OutputChannels* of : made)
            if (of->output == output.name)
                frame.channels.insert(frame.channels.end(), of->channels.begin(), of->channels.end());
        for (const OutputPart& part : output.parts)
            if (part.image)
                addPlanes(frame, shading.images[*part.image], channelsOf(part, casting), part.missing);
    }
    if (frame.channels.empty())
        throw InputError(formatText(
            "{}: the image has no channel: 'shadow' has none where no light casts shadows, and what is "
            "written to files of its own needs another output beside it",
            where(*settings.scene, settings.scene->output.line)));
    return frame;
}

std::vector<OutputFile> cubeMapFiles(const SceneSettings& settings, const PassContext& context,
                                     const Geometry& geometry, const std::vector<uint32_t>& instances,
                                     const std::vector<const CubeRender*>& cubes) {
    std::vector<OutputFile> files;
    for (size_t i = 0; i < instances.size(); i++)
        files.push_back(cubeMapFile(settings, context, instances[i], geometry, *cubes[i]));
    return files;
}

std::vector<OutputFile> shadowMapFiles(const SceneSettings& settings, const PassContext& context,
                                       const std::vector<LightId>& lights,
                                       const std::vector<const CastShadow*>& shadows) {
    std::vector<OutputFile> files;
    for (size_t i = 0; i < lights.size(); i++)
        if (shadows[i]->map && !shadows[i]->map->layers.empty())
            files.push_back(shadowMapFile(settings, context, lights[i], *shadows[i]->map));
    return files;
}

Image<uint8_t> toneMapped(const SceneSettings& settings, const Shading& shading) {
    const Output& output = settings.scene->output;
    const Image<float>& beauty = shading.images[ShadeOutput::beauty];
    return toneMap(beauty.empty() ? Image<float>(settings.view.width, settings.view.height, 3) : beauty,
                   output.toneMap, output.exposure, settings.raster.threads);
}

}  // namespace etalon
