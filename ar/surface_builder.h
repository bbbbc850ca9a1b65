// From the scene file's data to what the shading passes draw.
#pragma once

#include <string>
#include <vector>

#include "lighting/surface_scene.h"
#include "lighting/view.h"
#include "scene/scene.h"

namespace etalon {

// An object of the scene that is drawn on its own: a mesh placed once, or a plane. Meshes come first, in the
// order of the file, each with its placements in order; then the planes.
struct SceneObject {
    std::string name;
    bool isMesh = false;
    size_t index = 0, placement = 0;  // into Scene::meshes and MeshObject::objectToWorld, or Scene::planes
    const Material* material = nullptr;
};
std::vector<SceneObject> sceneObjects(const Scene& scene);

SurfaceMaterial surfaceMaterialOf(const Material& material);

// The environment's rotation, and its radiance where that is constant.
SurfaceEnvironment surfaceEnvironmentOf(const Environment& environment);

// Loads the meshes (each file once) and places every object of sceneObjects, in that order; without lights and
// environment. Appends to warnings.
SurfaceScene buildSurfaces(const Scene& scene, std::vector<std::string>& warnings);

// Reads the lat-long image: radiance times intensity. Negative and non-finite values become 0 and are counted
// in a warning, or are an InputError when strict.
Image<float> loadEnvironment(const Scene& scene, bool strict, std::vector<std::string>& warnings);

View cameraViewOf(const Camera& camera);

}  // namespace etalon
