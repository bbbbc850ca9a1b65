#include "bench/workloads.h"

#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "bitcheck/inputs.h"
#include "numeric/check.h"
#include "numeric/random.h"
#include "numeric/vectors.h"

namespace etalon::bench {
namespace {

using glm::dvec3;

void addVertex(SurfaceMesh& mesh, const dvec3& position, const dvec3& normal) {
    mesh.positions.emplace_back(position);
    mesh.normals.emplace_back(normal);
}

// The knot of tests and experiments, of thicker arms with ripples; segments x sides quads.
SurfaceMesh knotMesh(int segments, int sides) {
    KnotShape shape{.radius_m = 0.78, .swing_m = 0.39, .rise_m = 0.78, .tube_m = 0.32, .ripple_m = 0.03};
    return torusKnotMesh(segments, sides, shape);
}

// 4 x 4 quads of the plane y = -1.3, seen from above.
void addGround(SurfaceMesh& mesh) {
    constexpr int kQuads = 4;
    constexpr double kHalfSize_m = 3, kY_m = -1.3;
    const auto first = static_cast<uint32_t>(mesh.positions.size());
    for (int j = 0; j <= kQuads; j++)
        for (int i = 0; i <= kQuads; i++)
            addVertex(mesh,
                      {kHalfSize_m * (2.0 * i / kQuads - 1), kY_m, kHalfSize_m * (2.0 * j / kQuads - 1)},
                      {0, 1, 0});
    for (int j = 0; j < kQuads; j++)
        for (int i = 0; i < kQuads; i++) {
            const uint32_t a = first + static_cast<uint32_t>(j * (kQuads + 1) + i), b = a + kQuads + 1;
            for (const uint32_t index : {a, b + 1, a + 1, a, b, b + 1}) mesh.indices.push_back(index);
        }
}

View knotView(int width, int height) {
    constexpr double kFovY_rad = 0.9;
    PinholeCamera camera;
    camera.width = width;
    camera.height = height;
    camera.fx = camera.fy = height / 2.0 / std::tan(kFovY_rad / 2);
    camera.cx = width / 2.0;
    camera.cy = height / 2.0;
    camera.position = {0.5, 1.5, 4};
    camera.backward = unitOf(camera.position);
    camera.right = unitOf(crossOf({0, 1, 0}, camera.backward));
    camera.up = crossOf(camera.backward, camera.right);
    camera.near_m = 0.5;
    camera.far_m = 20;
    return cameraView(camera);
}

// World space is clip space: x and y in [-1, 1], z in [0, 1].
View screenView(int width, int height) {
    View view;
    view.width = width;
    view.height = height;
    view.worldToClip = {glm::dvec4(1, 0, 0, 0), {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}};
    view.eye = {0, 0, -1};
    return view;
}

void addTriangle(SurfaceMesh& mesh, const std::array<dvec3, 3>& corners) {
    for (const dvec3& corner : corners) {
        mesh.indices.push_back(static_cast<uint32_t>(mesh.positions.size()));
        addVertex(mesh, corner, {0, 0, -1});
    }
}

// Each corner up to `reach` in x and y from a random centre, at a random depth.
void addSoup(SurfaceMesh& mesh, int triangles, double reachX, double reachY) {
    Random random(0);
    for (int i = 0; i < triangles; i++) {
        const double x = random.uniform(-1, 1), y = random.uniform(-1, 1);
        std::array<dvec3, 3> corners;
        for (dvec3& corner : corners) {
            corner.x = random.uniform(x - reachX, x + reachX);
            corner.y = random.uniform(y - reachY, y + reachY);
            corner.z = random.uniform(0, 1);
        }
        addTriangle(mesh, corners);
    }
}

void addLayers(SurfaceMesh& mesh) {
    for (int i = 0; i < kLayers; i++) {
        const double z = 0.9 - 0.02 * i;
        addTriangle(mesh, {dvec3(-1, -1, z), dvec3(3, -1, z), dvec3(-1, 3, z)});
    }
}

// One strong light and, if there are more, weak ones spread over the upper hemisphere.
void addLights(SurfaceScene& scene, int count) {
    const double goldenAngle_rad = kPi * (3 - std::sqrt(5.0));
    for (int i = 0; i < count; i++) {
        const double y = 0.25 + 0.7 * (i + 0.5) / kMaxLights, r = std::sqrt(1 - y * y);
        const double angle_rad = i * goldenAngle_rad;
        scene.lights.push_back(
            {{r * std::cos(angle_rad), y, r * std::sin(angle_rad)}, dvec3(i == 0 ? 2.0 : 4.0 / kMaxLights)});
    }
}

Workload make(const std::string& name, int lights) {
    Workload w;
    SurfaceMesh& mesh = w.scene.meshes.emplace_back();
    w.view = knotView(kWidth, kHeight);
    if (name == "1k" || name == "1k-small") {
        mesh = knotMesh(42, 12);
        addGround(mesh);
        if (name == "1k-small") w.view = knotView(64, 48);
    } else if (name == "70k") {
        mesh = knotMesh(440, 80);
        addGround(mesh);
    } else if (name == "870k") {
        mesh = knotMesh(1476, 295);
        addGround(mesh);
    } else if (name == "large") {
        // The mean area of a triangle with random corners in a rectangle is 11/144 of the rectangle's.
        addSoup(mesh, 500, 1.28, 1.28);
        w.view = screenView(kWidth, kHeight);
    } else if (name == "sub-pixel") {
        // Clip space is two units wide.
        addSoup(mesh, 500000, 1.0 / kWidth, 1.0 / kHeight);
        w.view = screenView(kWidth, kHeight);
    } else {
        ETALON_CHECK(name == "layers", "no workload is called {}", name);
        addLayers(mesh);
        w.view = screenView(kLayerSize, kLayerSize);
    }
    SurfaceMaterial material;
    material.kind = MaterialKind::blinnPhong;
    material.diffuse = {0.7, 0.6, 0.5};
    material.specular = dvec3(0.1);
    material.exponent = 32;
    w.scene.materials.push_back(material);
    w.scene.instances.emplace_back();
    w.scene.ambient = dvec3(0.05);
    addLights(w.scene, lights);
    return w;
}

}  // namespace

const Workload& workload(const std::string& name, int lights) {
    ETALON_CHECK(lights >= 0 && lights <= kMaxLights, "{} lights", lights);
    static std::map<std::pair<std::string, int>, Workload> made;
    const auto key = std::pair(name, lights);
    const auto found = made.find(key);
    return found != made.end() ? found->second : made.emplace(key, make(name, lights)).first->second;
}

}  // namespace etalon::bench
