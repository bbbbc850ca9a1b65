// A scene as plain data: what docs/scene_format.md describes, checked and with defaults filled in.
// Right-handed, +Y up, metres, linear Rec.709. Lines are those of the scene file, for messages of later
// stages (where()).
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lighting/names.h"
#include "numeric/names.h"
#include "raster/profile.h"
#include "shadows/names.h"
#include "shadows/planar_lights.h"

namespace etalon {

// Largest magnitude of a length, coordinate, radiance or irradiance in a scene: products of three stay finite
// in float.
inline constexpr double kMaxSceneNumber = 1e9;
// Smallest length of a vector that stands for a direction.
inline constexpr double kMinDirectionLength = 1e-9;
// Largest Blinn-Phong exponent.
inline constexpr double kMaxExponent = 4096;
// Largest magnitude of the exposure, in stops: factors of 2^+-32.
inline constexpr double kMaxExposure = 32;
// Largest outer angle of a spot light, how much smaller the inner one must be, and what it is by default.
inline constexpr double kMaxCone_deg = 89.9, kMinConeStep_deg = 0.01, kDefaultInnerCone_deg = 0;
// Largest edge of a reflection cube map, in texels (six faces of float RGB: 4.5 GiB).
inline constexpr int kMaxCubeSize = 8192;

// Largest angle that a directional light with soft shadows subtends.
inline constexpr double kMaxLight_deg = 90;
// What shadow maps of a scene file have where it does not say otherwise: no acne on planes and smooth meshes
// (docs/experiments/shadow_bias.md).
inline ShadowMapSettings defaultShadowMap() {
    ShadowMapSettings map;
    map.bias = {2, 0.5, 0};
    map.receiverPlane = true;
    return map;
}
inline constexpr int kDiscTaps = 32;
inline constexpr double kSoftRadius_texels = 32;
// Most samples of a light with planar shadows in a scene file.
inline constexpr int kMaxSceneLightSamples = 4096;

// A pinhole camera, in pixels: a point (x, y, -z) of the camera's frame, z > 0, falls on the image at
// (cx + fx x / z, cy - fy y / z); pixel centres at +0.5, row 0 on top. fx, fy > 0.
struct Intrinsics {
    double fx = 0, fy = 0, cx = 0, cy = 0;
};

struct Camera {
    int line = 0;
    int width = 0, height = 0;  // pixels, 1 to kMaxImageSize
    Intrinsics intrinsics;
    double near = 0, far = 0;       // metres along -Z, 0 < near < far
    glm::dmat4 cameraToWorld{1.0};  // rotation and translation; the camera looks along its -Z
};

// How a light's shadows are made, if at all. The seeds are the scene's.
enum class ShadowMethod : uint8_t { none, map, volume, planar };
template <>
inline constexpr auto kNames<ShadowMethod> = std::to_array<std::string_view>({"none", "map", "volume",
                                                                              "planar"});
static_assert(isLastName(ShadowMethod::planar));
struct LightShadow {
    ShadowMethod method = ShadowMethod::none;
    ShadowMapSettings map = defaultShadowMap();  // of map
    PlanarLightSettings planar;                  // of planar
};

// What the plan calls the pass that makes a light's shadows.
constexpr std::string_view passNameOf(ShadowMethod method) {
    constexpr std::string_view kPassNames[] = {"", "shadow map", "shadow volumes", "planar shadows"};
    return kPassNames[static_cast<size_t>(method)];
}

enum class EnvironmentKind : uint8_t { none, constant, file };

// How the environment lights surfaces, besides being seen and mirrored (docs/scene_format.md).
enum class EnvironmentLightMethod : uint8_t {
    none,
    lights,
    dominant,
    harmonics,
    exact,
    map,
    blurred,
    blurredNormalised
};
template <>
inline constexpr auto kNames<EnvironmentLightMethod> = std::to_array<std::string_view>(
    {"none", "lights", "dominant", "harmonics", "exact", "map", "blurred", "blurred_normalised"});
static_assert(isLastName(EnvironmentLightMethod::blurredNormalised));
constexpr bool isBlurredMap(EnvironmentLightMethod method) {
    return method == EnvironmentLightMethod::blurred || method == EnvironmentLightMethod::blurredNormalised;
}
// Whether a cube map holds the light.
constexpr bool isLightMap(EnvironmentLightMethod method) {
    return method == EnvironmentLightMethod::map || isBlurredMap(method);
}
// Most lights of a median cut, largest edge of a map of irradiance.
inline constexpr int kMaxEnvironmentLights = 65536, kMaxLightMapSize = 512;
// Most reflections of mirrors in mirrors.
inline constexpr int kMaxReflections = 16;
// Most directions of ambient occlusion, and largest edge of their depth maps.
inline constexpr int kMaxOcclusionDirections = 4096, kMaxOcclusionMapSize = 8192;
// Most lights of an environment that cast shadows.
inline constexpr int kMaxShadowLights = 256;

// Radiance that comes from far away. none is black. file: the image's radiance times `intensity`, turned by
// `rotation_deg` counter-clockwise about +Y (seen from above).
struct Environment {
    int line = 0;
    EnvironmentKind kind = EnvironmentKind::none;
    glm::dvec3 constant{0.0};    // kind constant: radiance
    std::filesystem::path file;  // kind file: resolved against the scene file's folder
    double intensity = 1;        // > 0
    double rotation_deg = 0;
    EnvironmentLightMethod lighting = EnvironmentLightMethod::none;
    int lightCount = 64;  // of lights: a power of two
    int mapSize = 32;     // where isLightMap(lighting): texels along a face
    // Of lights and dominant: shadows of the `shadowLights` lights, if there are more, that stand for the smallest angles;
    // or, where shadowShare is above 0, of those with at least this part of the environment's energy, no more
    // than kMaxShadowLights (shadows/casting_lights.h).
    LightShadow shadow;
    int shadowLights = kMaxShadowLights;
    double shadowShare = 0;
};

// Squares of edge size_m on a plane, counted from its point along its u and v axes: where
// floor(u / size) + floor(v / size) is odd, `diffuse` replaces the material's.
struct Checker {
    glm::dvec3 diffuse{0.0};
    double size_m = 1;
};

// Reflectances in [0, 1]. lambert: diffuse; blinnPhong: diffuse, specular, exponent in [1, kMaxExponent], and
// reflectance of a mirror below; mirror: reflectance.
struct Material {
    int line = 0;
    std::string name;
    MaterialKind kind = MaterialKind::lambert;
    glm::dvec3 diffuse{0.0}, specular{0.0}, reflectance{0.0};
    double exponent = 1;
    std::optional<Checker> checker;  // only on planes
};

// A mesh file placed once or more. objectToWorld holds at least one affine matrix (last row 0 0 0 1), none
// singular; a negative determinant turns the winding round (transform.h).
struct MeshObject {
    int line = 0, fileLine = 0;
    std::string name;
    std::filesystem::path file;  // resolved against the scene file's folder
    size_t material = 0;         // index into Scene::materials
    std::vector<glm::dmat4> objectToWorld;
    bool twoSided = true;                             // false: triangles seen from behind are not drawn
    Reflection reflection = Reflection::environment;  // for a mirror
    int cubeSize = 256;                               // texels, for Reflection::scene
};

// A rectangle about `point`: point + a u + b v, |a| <= size.x / 2, |b| <= size.y / 2; u, v, normal are unit,
// perpendicular and right-handed (u cross v = normal). Seen from the side that the normal points to.
struct Plane {
    int line = 0;
    std::string name;
    glm::dvec3 point{0.0}, normal{0, 1, 0}, u{1, 0, 0}, v{0, 0, -1};
    glm::dvec2 size_m{1.0};
    size_t material = 0;
};

// A light as it shades (lighting/surface_scene.h), in world space, and its shadow.
struct SceneLight : SurfaceLight {
    int line = 0;
    LightShadow shadow;
};

struct Output {
    int line = 0;
    std::vector<std::string> images;    // of outputNames() (scene/outputs.h), each once, at least one
    ToneMap toneMap = ToneMap::linear;  // for PNG
    double exposure = 0;                // stops; for PNG
};

// What coordinates are relative to before the profile's arithmetic rounds them: the world's origin, as on a GPU that is
// given world positions, or the eye, as engines for large worlds have it.
enum class Origin : uint8_t { world, eye };
template <>
inline constexpr auto kNames<Origin> = std::to_array<std::string_view>({"world", "eye"});
static_assert(isLastName(Origin::eye));

struct Render {
    int line = 0;
    Origin origin = Origin::world;
    int samples = 1;  // per pixel: 1, 4 or 16
    Profile profile = profiles().front();
    bool perVertex = false;  // lights are evaluated at vertices (Gouraud), else at pixels (Phong)
    // Directions that ambient occlusion is found from, and texels along an edge of the depth map of each
    // (shadows/ambient_occlusion.h). 0 directions: surfaces see all of their surroundings.
    int occlusionDirections = 0, occlusionMapSize = 512;
    // Of mirrors that show the scene: in the last one of mirrors in mirrors the environment is seen.
    int reflections = 1;
    uint64_t seed = 0;
};

struct Scene {
    std::filesystem::path file;
    // Where in the file's world the origin of all positions below lies: 0, or with Origin::eye the camera's position.
    glm::dvec3 origin_m{0.0};
    Camera camera;
    Environment environment;
    glm::dvec3 ambient{0.0};          // radiance from everywhere, seen by diffuse surfaces only
    std::vector<Material> materials;  // in the order of their names
    std::vector<MeshObject> meshes;
    std::vector<Plane> planes;
    std::vector<SceneLight> lights;
    Output output;
    Render render;
};

// Moves every position of the scene by -to, and its origin to there, in double.
void moveOrigin(Scene& scene, const glm::dvec3& to);

// "file:line", the place of a part of the scene, for messages; "file" when the line is 0.
std::string where(const Scene& scene, int line);

// Reads and checks a whole scene file (docs/scene_format.md). Files that it names must exist; their contents are not
// read. InputError "file:line: reason" for the first thing that is wrong: TOML syntax, an unknown key (with the nearest
// known one), a missing key, a wrong type, a number that is not finite or out of range, a degenerate value, a name or
// file that does not exist.
Scene loadScene(const std::filesystem::path& path);

}  // namespace etalon
