#include "ar/render_scene.h"

#include <unistd.h>

#include <algorithm>
#include <bit>

#include "ar/environment_light.h"
#include "ar/scene_shadows.h"
#include "ar/surface_builder.h"
#include "lighting/render_view.h"
#include "raster/depth.h"
#include "raster/rules.h"
#include "shadows/casting_lights.h"
#include "shadows/surface_occlusion.h"
#include "numeric/text.h"

namespace etalon {
namespace {

constexpr double kGiB = 1024.0 * 1024.0 * 1024.0;

uint64_t machineMemory_bytes() {
    return static_cast<uint64_t>(sysconf(_SC_PHYS_PAGES)) * static_cast<uint64_t>(sysconf(_SC_PAGESIZE));
}

// Whether the whole number n > 0 is a number of the format.
bool holds(const Format& format, int n) {
    const int odd = n >> std::countr_zero(static_cast<unsigned>(n));
    return odd >> format.significandBits == 0 && n <= largestFinite(format);
}

// Runs the passes of one scene; each step fills the members that later ones read.
class SceneRenderer {
  public:
    SceneRenderer(const Scene& scene, const RenderOptions& options)
        : scene_(scene),
          options_(options),
          profile_(options.profile ? *options.profile : scene.render.profile),
          view_(cameraViewOf(scene.camera)),
          shadows_(surfaces_, placed_, profile_, options.raster, scene.render.seed, options.progress) {}

    void findVisibleObjects() {
        result_.plan = makePlan(scene_, options_.request);
        requireMemory();
        progress("geometry");
        surfaces_ = buildSurfaces(scene_, result_.warnings);
        placed_ = placeMeshes(surfaces_, profile_.vertex, options_.raster.threads);
        progress("visibility");
        visible_.emplace(
            findVisible(surfaces_, placed_, view_, profile_, scene_.render.samples, options_.raster));
        result_.raster = visible_->statistics;
        // What later plans decide with: what is seen, then the environment's lights, then what their shadows,
        // and those of other lights, may fall on.
        VisibilityFacts facts = visibilityFacts();
        const auto plan = [&] { result_.plan = makePlan(scene_, options_.request, &facts); };
        plan();
        if (result_.plan.environmentLight && scene_.environment.shadow.method != ShadowMethod::none) {
            makeEnvironmentLight();
            facts.environmentCasters = environmentCasters();
            plan();
        }
        facts.shadowObjects =
            shadows_.find(result_.plan.shadows, shadowReceivers(scene_, result_.plan, facts.objectVisible));
        plan();
    }

    RenderResult render() {
        findVisibleObjects();
        makeEnvironment();
        shadows_.make(result_.plan.shadows);
        makeCubes();
        shadeView();
        makeFrame();
        return std::move(result_);
    }

    Plan plan() {
        findVisibleObjects();
        return std::move(result_.plan);
    }

  private:
    void progress(const std::string& pass) const {
        if (options_.progress) options_.progress(pass);
    }

    // Whether memory goes to more than the view.
    bool hasMaps() const {
        const Plan& plan = result_.plan;
        return plan.occlusion || !plan.shadows.empty() ||
               (plan.environmentLight && scene_.environment.shadow.method != ShadowMethod::none) ||
               std::ranges::find(plan.objectCube, true) != plan.objectCube.end();
    }
    void requireMemory() const {
        const uint64_t needed = result_.plan.memory_bytes, present = machineMemory_bytes();
        if (needed <= present) {
            if (options_.announceMemory) options_.announceMemory(needed);
            return;
        }
        throw InputError(
            formatText("{}: {}x{} pixels with {} samples{} need {:.1f} GiB, this machine has {:.1f} GiB",
                       where(scene_, scene_.camera.line), scene_.camera.width, scene_.camera.height,
                       scene_.render.samples, hasMaps() ? ", and the maps that they look up," : "",
                       static_cast<double>(needed) / kGiB, static_cast<double>(present) / kGiB));
    }

    // Images are sampled with their sizes as numbers of the fragment arithmetic.
    void requireSampling(const char* what, int line, int width, int height) const {
        if (profile_.fragment.type != NumberType::emulated) return;
        for (const int size : {width, height})
            if (!holds(profile_.fragment.format, size))
                throw InputError(formatText(
                    "{}: {} of {}x{} texels cannot be sampled in the profile {}: its format holds no {}",
                    where(scene_, line), what, width, height, profile_.name, size));
    }
    bool runs(std::string_view pass) const {
        return std::ranges::any_of(result_.plan.passes,
                                   [&](const PlanPass& of) { return of.name == pass && of.runs; });
    }

    VisibilityFacts visibilityFacts() const {
        VisibilityFacts facts;
        facts.objectVisible.assign(surfaces_.instances.size(), false);
        facts.backgroundVisible = false;
        for (const uint32_t id : visible_->target.id.values()) {
            if (id == kNoTriangle)
                facts.backgroundVisible = true;
            else
                facts.objectVisible[visible_->instanceOfDraw[visible_->target.triangles[id].draw]] = true;
        }
        return facts;
    }

