#include "tests/ar/random_scene.h"

#include <algorithm>
#include <fstream>

#include "files/image_io.h"
#include "numeric/text.h"
#include "numeric/transform.h"
#include "raster/profile.h"
#include "scene/outputs.h"
#include "tests/support/random_numbers.h"

namespace etalon::test {
namespace {

constexpr std::string_view kMeshes[] = {"tetrahedron.obj", "cube.obj", "sheet.obj", "tilted_normals.obj"};
constexpr std::string_view kTetrahedron =
    "v 0 0.7 0\nv -0.6 -0.4 0.5\nv 0.6 -0.4 0.5\nv 0 -0.4 -0.7\nf 1 2 3\nf 1 3 4\nf 1 4 2\nf 2 4 3\n";
constexpr std::string_view kCube =
    "v -0.5 -0.5 -0.5\nv 0.5 -0.5 -0.5\nv 0.5 0.5 -0.5\nv -0.5 0.5 -0.5\n"
    "v -0.5 -0.5 0.5\nv 0.5 -0.5 0.5\nv 0.5 0.5 0.5\nv -0.5 0.5 0.5\n"
    "vn 0 0 -1\nvn 0 0 1\nvn 0 -1 0\nvn 0 1 0\nvn -1 0 0\nvn 1 0 0\n"
    "f 1//1 3//1 2//1\nf 1//1 4//1 3//1\nf 5//2 6//2 7//2\nf 5//2 7//2 8//2\n"
    "f 1//3 2//3 6//3\nf 1//3 6//3 5//3\nf 4//4 7//4 3//4\nf 4//4 8//4 7//4\n"
    "f 1//5 5//5 8//5\nf 1//5 8//5 4//5\nf 2//6 3//6 7//6\nf 2//6 7//6 6//6\n";
constexpr std::string_view kSheet = "v -1 0 1\nv 1 0 1\nv 1 0 -1\nv -1 0 -1\nf 1 2 3\nf 1 3 4\n";
constexpr std::string_view kTiltedNormals =
    "v -1 0 1\nv 1 0 1\nv 1 0 -1\nv -1 0 -1\nvn 0 1 0\nvn 0.6 0.8 0\nvn -0.6 -0.8 0\nf 1//1 2//2 3//1\nf "
    "1//1 3//3 "
    "4//2\n";

class Maker {
  public:
    Maker(const ScratchFolder& folder, uint64_t number) : folder_(folder), random_(number) {}

    Scene scene() {
        Scene scene;
        scene.file = folder_ / "scene.toml";
        setCamera(scene.camera);
        setMaterials(scene);
        setObjects(scene);
        setLights(scene);
        setEnvironment(scene.environment);
        if (chance(0.5)) scene.ambient = colour();
        setOutputs(scene.output);
        setRender(scene.render);
        return scene;
    }

  private:
    bool chance(double part) { return random_.uniform(0, 1) < part; }
    glm::dvec3 triple(double low, double high) {
        glm::dvec3 v;
        for (int c = 0; c < 3; c++) v[c] = random_.uniform(low, high);
        return v;
    }
    // Often black, sometimes in some channels.
    glm::dvec3 colour() {
        if (chance(0.3)) return glm::dvec3(0);
        glm::dvec3 v = triple(0, 1);
        for (int c = 0; c < 3; c++)
            if (chance(0.1)) v[c] = 0;
        return v;
    }
    glm::dvec3 direction() {
        const glm::dvec3 axes[] = {{0, 1, 0}, {0, -1, 0}, {1, 0, 0}, {0, 0, -1}};
        if (chance(0.3)) return axes[random_.below(4)];
        glm::dvec3 v = triple(-1, 1);
        v.y += 0.01;
        return unitOf(v);
    }

    void setCamera(Camera& camera) {
        camera.width = 5 + random_.below(16);
        camera.height = 5 + random_.below(12);
        camera.intrinsics.fx = camera.intrinsics.fy = camera.width * random_.uniform(0.7, 1.5);
        camera.intrinsics.cx = camera.width / 2.0;
        camera.intrinsics.cy = camera.height / 2.0;
        camera.near = 0.1;
        camera.far = 40;
        const double around_deg = random_.uniform(-180, 180);
        const double down_deg = random_.uniform(-60, 10);
        const double distance_m = random_.uniform(2, 5);
        camera.cameraToWorld =
            multiplied(rotationAboutAxis({0, 1, 0}, around_deg),
                       multiplied(rotationAboutAxis({1, 0, 0}, down_deg), translation({0, 0, distance_m})));
    }

