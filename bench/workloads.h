// What the benchmarks draw, Etalon and its peers alike.
#pragma once

#include <string>

#include "lighting/surface_scene.h"
#include "lighting/view.h"

namespace etalon::bench {

inline constexpr int kWidth = 1024, kHeight = 768;
inline constexpr int kLayers = 32, kLayerSize = 1024;
inline constexpr int kMaxLights = 64;

// One mesh, placed once without a transform, with one Blinn-Phong material, and the view that sees it.
struct Workload {
    SurfaceScene scene;
    View view;

    const SurfaceMesh& mesh() const { return scene.meshes[0]; }
    size_t triangles() const { return mesh().indices.size() / 3; }
};

// Workloads by name, made at the first call and kept. `lights` directional lights, 0 to kMaxLights.
//   1k, 70k, 870k    a rippled (2, 3) torus knot over a ground plane: 1040, 70432 and 870872 triangles,
//                    kWidth x kHeight pixels
//   1k-small         the same 1k in 64 x 48 pixels
//   large            500 triangles of about an eighth of the screen's area, some of it outside, at random
//                    depths
//   sub-pixel        500000 triangles inside squares of one pixel
//   layers           kLayers triangles that fill kLayerSize^2 pixels, each nearer than the one before
// Throws PreconditionError for another name.
const Workload& workload(const std::string& name, int lights);

}  // namespace etalon::bench
