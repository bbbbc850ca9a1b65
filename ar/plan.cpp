#include "ar/plan.h"

#include <algorithm>

#include "probes/dominant_lights.h"
#include "numeric/text.h"

namespace etalon {
namespace {

constexpr std::string_view kComponentNames[kRadianceComponents] = {"ambient", "diffuse", "specular", "mirror",
                                                                   "background"};
constexpr int kFacesPerCube = 6;

bool isFinitePositive(const glm::dvec3& v) { return v.x > 0 || v.y > 0 || v.z > 0; }

// Collects the passes; every decision is made here, once, with its reason.
class Planner {
  public:
    Planner(const Scene& scene, const PlanRequest& request, const VisibilityFacts* facts)
        : scene_(scene), facts_(facts), objects_(planObjects(scene)) {
        outputs_ = request.outputs.empty() ? scene.output.images : request.outputs;
        plan_.toneMap = request.png;
    }

    Plan run() {
        planVisibility();
        for (int c = 0; c < kRadianceComponents; c++) planComponent(static_cast<ShadeOutput>(c));
        planVertexLighting();
        planCubes();
        planEnvironment();
        planOcclusion();
        planShadows();
        planSurfaceImages();
        planBeauty();
        plan_.memory_bytes = memory();
        return std::move(plan_);
    }

  private:
    bool asked(std::string_view output) const {
        return std::find(outputs_.begin(), outputs_.end(), output) != outputs_.end();
    }
    bool visible(size_t object) const { return facts_ == nullptr || facts_->objectVisible[object]; }
    bool anyVisible(auto&& has) const {
        for (size_t i = 0; i < objects_.size(); i++)
            if (visible(i) && has(*objects_[i].material)) return true;
        return false;
    }
    bool any(auto&& has) const {
        for (const PlanObject& object : objects_)
            if (has(*object.material)) return true;
        return false;
    }
    void add(std::string name, bool runs, std::string reason, std::vector<std::string> needs = {}) {
        plan_.passes.push_back({std::move(name), runs, std::move(reason), std::move(needs)});
    }

    void planVisibility() {
        std::vector<std::string> needs;
        if (objects_.empty())
            add("geometry", false, "the scene has no meshes and no planes");
        else
            add("geometry", true, formatText("{} objects to place", objects_.size()));
        if (!objects_.empty()) needs.push_back("geometry");
        add("visibility", true, "every output is of what is visible", needs);
        plan_.depth = asked("depth");
        plan_.ids = asked("ids");
        plan_.coverage = asked("coverage");
        for (const auto& [name, runs] : {std::pair("depth", plan_.depth), std::pair("ids", plan_.ids),
                                         std::pair("coverage", plan_.coverage)})
            add(name, runs, runs ? "output asked for" : "not an output", {"visibility"});
    }

    // Whether the environment lights surfaces, and whether it does so by lights that glosses reflect.
    bool environmentLights() const {
        return scene_.environment.kind != EnvironmentKind::none &&
               scene_.environment.lighting != EnvironmentLightMethod::none;
    }
    bool environmentHasLights() const {
        return environmentLights() && (scene_.environment.lighting == EnvironmentLightMethod::lights ||
                                       scene_.environment.lighting == EnvironmentLightMethod::dominant);
    }

    // Why a radiance component is zero everywhere, or empty when it may not be.
    std::string whyNothing(ShadeOutput component) const {
        const auto isDiffuse = [](const Material& m) { return hasDiffusePart(m); };
        const auto isGlossy = [](const Material& m) { return m.kind == MaterialKind::blinnPhong; };
        const auto isMirror = [](const Material& m) { return hasMirrorPart(m); };
        const auto missing = [&](auto&& has, std::string_view what) -> std::string {
            if (!any(has)) return formatText("no {} in the scene", what);
            if (!anyVisible(has)) return formatText("no {} is visible", what);
            return {};
        };
        switch (component) {
            case ShadeOutput::ambient:
                if (!isFinitePositive(scene_.ambient)) return "ambient is 0";
                return missing(isDiffuse, "diffuse surface");
            case ShadeOutput::diffuse:
                if (scene_.lights.empty() && !environmentLights()) return "no lights in the scene";
                return missing(isDiffuse, "diffuse surface");
            case ShadeOutput::specular:
                if (scene_.lights.empty() && !environmentHasLights()) return "no lights in the scene";
                return missing(isGlossy, "blinn_phong surface");
            case ShadeOutput::mirror:
                return missing(isMirror, "mirror");
            default:
                if (scene_.environment.kind == EnvironmentKind::none) return "no environment in the scene";
                if (facts_ && !facts_->backgroundVisible) return "objects cover every pixel";
                return {};
        }
    }

