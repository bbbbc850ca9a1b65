#include "ar/surface_builder.h"

#include <cmath>
#include <map>

#include "files/image_io.h"
#include "files/mesh.h"
#include "numeric/text.h"
#include "numeric/transform.h"

namespace etalon {

SurfaceMaterial surfaceMaterialOf(const Material& material) {
    SurfaceMaterial surface;
    surface.kind = material.kind;
    surface.diffuse = material.diffuse;
    surface.specular = material.specular;
    surface.reflectance = material.reflectance;
    surface.exponent = material.exponent;
    if (material.checker) {
        surface.checker = true;
        surface.diffuse2 = material.checker->diffuse;
        surface.checkerSize_m = material.checker->size_m;
    }
    return surface;
}

SurfaceEnvironment surfaceEnvironmentOf(const Environment& environment) {
    SurfaceEnvironment surface;
    if (environment.kind == EnvironmentKind::constant) surface.constant = environment.constant;
    const SinCos rotation = sinCosOfDegrees(environment.rotation_deg);
    surface.cosRotation = rotation.cos;
    surface.sinRotation = rotation.sin;
    return surface;
}

std::vector<SceneObject> sceneObjects(const Scene& scene) {
    std::vector<SceneObject> objects;
    for (size_t m = 0; m < scene.meshes.size(); m++) {
        const MeshObject& mesh = scene.meshes[m];
        for (size_t p = 0; p < mesh.objectToWorld.size(); p++) {
            const std::string name =
                mesh.objectToWorld.size() == 1 ? mesh.name : formatText("{}[{}]", mesh.name, p);
            objects.push_back({name, true, m, p, &scene.materials[mesh.material]});
        }
    }
    for (size_t p = 0; p < scene.planes.size(); p++)
        objects.push_back({scene.planes[p].name, false, p, 0, &scene.materials[scene.planes[p].material]});
    return objects;
}

namespace {

// The inverse transpose of the upper 3x3 part, column by column.
glm::dmat3 normalMatrix(const glm::dmat4& m) {
    const auto column = [&](int i) {
        glm::dvec3 axis(0);
        axis[i] = 1;
        return transformNormal(m, axis);
    };
    return glm::dmat3(column(0), column(1), column(2));
}

glm::dvec3 centreOfBounds(const SurfaceMesh& mesh, const glm::dmat4& toWorld) {
    glm::dvec3 lowest(INFINITY), highest(-INFINITY);
    for (const glm::vec3& position : mesh.positions) {
        const glm::dvec3 p = transformPoint(toWorld, glm::dvec3(position));
        for (int k = 0; k < 3; k++) {
            lowest[k] = std::min(lowest[k], p[k]);
            highest[k] = std::max(highest[k], p[k]);
        }
    }
    return {(lowest.x + highest.x) / 2, (lowest.y + highest.y) / 2, (lowest.z + highest.z) / 2};
}

// Two triangles about the plane's point; the corners are +- u size.x / 2 +- v size.y / 2, surface coordinates in metres
// from there.
SurfaceMesh planeMesh(const Plane& plane) {
    SurfaceMesh mesh;
    for (const auto& [a, b] :
         {std::pair(-0.5, -0.5), std::pair(0.5, -0.5), std::pair(0.5, 0.5), std::pair(-0.5, 0.5)}) {
        const double u_m = a * plane.size_m.x, v_m = b * plane.size_m.y;
        mesh.positions.emplace_back(u_m * plane.u.x + v_m * plane.v.x, u_m * plane.u.y + v_m * plane.v.y,
                                    u_m * plane.u.z + v_m * plane.v.z);
        mesh.normals.emplace_back(plane.normal);
        mesh.uv_m.emplace_back(u_m, v_m);
    }
    mesh.indices = {0, 1, 2, 0, 2, 3};
    return mesh;
}

}  // namespace

SurfaceScene buildSurfaces(const Scene& scene, std::vector<std::string>& warnings) {
    SurfaceScene surfaces;
    for (const Material& material : scene.materials)
        surfaces.materials.push_back(surfaceMaterialOf(material));
    surfaces.ambient = scene.ambient;

    std::map<std::filesystem::path, uint32_t> meshOfFile;
    for (const SceneObject& object : sceneObjects(scene)) {
        SurfaceInstance instance;
        if (!object.isMesh) {
            const Plane& plane = scene.planes[object.index];
            instance.mesh = static_cast<uint32_t>(surfaces.meshes.size());
            instance.material = static_cast<uint32_t>(plane.material);
            instance.twoSided = false;
            instance.toWorld = translation(plane.point);
            surfaces.meshes.push_back(planeMesh(plane));
            surfaces.instances.push_back(instance);
            continue;
        }
        const MeshObject& mesh = scene.meshes[object.index];
        const auto [entry, isNew] =
            meshOfFile.try_emplace(mesh.file, static_cast<uint32_t>(surfaces.meshes.size()));
        if (isNew) {
            LoadedMesh loaded = loadMesh(mesh.file, where(scene, mesh.fileLine));
            for (std::string& warning : meshWarnings(mesh.file, loaded.report))
                warnings.push_back(std::move(warning));
            surfaces.meshes.push_back({std::move(loaded.mesh.positions),
                                       std::move(loaded.mesh.normals),
                                       {},
                                       std::move(loaded.mesh.indices)});
        }
        instance.mesh = entry->second;
        instance.material = static_cast<uint32_t>(mesh.material);
        instance.toWorld = mesh.objectToWorld[object.placement];
        instance.normalToWorld = normalMatrix(instance.toWorld);
        instance.twoSided = mesh.twoSided;
        instance.reflection = mesh.reflection;
        instance.cubeSize = mesh.cubeSize;
        instance.cubeCentre_m = centreOfBounds(surfaces.meshes[instance.mesh], instance.toWorld);
        surfaces.instances.push_back(instance);
    }
    return surfaces;
}

Image<float> loadEnvironment(const Scene& scene, bool strict, std::vector<std::string>& warnings) {
    Image<float> image = readRgb(scene.environment.file);
    uint64_t negative = 0, nonFinite = 0;
    for (float& value : image.values()) {
        const bool isFinite = std::isfinite(value);
        nonFinite += isFinite ? 0 : 1;
        negative += isFinite && value < 0 ? 1 : 0;
        value = isFinite && value > 0 ? static_cast<float>(value * scene.environment.intensity) : 0.f;
        if (!std::isfinite(value))
            throw InputError(formatText("{}: radiance times intensity {} exceeds the range of float",
                                        where(scene, scene.environment.line), scene.environment.intensity));
    }
    if (negative + nonFinite == 0) return image;
    const std::string found = formatText("{}: {} negative and {} non-finite values",
                                         scene.environment.file.string(), negative, nonFinite);
    if (strict) throw InputError(found);
    warnings.push_back(found + " were set to 0");
    return image;
}

View cameraViewOf(const Camera& camera) {
    const auto axis = [&](int column) { return glm::dvec3(camera.cameraToWorld[column]); };
    PinholeCamera pinhole;
    pinhole.width = camera.width;
    pinhole.height = camera.height;
    pinhole.fx = camera.intrinsics.fx;
    pinhole.fy = camera.intrinsics.fy;
    pinhole.cx = camera.intrinsics.cx;
    pinhole.cy = camera.intrinsics.cy;
    pinhole.right = axis(0);
    pinhole.up = axis(1);
    pinhole.backward = axis(2);
    pinhole.position = axis(3);
    pinhole.near_m = camera.near;
    pinhole.far_m = camera.far;
    return cameraView(pinhole);
}

}  // namespace etalon