    // Which of the environment's lights cast shadows.
    std::vector<EnvironmentCaster> environmentCasters() const {
        const Environment& environment = scene_.environment;
        std::vector<size_t> found =
            environment.shadowShare > 0
                ? lightsOfLargestShare(environmentLights_, environment.shadowShare)
                : lightsOfSmallestRegion(environmentLights_, static_cast<size_t>(environment.shadowLights));
        found.resize(std::min(found.size(), size_t{kMaxShadowLights}));
        const double total = energyOf(totalEnergy(environmentLights_));
        std::vector<EnvironmentCaster> casters;
        for (const size_t i : found) {
            const ProbeLight& light = environmentLights_[i];
            casters.push_back({i, light.solidAngle_sr, energyOf(light.energy) / total});
        }
        return casters;
    }

    void readEnvironment() {
        if (!result_.plan.readEnvironment || !surfaces_.environment.latLong.empty()) return;
        progress("environment image");
        surfaces_.environment.latLong = loadEnvironment(scene_, options_.strict, result_.warnings);
    }
    void makeEnvironmentLight() {
        if (!result_.plan.environmentLight || hasEnvironmentLight_) return;
        readEnvironment();
        progress("environment light");
        environmentLights_ =
            addEnvironmentLight(scene_.environment, profile_, options_.raster.threads, surfaces_);
        hasEnvironmentLight_ = true;
    }
    void makeEnvironment() {
        readEnvironment();
        const Image<float>& latLong = surfaces_.environment.latLong;
        if (!latLong.empty() && (result_.plan.environmentCube || runs("background")))
            requireSampling("an environment", scene_.environment.line, latLong.width(), latLong.height());
        const EnvironmentLightMethod method = scene_.environment.lighting;
        if (result_.plan.environmentLight &&
            (method == EnvironmentLightMethod::map || method == EnvironmentLightMethod::blurred))
            requireSampling("a map of irradiance", scene_.environment.line, scene_.environment.mapSize,
                            scene_.environment.mapSize);
        makeEnvironmentLight();
        if (!result_.plan.environmentCube) return;
        progress("environment cube map");
        environmentCube_.emplace(environmentCube(surfaces_.environment, profile_, options_.raster.threads));
    }

    void makeCubes() {
        cubes_.resize(surfaces_.instances.size());
        for (uint32_t i = 0; i < surfaces_.instances.size(); i++) {
            if (!result_.plan.objectCube[i]) continue;
            const SurfaceInstance& instance = surfaces_.instances[i];
            progress("cube map");
            CubeRenderRequest request;
            request.centre = instance.cubeCentre_m;
            request.size = instance.cubeSize;
            requireSampling("a cube map", 0, request.size, request.size);
            request.near_m = scene_.camera.near;
            request.far_m = scene_.camera.far;
            request.excluded = i;
            request.visibility = shadows_.common();
            request.visibilityOf = [&](const View& face) { return shadows_.ofView(face, 1, i); };
            if (result_.plan.occlusion)
                request.occlusionOf = [&](const ShadeJob& face) {
                    return fragmentOcclusion(face, occlusionOptions());
                };
            cubes_[i].emplace(renderCubeMap(surfaces_, placed_, request,
                                            environmentCube_ ? &*environmentCube_ : nullptr, profile_,
                                            options_.raster));
        }
    }

    DirectionalOptions occlusionOptions() const {
        return {scene_.render.occlusionDirections, scene_.render.occlusionMapSize, options_.raster};
    }
    void shadeView() {
        ShadeJob job = shadeJobOf(*visible_, surfaces_, placed_, view_, profile_, options_.raster);
        job.environmentCube = environmentCube_ ? &*environmentCube_ : nullptr;
        for (size_t i = 0; i < cubes_.size(); i++)
            if (cubes_[i]) job.sceneCubes[i] = &cubes_[i]->radiance;
        const std::unique_ptr<LightVisibility> ofView =
            shadows_.ofView(view_, scene_.render.samples, kNoInstance);
        job.visibility = ofView ? ofView.get() : shadows_.common();
        job.request = result_.plan.request;
        if (result_.plan.occlusion) progress("ambient occlusion");
        std::vector<VertexRadiance> radiance;
        TileOcclusion occlusion;
        if (result_.plan.lightVertices) {
            radiance = lightVerticesOf(job, result_.plan.occlusion ? vertexOcclusion(job, occlusionOptions())
                                                                   : std::vector<VertexOcclusion>{});
            job.vertexRadiance = &radiance;
        } else if (result_.plan.occlusion) {
            occlusion = fragmentOcclusion(job, occlusionOptions());
            job.occlusion = &occlusion;
        }
        progress("shading");
        shaded_ = shade(job, &result_.shading);
    }