    void planComponent(ShadeOutput component) {
        const std::string name(kComponentNames[static_cast<size_t>(component)]);
        const bool output = asked(name), beauty = asked("beauty") || plan_.toneMap;
        const std::string nothing = whyNothing(component);
        if (!output && !beauty)
            add(name, false, "no output shows it", {"visibility"});
        else if (!nothing.empty())
            add(name, false, nothing, {"visibility"});
        else
            add(name, true, output ? "output asked for" : "part of the beauty", {"visibility"});
        plan_.request[component] = output;
    }
    bool runs(std::string_view name) const { return plan_.find(name)->runs; }
    void addNeed(std::string_view pass, const std::string& need) {
        for (PlanPass& p : plan_.passes)
            if (p.name == pass) p.needs.push_back(need);
    }

    // Gouraud shading, where the scene asks for it.
    void planVertexLighting() {
        if (!scene_.render.perVertex) return;
        plan_.lightVertices = runs("diffuse") || runs("specular");
        add("vertex lighting", plan_.lightVertices,
            plan_.lightVertices ? "the scene is lit per vertex" : "neither diffuse nor specular runs",
            {"visibility"});
        for (const char* component : {"diffuse", "specular"})
            if (runs(component)) addNeed(component, "vertex lighting");
    }

    // A cube map of the scene for each visible mirror that asks for one.
    void planCubes() {
        plan_.objectCube.assign(objects_.size(), false);
        for (size_t i = 0; i < objects_.size(); i++) {
            const PlanObject& object = objects_[i];
            if (!object.isMesh || !hasMirrorPart(*object.material) ||
                scene_.meshes[object.index].reflection != Reflection::scene)
                continue;
            const std::string name = "cube map of " + object.name;
            if (!runs("mirror")) {
                add(name, false, "the mirror pass does not run");
                continue;
            }
            plan_.objectCube[i] = visible(i);
            add(name, visible(i),
                visible(i) ? "a visible mirror reflects the scene" : "its mirror is not visible",
                {"geometry"});
            if (visible(i)) addNeed("mirror", name);
        }
    }

    // Of what the ambient light and the environment's diffuse light reach, where the scene asks for it.
    void planOcclusion() {
        if (scene_.render.occlusionDirections == 0) return;
        const bool environment =
            plan_.environmentLight && !environmentHasLights() && (runs("diffuse") || anyCube());
        plan_.occlusion = runs("ambient") || environment || (anyCube() && isFinitePositive(scene_.ambient));
        add("ambient occlusion", plan_.occlusion,
            plan_.occlusion ? formatText("surfaces see their surroundings from {} directions",
                                         scene_.render.occlusionDirections)
                            : "nothing that runs is lit from everywhere",
            {"geometry", "visibility"});
        if (!plan_.occlusion) return;
        if (runs("ambient")) addNeed("ambient", "ambient occlusion");
        if (environment && runs("diffuse")) addNeed("diffuse", "ambient occlusion");
        if (plan_.lightVertices) addNeed("vertex lighting", "ambient occlusion");
        for (size_t i = 0; i < objects_.size(); i++)
            if (plan_.objectCube[i]) addNeed("cube map of " + objects_[i].name, "ambient occlusion");
    }

