// Scenes and points for the tests of shadows.
#pragma once

#include <cmath>
#include <vector>

#include "lighting/geometry.h"
#include "lighting/light_visibility.h"
#include "lighting/render_view.h"
#include "numeric/door.h"
#include "raster/profile.h"
#include "shadows/lookup_passes.h"
#include "shadows/shadow_map.h"
#include "tests/support/box_scene.h"

namespace etalon::test {

inline glm::dvec3 unit(const glm::dvec3& v) {
    const double length = std::sqrt(v.x * v.x + (v.y * v.y + v.z * v.z));
    return {v.x / length, v.y / length, v.z / length};
}

inline SurfaceLight sun(const glm::dvec3& toLight) {
    SurfaceLight light;
    light.toLight = unit(toLight);
    light.irradiance = glm::dvec3(1);
    return light;
}
inline SurfaceLight bulb(const glm::dvec3& position) {
    SurfaceLight light;
    light.kind = LightKind::point;
    light.position_m = position;
    light.intensity = glm::dvec3(1);
    return light;
}
inline SurfaceLight torch(const glm::dvec3& position, const glm::dvec3& axis, double cosOuter) {
    SurfaceLight light = bulb(position);
    light.kind = LightKind::spot;
    light.axis = unit(axis);
    light.cosOuter = cosOuter;
    return light;
}

// A square of edge `edge` about the centre, seen from above.
inline SurfaceMesh tile(glm::vec3 centre, float edge) {
    return rectangle(centre, {edge / 2, 0, 0}, {0, 0, -edge / 2});
}

// Points of the plane y = height with normal +Y: columns x rows of them over [low, high] in x and z, at cell
// centres.
inline LitPoints gridOn(double height, double low, double high, int count) {
    LitPoints points;
    for (int j = 0; j < count; j++)
        for (int i = 0; i < count; i++) {
            const double p[3] = {low + (high - low) * (i + 0.5) / count, height,
                                 low + (high - low) * (j + 0.5) / count};
            for (size_t k = 0; k < 3; k++) {
                points.position_m[k].push_back(p[k]);
                points.normal[k].push_back(k == 1 ? 1 : 0);
                points.faceNormal[k].push_back(k == 1 ? 1 : 0);
            }
            points.instance.push_back(0);
            points.x_px.push_back(static_cast<uint32_t>(i));
            points.y_px.push_back(static_cast<uint32_t>(j));
        }
    return points;
}

struct MapRequest {
    ShadowMapSettings settings;
    const char* profile = "f32";
    std::vector<bool> receivers = {};
};

inline std::vector<double> lookUp(const ShadowMap& map, const LitPoints& points, const Profile& profile,
                                  WindowSearch search = WindowSearch::sideBySide) {
    std::vector<double> visibility(points.size());
    passesIn<LookupPasses>(profile.fragment)
        ->makeLookup(map, samplerOf(profile), 1, search)
        ->find(points, visibility);
    return visibility;
}

inline std::vector<double> lookUp(const ShadowMap& map, const LitPoints& points,
                                  const char* profileName = "f32",
                                  WindowSearch search = WindowSearch::sideBySide) {
    return lookUp(map, points, *findProfile(profileName), search);
}

inline ShadowMap mapOf(const SurfaceScene& scene, const SurfaceLight& light, const MapRequest& request) {
    const Profile& profile = *findProfile(request.profile);
    const std::vector<PlacedMesh> placed = placeMeshes(scene, profile.vertex, 1);
    return renderShadowMap(scene, placed, light, request.receivers, request.settings, profile,
                           {1, 64, false});
}

inline std::vector<double> visibilityOf(const SurfaceScene& scene, const SurfaceLight& light,
                                        const LitPoints& points, const MapRequest& request) {
    return lookUp(mapOf(scene, light, request), points, request.profile);
}

}  // namespace etalon::test
