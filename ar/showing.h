// What of a scene can show, as far as is known: the reasons of the plan. An answer that assumes that something is
// visible says so (takeAssumption).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "ar/plan.h"
#include "ar/surface_builder.h"

namespace etalon {

class Showing {
  public:
    Showing(const Scene& scene, const Profile& profile, const PlanFacts& facts);

    const std::vector<SceneObject>& objects() const { return objects_; }
    const SurfaceMaterial& material(size_t object) const { return materials_[object]; }

    // Whether an answer since the last call assumed that something is visible.
    bool takeAssumption() { return std::exchange(assumes_, false); }

    bool isVisible(size_t object) const;
    // Whether an object has a cube map of the scene to mirror, seen or not; and whether a cube map shows: one whose
    // mirror is visible.
    bool hasCube(size_t object) const;
    bool anyCube() const;
    // Whether a pixel, or a cube map, may show an object.
    bool isShown(size_t object) const { return isVisible(object) || anyCube(); }

    bool environmentIsBlack() const;
    // Whether the environment lights surfaces: by lights that glosses reflect, or diffuse surfaces from everywhere.
    bool environmentLights() const;
    bool environmentHasLights() const;
    bool environmentIsDiffuse() const { return environmentLights() && !environmentHasLights(); }

    // For each light of the scene whether it is not black and reaches a surface that is shown.
    std::vector<bool> lightsThatShow() const;

    // Why a radiance component is 0 everywhere; empty: it may not be.
    std::string whyBlack(ShadeOutput component) const;
    // Why the cube map of an object shows nowhere, or is black.
    std::string whyNoCube(size_t object) const;
    // Why the cube map of an object shows in no other one.
    std::string whyNoCubeForCubes(size_t object) const;
    // Whether another object's mirror is in the cube map of an object.
    bool cubeSeesMirror(size_t object) const;
    bool isEnvironmentMirrorVisible() const;

    // Why all that the camera sees of diffuse surfaces, or of all, is open, or nothing depends on it. ofVertices:
    // found at vertices, else at fragments.
    std::string whyNoOcclusion(bool ofVertices, bool ofAllSurfaces) const;
    // Why nothing that is visible receives light of the environment, or, if it reflects it, none that it reflects.
    std::string whyNoIrradiance() const;
    std::string whyNoEnvironment() const;
    std::string whyNothingVisible() const;
    // Whether what cube maps show depends on what it sees of its surroundings.
    bool cubesHaveOcclusion() const;

    // What shadows may fall on: what is shown and reflects lights. Independent of the outputs.
    std::vector<bool> receivers() const;
    // What casts a light's shadows on the receivers; none: the geometry is not known.
    std::optional<ShadowFit> fitOf(const SurfaceLight& light, const LightShadow& shadow) const;
    // The receivers that are planes; none: the geometry is not known.
    std::optional<std::vector<uint32_t>> planarReceivers() const;
    // Why a light that is not black has no shadow. fit: that of maps and volumes. isOutput: what its shadow method
    // finds is shown, and not only what the light loses by it.
    std::string whyNoShadow(const SurfaceLight& light, const LightShadow& shadow,
                            const std::optional<ShadowFit>& fit, bool isOutput) const;

    // The names of objects; the first few of many.
    std::string namesOf(const std::vector<uint32_t>& objects) const;

  private:
    bool any(const auto& has) const;
    bool anyVisible(const auto& has) const;
    std::string whyMissing(const auto& hasPart, const auto& reflects, std::string_view what,
                           std::string_view reflectance) const;
    bool reaches(const SurfaceLight& light, size_t object) const;
    bool isBackgroundVisible() const;
    bool isDark() const;
    bool isOpen(const std::vector<bool>& marked, const Arithmetic& arithmetic) const;

    const Scene& scene_;
    const Profile& profile_;
    const PlanFacts& facts_;
    std::vector<SceneObject> objects_;
    std::vector<SurfaceMaterial> materials_;  // of each object
    std::vector<SurfaceLight> lights_;        // of the scene
    mutable bool assumes_ = false;
};

}  // namespace etalon