    void setMaterials(Scene& scene) {
        for (int i = 0; i < 4; i++) {
            Material material;
            material.name = formatText("m{}", i);
            material.kind = chance(0.2) ? MaterialKind::mirror : static_cast<MaterialKind>(random_.below(3));
            if (material.kind != MaterialKind::mirror) material.diffuse = colour();
            if (material.kind == MaterialKind::blinnPhong) {
                material.specular = colour();
                material.exponent = random_.uniform(1, 60);
            }
            if (material.kind == MaterialKind::mirror ||
                (material.kind == MaterialKind::blinnPhong && chance(0.5)))
                material.reflectance = colour();
            scene.materials.push_back(material);
        }
        // Of planes alone.
        Material checker;
        checker.name = "m4";
        checker.diffuse = colour();
        checker.checker = Checker{colour(), 0.5};
        scene.materials.push_back(checker);
    }

    void setObjects(Scene& scene) {
        for (int i = random_.below(5); i > 0; i--) {
            MeshObject mesh;
            mesh.name = formatText("mesh{}", scene.meshes.size());
            mesh.file = folder_ / std::string(kMeshes[random_.below(std::size(kMeshes))]);
            mesh.material = static_cast<size_t>(random_.below(4));
            for (int p = chance(0.2) ? 2 : 1; p > 0; p--) {
                const double size = random_.uniform(0.4, 1.2);
                const double x = chance(0.2) ? -size : size;
                const glm::dvec3 axis = direction();
                const double turn_deg = random_.uniform(-180, 180);
                mesh.objectToWorld.push_back(
                    multiplied(translation(triple(-1.5, 1.5)),
                               multiplied(rotationAboutAxis(axis, turn_deg), scaling({x, size, size}))));
            }
            mesh.twoSided = chance(0.6);
            if (hasMirrorPart(scene.materials[mesh.material]) && chance(0.6))
                mesh.reflection = Reflection::scene;
            mesh.cubeSize = 3 + random_.below(5);
            scene.meshes.push_back(mesh);
        }
        for (int i = random_.below(3); i > 0; i--) {
            Plane plane;
            plane.name = formatText("plane{}", scene.planes.size());
            plane.point = chance(0.5) ? glm::dvec3(0, -random_.below(2), 0) : triple(-1, 1);
            if (chance(0.4)) plane.normal = direction();
            const glm::dvec3 across =
                std::abs(plane.normal.x) > 0.9 ? glm::dvec3(0, 0, 1) : glm::dvec3(1, 0, 0);
            plane.v = unitOf(crossOf(plane.normal, across));
            plane.u = crossOf(plane.v, plane.normal);
            plane.size_m.x = random_.uniform(1, 6);
            plane.size_m.y = random_.uniform(1, 6);
            plane.material = static_cast<size_t>(random_.below(5));
            scene.planes.push_back(plane);
        }
    }

    LightShadow shadow(LightKind kind) {
        LightShadow shadow;
        shadow.method = static_cast<ShadowMethod>(random_.below(4));
        shadow.map.size = 8 + random_.below(24);
        shadow.map.filter = static_cast<ShadowFilter>(random_.below(4));
        shadow.map.depth = static_cast<ShadowDepth>(random_.below(4));
        shadow.map.faces = static_cast<ShadowFaces>(random_.below(3));
        shadow.map.taps = 1 + random_.below(4);
        (kind == LightKind::directional ? shadow.map.tangentOfHalfAngle : shadow.map.lightSize_m) =
            random_.uniform(0, 0.2);
        shadow.planar.resolution = 16;
        shadow.planar.samples = 1 + random_.below(3);
        shadow.planar.blurSigma_m = chance(0.3) ? 0.1 : 0;
        return shadow;
    }

    void setLights(Scene& scene) {
        for (int i = random_.below(4); i > 0; i--) {
            SceneLight light;
            light.kind = static_cast<LightKind>(random_.below(3));
            light.axis = direction();
            light.toLight = -light.axis;
            const glm::dvec3 power = 3.0 * colour();
            // Far from all objects, so that 1 / distance^2 stays in range.
            const double distance_m = random_.uniform(4, 8);
            light.position_m = distance_m * direction();
            const double outer_deg = random_.uniform(20, 80);
            light.cosOuter = sinCosOfDegrees(outer_deg).cos;
            light.cosInner = sinCosOfDegrees(outer_deg / 2).cos;
            (light.kind == LightKind::directional ? light.irradiance : light.intensity) = power;
            light.shadow = shadow(light.kind);
            scene.lights.push_back(light);
        }
    }

