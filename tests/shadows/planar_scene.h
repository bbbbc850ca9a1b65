// A ground, casters above it and their shadows, for the tests of planar shadows.
#pragma once

#include <cmath>
#include <deque>
#include <utility>
#include <vector>

#include "lighting/geometry.h"
#include "shadows/light_samples.h"
#include "shadows/planar_shadow.h"
#include "tests/support/box_scene.h"

namespace etalon::test {

inline PlanarReceiver groundReceiver(double half_m = 2) {
    PlanarReceiver receiver;
    receiver.frame = planeFrame({0, 0, 0}, {0, 1, 0});
    receiver.corners_m = {{-half_m, -half_m}, {half_m, -half_m}, {half_m, half_m}, {-half_m, half_m}};
    receiver.indices = {0, 1, 2, 0, 2, 3};
    return receiver;
}

// Meshes that stay where they are.
class Casters {
  public:
    Casters& add(SurfaceMesh mesh) {
        meshes_.push_back(std::move(mesh));
        PlacedMesh& placed = placed_.emplace_back();
        placed.mesh = &meshes_.back();
        for (const glm::vec3& p : meshes_.back().positions) placed.positions.emplace_back(p.x, p.y, p.z);
        return *this;
    }
    // A horizontal square.
    Casters& addSquare(float x, float height, float z, float half) {
        return add(rectangle({x, height, z}, {half, 0, 0}, {0, 0, half}));
    }
    // The six sides of a box.
    Casters& addBox(glm::vec3 lowest, glm::vec3 highest) {
        SurfaceMesh mesh;
        for (int i = 0; i < 8; i++)
            mesh.positions.emplace_back(i & 1 ? highest.x : lowest.x, i & 2 ? highest.y : lowest.y,
                                        i & 4 ? highest.z : lowest.z);
        mesh.normals.resize(8);
        mesh.indices = {0, 1, 3, 0, 3, 2, 4, 6, 7, 4, 7, 5, 0, 4, 5, 0, 5, 1,
                        2, 3, 7, 2, 7, 6, 0, 2, 6, 0, 6, 4, 1, 5, 7, 1, 7, 3};
        return add(std::move(mesh));
    }
    PlanarCasters above(const PlaneFrame& frame, double contact_m = 1e-5) const {
        std::vector<const PlacedMesh*> list;
        for (const PlacedMesh& placed : placed_) list.push_back(&placed);
        return castersAbove(frame, list, contact_m);
    }

  private:
    std::deque<SurfaceMesh> meshes_;
    std::deque<PlacedMesh> placed_;
};

inline BlockedSamples countOn(const PlanarReceiver& receiver, const Casters& casters,
                              const std::vector<glm::dvec4>& lights, const PlanarShadowOptions& options = {},
                              const char* profile = "f32", const RasterOptions& raster = {1, 64}) {
    return countBlocked(receiver, casters.above(receiver.frame, options.contact_m), lights, options,
                        *findProfile(profile), raster);
}

inline PlanarShadow shadowOn(const PlanarReceiver& receiver, const Casters& casters,
                             const std::vector<glm::dvec4>& lights, const PlanarShadowOptions& options = {},
                             const char* profile = "f32", const RasterOptions& raster = {1, 64}) {
    return planarShadow(receiver, casters.above(receiver.frame, options.contact_m), lights, options,
                        *findProfile(profile), raster);
}

// The stored shadow of the texel that (s, t) lies in; 0 beyond the texture.
inline double shadowAt(const PlanarShadow& shadow, double s_m, double t_m) {
    const int x = static_cast<int>(std::floor((s_m - shadow.grid.corner_m.x) / shadow.grid.texel_m));
    const int y = static_cast<int>(std::floor((t_m - shadow.grid.corner_m.y) / shadow.grid.texel_m));
    if (x < 0 || y < 0 || x >= shadow.grid.width || y >= shadow.grid.height) return 0;
    return static_cast<double>(shadow.shadow.at(x, y));
}

}  // namespace etalon::test