    // What each light asks for, if something lies in its way.
    void planShadows() {
        const size_t count = scene_.lights.size();
        for (size_t l = 0; l < count; l++) {
            const SceneLight& light = scene_.lights[l];
            if (light.shadow.method == ShadowMethod::none) continue;
            const bool isBlack =
                !isFinitePositive(light.kind == LightKind::directional ? light.irradiance : light.intensity);
            planShadow({formatText("light{}", l), &light.shadow, l}, isBlack, "");
        }
        const Environment& environment = scene_.environment;
        if (environment.shadow.method == ShadowMethod::none) return;
        if (!facts_ || !facts_->environmentCasters) {
            add("shadows of environment lights", plan_.environmentLight,
                plan_.environmentLight ? "its lights are known once it is read" : "it lights nothing",
                {"environment light"});
            return;
        }
        if (facts_->environmentCasters->empty())
            add("shadows of environment lights", false,
                environment.shadowShare > 0 ? "no light has so large a share of its energy"
                                            : "it has no lights");
        for (const EnvironmentCaster& caster : *facts_->environmentCasters)
            planShadow(
                {formatText("environment light {}", caster.light), &environment.shadow, count + caster.light},
                false,
                formatText("region of {:.3g} sr, {:.3g} % of the energy; ", caster.solidAngle_sr,
                           100 * caster.share));
    }
    void planShadow(PlanShadow shadow, bool isBlack, const std::string& why) {
        constexpr std::string_view kNames[] = {"", "shadow map", "shadow volumes", "planar shadows"};
        const std::string name =
            formatText("{} of {}", kNames[static_cast<size_t>(shadow.shadow->method)], shadow.light);
        const std::string nothing = isBlack ? "the light is black" : whyNoShadow(*shadow.shadow);
        shadow.runs = nothing.empty();
        add(name, shadow.runs, why + (shadow.runs ? shadowText(*shadow.shadow) : nothing), {"geometry"});
        if (shadow.index >= scene_.lights.size()) addNeed(name, "environment light");
        plan_.shadows.push_back(std::move(shadow));
        if (!nothing.empty()) return;
        for (const char* component : {"diffuse", "specular"})
            if (runs(component)) addNeed(component, name);
        for (size_t i = 0; i < objects_.size(); i++)
            if (plan_.objectCube[i]) addNeed("cube map of " + objects_[i].name, name);
    }
    // The objects of the shadow that is planned next; null: not known yet.
    const std::vector<uint32_t>* shadowObjects() const {
        return facts_ && facts_->shadowObjects ? &(*facts_->shadowObjects)[plan_.shadows.size()] : nullptr;
    }
    std::string whyNoShadow(const LightShadow& shadow) const {
        if (!runs("diffuse") && !runs("specular") && !anyCube()) return "neither diffuse nor specular runs";
        if (scene_.render.perVertex && !anyCube()) return "the scene is lit per vertex";
        if (!shadowObjects() || !shadowObjects()->empty()) return {};
        return shadow.method == ShadowMethod::planar ? "no shadow falls on a plane that is visible"
                                                     : "nothing stands between the light and what is visible";
    }
    // The objects that cast, or are planes that shadows fall on, by name; the first few of many.
    std::string shadowText(const LightShadow& shadow) const {
        constexpr size_t kNamed = 4;
        const std::vector<uint32_t>* found = shadowObjects();
        if (!found) return "objects may stand in the light's way";
        std::string text = shadow.method == ShadowMethod::planar ? "fall on " : "cast by ";
        for (size_t i = 0; i < std::min(found->size(), kNamed); i++)
            text += (i > 0 ? ", " : "") + objects_[(*found)[i]].name;
        return found->size() > kNamed ? formatText("{} and {} more", text, found->size() - kNamed) : text;
    }

    bool anyCube() const {
        return std::find(plan_.objectCube.begin(), plan_.objectCube.end(), true) != plan_.objectCube.end();
    }
    // A mirror looks into the environment: a visible one directly, or any other inside a cube map.
    bool mirrorSeesEnvironment() const {
        if (!runs("mirror")) return false;
        for (size_t i = 0; i < objects_.size(); i++)
            if (hasMirrorPart(*objects_[i].material) && !plan_.objectCube[i] && (visible(i) || anyCube()))
                return true;
        return false;
    }

