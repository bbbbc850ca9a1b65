#include <doctest/doctest.h>

#include <cmath>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "numeric/check.h"
#include "numeric/transform.h"
#include "scene/scene.h"
#include "tests/support/scratch_folder.h"

namespace etalon {
namespace {

using test::ScratchFolder;

// A scene that uses most keys. The numbers of its lines, from 1, are those of the tables below.
const std::vector<std::string> kGoodScene{
    /*  1 */ "ambient = [0.1, 0.2, 0.3]",
    /*  2 */ "[render]",
    /*  3 */ "samples = 4",
    /*  4 */ "profile = 'f64'",
    /*  5 */ "seed = 7",
    /*  6 */ "[output]",
    /*  7 */ "images = ['beauty', 'depth']",
    /*  8 */ "tone_map = 'reinhard'",
    /*  9 */ "exposure = 1.5",
    /* 10 */ "[camera]",
    /* 11 */ "width = 64",
    /* 12 */ "height = 48",
    /* 13 */ "fov_y_deg = 90",
    /* 14 */ "near = 0.1",
    /* 15 */ "far = 50",
    /* 16 */ "position = [0, 1, 4]",
    /* 17 */ "look_at = [0, 1, 0]",
    /* 18 */ "up = [0, 1, 0]",
    /* 19 */ "[environment]",
    /* 20 */ "constant = [1, 2, 3]",
    /* 21 */ "[material.red]",
    /* 22 */ "kind = 'blinn_phong'",
    /* 23 */ "diffuse = [0.8, 0.1, 0.1]",
    /* 24 */ "specular = [0.2, 0.2, 0.2]",
    /* 25 */ "exponent = 50",
    /* 26 */ "[material.chrome]",
    /* 27 */ "kind = 'mirror'",
    /* 28 */ "reflectance = [0.9, 0.8, 0.7]",
    /* 29 */ "[[mesh]]",
    /* 30 */ "name = 'ball'",
    /* 31 */ "file = 'ball.obj'",
    /* 32 */ "material = 'chrome'",
    /* 33 */ "scale = 2",
    /* 34 */ "translate = [1, 2, 3]",
    /* 35 */ "reflection = 'scene'",
    /* 36 */ "cube_size = 32",
    /* 37 */ "[[plane]]",
    /* 38 */ "name = 'floor'",
    /* 39 */ "point = [0, -1, 0]",
    /* 40 */ "normal = [0, 2, 0]",
    /* 41 */ "size_m = [4, 6]",
    /* 42 */ "material = 'red'",
    /* 43 */ "u_axis = [1, 1, 0]",
    /* 44 */ "[[light]]",
    /* 45 */ "kind = 'directional'",
    /* 46 */ "direction = [0, -3, 0]",
    /* 47 */ "irradiance = [1, 2, 3]",
};

// The good scene with one line (from 1) replaced; 0 replaces none. Several lines may stand in the
// replacement.
std::string sceneText(size_t line = 0, const std::string& replacement = "") {
    std::string text;
    for (size_t i = 0; i < kGoodScene.size(); i++)
        text += (i + 1 == line ? replacement : kGoodScene[i]) + "\n";
    return text;
}

struct SceneFolder {
    SceneFolder() { std::ofstream(folder / "ball.obj") << "v 0 0 0\n"; }
    std::filesystem::path file() const { return folder / "scene.toml"; }
    Scene load(const std::string& text) const {
        std::ofstream(file(), std::ios::binary) << text;
        return loadScene(file());
    }
    ScratchFolder folder;
};

std::string errorOf(const SceneFolder& folder, const std::string& text) {
    try {
        folder.load(text);
    } catch (const InputError& error) {
        return error.what();
    }
    return "no error";
}

TEST_CASE("SceneIsReadAsWritten") {
    const SceneFolder folder;
    const Scene scene = folder.load(sceneText());
    CHECK(scene.ambient == glm::dvec3(0.1, 0.2, 0.3));
    CHECK(scene.render.samples == 4);
    CHECK(scene.render.profile.name == "f64");
    CHECK(scene.render.seed == 7);
    CHECK(scene.output.images == std::vector<std::string>{"beauty", "depth"});
    CHECK(scene.output.toneMap == ToneMap::reinhard);
    CHECK(scene.output.exposure == 1.5);
    CHECK(scene.camera.width == 64);
    CHECK(scene.camera.height == 48);
    // tan(45 degrees) = 1: f is half the height, to within the rounding of sine and cosine.
    CHECK(scene.camera.intrinsics.fy == doctest::Approx(24).epsilon(1e-15));
    CHECK(scene.camera.intrinsics.fx == scene.camera.intrinsics.fy);
    CHECK(scene.camera.intrinsics.cx == 32);
    CHECK(scene.camera.intrinsics.cy == 24);
    CHECK(scene.camera.cameraToWorld == translation({0, 1, 4}));
    CHECK(scene.environment.kind == EnvironmentKind::constant);
    CHECK(scene.environment.constant == glm::dvec3(1, 2, 3));
    REQUIRE(scene.materials.size() == 2);
    CHECK(scene.materials[0].name == "chrome");
    CHECK(scene.materials[0].kind == MaterialKind::mirror);
    CHECK(scene.materials[0].reflectance == glm::dvec3(0.9, 0.8, 0.7));
    CHECK(scene.materials[1].kind == MaterialKind::blinnPhong);
    CHECK(scene.materials[1].exponent == 50);
    REQUIRE(scene.meshes.size() == 1);
    const MeshObject& mesh = scene.meshes[0];
    CHECK(mesh.name == "ball");
    CHECK(mesh.file == folder.folder / "ball.obj");
    CHECK(mesh.line == 29);
    CHECK(mesh.fileLine == 31);
    CHECK(mesh.material == 0);
    CHECK(mesh.reflection == Reflection::scene);
    CHECK(mesh.cubeSize == 32);
    REQUIRE(mesh.objectToWorld.size() == 1);
    CHECK(transformPoint(mesh.objectToWorld[0], {1, 0, 0}) == glm::dvec3(3, 2, 3));
    REQUIRE(scene.planes.size() == 1);
    CHECK(scene.planes[0].normal == glm::dvec3(0, 1, 0));
    CHECK(scene.planes[0].u == glm::dvec3(1, 0, 0));
    CHECK(scene.planes[0].v == glm::dvec3(0, 0, -1));
    CHECK(scene.planes[0].size_m == glm::dvec2(4, 6));
    CHECK(scene.planes[0].material == 1);
    REQUIRE(scene.lights.size() == 1);
    CHECK(scene.lights[0].toLight == glm::dvec3(0, 1, 0));
    CHECK(where(scene, mesh.fileLine) == folder.file().string() + ":31");
}

TEST_CASE("DefaultsFillWhatIsLeftOut") {
    const SceneFolder folder;
    const Scene scene = folder.load(
        "[camera]\nwidth = 8\nheight = 8\nfx = 10\nfy = 11\ncx = 4.5\ncy = 3.5\nnear = 0.1\nfar = 9\n"
        "camera_to_world = [[0, 0, 1, 5], [0, 1, 0, 6], [-1, 0, 0, 7], [0, 0, 0, 1]]\n"
        "[material.m]\nkind = 'lambert'\ndiffuse = [0, 0, 0]\n[[mesh]]\nfile = 'ball.obj'\nmaterial = 'm'\n");
    CHECK(scene.camera.intrinsics.fx == 10);
    CHECK(scene.camera.intrinsics.fy == 11);
    CHECK(scene.camera.intrinsics.cx == 4.5);
    CHECK(scene.camera.intrinsics.cy == 3.5);
    // Rows of the file are rows of the matrix; an exact rotation keeps its bits.
    CHECK(transformPoint(scene.camera.cameraToWorld, {0, 0, -1}) == glm::dvec3(4, 6, 7));
    CHECK(scene.environment.kind == EnvironmentKind::none);
    CHECK(scene.output.images == std::vector<std::string>{"beauty"});
    CHECK(scene.output.toneMap == ToneMap::linear);
    CHECK(scene.render.samples == 1);
    CHECK(scene.render.profile.name == "f32");
    CHECK(scene.meshes[0].name == "mesh0");
    CHECK(scene.meshes[0].objectToWorld == std::vector<glm::dmat4>{glm::dmat4(1.0)});
}

TEST_CASE("PlacedLightsAreReadAsWritten") {
    const SceneFolder folder;
    const Scene scene = folder.load(
        sceneText() +
        "[[light]]\nkind = 'point'\nposition = [1, 2, 3]\nintensity = [4, 5, 6]\n"
        "[[light]]\nkind = 'spot'\nposition = [1, 2, 3]\nintensity = [4, 5, 6]\ndirection = [0, 0, -2]\n"
        "outer_deg = 60\ninner_deg = 30\n");
    REQUIRE(scene.lights.size() == 3);
    CHECK(scene.lights[1].kind == LightKind::point);
    CHECK(scene.lights[1].position_m == glm::dvec3(1, 2, 3));
    CHECK(scene.lights[1].intensity == glm::dvec3(4, 5, 6));
    CHECK(scene.lights[2].kind == LightKind::spot);
    CHECK(scene.lights[2].axis == glm::dvec3(0, 0, -1));
    CHECK(scene.lights[2].cosOuter == doctest::Approx(0.5).epsilon(1e-15));
    CHECK(scene.lights[2].cosInner == doctest::Approx(std::sqrt(0.75)).epsilon(1e-15));
    const auto refused = [&](const std::string& cones) {
        return errorOf(folder, sceneText() +
                                   "[[light]]\nkind = 'spot'\nposition = [1, 2, 3]\nintensity = [4, 5, 6]\n"
                                   "direction = [0, 0, -2]\n" +
                                   cones);
    };
    CHECK(refused("outer_deg = 90\n").find("'outer_deg'") != std::string::npos);
    CHECK(refused("inner_deg = 20\nouter_deg = 20\n").find("must be at least 0.01 below 'outer_deg'") !=
          std::string::npos);
}

TEST_CASE("ShadowsAreReadAsWritten") {
    const SceneFolder folder;
    const auto lightWith = [&](const std::string& kind, const std::string& keys) {
        const std::string light = kind == "directional" ? "direction = [0, -1, 0]\nirradiance = [1, 1, 1]\n"
                                                        : "position = [1, 2, 3]\nintensity = [4, 5, 6]\n";
        return sceneText() + "[[light]]\nkind = '" + kind + "'\n" + light + keys;
    };
    const auto methodWith = [&](const std::string& keys) {
        return folder.load(lightWith("point", keys)).lights[1].shadow.method;
    };
    CHECK(methodWith("") == ShadowMethod::none);
    CHECK(methodWith("shadow = 'none'\n") == ShadowMethod::none);
    CHECK(methodWith("shadow = 'map'\n") == ShadowMethod::map);
    CHECK(methodWith("shadow = 'volume'\n") == ShadowMethod::volume);
    CHECK(methodWith("shadow = 'planar'\n") == ShadowMethod::planar);
    const auto read = [&](const std::string& kind, const std::string& keys) {
        return folder.load(lightWith(kind, "shadow = 'map'\n" + keys)).lights[1].shadow.map;
    };
    const ShadowMapSettings plain = read("point", "");
    CHECK(plain.size == 1024);
    CHECK(plain.depth == ShadowDepth::d24);
    CHECK(plain.filter == ShadowFilter::pcf);
    CHECK(plain.taps == 4);
    CHECK(plain.receiverPlane);
    const ShadowMapSettings soft = read(
        "point",
        "shadow_size = 64\nshadow_depth = 'linear'\nshadow_faces = 'back'\nshadow_bias = 3\n"
        "shadow_slope_bias = 1.5\nshadow_receiver_plane = false\nshadow_filter = 'soft'\nshadow_taps = 48\n"
        "shadow_radius_texels = 8\nshadow_light_size_m = 0.25\nshadow_normal_offset = 1.5\n"
        "shadow_reference = 'quantised'\nshadow_snap = false\n");
    CHECK(soft.normalOffset_texels == 1.5);
    CHECK(soft.reference == ShadowReference::quantised);
    CHECK_FALSE(soft.snap);
    CHECK(plain.normalOffset_texels == 0);
    CHECK(plain.reference == ShadowReference::clamped);
    CHECK(plain.snap);
    CHECK(soft.size == 64);
    CHECK(soft.depth == ShadowDepth::linear);
    CHECK(soft.faces == ShadowFaces::back);
    CHECK(soft.bias.constant == 3);
    CHECK(soft.bias.slopeScale == 1.5);
    CHECK_FALSE(soft.receiverPlane);
    CHECK(soft.filter == ShadowFilter::soft);
    CHECK(soft.taps == 48);
    CHECK(soft.radius_texels == 8);
    CHECK(soft.lightSize_m == 0.25);
    const ShadowMapSettings sun = read("directional", "shadow_filter = 'soft'\nshadow_light_deg = 90\n");
    CHECK(sun.tangentOfHalfAngle == doctest::Approx(1));
    const auto readPlanar = [&](const std::string& kind, const std::string& keys) {
        return folder.load(lightWith(kind, "shadow = 'planar'\n" + keys)).lights[1].shadow.planar;
    };
    const PlanarLightSettings planar = readPlanar(
        "point", "shadow_size = 256\nshadow_samples = 49\nshadow_blur_m = 0.25\nshadow_light_size_m = 0.5\n");
    CHECK(planar.resolution == 256);
    CHECK(planar.samples == 49);
    CHECK(planar.blurSigma_m == 0.25);
    CHECK(planar.lightSize_m == 0.5);
    CHECK(readPlanar("directional", "").samples == 25);
    CHECK(readPlanar("directional", "shadow_light_deg = 90\n").tangentOfHalfAngle == doctest::Approx(1));

    const auto refused = [&](const std::string& kind, const std::string& keys) {
        return errorOf(folder, lightWith(kind, keys));
    };
    const auto says = [](const std::string& error, const char* text) {
        CHECK_MESSAGE(error.find(text) != std::string::npos, error);
    };
    says(refused("point", "shadow = 'maps'\n"), "did you mean 'map'");
    says(refused("point", "shadow_size = 64\n"), "needs shadow = \"map\"");
    says(refused("point", "shadow = 'volume'\nshadow_size = 64\n"), "needs shadow = \"map\"");
    says(refused("point", "shadow = 'map'\nshadow_size = 0\n"), "[1, 8192]");
    says(refused("point", "shadow = 'map'\nshadow_receiver_plane = 1\n"), "must be true or false");
    says(refused("point", "shadow = 'map'\nshadow_taps = 17\n"), "[1, 16]");
    says(refused("point", "shadow = 'map'\nshadow_filter = 'hard'\nshadow_taps = 4\n"), "not used by");
    says(refused("point", "shadow = 'map'\nshadow_radius_texels = 4\n"), "needs shadow_filter");
    says(refused("point", "shadow = 'map'\nshadow_filter = 'soft'\n"), "missing key 'shadow_light_size_m'");
    says(refused("point", "shadow = 'map'\nshadow_filter = 'soft'\nshadow_light_deg = 1\n"),
         "used by directional lights alone");
    says(refused("directional", "shadow = 'map'\nshadow_filter = 'soft'\nshadow_light_size_m = 1\n"),
         "not used by directional lights");
    says(refused("point", "shadow = 'map'\nshadow_light_size_m = 1\n"), "needs shadow_filter = \"soft\"");
    says(refused("point", "shadow = 'map'\nshadow_normal_offset = -1\n"), "[0, 64]");
    says(refused("point", "shadow = 'planar'\nshadow_snap = true\n"), "needs shadow = \"map\"");
    says(refused("point", "shadow = 'map'\nshadow_blur_m = 1\n"), "needs shadow = \"planar\"");
    says(refused("point", "shadow_samples = 4\n"), "needs shadow = \"planar\"");
    says(refused("point", "shadow = 'planar'\nshadow_samples = 0\n"), "[1, 4096]");
    says(refused("point", "shadow = 'planar'\nshadow_size = 15\n"), "[16, 8192]");
    says(refused("point", "shadow = 'planar'\nshadow_bias = 1\n"), "needs shadow = \"map\"");
    says(refused("point", "shadow = 'planar'\nshadow_light_deg = 1\n"), "used by directional lights alone");
}

TEST_CASE("ShadowsOfTheEnvironmentAreReadAsWritten") {
    const SceneFolder folder;
    const auto with = [&](const std::string& keys) { return sceneText(20, "constant = [1, 1, 1]\n" + keys); };
    const auto read = [&](const std::string& keys) {
        return folder.load(with("lighting = 'lights'\n" + keys)).environment;
    };
    CHECK(read("").shadow.method == ShadowMethod::none);
    const Environment plain = read("shadow = 'map'\nshadow_size = 128\n");
    CHECK(plain.shadow.method == ShadowMethod::map);
    CHECK(plain.shadow.map.size == 128);
    CHECK(plain.shadowLights == 256);
    CHECK(plain.shadowShare == 0);
    CHECK(read("shadow = 'volume'\nshadow_lights = 9\n").shadowLights == 9);
    const Environment planar = read("shadow = 'planar'\nshadow_light_deg = 2\nshadow_share = 0.125\n");
    CHECK(planar.shadow.planar.tangentOfHalfAngle > 0.0174);
    CHECK(planar.shadowShare == 0.125);

    const auto says = [&](const std::string& keys, const char* text) {
        const std::string error = errorOf(folder, with(keys));
        CHECK_MESSAGE(error.find(text) != std::string::npos, error);
    };
    const std::string lights = "lighting = 'lights'\n";
    says("shadow = 'map'\n", "needs lighting = \"lights\" or \"dominant\"");
    says("lighting = 'exact'\nshadow = 'map'\n", "needs lighting = \"lights\" or \"dominant\"");
    says(lights + "shadow_lights = 2\n", "needs 'shadow' beside it");
    says(lights + "shadow_size = 64\n", "needs shadow = \"map\" or \"planar\"");
    says(lights + "shadow = 'map'\nshadow_lights = 0\n", "[1, 256]");
    says(lights + "shadow = 'map'\nshadow_lights = 2\nshadow_share = 0.5\n", "cannot stand beside");
    says(lights + "shadow = 'map'\nshadow_share = 0\n", "'shadow_share'");
    says(lights + "shadow = 'map'\nshadow_light_size_m = 1\n", "not used by directional lights");
}

TEST_CASE("OcclusionIsReadAsWritten") {
    const SceneFolder folder;
    const auto with = [&](const std::string& keys) { return sceneText(5, keys); };
    CHECK(folder.load(with("occlusion = 0")).render.occlusionDirections == 0);
    const Render plain = folder.load(with("occlusion = 100")).render;
    CHECK(plain.occlusionDirections == 100);
    CHECK(plain.occlusionMapSize == 512);
    CHECK(folder.load(with("occlusion = 1\nocclusion_size = 64")).render.occlusionMapSize == 64);
    for (const auto& [keys, text] :
         {std::pair("occlusion = 4097", "[0, 4096]"), std::pair("occlusion_size = 64", "needs 'occlusion'"),
          std::pair("occlusion = 0\nocclusion_size = 64", "needs 'occlusion'"),
          std::pair("occlusion = 1\nocclusion_size = 0", "[1, 8192]")}) {
        const std::string error = errorOf(folder, with(keys));
        CHECK_MESSAGE(error.find(text) != std::string::npos, error);
    }
}

TEST_CASE("InstancesAreAppliedAfterTheMeshsOwnTransform") {
    const SceneFolder folder;
    const Scene scene = folder.load(
        sceneText(34,
                  "rotate_axis = [0, 0, 2]\nrotate_deg = 90\ninstances = [{ translate = [5, 0, 0] },\n"
                  "  { rotate_xyz_deg = [0, 90, 0], scale = [1, 2, -1] }]"));
    const std::vector<glm::dmat4>& places = scene.meshes[0].objectToWorld;
    REQUIRE(places.size() == 2);
    // Scale 2, then a quarter turn about Z: +X goes to 2 Y.
    CHECK(transformPoint(places[0], {1, 0, 0}) == glm::dvec3(5, 2, 0));
    CHECK(transformPoint(places[1], {1, 0, 0}) == glm::dvec3(0, 4, 0));
    // +Z: 2 Z, unturned by Z, mirrored by -1, then turned by Y to -X.
    CHECK(transformPoint(places[1], {0, 0, 1}) == glm::dvec3(-2, 0, 0));
    CHECK(determinant3(places[1]) < 0);
}

// A line of the good scene that is replaced, the line that the message must name, and words it must have.
struct BadInput {
    size_t line;
    std::string replacement;
    size_t reported;
    std::vector<std::string> words;
};

void checkAll(const std::vector<BadInput>& table) {
    const SceneFolder folder;
    for (const BadInput& bad : table) {
        const std::string message = errorOf(folder, sceneText(bad.line, bad.replacement));
        const std::string prefix = folder.file().string() + ":" + std::to_string(bad.reported) + ": ";
        CAPTURE(bad.line);
        CAPTURE(bad.replacement);
        CAPTURE(message);
        CHECK(message.starts_with(prefix));
        CHECK(message.find('\n') == std::string::npos);
        for (const std::string& word : bad.words)
            CHECK_MESSAGE(message.find(word) != std::string::npos, word);
    }
}

TEST_CASE("SyntaxAndStructureErrorsNameTheLine") {
    checkAll({
        {12, "height = = 4", 12, {"not valid TOML"}},
        {12, "height = 4\nheight = 5", 13, {"not valid TOML", "height"}},
        {9, "exposure = \"abc", 9, {"not valid TOML"}},
        {9, "exposure = [0,} 1]", 9, {"not valid TOML"}},
        {9, "exposure = [0,\n } 1]", 10, {"not valid TOML"}},
        {9, "exposure = }", 9, {"not valid TOML"}},
        {1,
         "ambience = [0.1, 0.2, 0.3]",
         1,
         {"unknown key 'ambience'", "the scene", "did you mean 'ambient'"}},
        {11, "widht = 64", 11, {"unknown key 'widht'", "[camera]", "did you mean 'width'"}},
        {3, "sampels = 4\nzzzzzzzzzz = 1", 3, {"unknown key 'sampels'", "did you mean 'samples'"}},
        {30, "nmae = 'x'", 30, {"unknown key 'nmae'", "[[mesh]]", "did you mean 'name'"}},
        {20, "'bad\\nkey' = 1\nconstant = [1, 1, 1]", 20, {"unknown key"}},
        {29, "[mesh]", 29, {"'mesh'", "[[mesh]]"}},
        {44, "[light]", 44, {"'light'", "[[light]]"}},
        {21, "[material]\nred = 3\n[material.rot]", 22, {"[material.red] must be a table", "an integer"}},
    });
}

TEST_CASE("CharactersOutsideAsciiStandInCommentsAndStringsOnly") {
    checkAll({
        {38, "n\u00e4me = 'x'", 38, {"not valid TOML"}},
        {38, "name = 'x' \u00e4", 38, {"not valid TOML"}},
        {38, "name = \"\\\u00e4\"", 38, {"not valid TOML"}},
        {38, "name = ++'\u01d1'", 38, {"not valid TOML"}},
        {38, "name =\u00a0'x'", 38, {"not valid TOML"}},
    });
    const SceneFolder folder;
    for (const char* line :
         {"name = 'Stra\u00dfe'  # gr\u00fcn", "name = \"\\\"\u00e4\"", "name = '''Don't'''  # \u00e4",
          "name = \"\"\"it's \u00e4 \\\n  \u01d1 \u3001\"\"\""})
        CHECK(errorOf(folder, sceneText(38, line)) == "no error");
    CHECK(errorOf(folder, "\xef\xbb\xbf" + sceneText()) == "no error");
}

TEST_CASE("WrongTypesAndRangesNameTheKeyAndWhatItMayBe") {
    checkAll({
        {1, "ambient = [0.1, 0.2]", 1, {"'ambient'", "3 numbers", "2 of them"}},
        {1, "ambient = [0.1, -0.2, 0]", 1, {"'ambient'", "[0, ", "-0.2"}},
        {1, "ambient = [0.1,\n nan, 0]", 2, {"'ambient'", "nan"}},
        {1, "ambient = 'blue'", 1, {"'ambient'", "a string"}},
        {3, "samples = 5", 3, {"'samples'", "1, 4 or 16", "5"}},
        {3, "samples = 4.0", 3, {"'samples'", "an integer", "a number"}},
        {3, "samples = true", 3, {"'samples'", "a boolean"}},
        {4, "profile = 'fp32'", 4, {"'profile'", "fp16", "did you mean"}},
        {4, "profile = 1979-05-27", 4, {"'profile'", "a date"}},
        {5, "seed = -1", 5, {"'seed'", "[0, 9223372036854775807]"}},
        {7, "images = []", 7, {"'images'", "at least one"}},
        {7, "images = ['beauty',\n 'beuaty']", 8, {"'beuaty'", "did you mean 'beauty'", "coverage"}},
        {7, "images = ['ids', 'depth', 'ids']", 7, {"'ids' twice"}},
        {7, "images = [1]", 7, {"'images'", "strings"}},
        {8, "tone_map = 'aces'", 8, {"'tone_map'", "linear, reinhard, filmic"}},
        {9, "exposure = inf", 9, {"'exposure'", "[-32, 32]", "inf"}},
        {11, "width = 0", 11, {"'width'", "[1, 65536]", "0"}},
        {11, "width = 65537", 11, {"'width'", "[1, 65536]"}},
        {12, "height = -3", 12, {"'height'"}},
        {13, "fov_y_deg = 180", 13, {"'fov_y_deg'", "(0, 180)"}},
        {13, "fov_y_deg = 0", 13, {"'fov_y_deg'", "(0, 180)"}},
        {13, "fov_y_deg = 1e-300", 13, {"'fov_y_deg'", "focal length"}},
        {13, "fov_y_deg = nan", 13, {"'fov_y_deg'", "nan"}},
        {13, "fov_y_deg = 60\nfx = 3", 14, {"'fx'", "'fov_y_deg'"}},
        {13, "fx = 0\nfy = 1\ncx = 1\ncy = 1", 13, {"'fx'"}},
        {14, "near = 0", 14, {"'near'"}},
        {14, "near = 50", 15, {"'far'", "greater than 'near'"}},
        {15, "far = inf", 15, {"'far'", "inf"}},
        {15, "far = 1e400", 15, {}},
        {20, "constant = [1, 1, inf]", 20, {"'constant'", "inf"}},
        {23, "diffuse = [0.8, 0.1, 1.5]", 23, {"'diffuse'", "[0, 1]", "1.5"}},
        {25, "exponent = 0.5", 25, {"'exponent'", "[1, 4096]"}},
        {25, "exponent = 5000", 25, {"'exponent'", "[1, 4096]"}},
        {22, "kind = 'phong'", 22, {"'kind'", "did you mean 'blinn_phong'"}},
        {22, "kind = 'lambert'", 24, {"'specular'", "not used by kind 'lambert'"}},
        {27, "kind = 'lambert'", 28, {"'reflectance'", "not used by kind 'lambert'"}},
        {36, "cube_size = 10000", 36, {"'cube_size'", "[1, 8192]"}},
        {41, "size_m = [4, 0]", 41, {"'size_m'", "(0, "}},
        {41, "size_m = 4", 41, {"'size_m'", "2 numbers"}},
        {47, "irradiance = [1, 1, -1]", 47, {"'irradiance'", "-1"}},
        {45, "kind = 'area'", 45, {"'kind'", "directional"}},
        {45, "kind = 'point'", 47, {"'irradiance'", "not used by kind 'point'"}},
        {45,
         "kind = 'directional'\nposition = [0, 0, 0]",
         46,
         {"'position'", "not used by kind 'directional'"}},
        {45,
         "kind = 'spot'\nposition = [0, 1, 0]\nintensity = [1, 1, 1]",
         49,
         {"'irradiance'", "not used by kind 'spot'"}},
        {31, "file = ''", 31, {"'file'", "empty"}},
    });
}

TEST_CASE("MissingKeysAndFilesAreNamed") {
    checkAll({
        {11, "", 10, {"missing key 'width'", "[camera]"}},
        {13, "", 10, {"'fov_y_deg'", "'fx'"}},
        {13, "fx = 3", 10, {"missing key 'fy'"}},
        {15, "", 10, {"missing key 'far'"}},
        {17, "", 10, {"missing key 'look_at'"}},
        {20, "", 19, {"'file' or 'constant'"}},
        {20, "file = 'no.exr'", 20, {"'file'", "does not exist", "no.exr"}},
        {20, "file = '.'", 20, {"'file'", "regular file"}},
        {20, "file = 'ball.obj'\nconstant = [1, 1, 1]", 21, {"'constant'", "'file'"}},
        {20, "file = 'ball.obj'\nintensity = 0", 21, {"'intensity'", "(0, "}},
        {20, "constant = [1, 1, 1]\nrotation_deg = 3", 21, {"'rotation_deg'", "'file'"}},
        {20, "constant = [1, 1, 1]\nlights = 4", 21, {"'lights'", "lighting = \"lights\""}},
        {20,
         "constant = [1, 1, 1]\nlighting = 'lights'\nlights = 5",
         22,
         {"'lights'", "power of two, not 5"}},
        {20, "constant = [1, 1, 1]\nlighting = 'harmonic'", 21, {"'lighting'", "did you mean 'harmonics'"}},
        {20, "constant = [1, 1, 1]\nlighting = 'exact'\nmap_size = 5", 22, {"'map_size'", "\"blurred\""}},
        {23, "", 21, {"missing key 'diffuse'", "[material.red]"}},
        {28, "", 26, {"missing key 'reflectance'"}},
        {31, "", 29, {"missing key 'file'", "[[mesh]]"}},
        {31, "file = 'bal.obj'", 31, {"'file'", "does not exist", "bal.obj"}},
        {32, "material = 'crome'", 32, {"'crome'", "did you mean 'chrome'"}},
        {42, "", 37, {"missing key 'material'"}},
        {46, "", 44, {"missing key 'direction'"}},
    });
    const SceneFolder folder;
    CHECK(errorOf(folder, "").ends_with("scene.toml:1: missing key 'camera' in the scene"));
    CHECK_THROWS_WITH_AS(loadScene(folder.folder / "no.toml"),
                         ((folder.folder / "no.toml").string() + ": no such scene file").c_str(), InputError);
    CHECK_THROWS_AS(loadScene(folder.folder.path()), InputError);
}

TEST_CASE("DegenerateValuesAreErrors") {
    checkAll({
        {17, "look_at = [0, 1, 4]", 17, {"'look_at'", "'position'"}},
        {18, "up = [0, 0, 1]", 18, {"'up'", "parallel"}},
        {18, "up = [0, 0, 0]", 18, {"'up'", "zero"}},
        {17, "look_at = [0, -9, 4]\n", 19, {"'up'", "parallel"}},
        {16,
         "camera_to_world = [[1,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,0,1]]",
         17,
         {"'look_at'", "camera_to_world"}},
        {40, "normal = [0, 0, 0]", 40, {"'normal'", "zero"}},
        {43, "u_axis = [0, -1, 0]", 43, {"'u_axis'", "parallel"}},
        {46, "direction = [0, 0, 0]", 46, {"'direction'", "zero"}},
        {46, "direction = [0, nan, 0]", 46, {"'direction'", "nan"}},
        {33, "scale = 0", 33, {"'scale'", "singular"}},
        {33, "scale = [1, 0, 1]", 33, {"'scale'", "singular"}},
        {33, "transform = [[1,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,0,1]]", 34, {"'translate'", "'transform'"}},
        {34, "rotate_deg = 30", 29, {"missing key 'rotate_axis'"}},
        {34, "rotate_axis = [0, 0, 0]\nrotate_deg = 30", 34, {"'rotate_axis'", "zero"}},
        {34, "rotate_deg = 30\nrotate_xyz_deg = [1, 2, 3]", 34, {"'rotate_deg'", "rotate_xyz_deg"}},
        {34, "instances = []", 34, {"'instances'", "at least one"}},
        {34,
         "instances = [{ translate = [0, 0, 0] },\n { sclae = 3 }]",
         35,
         {"'sclae'", "did you mean 'scale'"}},
        {38, "name = 'ball'", 37, {"'ball' is taken", "line 29"}},
        {32, "material = 'red'", 35, {"'reflection'", "mirror"}},
        {35, "reflection = 'environment'", 36, {"'cube_size'", "scene"}},
        {25, "exponent = 50\nchecker = [0, 0, 0]", 21, {"missing key 'checker_size_m'"}},
        {25, "exponent = 50\nchecker_size_m = 1", 26, {"'checker_size_m'", "'checker'"}},
    });
}

TEST_CASE("MatricesMustBeAffineAndNotSingular") {
    const SceneFolder folder;
    const auto withTransform = [](const std::string& rows) {
        std::string text = sceneText(34, "transform = " + rows);
        text.erase(text.find("scale = 2\n"), 9);
        return text;
    };
    CHECK(errorOf(folder, withTransform("[[1,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,0,1]]")) == "no error");
    const std::vector<std::pair<std::string, std::string>> table{
        {"[[1,2,3,0],[2,4,6,0],[0,0,1,0],[0,0,0,1]]", "singular"},
        {"[[1,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,1,1]]", "last row"},
        {"[[1,0,0,0],[0,1,0,0],[0,0,1,0]]", "4 rows of 4"},
        {"[[1,0,0,0],[0,1,0,0],[0,0,1],[0,0,0,1]]", "4 rows of 4"},
        {"[[1,0,0,0],[0,nan,0,0],[0,0,1,0],[0,0,0,1]]", "nan"}};
    for (const auto& bad : table) {
        const std::string &rows = bad.first, &words = bad.second;
        const std::string message = errorOf(folder, withTransform(rows));
        CAPTURE(rows);
        CAPTURE(message);
        CHECK(message.find(":34: ") != std::string::npos);
        CHECK(message.find(words) != std::string::npos);
    }
}

TEST_CASE("CameraMatricesMustBeRigid") {
    const SceneFolder folder;
    const auto withPose = [](const std::string& rows) {
        std::string text = sceneText(16, "camera_to_world = " + rows);
        text.erase(text.find("look_at"), text.find("[environment]") - text.find("look_at"));
        return text;
    };
    CHECK(errorOf(folder, withPose("[[1,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,0,1]]")) == "no error");
    CHECK(errorOf(folder, withPose("[[2,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,0,1]]")).find("length 1") !=
          std::string::npos);
    CHECK(errorOf(folder, withPose("[[-1,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,0,1]]")).find("mirrors") !=
          std::string::npos);
}

TEST_CASE("CheckersStayOnPlanes") {
    const SceneFolder folder;
    std::string text = sceneText(25, "exponent = 50\nchecker = [0, 0, 0]\nchecker_size_m = 0.5");
    const Scene scene = folder.load(text);
    REQUIRE(scene.materials[1].checker.has_value());
    CHECK(scene.materials[1].checker->size_m == 0.5);
    for (const char* line : {"reflection = 'scene'\n", "cube_size = 32\n"})
        text.erase(text.find(line), std::string(line).size());
    text.replace(text.find("'chrome'"), 8, "'red'");
    CHECK(errorOf(folder, text).find("only planes") != std::string::npos);
}

TEST_CASE("NamesWithLineBreaksLeaveMessagesOneLine") {
    const SceneFolder folder;
    std::string taken = sceneText(30, R"(name = "a\nb")");
    taken.replace(taken.find("'floor'"), 7, R"("a\nb")");
    CHECK(errorOf(folder, taken) ==
          folder.file().string() + ":37: 'name': 'a?b' is taken by the object at line 29");

    std::string checked = sceneText(26, "[material.\"a\\nb\"]");
    const std::string mirror = kGoodScene[26] + "\n" + kGoodScene[27];
    checked.replace(checked.find(mirror), mirror.size(),
                    "kind = 'lambert'\ndiffuse = [0, 0, 0]\nchecker = [0, 0, 0]\nchecker_size_m = 1");
    checked.replace(checked.find("'chrome'"), 8, R"("a\nb")");
    const std::string message = errorOf(folder, checked);
    CHECK(message.find("'a?b' has a checker") != std::string::npos);
    CHECK(message.find('\n') == std::string::npos);
}

TEST_CASE("ShippedScenesLoad") {
    for (const char* name : {"minimal", "stress"}) {
        const Scene scene = loadScene(std::filesystem::path("scenes") / (std::string(name) + ".toml"));
        CHECK(!scene.meshes.empty());
        CHECK(!scene.lights.empty());
    }
    CHECK(loadScene("scenes/stress.toml").lights.size() == 64);

    // The demo's environment is not in the repository; an empty file of its name stands in for it here.
    const ScratchFolder folder;
    std::filesystem::create_directories(folder / "probes");
    std::ofstream(folder / "probes/courtyard.exr") << "";
    std::filesystem::copy("scenes/meshes", folder / "meshes");
    std::filesystem::copy("scenes/demo.toml", folder / "demo.toml");
    const Scene demo = loadScene(folder / "demo.toml");
    CHECK(demo.camera.width == 960);
    CHECK(demo.camera.height == 540);
    CHECK(demo.render.samples == 4);
    CHECK(demo.environment.kind == EnvironmentKind::file);
    CHECK(demo.environment.lightCount == 64);
    CHECK(demo.environment.shadow.method == ShadowMethod::map);
    CHECK(demo.lights.empty());
}

}  // namespace
}  // namespace etalon
