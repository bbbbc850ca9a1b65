// What the shading passes draw: meshes in world space, materials, lights and the environment. Plain data,
// made by ar/ from a scene file or by any other caller.
#pragma once

#include <array>
#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "probes/spherical_harmonics.h"
#include "raster/image.h"

namespace etalon {

enum class MaterialKind : uint8_t { lambert, blinnPhong, mirror };

// Linear Rec.709 reflectances in [0, 1].
struct SurfaceMaterial {
    MaterialKind kind = MaterialKind::lambert;
    glm::dvec3 diffuse{0};
    glm::dvec3 specular{0};
    glm::dvec3 reflectance{0};  // of mirrors, and of a mirror below Blinn-Phong's lobe
    double exponent = 1;        // of Blinn-Phong, at least 1
    bool checker = false;       // squares of odd parity take diffuse2; u and v in metres
    glm::dvec3 diffuse2{0};
    double checkerSize_m = 1;
};

// No channel is above 0.
inline bool isBlack(const glm::dvec3& v) { return !(v.x > 0 || v.y > 0 || v.z > 0); }

// Whether a material (this one or a scene file's) is of a kind that has a diffuse, a specular and a mirror part.
bool hasDiffusePart(const auto& material) { return material.kind != MaterialKind::mirror; }
bool hasSpecularPart(const auto& material) { return material.kind == MaterialKind::blinnPhong; }
bool hasMirrorPart(const auto& material) {
    return material.kind == MaterialKind::mirror || !isBlack(material.reflectance);
}
// Whether the part reflects anything.
inline bool reflectsDiffusely(const SurfaceMaterial& material) {
    return hasDiffusePart(material) &&
           !(isBlack(material.diffuse) && (!material.checker || isBlack(material.diffuse2)));
}
inline bool reflectsSpecularly(const SurfaceMaterial& material) {
    return hasSpecularPart(material) && !isBlack(material.specular);
}
inline bool mirrors(const SurfaceMaterial& material) { return !isBlack(material.reflectance); }

// directional: from infinitely far; point: in all directions from a place; spot: in a cone.
// Kernel texts number them so (lighting/kernels/light_scope.glsl).
enum class LightKind : uint8_t { directional, point, spot };

struct SurfaceLight {
    // Of a directional light: the unit vector towards it, and what a surface that faces it receives, W/m^2
    // per channel.
    glm::dvec3 toLight{0, 1, 0};
    glm::dvec3 irradiance{0};

    LightKind kind = LightKind::directional;
    glm::dvec3 position_m{0};
    glm::dvec3 intensity{0};  // W/sr per channel; of a spot along its axis
    // Of a spot: the way the light travels, unit, and its cones (lighting/kernels/positional_light.glsl).
    glm::dvec3 axis{0, -1, 0};
    double cosInner = 1, cosOuter = 0;
};

// A mesh of the scene. normals and surface coordinates are per vertex; uv may be empty (then 0).
struct SurfaceMesh {
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals;
    std::vector<glm::vec2> uv_m;
    std::vector<uint32_t> indices;
};

// Where a mirror looks: into the environment alone, or into a cube map of the scene around the object's
// centre.
enum class Reflection : uint8_t { environment, scene };

// A placed mesh. normalToWorld is the inverse transpose of the upper 3x3 part, up to a positive factor.
struct SurfaceInstance {
    uint32_t mesh = 0, material = 0;
    glm::dmat4 toWorld{1};
    glm::dmat3 normalToWorld{1};
    Reflection reflection = Reflection::environment;
    int cubeSize = 0;            // of the scene reflection, in texels
    glm::dvec3 cubeCentre_m{0};  // world space
    bool twoSided = true;        // false: culled when seen from behind
};

// What diffuse surfaces receive from the environment, beside the lights: irradiance over normals in world
// space, W/m^2.
//   harmonics: the function, negative values count as 0
//   texels: the sum over the texels of a probe, each of them a light, of the shape that irradianceAt() has
//           (probes/irradiance.h) in the order of texels; its relative error in an arithmetic of unit roundoff u, for n
//           texels of non-negative flux in its range, is at most (kIrradianceRun + log2(n / kIrradianceRun) + 8) u, and
//           flux times 2^k gives light times 2^k to the bit
//   map: a cube map of irradiance, looked up along the normal
struct EnvironmentLight {
    // The kernel text numbers them so (lighting/kernels/environment_light.glsl).
    enum class Kind : uint8_t { none, harmonics, texels, map };
    Kind kind = Kind::none;
    SphericalHarmonics harmonics;
    std::vector<glm::dvec3> directions, flux;  // of each texel: unit vector to it, radiance times solid angle
    CubeMap<float> map;                        // three channels
};

// What lights the points of surfaces, besides the ambient light. The referenced objects outlive this.
struct LightSources {
    const std::vector<SurfaceLight>* lights = nullptr;
    const std::vector<bool>* shows = nullptr;  // for each light whether it is evaluated; null: all are
    const EnvironmentLight* environment = nullptr;
};

// Radiance from far away over directions: a lat-long image (OpenEXR convention), or nothing (black).
struct SurfaceEnvironment {
    Image<float> latLong;  // 3 channels; empty: constant
    glm::dvec3 constant{0};
    double cosRotation = 1, sinRotation = 0;  // of the environment about +Y
    EnvironmentLight light;
};

struct SurfaceScene {
    std::vector<SurfaceMesh> meshes;
    std::vector<SurfaceInstance> instances;
    std::vector<SurfaceMaterial> materials;
    std::vector<SurfaceLight> lights;
    glm::dvec3 ambient{0};  // radiance that arrives from everywhere
    SurfaceEnvironment environment;
};

}  // namespace etalon
