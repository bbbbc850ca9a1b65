// The materials, meshes and planes of a scene file.

#include "numeric/text.h"
#include "numeric/transform.h"
#include "scene/scene_parts.h"

namespace etalon {

namespace {

// Smallest sine of the angle between `u_axis` and `normal`.
constexpr double kMinAxisSine = 1e-6;

// One factor for all axes, or three.
glm::dvec3 readScale(const TableReader& reader) {
    const bool isArray = reader.value("scale").kind == TomlKind::array;
    const glm::dvec3 scale = isArray ? reader.triple("scale", kCoordinateRange)
                                     : glm::dvec3(reader.number("scale", kCoordinateRange));
    for (int i = 0; i < 3; i++)
        if (scale[i] > -kMinScale && scale[i] < kMinScale)
            reader.failKey("scale",
                           formatText("must not be zero (magnitude in [{}, {}]): the transform would be "
                                      "singular",
                                      kMinScale, kMaxSceneNumber));
    return scale;
}

size_t findMaterial(const TableReader& reader, const std::vector<Material>& materials) {
    const std::string name = reader.text("material");
    std::vector<std::string_view> names;
    for (size_t i = 0; i < materials.size(); i++) {
        if (materials[i].name == name) return i;
        names.push_back(materials[i].name);
    }
    reader.failKey("material", formatText("is '{}', but there is no [material.{}]{}", printable(name),
                                          printable(name), nearestHint(name, names)));
}

Checker readChecker(const TableReader& reader) {
    Checker checker;
    checker.diffuse = reader.triple("checker");
    checker.size_m = reader.number("checker_size_m");
    return checker;
}

}  // namespace

Material readMaterial(const std::string& file, const std::string& name, const TomlValue& value) {
    const TableReader reader(file, value, {SceneTable::material},
                             formatText("[material.{}]", printable(name)));
    Material material;
    material.line = reader.line();
    material.name = name;
    material.kind = reader.member<MaterialKind>("kind");
    const auto forbid = [&](std::initializer_list<std::string_view> keys) {
        for (const std::string_view key : keys)
            reader.forbid(key, formatText("is not used by kind '{}'", nameOf(material.kind)));
    };
    if (material.kind == MaterialKind::mirror) {
        forbid({"diffuse", "specular", "exponent", "checker", "checker_size_m"});
        material.reflectance = reader.triple("reflectance");
        return material;
    }
    if (material.kind == MaterialKind::lambert) forbid({"specular", "exponent", "reflectance"});
    material.diffuse = reader.triple("diffuse");
    if (material.kind == MaterialKind::blinnPhong) {
        material.specular = reader.triple("specular");
        material.exponent = reader.number("exponent");
        if (reader.has("reflectance")) material.reflectance = reader.triple("reflectance");
    }
    if (reader.has("checker"))
        material.checker = readChecker(reader);
    else
        reader.forbid("checker_size_m", "needs 'checker' beside it");
    return material;
}

glm::dmat4 readTransform(const TableReader& reader) {
    if (reader.has("transform")) {
        for (const char* key : {"translate", "rotate_axis", "rotate_deg", "rotate_xyz_deg", "scale"})
            reader.forbid(key, "cannot stand beside 'transform'");
        return reader.matrix("transform");
    }
    glm::dmat4 m{1.0};
    if (reader.has("scale")) m = scaling(readScale(reader));
    if (reader.has("rotate_xyz_deg")) {
        for (const char* key : {"rotate_axis", "rotate_deg"})
            reader.forbid(key, "cannot stand beside 'rotate_xyz_deg'");
        m = multiplied(rotationXyz(reader.triple("rotate_xyz_deg")), m);
    } else if (reader.has("rotate_axis") || reader.has("rotate_deg")) {
        const glm::dvec3 axis = unitOf(reader.direction("rotate_axis"));
        m = multiplied(rotationAboutAxis(axis, reader.number("rotate_deg")), m);
    }
    if (reader.has("translate")) m = multiplied(translation(reader.triple("translate")), m);
    return m;
}

MeshObject readMesh(const std::string& file, const TomlValue& value, const std::vector<Material>& materials) {
    const TableReader reader(file, value, {SceneTable::mesh});
    MeshObject mesh;
    mesh.line = reader.line();
    if (reader.has("name")) mesh.name = reader.text("name");
    mesh.file = reader.existingFile("file");
    mesh.fileLine = reader.lineOf("file");
    mesh.material = findMaterial(reader, materials);
    const Material& material = materials[mesh.material];
    if (material.checker)
        reader.failKey("material", formatText("'{}' has a checker, which only planes can show",
                                              printable(material.name)));

    const glm::dmat4 own = readTransform(reader);
    if (reader.has("instances") && reader.tables("instances").empty())
        reader.failKey("instances", "must hold at least one transform");
    for (const TomlValue& instance : reader.tables("instances")) {
        const TableReader place(file, instance, {SceneTable::transform});
        mesh.objectToWorld.push_back(multiplied(readTransform(place), own));
    }
    if (mesh.objectToWorld.empty()) mesh.objectToWorld.push_back(own);

    mesh.twoSided = !reader.has("sides") || reader.choice("sides") == "both";
    if (!hasMirrorPart(material))
        for (const char* key : {"reflection", "cube_size"})
            reader.forbid(key, "needs a mirror, a material with 'reflectance'");
    mesh.reflection = reader.member("reflection", mesh.reflection);
    if (mesh.reflection != Reflection::scene) reader.forbid("cube_size", "needs reflection = \"scene\"");
    if (reader.has("cube_size")) mesh.cubeSize = reader.integer("cube_size");
    return mesh;
}

Plane readPlane(const std::string& file, const TomlValue& value, const std::vector<Material>& materials) {
    const TableReader reader(file, value, {SceneTable::plane});
    Plane plane;
    plane.line = reader.line();
    if (reader.has("name")) plane.name = reader.text("name");
    plane.point = reader.triple("point");
    plane.normal = unitOf(reader.direction("normal"));
    plane.size_m = reader.pair("size_m");
    plane.material = findMaterial(reader, materials);

    // Without a u axis: +X, or +Z for a plane that faces along X to within 26 degrees (cosine 0.9).
    constexpr double kAlongX = 0.9;
    const bool alongX = plane.normal.x > kAlongX || plane.normal.x < -kAlongX;
    const glm::dvec3 axis = reader.has("u_axis") ? unitOf(reader.direction("u_axis"))
                            : alongX             ? glm::dvec3(0, 0, 1)
                                                 : glm::dvec3(1, 0, 0);
    const glm::dvec3 v = crossOf(plane.normal, axis);
    if (lengthOf(v) < kMinAxisSine) reader.failKey("u_axis", "must not be parallel to 'normal'");
    plane.v = unitOf(v);
    plane.u = crossOf(plane.v, plane.normal);
    return plane;
}

}  // namespace etalon