    void setEnvironment(Environment& environment) {
        environment.kind = static_cast<EnvironmentKind>(random_.below(3));
        if (environment.kind == EnvironmentKind::none) return;
        if (environment.kind == EnvironmentKind::constant) environment.constant = colour();
        if (environment.kind == EnvironmentKind::file) {
            environment.file = folder_ / (chance(0.1) ? "black.exr" : "sky.exr");
            environment.rotation_deg = random_.below(5) * 45;
        }
        environment.lighting = static_cast<EnvironmentLightMethod>(random_.below(7));
        environment.lightCount = 1 << random_.below(4);
        environment.mapSize = 1 + random_.below(4);
        environment.shadow = shadow(LightKind::directional);
        environment.shadowLights = 1 + random_.below(4);
        if (chance(0.3)) environment.shadowShare = random_.uniform(0.05, 0.6);
    }

    void setOutputs(Output& output) {
        const double part = random_.uniform(0, 1);
        for (const std::string_view name : outputNames())
            if (chance(part)) output.images.emplace_back(name);
        if (output.images.empty()) {
            const auto number = static_cast<size_t>(random_.below(static_cast<int>(outputNames().size())));
            output.images = {std::string(outputNames()[number])};
        }
        // Those that may have no channel are not alone.
        const auto hasChannel = [](const std::string& name) {
            return name != "shadow" && findOutput(name)->file.empty();
        };
        if (std::ranges::none_of(output.images, hasChannel)) output.images.emplace_back("ids");
        output.toneMap = static_cast<ToneMap>(random_.below(static_cast<int>(kNames<ToneMap>.size())));
    }

    void setRender(Render& render) {
        render.samples = chance(0.2) ? 4 : 1;
        render.perVertex = chance(0.3);
        if (chance(0.5)) render.occlusionDirections = 1 + random_.below(12);
        render.occlusionMapSize = 4 + random_.below(28);
        render.seed = random_.bits() >> 1;
        // Truth is slow.
        const auto names = profileNames();
        if (chance(0.5)) render.profile = *findProfile(names[random_.below(static_cast<int>(names.size()))]);
        if (render.profile.name == "truth" && chance(0.9)) render.profile = *findProfile("f64");
    }

    const ScratchFolder& folder_;
    RandomNumbers random_;
};

}  // namespace

RandomScenes::RandomScenes() {
    const std::string_view texts[] = {kTetrahedron, kCube, kSheet, kTiltedNormals};
    for (size_t i = 0; i < std::size(kMeshes); i++)
        std::ofstream(folder_ / std::string(kMeshes[i])) << texts[i];
    for (const bool isBlack : {false, true}) {
        RandomNumbers random(1);
        Frame sky;
        sky.width = 8;
        sky.height = 4;
        for (const char* name : {"R", "G", "B"}) {
            Image<float> plane(8, 4);
            for (float& value : plane.values())
                value = isBlack ? 0 : static_cast<float>(random.uniform(0, 1));
            plane.at(5, 1) = isBlack ? 0 : 20;
            sky.channels.push_back({name, plane});
        }
        writeExr(sky, folder_ / (isBlack ? "black.exr" : "sky.exr"));
    }
}

Scene RandomScenes::scene(uint64_t number) const { return Maker(folder_, number).scene(); }

std::string sceneText(const Scene& scene) {
    std::string text = formatText(
        "profile {}, {} samples, {}, occlusion {} of {}, environment {} lights {} shadow {}; outputs",
        scene.render.profile.name, scene.render.samples, scene.render.perVertex ? "per vertex" : "per pixel",
        scene.render.occlusionDirections, scene.render.occlusionMapSize,
        static_cast<int>(scene.environment.kind), nameOf(scene.environment.lighting),
        static_cast<int>(scene.environment.shadow.method));
    for (const std::string& output : scene.output.images) text += " " + output;
    for (const MeshObject& mesh : scene.meshes)
        text += formatText("; {} {} m{} {}{}", mesh.name, mesh.file.stem().string(), mesh.material,
                           mesh.twoSided ? "both" : "front",
                           mesh.reflection == Reflection::scene ? " scene" : "");
    for (const Plane& plane : scene.planes) text += formatText("; {} m{}", plane.name, plane.material);
    for (const SceneLight& light : scene.lights)
        text += formatText("; light {} shadow {}", static_cast<int>(light.kind),
                           static_cast<int>(light.shadow.method));
    return text;
}

}  // namespace etalon::test
