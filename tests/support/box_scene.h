// Small surface scenes for tests.
#pragma once

#include <utility>

#include "lighting/surface_scene.h"

namespace etalon::test {

// A rectangle with corners centre +- u +- v whose front looks along u cross v.
inline SurfaceMesh rectangle(glm::vec3 centre, glm::vec3 u, glm::vec3 v) {
    SurfaceMesh mesh;
    const glm::vec3 normal(u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z, u.x * v.y - u.y * v.x);
    for (const auto& [a, b] : {std::pair(-1, -1), std::pair(1, -1), std::pair(1, 1), std::pair(-1, 1)}) {
        const auto fa = static_cast<float>(a), fb = static_cast<float>(b);
        mesh.positions.emplace_back(centre.x + (fa * u.x + fb * v.x), centre.y + (fa * u.y + fb * v.y),
                                    centre.z + (fa * u.z + fb * v.z));
        mesh.normals.push_back(normal);
    }
    mesh.indices = {0, 1, 2, 0, 2, 3};
    return mesh;
}

// Adds an object of its own material to the scene; returns its index.
inline uint32_t addObject(SurfaceScene& scene, SurfaceMesh mesh, const SurfaceMaterial& material) {
    SurfaceInstance instance;
    instance.mesh = static_cast<uint32_t>(scene.meshes.size());
    instance.material = static_cast<uint32_t>(scene.materials.size());
    scene.meshes.push_back(std::move(mesh));
    scene.materials.push_back(material);
    scene.instances.push_back(instance);
    return static_cast<uint32_t>(scene.instances.size() - 1);
}

inline SurfaceMaterial lambertian(double albedo) {
    SurfaceMaterial material;
    material.diffuse = glm::dvec3(albedo);
    return material;
}

// The inside of the box [-x, x] x [-y, y] x [-z, z]; the wall at +X has albedo 0.1, -X 0.2, ... -Z 0.6.
inline SurfaceScene box(float x, float y, float z) {
    SurfaceScene scene;
    addObject(scene, rectangle({x, 0, 0}, {0, 0, z}, {0, y, 0}), lambertian(0.1));
    addObject(scene, rectangle({-x, 0, 0}, {0, y, 0}, {0, 0, z}), lambertian(0.2));
    addObject(scene, rectangle({0, y, 0}, {x, 0, 0}, {0, 0, z}), lambertian(0.3));
    addObject(scene, rectangle({0, -y, 0}, {0, 0, z}, {x, 0, 0}), lambertian(0.4));
    addObject(scene, rectangle({0, 0, z}, {0, y, 0}, {x, 0, 0}), lambertian(0.5));
    addObject(scene, rectangle({0, 0, -z}, {x, 0, 0}, {0, y, 0}), lambertian(0.6));
    scene.ambient = glm::dvec3(1);
    return scene;
}

}  // namespace etalon::test
