#include "ar/showing.h"

#include <algorithm>

#include "numeric/text.h"
#include "shadows/planar_receiver.h"
#include "shadows/reach.h"

namespace etalon {
namespace {

bool isBlackLight(const SurfaceLight& light) {
    return isBlack(light.kind == LightKind::directional ? light.irradiance : light.intensity);
}

Arithmetic vertexArithmetic(const Profile& profile) {
    return profile.vertex == RasterReal::fp32 ? Arithmetic::fp32 : Arithmetic::fp64;
}

}  // namespace

Showing::Showing(const Scene& scene, const Profile& profile, const PlanFacts& facts)
    : scene_(scene), profile_(profile), facts_(facts), objects_(sceneObjects(scene)) {
    for (const SceneObject& object : objects_) materials_.push_back(surfaceMaterialOf(*object.material));
    for (const SceneLight& light : scene.lights) lights_.push_back(light);
}

bool Showing::isVisible(size_t object) const {
    if (facts_.visibility) return facts_.visibility->objectVisible[object];
    assumes_ = true;
    return true;
}
bool Showing::isBackgroundVisible() const {
    if (facts_.visibility) return facts_.visibility->backgroundVisible;
    assumes_ = true;
    return true;
}
bool Showing::any(const auto& has) const { return std::ranges::any_of(materials_, has); }
bool Showing::anyVisible(const auto& has) const {
    for (size_t i = 0; i < objects_.size(); i++)
        if (has(materials_[i]) && isVisible(i)) return true;
    return false;
}

bool Showing::hasCube(size_t object) const {
    const SceneObject& of = objects_[object];
    return of.isMesh && hasMirrorPart(*of.material) &&
           scene_.meshes[of.index].reflection == Reflection::scene;
}
bool Showing::anyCube() const {
    for (size_t i = 0; i < objects_.size(); i++)
        if (hasCube(i) && mirrors(materials_[i]) && isVisible(i)) return true;
    return false;
}

bool Showing::environmentIsBlack() const {
    const Environment& environment = scene_.environment;
    return environment.kind == EnvironmentKind::none ||
           (environment.kind == EnvironmentKind::constant && isBlack(environment.constant));
}
bool Showing::environmentLights() const {
    return !environmentIsBlack() && scene_.environment.lighting != EnvironmentLightMethod::none;
}
bool Showing::environmentHasLights() const {
    return environmentLights() && (scene_.environment.lighting == EnvironmentLightMethod::lights ||
                                   scene_.environment.lighting == EnvironmentLightMethod::dominant);
}
// Nothing shines.
bool Showing::isDark() const {
    return environmentIsBlack() && isBlack(scene_.ambient) && std::ranges::all_of(lights_, isBlackLight);
}

bool Showing::reaches(const SurfaceLight& light, size_t object) const {
    if (!facts_.geometry) return true;
    const int bits =
        std::min(significandBitsOf(profile_.fragment), significandBitsOf(vertexArithmetic(profile_)));
    return lightReaches(facts_.geometry->placed[object], facts_.geometry->surfaces.instances[object].twoSided,
                        light, bits);
}

std::vector<bool> Showing::lightsThatShow() const {
    std::vector<bool> shows;
    for (const SurfaceLight& light : lights_) {
        bool isSeen = false;
        for (size_t i = 0; i < objects_.size() && !isSeen && !isBlackLight(light); i++)
            isSeen = (reflectsDiffusely(materials_[i]) || reflectsSpecularly(materials_[i])) && isShown(i) &&
                     reaches(light, i);
        shows.push_back(isSeen);
    }
    return shows;
}

// Why no surface has a part that shows.
std::string Showing::whyMissing(const auto& hasPart, const auto& reflects, std::string_view what,
                                std::string_view reflectance) const {
    if (!any(hasPart)) return formatText("no {} in the scene", what);
    if (!any(reflects)) return formatText("the {} of each {} is 0", reflectance, what);
    if (!anyVisible(hasPart)) return formatText("no {} is visible", what);
    if (!anyVisible(reflects)) return formatText("the {} of each {} that is visible is 0", reflectance, what);
    return {};
}

std::string Showing::whyBlack(ShadeOutput component) const {
    const auto whyUnlit = [&](bool byEnvironment, const auto& hasPart, const auto& reflects,
                              std::string_view what, std::string_view reflectance,
                              const char* unlitBy) -> std::string {
        if (std::ranges::all_of(lights_, isBlackLight) && !byEnvironment)
            return std::string(lights_.empty() ? "no lights in the scene" : "every light is black") +
                   (environmentIsBlack() ? "" : unlitBy);
        const std::string missing = whyMissing(hasPart, reflects, what, reflectance);
        if (!missing.empty() || byEnvironment) return missing;
        for (size_t i = 0; i < objects_.size(); i++)
            if (reflects(materials_[i]) && isVisible(i))
                for (const SurfaceLight& light : lights_)
                    if (!isBlackLight(light) && reaches(light, i)) return {};
        return formatText("the lights are behind each {} that is visible", what);
    };
    const auto isDiffuse = [](const SurfaceMaterial& m) { return hasDiffusePart(m); };
    switch (component) {
        case ShadeOutput::ambient:
            if (isBlack(scene_.ambient)) return "ambient is 0";
            return whyMissing(isDiffuse, reflectsDiffusely, "diffuse surface", "diffuse reflectance");
        case ShadeOutput::diffuse:
            return whyUnlit(environmentLights(), isDiffuse, reflectsDiffusely, "diffuse surface",
                            "diffuse reflectance", ", and the environment lights no surfaces");
        case ShadeOutput::specular:
            return whyUnlit(
                environmentHasLights(), [](const SurfaceMaterial& m) { return hasSpecularPart(m); },
                reflectsSpecularly, "blinn_phong surface", "specular reflectance",
                ", and the environment is not cut into lights");
        case ShadeOutput::mirror: {
            const std::string missing = whyMissing([](const SurfaceMaterial& m) { return hasMirrorPart(m); },
                                                   mirrors, "mirror", "reflectance");
            if (!missing.empty()) return missing;
            if (isDark()) return "nothing in the scene shines";
            if (environmentIsBlack() && !anyCube()) return "the environment that mirrors show is black";
            return {};
        }
        default:
            if (scene_.environment.kind == EnvironmentKind::none) return "no environment in the scene";
            if (environmentIsBlack()) return "the environment is black";
            return isBackgroundVisible() ? "" : "objects cover every pixel";
    }
}

std::string Showing::whyNoCube(size_t object) const {
    if (!mirrors(materials_[object])) return "its mirror is black";
    if (isDark()) return "nothing in the scene shines";
    return isVisible(object) ? "" : "its mirror is not visible";
}
bool Showing::cubeSeesMirror(size_t object) const {
    for (size_t i = 0; i < objects_.size(); i++)
        if (i != object && mirrors(materials_[i])) return true;
    return false;
}
std::string Showing::whyNoCubeForCubes(size_t object) const {
    if (!mirrors(materials_[object])) return "it reflects nothing";
    for (size_t i = 0; i < objects_.size(); i++)
        if (i != object && hasCube(i)) return {};
    return "no other mirror reflects the scene";
}
bool Showing::isEnvironmentMirrorVisible() const {
    for (size_t i = 0; i < objects_.size(); i++)
        if (mirrors(materials_[i]) && !hasCube(i) && isVisible(i)) return true;
    return false;
}

// Whether occlusion changes no bit of what the marked objects reflect.
bool Showing::isOpen(const std::vector<bool>& marked, const Arithmetic& arithmetic) const {
    return isAllOpen(facts_.geometry->placed, facts_.geometry->surfaces.instances, marked,
                     scene_.render.occlusionMapSize, significandBitsOf(arithmetic));
}
std::string Showing::whyNoOcclusion(bool ofVertices, bool ofAllSurfaces) const {
    std::vector<bool> marked(objects_.size());
    for (size_t i = 0; i < objects_.size(); i++)
        marked[i] = (ofAllSurfaces || reflectsDiffusely(materials_[i])) && isVisible(i);
    // Where nothing is lit from everywhere, no pass asks.
    if (!facts_.geometry || std::ranges::find(marked, true) == marked.end()) return {};
    // Bent normals are doubles, made unit at vertices: those that are not bent may differ from the normal in the
    // last place.
    const bool isRounded = ofVertices || profile_.fragment == Arithmetic::truth;
    if ((environmentIsDiffuse() || ofAllSurfaces) && isRounded) return {};
    return isOpen(marked, ofVertices ? vertexArithmetic(profile_) : profile_.fragment)
               ? ofAllSurfaces ? "nothing can occlude what is visible"
                               : "nothing can occlude the diffuse surfaces that are visible"
               : "";
}
std::string Showing::whyNothingVisible() const {
    for (size_t i = 0; i < objects_.size(); i++)
        if (isVisible(i)) return {};
    return "no surface is visible";
}
std::string Showing::whyNoIrradiance() const {
    if (environmentIsBlack()) return "the environment is black";
    if (!environmentLights()) return "the environment lights no surfaces";
    return whyNothingVisible();
}
std::string Showing::whyNoEnvironment() const {
    const std::string dark = whyNoIrradiance();
    return dark.empty() ? whyMissing([](const SurfaceMaterial& m) { return hasDiffusePart(m); },
                                     reflectsDiffusely, "diffuse surface", "diffuse reflectance")
                        : dark;
}
bool Showing::cubesHaveOcclusion() const {
    if (scene_.render.occlusionDirections == 0) return false;
    if (isBlack(scene_.ambient) && !environmentIsDiffuse()) return false;
    if (!facts_.geometry || (environmentIsDiffuse() && profile_.fragment == Arithmetic::truth)) return true;
    std::vector<bool> marked;
    for (const SurfaceMaterial& material : materials_) marked.push_back(reflectsDiffusely(material));
    return !isOpen(marked, profile_.fragment);
}

std::vector<bool> Showing::receivers() const {
    std::vector<bool> receivers;
    for (size_t i = 0; i < objects_.size(); i++)
        receivers.push_back((reflectsDiffusely(materials_[i]) || reflectsSpecularly(materials_[i])) &&
                            isShown(i));
    return receivers;
}

std::optional<ShadowFit> Showing::fitOf(const SurfaceLight& light, const LightShadow& shadow) const {
    if (!facts_.geometry || shadow.method == ShadowMethod::planar) return std::nullopt;
    return fitShadowMap(facts_.geometry->placed, light, receivers(), shadow.map);
}

std::optional<std::vector<uint32_t>> Showing::planarReceivers() const {
    if (!facts_.geometry) return std::nullopt;
    const std::vector<bool> receives = receivers();
    std::vector<uint32_t> planes;
    for (uint32_t i = 0; i < objects_.size(); i++)
        if (receives[i] && planarReceiverOf(facts_.geometry->placed[i])) planes.push_back(i);
    return planes;
}

std::string Showing::whyNoShadow(const SurfaceLight& light, const LightShadow& shadow,
                                 const std::optional<ShadowFit>& fit, bool isOutput) const {
    const std::vector<bool> receives = receivers();
    if (std::ranges::find(receives, true) == receives.end())
        return "no surface that is visible reflects lights";
    bool isReached = isOutput;
    for (size_t i = 0; i < objects_.size() && !isReached; i++) isReached = receives[i] && reaches(light, i);
    if (!isReached) return "the light is behind all that is visible, and no output shows its shadow";
    if (fit && fit->casters.empty()) return "nothing stands between the light and what is visible";
    if (shadow.method != ShadowMethod::planar) return {};
    if (objects_.size() == 1) return "nothing stands between the light and what is visible";
    const auto planes = planarReceivers();
    return planes && planes->empty() ? "no plane is visible that a shadow could fall on" : "";
}

std::string Showing::namesOf(const std::vector<uint32_t>& objects) const {
    constexpr size_t kNamed = 4;
    std::string text;
    for (size_t i = 0; i < std::min(objects.size(), kNamed); i++)
        text += (i > 0 ? ", " : "") + objects_[objects[i]].name;
    return objects.size() > kNamed ? formatText("{} and {} more", text, objects.size() - kNamed) : text;
}

}  // namespace etalon