    void planEnvironment() {
        const bool isFile = scene_.environment.kind == EnvironmentKind::file;
        plan_.environmentCube = isFile && mirrorSeesEnvironment();
        plan_.environmentLight = environmentLights() && (runs("diffuse") || runs("specular") || anyCube());
        plan_.readEnvironment =
            isFile && (plan_.environmentCube || plan_.environmentLight || runs("background") || anyCube());
        if (!isFile) {
            add("environment image", false, "the environment is not an image");
        } else if (plan_.readEnvironment) {
            add("environment image", true,
                runs("background")       ? "the background shows it"
                : plan_.environmentLight ? "it lights surfaces"
                                         : "a mirror reflects it");
        } else {
            add("environment image", false,
                "neither the background nor a mirror shows it, and it lights nothing");
        }
        if (environmentLights()) {
            add("environment light", plan_.environmentLight,
                plan_.environmentLight
                    ? formatText("surfaces are lit by the environment: {}",
                                 kEnvironmentLightMethods[static_cast<size_t>(scene_.environment.lighting)])
                    : "neither diffuse nor specular runs",
                isFile ? std::vector<std::string>{"environment image"} : std::vector<std::string>{});
            for (const char* component : {"diffuse", "specular"})
                if (plan_.environmentLight && runs(component)) addNeed(component, "environment light");
        }
        add("environment cube map", plan_.environmentCube,
            plan_.environmentCube ? "a mirror reflects the environment"
            : isFile              ? "no mirror that runs reflects the environment"
                                  : "the environment is not an image",
            {"environment image"});
        if (plan_.readEnvironment && runs("background")) addNeed("background", "environment image");
        if (plan_.environmentCube) addNeed("mirror", "environment cube map");
        if (!plan_.readEnvironment) return;
        for (size_t i = 0; i < objects_.size(); i++)
            if (plan_.objectCube[i]) addNeed("cube map of " + objects_[i].name, "environment image");
    }

    void planSurfaceImages() {
        for (const auto& [name, output] :
             {std::pair("normals", ShadeOutput::normals), std::pair("distance", ShadeOutput::distance)}) {
            plan_.request[output] = asked(name);
            add(name, asked(name), asked(name) ? "output asked for" : "not an output", {"visibility"});
        }
    }

    void planBeauty() {
        const bool beauty = asked("beauty") || plan_.toneMap;
        plan_.request[ShadeOutput::beauty] = beauty;
        std::vector<std::string> needs;
        for (const std::string_view component : kComponentNames)
            if (beauty && runs(component)) needs.emplace_back(component);
        add("beauty", beauty,
            asked("beauty") ? "output asked for"
            : plan_.toneMap ? "the PNG shows it"
                            : "not an output",
            needs);
        add("tone mapping", plan_.toneMap, plan_.toneMap ? "a PNG is written" : "no PNG is written",
            {"beauty"});
    }

