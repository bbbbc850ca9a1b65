// The plan: which passes a scene and the requested outputs need, and why each other one does not run.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "ar/scene.h"
#include "lighting/shade.h"

namespace etalon {

// One pass. name is unique in a plan; needs: the names of the passes whose results it reads.
struct PlanPass {
    std::string name;
    bool runs = false;
    std::string reason;
    std::vector<std::string> needs;
};

// An object of the scene that is drawn on its own: a mesh placed once, or a plane. Meshes come first, in the
// order of the file, each with its placements in order; then the planes.
struct PlanObject {
    std::string name;
    bool isMesh = false;
    size_t index = 0, placement = 0;  // into Scene::meshes and MeshObject::objectToWorld, or Scene::planes
    const Material* material = nullptr;
};
std::vector<PlanObject> planObjects(const Scene& scene);

// A light whose shadows the scene asks for.
struct PlanShadow {
    std::string light;                    // "light0", "environment light 3"
    const LightShadow* shadow = nullptr;  // the scene's
    size_t index = 0;                     // of the light among SurfaceScene::lights
    bool runs = false;
};

// A light of the environment that casts shadows.
struct EnvironmentCaster {
    size_t light = 0;          // among those that addEnvironmentLight adds
    double solidAngle_sr = 0;  // that it stands for
    double share = 0;          // of the energy of all of them
};

// What earlier passes found; without it the plan assumes that everything may be visible.
struct VisibilityFacts {
    std::vector<bool> objectVisible;  // for each of planObjects
    bool backgroundVisible = true;
    // Once the environment's lights are known.
    std::optional<std::vector<EnvironmentCaster>> environmentCasters;
    // For each of the shadows of the plan with the facts above: the objects that stand between the light and
    // what is lit (map, volume), or the planes that shadows fall on (planar).
    std::optional<std::vector<std::vector<uint32_t>>> shadowObjects;
};

struct Plan {
    std::vector<PlanPass> passes;

    // The same decisions for the renderer.
    ShadeRequest request;           // what shading makes
    bool readEnvironment = false;   // the lat-long image
    bool environmentCube = false;   // its cube map for mirrors
    bool environmentLight = false;  // what it lights surfaces with
    std::vector<bool> objectCube;   // for each of planObjects: render its cube map
    bool lightVertices = false;     // lights are evaluated at vertices
    bool occlusion = false;         // what surfaces see of their surroundings
    // Of the scene's lights in their order, then of the environment's, as far as these are known.
    std::vector<PlanShadow> shadows;
    bool depth = false, ids = false, coverage = false, toneMap = false;
    uint64_t memory_bytes = 0;  // of render target and images, at most

    const PlanPass* find(std::string_view name) const;
};

// Which objects shadows may fall on: those whose surface reflects lights and that a pixel, or a cube map, may
// show.
std::vector<bool> shadowReceivers(const Scene& scene, const Plan& plan,
                                  const std::vector<bool>& objectVisible);

// What is asked for beyond the scene's own outputs.
struct PlanRequest {
    std::vector<std::string> outputs;  // of kOutputNames; empty: those of the scene
    bool png = false;                  // a tone mapped image is written
};

Plan makePlan(const Scene& scene, const PlanRequest& request, const VisibilityFacts* facts = nullptr);

// One line for each pass, then the memory.
std::string planText(const Plan& plan);
std::string planJson(const Plan& plan);
// Graphviz: an arrow from a pass to each pass that reads its result; passes that do not run are dashed.
std::string planDot(const Plan& plan);

}  // namespace etalon
