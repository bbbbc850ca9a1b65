// The camera, the environment and the lights of a scene file.
#include <fmt/format.h>

#include <algorithm>
#include <bit>

#include "ar/scene_parts.h"
#include "ar/transform.h"
#include "raster/image.h"

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
                       fmt::format("must be a rotation and a translation: columns of length 1 "
                                   "at right angles, to within {}",
                                   kRigidTolerance));
    if (determinant3(m) < 0)
        reader.failKey("camera_to_world",
                       "must be a rotation and a translation: it mirrors (determinant -1)");
    return orthonormalised(m);
}

glm::dmat4 poseFromTarget(const TableReader& reader) {
    const glm::dvec3 position = reader.triple("position", kCoordinateRange);
    const glm::dvec3 target = reader.triple("look_at", kCoordinateRange);
    const glm::dvec3 view(target.x - position.x, target.y - position.y, target.z - position.z);
    if (lengthOf(view) < kMinDirectionLength)
        reader.failKey("look_at", fmt::format("must differ from 'position' (distance at least {} m)",
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
        const double fov_deg = reader.number("fov_y_deg", {0, 180, true, true});
        const SinCos half = sinCosOfDegrees(fov_deg / 2);
        // f = (height / 2) / tan(fov / 2)
        k.fy = height * 0.5 * half.cos / half.sin;
        if (!(k.fy >= 1 / kMaxSceneNumber && k.fy <= kMaxSceneNumber))
            reader.failKey("fov_y_deg",
                           fmt::format("of {} makes a focal length of {} px; allowed are {} to {}", fov_deg,
                                       k.fy, 1 / kMaxSceneNumber, kMaxSceneNumber));
        k.fx = k.fy;
        k.cx = width * 0.5;
        k.cy = height * 0.5;
        return k;
    }
    if (!reader.has("fx") && !reader.has("fy") && !reader.has("cx") && !reader.has("cy"))
        reader.fail(reader.line(), "missing key 'fov_y_deg' (or 'fx', 'fy', 'cx', 'cy') in [camera]");
    k.fx = reader.number("fx", {1 / kMaxSceneNumber, kMaxSceneNumber});
    k.fy = reader.number("fy", {1 / kMaxSceneNumber, kMaxSceneNumber});
    k.cx = reader.number("cx", kCoordinateRange);
    k.cy = reader.number("cy", kCoordinateRange);
    return k;
}

// How an environment lights surfaces.
void readLighting(const TableReader& reader, Environment& environment) {
    if (reader.has("lighting")) {
        const std::string name = reader.choice("lighting", kEnvironmentLightMethods);
        environment.lighting = static_cast<EnvironmentLightMethod>(
            std::ranges::find(kEnvironmentLightMethods, name) - std::begin(kEnvironmentLightMethods));
    }
    if (environment.lighting != EnvironmentLightMethod::lights)
        reader.forbid("lights", "needs lighting = \"lights\"");
    if (environment.lighting != EnvironmentLightMethod::map &&
        environment.lighting != EnvironmentLightMethod::blurred)
        reader.forbid("map_size", "needs lighting = \"map\" or \"blurred\"");
    if (reader.has("lights")) {
        environment.lightCount = static_cast<int>(reader.integer("lights", 1, kMaxEnvironmentLights));
        if (!std::has_single_bit(static_cast<unsigned>(environment.lightCount)))
            reader.failKey("lights", fmt::format("must be a power of two, not {}", environment.lightCount));
    }
    if (reader.has("map_size"))
        environment.mapSize = static_cast<int>(reader.integer("map_size", 1, kMaxLightMapSize));
}

}  // namespace