    static constexpr uint64_t kBytesPerSample = 4 + 4 + 1;  // depth, id, stencil
    // Of the images that a light's shadows are looked up in, and of what they are drawn into.
    static uint64_t shadowMemory(const LightShadow& shadow, bool isDirectional) {
        const auto squared = [](int size) {
            return static_cast<uint64_t>(size) * static_cast<uint64_t>(size);
        };
        if (shadow.method == ShadowMethod::map)
            return (isDirectional ? 1 : kFacesPerCube) * squared(shadow.map.size) *
                   (kBytesPerSample + 2 * sizeof(double));
        if (shadow.method == ShadowMethod::planar)
            return squared(shadow.planar.resolution) * (kBytesPerSample + sizeof(uint32_t) + sizeof(float));
        return 0;
    }
    // Bytes of the largest buffers that live at one time.
    uint64_t memory() const {
        constexpr uint64_t kBytesPerFloat = 4;
        const uint64_t pixels =
            static_cast<uint64_t>(scene_.camera.width) * static_cast<uint64_t>(scene_.camera.height);
        uint64_t floats = 0;
        for (int o = 0; o < kShadeOutputs; o++)
            if (plan_.request.wanted[o])
                floats += static_cast<ShadeOutput>(o) == ShadeOutput::distance ? 1 : 3;
        floats += (plan_.depth ? 1u : 0u) + (plan_.ids ? 2u : 0u) + (plan_.coverage ? 1u : 0u);
        // The images, and once more as the channels that are written.
        uint64_t bytes = pixels * (static_cast<uint64_t>(scene_.render.samples) * kBytesPerSample +
                                   2 * floats * kBytesPerFloat);
        for (size_t i = 0; i < objects_.size(); i++) {
            if (!plan_.objectCube[i]) continue;
            const auto size = static_cast<uint64_t>(scene_.meshes[objects_[i].index].cubeSize);
            bytes += kFacesPerCube * size * size * 4 * kBytesPerFloat;
        }
        // One depth map at a time, and a point and its sums for each fragment.
        if (plan_.occlusion) {
            constexpr uint64_t kBytesPerPoint = 256;
            const auto size = static_cast<uint64_t>(scene_.render.occlusionMapSize);
            bytes += size * size * kBytesPerSample +
                     pixels * static_cast<uint64_t>(scene_.render.samples) * kBytesPerPoint;
        }
        uint64_t volumes = 0;
        for (const PlanShadow& shadow : plan_.shadows) {
            if (!shadow.runs) continue;
            const bool isFar = shadow.index >= scene_.lights.size() ||
                               scene_.lights[shadow.index].kind == LightKind::directional;
            bytes += shadowMemory(*shadow.shadow, isFar);
            if (shadow.shadow->method == ShadowMethod::volume) volumes++;
        }
        if (plan_.environmentLight && !(facts_ && facts_->environmentCasters)) {
            const Environment& environment = scene_.environment;
            const int asked = environment.shadowShare > 0 ? kMaxShadowLights : environment.shadowLights;
            const int lights = environment.lighting == EnvironmentLightMethod::lights
                                   ? environment.lightCount
                                   : DominantLightSearch{}.maxLights;
            const auto most = static_cast<uint64_t>(std::min(asked, lights));
            bytes += most * shadowMemory(environment.shadow, true);
            if (environment.shadow.method == ShadowMethod::volume) volumes += most;
        }
        // The depths of one view at a time, and a mask for each light.
        if (volumes > 0)
            bytes += pixels * static_cast<uint64_t>(scene_.render.samples) *
                     (kBytesPerSample + sizeof(uint32_t) + volumes);
        return bytes;
    }

    const Scene& scene_;
    const VisibilityFacts* facts_;
    std::vector<PlanObject> objects_;
    std::vector<std::string> outputs_;
    Plan plan_;
};

}  // namespace

std::vector<PlanObject> planObjects(const Scene& scene) {
    std::vector<PlanObject> objects;
    for (size_t m = 0; m < scene.meshes.size(); m++) {
        const MeshObject& mesh = scene.meshes[m];
        for (size_t p = 0; p < mesh.objectToWorld.size(); p++) {
            const std::string name =
                mesh.objectToWorld.size() == 1 ? mesh.name : formatText("{}[{}]", mesh.name, p);
            objects.push_back({name, true, m, p, &scene.materials[mesh.material]});
        }
    }
    for (size_t p = 0; p < scene.planes.size(); p++)
        objects.push_back({scene.planes[p].name, false, p, 0, &scene.materials[scene.planes[p].material]});
    return objects;
}

std::vector<bool> shadowReceivers(const Scene& scene, const Plan& plan,
                                  const std::vector<bool>& objectVisible) {
    const bool anyCube =
        std::find(plan.objectCube.begin(), plan.objectCube.end(), true) != plan.objectCube.end();
    std::vector<bool> receivers;
    for (const PlanObject& object : planObjects(scene))
        receivers.push_back(hasDiffusePart(*object.material) && (anyCube || objectVisible[receivers.size()]));
    return receivers;
}

const PlanPass* Plan::find(std::string_view name) const {
    for (const PlanPass& pass : passes)
        if (pass.name == name) return &pass;
    return nullptr;
}

Plan makePlan(const Scene& scene, const PlanRequest& request, const VisibilityFacts* facts) {
    return Planner(scene, request, facts).run();
}

}  // namespace etalon
