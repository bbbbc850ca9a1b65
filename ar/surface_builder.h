// From the scene file's data to what the shading passes draw.
#pragma once

#include <string>
#include <vector>

#include "ar/plan.h"
#include "ar/scene.h"
#include "lighting/surface_scene.h"
#include "lighting/view.h"

namespace etalon {

// Loads the meshes (each file once) and places every object of planObjects, in that order. Appends to
// warnings.
SurfaceScene buildSurfaces(const Scene& scene, std::vector<std::string>& warnings);

// Reads the lat-long image: radiance times intensity. Negative and non-finite values become 0 and are counted
// in a warning, or are an InputError when strict.
Image<float> loadEnvironment(const Scene& scene, bool strict, std::vector<std::string>& warnings);

View cameraViewOf(const Camera& camera);

}  // namespace etalon
