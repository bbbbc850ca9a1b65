// The plan: which passes a scene and the requested outputs need, and why each other one does not run.
#pragma once

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

// What the visibility pass found; without it the plan assumes that everything may be visible.
struct VisibilityFacts {
    std::vector<bool> objectVisible;  // for each of planObjects
    bool backgroundVisible = true;
    // For each light with shadows the objects that stand between it and what is looked up (fitShadowMap).
    std::vector<std::vector<uint32_t>> castersOfLight;
};

struct Plan {
    std::vector<PlanPass> passes;

    // The same decisions for the renderer.
    ShadeRequest request;             // what shading makes
    bool readEnvironment = false;     // the lat-long image
    bool environmentCube = false;     // its cube map for mirrors
    bool environmentLight = false;    // what it lights surfaces with
    std::vector<bool> objectCube;     // for each of planObjects: render its cube map
    bool lightVertices = false;       // lights are evaluated at vertices
    std::vector<bool> shadowMap;      // for each light: render and look up its map
    std::vector<bool> shadowVolumes;  // for each light: count its volumes, in each view
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
