// The camera, the environment and the lights of a scene file.

#include <algorithm>
#include <bit>

#include "numeric/text.h"
#include "numeric/transform.h"
#include "raster/image.h"
#include "scene/scene_parts.h"

namespace etalon {

namespace {

// How far the columns of a pose may be from unit length and right angles: a pose written with six digits
// passes.
constexpr double kRigidTolerance = 1e-5;
// Smallest sine of the angle between `up` and the view.
constexpr double kMinUpSine = 1e-6;

bool near(double a, double b) { return a - b <= kRigidTolerance && b - a <= kRigidTolerance; }

// cameraToWorld from a matrix; it must be a rotation and a translation.
glm::dmat4 poseFromMatrix(const TableReader& reader) {
    constexpr const char* kReason = "cannot stand beside 'camera_to_world'";
    for (const char* key : {"position", "look_at", "up"}) reader.forbid(key, kReason);
    const glm::dmat4 m = reader.matrix("camera_to_world");
    const glm::dvec3 x(m[0]), y(m[1]), z(m[2]);
    const bool rigid = near(dotOf(x, x), 1) && near(dotOf(y, y), 1) && near(dotOf(z, z), 1) &&
                       near(dotOf(x, y), 0) && near(dotOf(y, z), 0) && near(dotOf(z, x), 0);
    if (!rigid)
        reader.failKey("camera_to_world",
                       formatText("must be a rotation and a translation: columns of length 1 "
                                  "at right angles, to within {}",
                                  kRigidTolerance));
    if (determinant3(m) < 0)
        reader.failKey("camera_to_world",
                       "must be a rotation and a translation: it mirrors (determinant -1)");
    return orthonormalised(m);
}

glm::dmat4 poseFromTarget(const TableReader& reader) {
    const glm::dvec3 position = reader.triple("position");
    const glm::dvec3 target = reader.triple("look_at");
    const glm::dvec3 view(target.x - position.x, target.y - position.y, target.z - position.z);
    if (lengthOf(view) < kMinDirectionLength)
        reader.failKey("look_at", formatText("must differ from 'position' (distance at least {} m)",
                                             kMinDirectionLength));
    const glm::dvec3 up = reader.has("up") ? reader.direction("up") : glm::dvec3(0, 1, 0);
    if (lengthOf(crossOf(unitOf(up), unitOf(view))) < kMinUpSine)
        reader.failKey("up", reader.has("up")
                                 ? "must not be parallel to the view from 'position' to 'look_at'"
                                 : "is needed: the default 0 1 0 is parallel to the view");
    return lookAt(position, target, up);
}

Intrinsics readIntrinsics(const TableReader& reader, int width, int height) {
    Intrinsics k;
    if (reader.has("fov_y_deg")) {
        for (const char* key : {"fx", "fy", "cx", "cy"})
            reader.forbid(key, "cannot stand beside 'fov_y_deg'");
        const double fov_deg = reader.number("fov_y_deg");
        const SinCos half = sinCosOfDegrees(fov_deg / 2);
        // f = (height / 2) / tan(fov / 2)
        k.fy = height * 0.5 * half.cos / half.sin;
        if (!(k.fy >= 1 / kMaxSceneNumber && k.fy <= kMaxSceneNumber))
            reader.failKey("fov_y_deg",
                           formatText("of {} makes a focal length of {} px; allowed are {} to {}", fov_deg,
                                      k.fy, 1 / kMaxSceneNumber, kMaxSceneNumber));
        k.fx = k.fy;
        k.cx = width * 0.5;
        k.cy = height * 0.5;
        return k;
    }
    if (!reader.has("fx") && !reader.has("fy") && !reader.has("cx") && !reader.has("cy"))
        reader.fail(reader.line(), "missing key 'fov_y_deg' (or 'fx', 'fy', 'cx', 'cy') in [camera]");
    k.fx = reader.number("fx");
    k.fy = reader.number("fy");
    k.cx = reader.number("cx");
    k.cy = reader.number("cy");
    return k;
}

// How an environment lights surfaces.
void readLighting(const TableReader& reader, Environment& environment) {
    environment.lighting = reader.member("lighting", environment.lighting);
    if (environment.lighting != EnvironmentLightMethod::lights)
        reader.forbid("lights", "needs lighting = \"lights\"");
    if (!isLightMap(environment.lighting))
        reader.forbid("map_size", "needs lighting = \"map\", \"blurred\" or \"blurred_normalised\"");
    if (reader.has("lights")) {
        environment.lightCount = reader.integer("lights");
        if (!std::has_single_bit(static_cast<unsigned>(environment.lightCount)))
            reader.failKey("lights", formatText("must be a power of two, not {}", environment.lightCount));
    }
    if (reader.has("map_size")) environment.mapSize = reader.integer("map_size");
}

// Which lights of an environment cast shadows, and how.
void readShadowLights(const TableReader& reader, Environment& environment) {
    environment.shadow = readShadow(reader, LightKind::directional);
    if (environment.shadow.method == ShadowMethod::none) {
        for (const char* key : {"shadow_lights", "shadow_share"})
            reader.forbid(key, "needs 'shadow' beside it");
        return;
    }
    if (environment.lighting != EnvironmentLightMethod::lights &&
        environment.lighting != EnvironmentLightMethod::dominant)
        reader.forbid("shadow", "needs lighting = \"lights\" or \"dominant\"");
    if (reader.has("shadow_lights")) {
        reader.forbid("shadow_share", "cannot stand beside 'shadow_lights'");
        environment.shadowLights = reader.integer("shadow_lights");
    }
    if (reader.has("shadow_share")) environment.shadowShare = reader.number("shadow_share");
}

}  // namespace

Camera readCamera(const std::string& file, const TomlValue& value) {
    const TableReader reader(file, value, {SceneTable::camera});
    Camera camera;
    camera.line = reader.line();
    camera.width = reader.integer("width");
    camera.height = reader.integer("height");
    camera.intrinsics = readIntrinsics(reader, camera.width, camera.height);
    camera.near = reader.number("near");
    camera.far = reader.number("far");
    if (!(camera.near < camera.far))
        reader.failKey("far",
                       formatText("must be greater than 'near' ({} m), not {}", camera.near, camera.far));
    camera.cameraToWorld = reader.has("camera_to_world") ? poseFromMatrix(reader) : poseFromTarget(reader);
    return camera;
}

Environment readEnvironment(const std::string& file, const TomlValue& value) {
    const TableReader reader(file, value,
                             {SceneTable::environment, SceneTable::environmentShadow, SceneTable::shadowMap,
                              SceneTable::planarShadow});
    Environment environment;
    environment.line = reader.line();
    readLighting(reader, environment);
    readShadowLights(reader, environment);
    if (reader.has("file")) {
        reader.forbid("constant", "cannot stand beside 'file'");
        environment.kind = EnvironmentKind::file;
        environment.file = reader.existingFile("file");
        if (reader.has("intensity")) environment.intensity = reader.number("intensity");
        if (reader.has("rotation_deg")) environment.rotation_deg = reader.number("rotation_deg");
        return environment;
    }
    for (const char* key : {"intensity", "rotation_deg"}) reader.forbid(key, "needs 'file' beside it");
    if (!reader.has("constant"))
        reader.fail(reader.line(),
                    "missing key 'file' or 'constant' in [environment] (leave the table out for black)");
    environment.kind = EnvironmentKind::constant;
    environment.constant = reader.triple("constant");
    return environment;
}

SceneLight readLight(const std::string& file, const TomlValue& value) {
    const TableReader reader(file, value,
                             {SceneTable::light, SceneTable::shadowMap, SceneTable::planarShadow});
    SceneLight light;
    light.line = reader.line();
    light.kind = reader.member<LightKind>("kind");
    const auto forbid = [&](std::initializer_list<std::string_view> keys) {
        for (const std::string_view key : keys)
            reader.forbid(key, formatText("is not used by kind '{}'", nameOf(light.kind)));
    };
    if (light.kind != LightKind::point) {
        light.axis = unitOf(reader.direction("direction"));
        light.toLight = -light.axis;
    }
    if (light.kind == LightKind::directional) {
        forbid({"position", "intensity", "inner_deg", "outer_deg"});
        light.irradiance = reader.triple("irradiance");
        light.shadow = readShadow(reader, light.kind);
        return light;
    }
    forbid({"irradiance"});
    light.position_m = reader.triple("position");
    light.intensity = reader.triple("intensity");
    if (light.kind == LightKind::point) {
        forbid({"direction", "inner_deg", "outer_deg"});
        light.shadow = readShadow(reader, light.kind);
        return light;
    }
    // The angles from the direction where the intensity begins to fall and where it is 0.
    const double outer_deg = reader.number("outer_deg");
    const double inner_deg = reader.has("inner_deg") ? reader.number("inner_deg") : kDefaultInnerCone_deg;
    if (!(inner_deg <= outer_deg - kMinConeStep_deg))
        reader.failKey(reader.has("inner_deg") ? "inner_deg" : "outer_deg",
                       formatText("must be at least {} below 'outer_deg' ({}), not {}", kMinConeStep_deg,
                                  outer_deg, inner_deg));
    light.cosInner = sinCosOfDegrees(inner_deg).cos;
    light.cosOuter = sinCosOfDegrees(outer_deg).cos;
    light.shadow = readShadow(reader, light.kind);
    return light;
}

}  // namespace etalon
