#include "scene/scene.h"

#include <algorithm>
#include <map>

#include "numeric/check.h"
#include "numeric/text.h"
#include "scene/outputs.h"
#include "scene/profile_file.h"
#include "scene/scene_parts.h"

namespace etalon {

namespace {

// The tables of [material.NAME], in the order of their names.
std::vector<Material> readMaterials(const std::string& file, const TableReader& top) {
    std::vector<Material> materials;
    if (!top.has("material")) return materials;
    const TomlValue& table = top.value("material");
    if (table.kind != TomlKind::table) top.failKey("material", "must be a table: write [material.NAME]");
    for (size_t i = 0; i < table.items.size(); i++)
        materials.push_back(readMaterial(file, table.keys[i], table.items[i]));
    return materials;
}

// Names are given to objects that have none ("mesh0", "plane0"), and no two objects share one.
void nameObjects(const TableReader& top, Scene& scene) {
    std::map<std::string, int> lines;
    const auto take = [&](std::string& name, const char* prefix, size_t index, int line) {
        if (name.empty()) name = formatText("{}{}", prefix, index);
        const auto [entry, isNew] = lines.emplace(name, line);
        if (!isNew)
            top.fail(line, formatText("'name': '{}' is taken by the object at line {}", printable(name),
                                      entry->second));
    };
    for (size_t i = 0; i < scene.meshes.size(); i++)
        take(scene.meshes[i].name, "mesh", i, scene.meshes[i].line);
    for (size_t i = 0; i < scene.planes.size(); i++)
        take(scene.planes[i].name, "plane", i, scene.planes[i].line);
}

}  // namespace

Output readOutput(const std::string& file, const TomlValue& value) {
    const TableReader reader(file, value, {SceneTable::output});
    Output output;
    output.line = reader.line();
    if (reader.has("images")) {
        const TomlValue& images = reader.value("images");
        if (images.kind != TomlKind::array || images.items.empty())
            reader.failKey("images", "must be an array of at least one output name");
        for (const TomlValue& item : images.items) {
            if (item.kind != TomlKind::string)
                reader.fail(item.line, "'images' in [output] must hold strings");
            const std::string_view name = item.text;
            if (!findOutput(name))
                reader.fail(
                    item.line,
                    formatText("'images' in [output]: no output is called '{}'{}; there are {}",
                               printable(name), nearestHint(name, outputNames()), joined(outputNames())));
            if (std::find(output.images.begin(), output.images.end(), name) != output.images.end())
                reader.fail(item.line, formatText("'images' in [output] names '{}' twice", name));
            output.images.emplace_back(name);
        }
    } else {
        output.images = {"beauty"};
    }
    output.toneMap = reader.member("tone_map", output.toneMap);
    if (reader.has("exposure")) output.exposure = reader.number("exposure");
    return output;
}

Render readRender(const std::string& file, const TomlValue& value) {
    const TableReader reader(file, value, {SceneTable::render});
    Render render;
    render.line = reader.line();
    if (reader.has("samples")) {
        const int samples = reader.integer("samples");
        if (samples != 1 && samples != 4 && samples != 16)
            reader.failKey("samples", formatText("must be 1, 4 or 16, not {}", samples));
        render.samples = samples;
    }
    if (reader.has("profile")) {
        const std::string given = reader.text("profile");
        if (isProfileFile(given))
            render.profile = readProfileFile(reader.existingFile("profile"));
        else
            render.profile = *findProfile(reader.choice("profile", profileNames()));
    }
    render.origin = reader.member("origin", render.origin);
    if (reader.has("lighting")) render.perVertex = reader.choice("lighting") == "per_vertex";
    if (reader.has("occlusion")) render.occlusionDirections = reader.integer("occlusion");
    if (render.occlusionDirections == 0)
        reader.forbid("occlusion_size", "needs 'occlusion' of at least 1 beside it");
    if (reader.has("occlusion_size")) render.occlusionMapSize = reader.integer("occlusion_size");
    if (reader.has("reflections")) render.reflections = reader.integer("reflections");
    if (reader.has("seed")) render.seed = static_cast<uint64_t>(reader.integer("seed", 0, INT64_MAX));
    return render;
}

void moveOrigin(Scene& scene, const glm::dvec3& to) {
    const auto move = [&](glm::dmat4& toWorld) {
        for (int c = 0; c < 3; c++) toWorld[3][c] -= to[c];
    };
    move(scene.camera.cameraToWorld);
    for (MeshObject& mesh : scene.meshes) std::ranges::for_each(mesh.objectToWorld, move);
    for (Plane& plane : scene.planes) plane.point -= to;
    for (SceneLight& light : scene.lights)
        if (light.kind != LightKind::directional) light.position_m -= to;
    scene.origin_m += to;
}

std::string where(const Scene& scene, int line) {
    return line > 0 ? formatText("{}:{}", scene.file.string(), line) : scene.file.string();
}

Scene loadScene(const std::filesystem::path& path) {
    const TomlValue document = readToml(path);
    const std::string file = path.string();
    const TableReader top(file, document, {SceneTable::scene});
    Scene scene;
    scene.file = path;
    scene.camera = readCamera(file, top.value("camera"));
    if (top.has("environment")) scene.environment = readEnvironment(file, top.value("environment"));
    if (top.has("ambient")) scene.ambient = top.triple("ambient");
    scene.materials = readMaterials(file, top);
    for (const TomlValue& mesh : top.tables("mesh"))
        scene.meshes.push_back(readMesh(file, mesh, scene.materials));
    for (const TomlValue& plane : top.tables("plane"))
        scene.planes.push_back(readPlane(file, plane, scene.materials));
    for (const TomlValue& light : top.tables("light")) scene.lights.push_back(readLight(file, light));
    if (top.has("output"))
        scene.output = readOutput(file, top.value("output"));
    else
        scene.output.images = {"beauty"};
    if (top.has("render")) scene.render = readRender(file, top.value("render"));
    nameObjects(top, scene);
    if (scene.render.origin == Origin::eye) moveOrigin(scene, glm::dvec3(scene.camera.cameraToWorld[3]));
    return scene;
}

}  // namespace etalon