    // The outputs in the order of kOutputNames, whatever order they were asked for in.
    void makeFrame() {
        Frame& frame = result_.frame;
        frame.width = view_.width;
        frame.height = view_.height;
        frame.metadata = {{"etalon.scene", scene_.file.filename().string()},
                          {"etalon.profile", profile_.name},
                          {"etalon.rules", std::to_string(kRulesVersion)}};
        const std::vector<std::string>& asked =
            options_.request.outputs.empty() ? scene_.output.images : options_.request.outputs;
        for (const std::string_view name : kOutputNames) {
            if (std::find(asked.begin(), asked.end(), name) == asked.end()) continue;
            if (name == "beauty") addColour(ShadeOutput::beauty, "");
            if (name == "depth") addDepth();
            if (name == "distance") addPlanes(ShadeOutput::distance, {"distance"});
            if (name == "normals") addPlanes(ShadeOutput::normals, {"N.X", "N.Y", "N.Z"});
            if (name == "ids") addIds();
            if (name == "coverage") addCoverage();
            if (name == "diffuse") addColour(ShadeOutput::diffuse, "diffuse.");
            if (name == "specular") addColour(ShadeOutput::specular, "specular.");
            if (name == "mirror") addColour(ShadeOutput::mirror, "mirror.");
            if (name == "background") addColour(ShadeOutput::background, "background.");
            if (name == "ambient") addColour(ShadeOutput::ambient, "ambient.");
        }
        result_.beauty = std::move(shaded_[ShadeOutput::beauty]);
    }

    void addPlanes(ShadeOutput output, const std::vector<std::string>& names) {
        const Image<float>& image = shaded_[output];
        for (size_t c = 0; c < names.size(); c++) {
            Image<float> plane(view_.width, view_.height);
            std::copy(image.plane(static_cast<int>(c)).begin(), image.plane(static_cast<int>(c)).end(),
                      plane.values().begin());
            result_.frame.channels.push_back({names[c], std::move(plane)});
        }
    }
    void addColour(ShadeOutput output, const std::string& layer) {
        addPlanes(output, {layer + "R", layer + "G", layer + "B"});
    }
    // Sample 0 as it is stored, on the scale 0 (near) to 1 (far).
    void addDepth() {
        Image<float> depth(view_.width, view_.height);
        const RenderTarget& target = visible_->target;
        for (size_t i = 0; i < depth.pixelCount(); i++)
            depth.values()[i] =
                static_cast<float>(depthFromStored(target.format.depth, target.depth.plane(0)[i]));
        result_.frame.channels.push_back({"Z", std::move(depth)});
    }
    // Sample 0: the object (1 for the first; 0: nothing) and its triangle (from 0).
    void addIds() {
        Image<uint32_t> objects(view_.width, view_.height), triangles(view_.width, view_.height);
        const RenderTarget& target = visible_->target;
        for (size_t i = 0; i < objects.pixelCount(); i++) {
            const uint32_t id = target.id.plane(0)[i];
            if (id == kNoTriangle) continue;
            objects.values()[i] = visible_->instanceOfDraw[target.triangles[id].draw] + 1;
            triangles.values()[i] = target.triangles[id].triangle;
        }
        result_.frame.channels.push_back({"id.object", std::move(objects)});
        result_.frame.channels.push_back({"id.triangle", std::move(triangles)});
    }
    // The fraction of a pixel's samples that objects cover.
    void addCoverage() {
        Image<float> coverage(view_.width, view_.height);
        const Image<uint32_t>& id = visible_->target.id;
        for (size_t i = 0; i < coverage.pixelCount(); i++) {
            int covered = 0;
            for (int s = 0; s < id.channels(); s++) covered += id.plane(s)[i] != kNoTriangle ? 1 : 0;
            coverage.values()[i] = static_cast<float>(covered) / static_cast<float>(id.channels());
        }
        result_.frame.channels.push_back({"coverage", std::move(coverage)});
    }

    const Scene& scene_;
    const RenderOptions& options_;
    const Profile profile_;
    View view_;
    RenderResult result_;
    SurfaceScene surfaces_;
    std::vector<PlacedMesh> placed_;
    std::optional<VisibleScene> visible_;
    std::optional<CubeMap<float>> environmentCube_;
    std::vector<ProbeLight> environmentLights_;
    bool hasEnvironmentLight_ = false;
    SceneShadows shadows_;
    std::vector<std::optional<CubeRender>> cubes_;
    ShadedImages shaded_;
};

}  // namespace

RenderResult renderScene(const Scene& scene, const RenderOptions& options) {
    return SceneRenderer(scene, options).render();
}

Plan planScene(const Scene& scene, const RenderOptions& options) {
    return SceneRenderer(scene, options).plan();
}

}  // namespace etalon