Camera readCamera(const std::string& file, const TomlValue& value) {
    const TableReader reader(file, value, "[camera]",
                             {"width", "height", "fov_y_deg", "fx", "fy", "cx", "cy", "near", "far",
                              "position", "look_at", "up", "camera_to_world"});
    Camera camera;
    camera.line = reader.line();
    camera.width = static_cast<int>(reader.integer("width", 1, kMaxImageSize));
    camera.height = static_cast<int>(reader.integer("height", 1, kMaxImageSize));
    camera.intrinsics = readIntrinsics(reader, camera.width, camera.height);
    camera.near = reader.number("near", {1 / kMaxSceneNumber, kMaxSceneNumber});
    camera.far = reader.number("far", kPositiveRange);
    if (!(camera.near < camera.far))
        reader.failKey("far",
                       fmt::format("must be greater than 'near' ({} m), not {}", camera.near, camera.far));
    camera.cameraToWorld = reader.has("camera_to_world") ? poseFromMatrix(reader) : poseFromTarget(reader);
    return camera;
}

Environment readEnvironment(const std::string& file, const TomlValue& value) {
    const TableReader reader(
        file, value, "[environment]",
        {"file", "intensity", "rotation_deg", "constant", "lighting", "lights", "map_size"});
    Environment environment;
    environment.line = reader.line();
    readLighting(reader, environment);
    if (reader.has("file")) {
        reader.forbid("constant", "cannot stand beside 'file'");
        environment.kind = EnvironmentKind::file;
        environment.file = reader.existingFile("file");
        if (reader.has("intensity")) environment.intensity = reader.number("intensity", kPositiveRange);
        if (reader.has("rotation_deg"))
            environment.rotation_deg = reader.number("rotation_deg", kDegreesRange);
        return environment;
    }
    for (const char* key : {"intensity", "rotation_deg"}) reader.forbid(key, "needs 'file' beside it");
    if (!reader.has("constant"))
        reader.fail(reader.line(),
                    "missing key 'file' or 'constant' in [environment] (leave the table out for black)");
    environment.kind = EnvironmentKind::constant;
    environment.constant = reader.triple("constant", kNonNegativeRange);
    return environment;
}

namespace {

// How the light's shadows are made.
std::string readShadowMethod(const TableReader& reader) {
    constexpr std::string_view kShadows[] = {"none", "map", "volume"};
    return reader.has("shadow") ? reader.choice("shadow", kShadows) : "none";
}

// The keys that begin with "shadow_".
std::optional<ShadowMapSettings> readShadow(const TableReader& reader, LightKind kind) {
    constexpr std::string_view kDepths[] = {"d16", "d24", "d32f", "linear"};
    constexpr std::string_view kFaces[] = {"both", "front", "back"};
    constexpr std::string_view kFilters[] = {"hard", "pcf", "disc", "soft"};
    const auto indexOf = [&](std::string_view key, std::span<const std::string_view> names, auto fallback) {
        if (!reader.has(key)) return fallback;
        const std::string name = reader.choice(key, names);
        return static_cast<decltype(fallback)>(std::find(names.begin(), names.end(), name) - names.begin());
    };
    const bool isMap = readShadowMethod(reader) == "map";
    const auto forbid = [&](std::initializer_list<std::string_view> keys, std::string_view reason) {
        for (const std::string_view key : keys) reader.forbid(key, reason);
    };
    if (!isMap) {
        forbid({"shadow_size", "shadow_depth", "shadow_faces", "shadow_bias", "shadow_slope_bias",
                "shadow_receiver_plane", "shadow_filter", "shadow_taps", "shadow_radius_texels",
                "shadow_light_size_m", "shadow_light_deg"},
               "needs shadow = \"map\"");
        return std::nullopt;
    }
    ShadowMapSettings map = defaultShadowMap();
    if (reader.has("shadow_size"))
        map.size = static_cast<int>(reader.integer("shadow_size", 1, kMaxShadowMapSize));
    map.depth = indexOf("shadow_depth", kDepths, map.depth);
    map.faces = indexOf("shadow_faces", kFaces, map.faces);
    if (reader.has("shadow_bias")) map.bias.constant = reader.number("shadow_bias", kShadowBiasRange);
    if (reader.has("shadow_slope_bias"))
        map.bias.slopeScale = reader.number("shadow_slope_bias", kShadowBiasRange);
    if (reader.has("shadow_receiver_plane")) map.receiverPlane = reader.boolean("shadow_receiver_plane");
    map.filter = indexOf("shadow_filter", kFilters, map.filter);
    const bool isDisc = map.filter == ShadowFilter::disc, isSoft = map.filter == ShadowFilter::soft;
    if (map.filter == ShadowFilter::hard) forbid({"shadow_taps"}, "is not used by shadow_filter 'hard'");
    if (isDisc || isSoft) map.taps = kDiscTaps;
    if (reader.has("shadow_taps"))
        map.taps = static_cast<int>(
            reader.integer("shadow_taps", 1, isDisc || isSoft ? kMaxDiscTaps : kMaxWindowTaps));
    if (!isDisc && !isSoft) forbid({"shadow_radius_texels"}, "needs shadow_filter = \"disc\" or \"soft\"");
    if (isSoft) map.radius_texels = kSoftRadius_texels;
    if (reader.has("shadow_radius_texels"))
        map.radius_texels = reader.number("shadow_radius_texels", {0, kMaxShadowRadius_texels});
    const bool isFar = kind == LightKind::directional;
    forbid({isFar ? "shadow_light_size_m" : "shadow_light_deg"},
           isFar ? "is not used by kind 'directional'" : "is used by kind 'directional' alone");
    if (!isSoft) forbid({"shadow_light_size_m", "shadow_light_deg"}, "needs shadow_filter = \"soft\"");
    if (isSoft && isFar) {
        const SinCos half = sinCosOfDegrees(reader.number("shadow_light_deg", {0, kMaxLight_deg}) / 2);
        map.tangentOfHalfAngle = half.sin / half.cos;
    }
    if (isSoft && !isFar) map.lightSize_m = reader.number("shadow_light_size_m", kNonNegativeRange);
    return map;
}

}  // namespace

SceneLight readLight(const std::string& file, const TomlValue& value) {
    constexpr std::string_view kKinds[] = {"directional", "point", "spot"};
    const TableReader reader(
        file, value, "[[light]]",
        {"kind", "direction", "irradiance", "position", "intensity", "inner_deg", "outer_deg", "shadow",
         "shadow_size", "shadow_depth", "shadow_faces", "shadow_bias", "shadow_slope_bias",
         "shadow_receiver_plane", "shadow_filter", "shadow_taps", "shadow_radius_texels",
         "shadow_light_size_m", "shadow_light_deg"});
    SceneLight light;
    light.line = reader.line();
    light.shadowVolumes = readShadowMethod(reader) == "volume";
    const std::string kind = reader.choice("kind", kKinds);
    const auto forbid = [&](std::initializer_list<std::string_view> keys) {
        for (const std::string_view key : keys)
            reader.forbid(key, fmt::format("is not used by kind '{}'", kind));
    };
    if (kind != "point") light.direction = unitOf(reader.direction("direction"));
    if (kind == "directional") {
        forbid({"position", "intensity", "inner_deg", "outer_deg"});
        light.irradiance = reader.triple("irradiance", kNonNegativeRange);
        light.shadowMap = readShadow(reader, light.kind);
        return light;
    }
    forbid({"irradiance"});
    light.position = reader.triple("position", kCoordinateRange);
    light.intensity = reader.triple("intensity", kNonNegativeRange);
    if (kind == "point") {
        light.kind = LightKind::point;
        forbid({"direction", "inner_deg", "outer_deg"});
        light.shadowMap = readShadow(reader, light.kind);
        return light;
    }
    light.kind = LightKind::spot;
    light.outer_deg = reader.number("outer_deg", {kMinConeStep_deg, kMaxCone_deg});
    if (reader.has("inner_deg")) light.inner_deg = reader.number("inner_deg", {0, kMaxCone_deg});
    if (!(light.inner_deg <= light.outer_deg - kMinConeStep_deg))
        reader.failKey(reader.has("inner_deg") ? "inner_deg" : "outer_deg",
                       fmt::format("must be at least {} below 'outer_deg' ({}), not {}", kMinConeStep_deg,
                                   light.outer_deg, light.inner_deg));
    light.shadowMap = readShadow(reader, light.kind);
    return light;
}

}  // namespace etalon
