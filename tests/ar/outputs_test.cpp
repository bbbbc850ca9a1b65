// What outputs hold, where the right answer is known: planes seen by a camera that looks along -Z.
#include "scene/outputs.h"

#include <doctest/doctest.h>

#include <cmath>
#include <fstream>

#include "ar/render_scene.h"
#include "files/image_io.h"
#include "files/probe_file.h"
#include "numeric/transform.h"
#include "numeric/vectors.h"
#include "tests/support/scratch_folder.h"

using namespace etalon;

namespace {

constexpr int kWidth = 16, kHeight = 12;
constexpr glm::dvec3 kAlbedo(0.5, 0.25, 1);

Plane planeAt(const glm::dvec3& point, double size_m, const char* name) {
    Plane plane;
    plane.name = name;
    plane.point = point;
    plane.normal = {0, 0, 1};
    plane.u = {1, 0, 0};
    plane.v = {0, 1, 0};
    plane.size_m = {size_m, size_m};
    return plane;
}

// A wall that fills the view, 3 m away.
Scene wallScene(std::vector<std::string> outputs) {
    Scene scene;
    scene.camera.width = kWidth;
    scene.camera.height = kHeight;
    scene.camera.intrinsics = {12, 12, kWidth / 2.0, kHeight / 2.0};
    scene.camera.near = 0.125;
    scene.camera.far = 64;
    Material matt;
    matt.name = "matt";
    matt.diffuse = kAlbedo;
    scene.materials = {matt};
    scene.planes = {planeAt({0, 0, -3}, 40, "wall")};
    scene.output.images = std::move(outputs);
    return scene;
}
// A light from the upper left that a square keeps from the middle of the wall.
Scene blockedScene(std::vector<std::string> outputs, ShadowMethod method) {
    Scene scene = wallScene(std::move(outputs));
    scene.planes.push_back(planeAt({-1, 0, -2}, 0.8, "square"));
    SceneLight light;
    light.axis = unitOf(glm::dvec3(1, 0, -1));
    light.toLight = -light.axis;
    light.irradiance = glm::dvec3(2);
    light.shadow.method = method;
    light.shadow.map.size = 256;
    light.shadow.planar.samples = 1;
    light.shadow.planar.resolution = 256;
    scene.lights = {light};
    return scene;
}

Frame frameOf(const Scene& scene) { return renderScene(scene, {}).frame; }
std::span<const float> valuesOf(const Frame& frame, const std::string& channel) {
    REQUIRE_MESSAGE(frame.find(channel), channel);
    return std::get<Image<float>>(frame.find(channel)->values).values();
}
float at(const Frame& frame, const std::string& channel, int x, int y) {
    return valuesOf(frame, channel)[static_cast<size_t>(y * kWidth + x)];
}
bool isAll(const Frame& frame, const std::string& channel, float value) {
    return std::ranges::all_of(valuesOf(frame, channel), [&](float v) { return v == value; });
}

constexpr ShadowMethod kMethods[] = {ShadowMethod::map, ShadowMethod::volume, ShadowMethod::planar};

// 16 lights of a white environment, all of which cast shadows, instead of the scene's.
void lightByEnvironment(Scene& scene, ShadowMethod method) {
    scene.lights.clear();
    scene.environment.kind = EnvironmentKind::constant;
    scene.environment.constant = glm::dvec3(1);
    scene.environment.lighting = EnvironmentLightMethod::lights;
    scene.environment.lightCount = 16;
    scene.environment.shadow.method = method;
    scene.environment.shadowLights = 16;
}

}  // namespace

TEST_CASE("ZIsTheDistanceAlongTheView") {
    Scene scene = wallScene({"depth", "distance", "window_depth"});
    for (const char* profile : {"f32", "f64", "truth", "fp16"}) {
        scene.render.profile = *findProfile(profile);
        const Frame frame = frameOf(scene);
        CHECK(isAll(frame, "Z", 3));
        CHECK(at(frame, "distance", 0, 0) > 3.5f);
    }
    // Seen from elsewhere the wall is at another distance at each pixel.
    scene.render.profile = *findProfile("f32");
    const double turn_deg = 30;
    scene.camera.cameraToWorld = rotationAboutAxis({0, 1, 0}, turn_deg);
    const Frame turned = frameOf(scene);
    const SinCos turn = sinCosOfDegrees(turn_deg);
    for (int x = 0; x < kWidth; x++) {
        // The ray (a, b, -1) of the camera has the world z component -(a sin + cos), and reaches -3.
        const double a = (x + 0.5 - kWidth / 2.0) / 12;
        const double z = 3 / (turn.cos - a * -turn.sin);
        // The wall's corners are moved to subpixels.
        CHECK(at(turned, "Z", x, 5) == doctest::Approx(z).epsilon(1e-4));
        // The stored depth of the near plane is 0, of the far plane 1.
        const double stored = 64 / (64 - 0.125) * (1 - 0.125 / z);
        CHECK(at(turned, "depth.window", x, 5) == doctest::Approx(stored).epsilon(1e-5));
    }
    // Nothing is infinitely far, and at the far plane of the depth test.
    scene = wallScene({"depth", "window_depth"});
    scene.planes[0].size_m = {1, 1};
    const Frame small = frameOf(scene);
    CHECK(at(small, "Z", 0, 0) == INFINITY);
    CHECK(at(small, "depth.window", 0, 0) == 1);
    CHECK(at(small, "Z", 8, 6) == 3);
}

TEST_CASE("IdsCountFromOne") {
    Scene scene = wallScene({"ids"});
    scene.planes[0].size_m = {1, 1};
    const Frame frame = frameOf(scene);
    const auto idsOf = [&](const char* channel) {
        return std::get<Image<uint32_t>>(frame.find(channel)->values).values();
    };
    std::vector<size_t> triangles(3);
    for (size_t i = 0; i < idsOf("id.object").size(); i++) {
        const uint32_t object = idsOf("id.object")[i], triangle = idsOf("id.triangle")[i];
        CHECK(object <= 1);
        CHECK((triangle == 0) == (object == 0));
        REQUIRE(triangle <= 2);
        triangles[triangle]++;
    }
    for (const size_t count : triangles) CHECK(count > 0);
}

TEST_CASE("AlphaIsThePartThatIsCovered") {
    Scene scene = wallScene({"alpha", "coverage"});
    scene.planes[0].size_m = {1.1, 1.1};
    scene.render.samples = 4;
    const Frame frame = frameOf(scene);
    CHECK(at(frame, "A", 8, 6) == 1);
    CHECK(at(frame, "A", 0, 0) == 0);
    // The edge runs through x = 8 - 2.2 px, so that it leaves two of the four sample columns of pixel 5.
    CHECK(at(frame, "A", 5, 6) > 0);
    CHECK(at(frame, "A", 5, 6) < 1);
    for (size_t i = 0; i < valuesOf(frame, "A").size(); i++) {
        const float alpha = valuesOf(frame, "A")[i];
        CHECK(alpha * 4 == std::floor(alpha * 4));
        CHECK(alpha == valuesOf(frame, "coverage")[i]);
    }
}

TEST_CASE("ALightThatIsNotBlockedHasNoShadow") {
    for (const ShadowMethod method : kMethods) {
        Scene scene = blockedScene({"shadow"}, method);
        scene.planes.resize(1);
        CHECK(isAll(frameOf(scene), "shadow.light0", 1));
        // Nor where there is nothing.
        scene.planes[0].size_m = {1, 1};
        CHECK(isAll(frameOf(scene), "shadow.light0", 1));
        scene.planes.clear();
        CHECK(isAll(frameOf(scene), "shadow.light0", 1));
    }
}

TEST_CASE("ShadowsAreOutputsOfEachLightThatCasts") {
    for (const ShadowMethod method : kMethods) {
        CAPTURE(nameOf(method));
        Scene scene = blockedScene({"shadow", "diffuse"}, method);
        scene.lights.insert(scene.lights.begin(), scene.lights[0]);
        scene.lights[0].shadow.method = ShadowMethod::none;
        const Frame frame = frameOf(scene);
        CHECK_FALSE(frame.find("shadow.light0"));
        CHECK(at(frame, "shadow.light1", 8, 6) == 0);
        CHECK(at(frame, "shadow.light1", 14, 2) == 1);
        CHECK(at(frame, "diffuse.G", 8, 6) == doctest::Approx(at(frame, "diffuse.G", 14, 2) / 2));
        // Wherever the scene is lit, and however bright.
        Scene other = scene;
        other.render.perVertex = true;
        CHECK(
            std::ranges::equal(valuesOf(frameOf(other), "shadow.light1"), valuesOf(frame, "shadow.light1")));
        other = scene;
        other.lights[1].irradiance = glm::dvec3(0);
        CHECK(
            std::ranges::equal(valuesOf(frameOf(other), "shadow.light1"), valuesOf(frame, "shadow.light1")));
        // Mirrors reflect no lights.
        other = scene;
        other.materials.push_back(scene.materials[0]);
        other.materials[1].kind = MaterialKind::mirror;
        other.materials[1].diffuse = glm::dvec3(0);
        other.materials[1].reflectance = glm::dvec3(1);
        other.planes[0].material = 1;
        CHECK(at(frameOf(other), "shadow.light1", 8, 6) == 1);
    }
}

TEST_CASE("ShadowsOfSeveralSamplesAreMeans") {
    Scene scene = blockedScene({"shadow"}, ShadowMethod::volume);
    scene.render.samples = 4;
    size_t between = 0;
    const Frame frame = frameOf(scene);
    for (const float value : valuesOf(frame, "shadow.light0")) {
        CHECK(value * 4 == std::floor(value * 4));
        between += value > 0 && value < 1 ? 1 : 0;
    }
    CHECK(between > 0);
}

TEST_CASE("LightsOfAnEnvironmentHaveShadowChannels") {
    Scene scene = blockedScene({"shadow", "irradiance"}, ShadowMethod::none);
    lightByEnvironment(scene, ShadowMethod::volume);
    const Frame frame = frameOf(scene);
    size_t channels = 0;
    for (const Channel& channel : frame.channels)
        channels += channel.name.starts_with("shadow.environment") ? 1 : 0;
    CHECK(channels == 16);
    scene.environment.shadow.method = ShadowMethod::none;
    scene.output.images = {"irradiance"};
    const Frame open = frameOf(scene);
    double lost = 0;
    for (size_t i = 0; i < valuesOf(open, "irradiance.G").size(); i++) {
        CHECK(valuesOf(frame, "irradiance.G")[i] <= valuesOf(open, "irradiance.G")[i]);
        lost += double{valuesOf(open, "irradiance.G")[i]} - double{valuesOf(frame, "irradiance.G")[i]};
    }
    CHECK(lost > 0);
    scene.output.images = {"shadow", "ids"};
    REQUIRE(renderScene(scene, {}).warnings.size() == 1);
    CHECK(renderScene(scene, {}).warnings[0].find("'shadow' has no channel") != std::string::npos);
    scene.output.images = {"shadow"};
    CHECK_THROWS_AS(frameOf(scene), InputError);
}

TEST_CASE("ALonePlaneIsOpen") {
    Scene scene = wallScene({"occlusion", "normals"});
    for (const int directions : {0, 48}) {
        scene.render.occlusionDirections = directions;
        for (const bool perVertex : {false, true}) {
            scene.render.perVertex = perVertex;
            const Frame frame = frameOf(scene);
            CHECK(isAll(frame, "occlusion.open", 1));
            for (const char* axis : {"X", "Y", "Z"})
                CHECK(std::ranges::equal(valuesOf(frame, std::string("occlusion.") + axis),
                                         valuesOf(frame, std::string("N.") + axis)));
        }
    }
    // A square before it covers some of its surroundings, and bends the normal away from itself.
    scene.render.occlusionDirections = 400;
    scene.planes.push_back(planeAt({-1, 0, -2.5}, 0.8, "square"));
    for (const bool perVertex : {false, true}) {
        scene.render.perVertex = perVertex;
        const Frame frame = frameOf(scene);
        CHECK(at(frame, "occlusion.open", 7, 6) < 0.97f);
        CHECK(at(frame, "occlusion.X", 7, 6) > 0.01f);
    }
    // Where nothing is, nothing is in the way.
    scene.planes.clear();
    const Frame nothing = frameOf(scene);
    CHECK(isAll(nothing, "occlusion.open", 1));
    CHECK(isAll(nothing, "occlusion.X", 0));
}

TEST_CASE("IrradianceOfAConstantEnvironmentIsPi") {
    Scene scene = wallScene({"irradiance", "environment", "diffuse"});
    scene.environment.kind = EnvironmentKind::constant;
    scene.environment.constant = {1, 2, 0.5};
    struct Method {
        EnvironmentLightMethod method;
        double tolerance;
    };
    // The image that stands for a constant has 32 x 16 texels; 64 lights are coarse.
    for (const Method& of :
         {Method{EnvironmentLightMethod::harmonics, 5e-3}, Method{EnvironmentLightMethod::exact, 5e-3},
          Method{EnvironmentLightMethod::map, 5e-3}, Method{EnvironmentLightMethod::lights, 0.05}}) {
        CAPTURE(nameOf(of.method));
        scene.environment.lighting = of.method;
        const Frame frame = frameOf(scene);
        int c = 0;
        for (const char* colour : {"R", "G", "B"}) {
            const auto irradiance = valuesOf(frame, std::string("irradiance.") + colour);
            const auto environment = valuesOf(frame, std::string("environment.") + colour);
            const auto diffuse = valuesOf(frame, std::string("diffuse.") + colour);
            for (size_t i = 0; i < irradiance.size(); i++) {
                CHECK(irradiance[i] ==
                      doctest::Approx(kPi * scene.environment.constant[c]).epsilon(of.tolerance));
                CHECK(environment[i] ==
                      doctest::Approx(kAlbedo[c] / kPi * double{irradiance[i]}).epsilon(1e-6));
                if (of.method == EnvironmentLightMethod::lights)
                    CHECK(environment[i] == doctest::Approx(diffuse[i]).epsilon(1e-5));
                else
                    CHECK(environment[i] == diffuse[i]);
            }
            c++;
        }
    }
    // Other lights are no part of either; what reflects nothing receives it all the same.
    SceneLight light;
    light.axis = {0, 0, -1};
    light.toLight = {0, 0, 1};
    light.irradiance = glm::dvec3(5);
    const Frame before = frameOf(scene);
    scene.lights = {light};
    scene.ambient = glm::dvec3(1);
    const Frame lit = frameOf(scene);
    CHECK(std::ranges::equal(valuesOf(lit, "irradiance.R"), valuesOf(before, "irradiance.R")));
    CHECK(std::ranges::equal(valuesOf(lit, "environment.R"), valuesOf(before, "environment.R")));
    scene.materials[0].diffuse = glm::dvec3(0);
    const Frame black = frameOf(scene);
    CHECK(std::ranges::equal(valuesOf(black, "irradiance.R"), valuesOf(before, "irradiance.R")));
    CHECK(isAll(black, "environment.R", 0));
}

TEST_CASE("OccludedIrradianceIsWhatTheDiffuseLightIsMadeOf") {
    Scene scene = wallScene({"irradiance", "environment", "diffuse", "occlusion"});
    scene.planes.push_back(planeAt({-1, 0, -2.5}, 0.8, "square"));
    scene.render.occlusionDirections = 64;
    scene.environment.kind = EnvironmentKind::constant;
    scene.environment.constant = glm::dvec3(1);
    scene.environment.lighting = EnvironmentLightMethod::harmonics;
    const Frame frame = frameOf(scene);
    CHECK(std::ranges::equal(valuesOf(frame, "environment.G"), valuesOf(frame, "diffuse.G")));
    for (size_t i = 0; i < valuesOf(frame, "irradiance.R").size(); i++)
        CHECK(valuesOf(frame, "irradiance.R")[i] ==
              doctest::Approx(kPi * double{valuesOf(frame, "occlusion.open")[i]}).epsilon(5e-3));
}

// A mirror of the scene between the camera and the wall: its cube map, as a file, is a probe.
TEST_CASE("CubeMapsOfMirrorsAreProbes") {
    const test::ScratchFolder folder;
    std::ofstream(folder / "mirror.obj") << "v -0.2 -0.2 0\nv 0.2 -0.2 0\nv 0 0.2 0\nf 1 2 3\n";
    Scene scene = wallScene({"ids", "cube_map"});
    Material mirror;
    mirror.name = "mirror";
    mirror.kind = MaterialKind::mirror;
    mirror.reflectance = glm::dvec3(1);
    scene.materials.push_back(mirror);
    MeshObject mesh;
    mesh.name = "mirror";
    mesh.file = folder / "mirror.obj";
    mesh.material = 1;
    mesh.objectToWorld = {translation({0, 0, -1})};
    mesh.reflection = Reflection::scene;
    mesh.cubeSize = 8;
    scene.meshes = {mesh};
    Plane side = planeAt({1.5, 0, -1}, 1, "side");
    side.normal = {-1, 0, 0}, side.u = {0, 0, 1};
    scene.planes.push_back(side);
    scene.ambient = glm::dvec3(1);
    scene.environment.kind = EnvironmentKind::constant;
    scene.environment.constant = glm::dvec3(0.125);
    const RenderResult result = renderScene(scene, {});
    REQUIRE(result.files.size() == 1);
    CHECK(result.files[0].name == "cube_map.1");
    CHECK(result.warnings.empty());
    CHECK_FALSE(result.plan.find("mirror")->runs);
    writeExr(result.files[0].frame, folder / "cube.exr");
    const Probe probe = loadProbe(folder / "cube.exr");
    CHECK(probe.shape == ProbeShape{Mapping::cube, 8, 8});
    CHECK(probe.position_m.z == doctest::Approx(-1));
    // Behind it the wall, 2 m away, lit by the ambient light; before it the environment.
    const auto face = [](CubeFace f) { return static_cast<size_t>(f); };
    CHECK(probe.radiance[face(CubeFace::minusZ)].at(4, 4, 1) == doctest::Approx(kAlbedo.y));
    CHECK(probe.distance_m[face(CubeFace::minusZ)].at(4, 4) == doctest::Approx(2 * std::sqrt(1 + 2.0 / 64)));
    CHECK(probe.radiance[face(CubeFace::plusZ)].at(4, 4, 1) == 0.125f);
    CHECK(probe.distance_m[face(CubeFace::plusZ)].at(4, 4) == INFINITY);
    // The side is 1.5 m to the right, and nothing near to the left.
    CHECK(probe.distance_m[face(CubeFace::plusX)].at(4, 4) ==
          doctest::Approx(1.5 * std::sqrt(1 + 2.0 / 64)).epsilon(1e-3));
    CHECK(probe.distance_m[face(CubeFace::minusX)].at(4, 4) > 10);
    // What is not made is said.
    scene.meshes[0].objectToWorld = {translation({0, 0, 1})};
    const RenderResult hidden = renderScene(scene, {});
    CHECK(hidden.files.empty());
    REQUIRE(hidden.warnings.size() == 1);
    CHECK(hidden.warnings[0] == "cube map of mirror is not made: its mirror is not visible");
}

TEST_CASE("ShadowMapsAreFiles") {
    Scene scene = blockedScene({"ids", "shadow_map"}, ShadowMethod::map);
    RenderResult result = renderScene(scene, {});
    REQUIRE(result.files.size() == 1);
    CHECK(result.files[0].name == "shadow_map.light0");
    const Frame& map = result.files[0].frame;
    CHECK(map.width == 256);
    CHECK(map.height == 256);
    CHECK(map.metadata.at("etalon.projection").starts_with("parallel; "));
    // The square is drawn and nothing around it.
    size_t drawn = 0;
    for (const float depth : valuesOf(map, "depth")) {
        CHECK(depth >= 0);
        CHECK(depth <= 1);
        drawn += depth < 1 ? 1 : 0;
    }
    CHECK(drawn > valuesOf(map, "depth").size() / 4);
    CHECK_FALSE(result.plan.find("diffuse")->runs);
    // Of a point light: six faces, with their borders.
    scene.lights[0].kind = LightKind::point;
    scene.lights[0].position_m = {-1, 0, -1};
    scene.lights[0].intensity = glm::dvec3(1);
    scene.lights[0].shadow.map.depth = ShadowDepth::linear;
    result = renderScene(scene, {});
    REQUIRE(result.files.size() == 1);
    CHECK(result.files[0].frame.height == 6 * result.files[0].frame.width);
    float nearest = INFINITY;
    for (const float distance : valuesOf(result.files[0].frame, "distance"))
        nearest = std::min(nearest, distance);
    CHECK(nearest == doctest::Approx(1).epsilon(1e-3));
    // Nothing stands in the way.
    scene.planes.resize(1);
    result = renderScene(scene, {});
    CHECK(result.files.empty());
    REQUIRE(result.warnings.size() == 1);
    CHECK(result.warnings[0].find("shadow map of light0 is not made: ") == 0);
    scene.output.images = {"shadow_map"};
    CHECK_THROWS_AS(renderScene(scene, {}), InputError);
}

// The lights of an environment are found for their maps alone, too.
TEST_CASE("ShadowMapsOfAnEnvironmentAreFiles") {
    Scene scene = blockedScene({"ids", "shadow_map"}, ShadowMethod::none);
    lightByEnvironment(scene, ShadowMethod::map);
    scene.environment.shadow.map.size = 16;
    const RenderResult alone = renderScene(scene, {});
    CHECK_FALSE(alone.plan.find("diffuse")->runs);
    CHECK(alone.files.size() + alone.warnings.size() == 16);
    REQUIRE(alone.files.size() > 4);
    scene.output.images.emplace_back("beauty");
    const RenderResult result = renderScene(scene, {});
    REQUIRE(result.files.size() == alone.files.size());
    for (size_t i = 0; i < alone.files.size(); i++) {
        CHECK(result.files[i].name == alone.files[i].name);
        CHECK(std::ranges::equal(valuesOf(result.files[i].frame, "depth"),
                                 valuesOf(alone.files[i].frame, "depth")));
    }
}

TEST_CASE("OutputsRunTheirPassesAndNoOthers") {
    const auto runs = [](const Scene& scene, const char* pass) {
        const Plan plan = renderScene(scene, {}).plan;
        const Pass* found = plan.find(pass);
        return found && found->runs;
    };
    Scene scene = blockedScene({"shadow"}, ShadowMethod::map);
    scene.render.occlusionDirections = 16;
    for (const char* pass : {"shadow map of light0", "shadows in view", "shadow", "lights", "shading"})
        CHECK_MESSAGE(runs(scene, pass), pass);
    for (const char* pass : {"diffuse", "beauty", "ambient occlusion", "irradiance", "occlusion"})
        CHECK_FALSE_MESSAGE(runs(scene, pass), pass);
    scene.output.images = {"occlusion"};
    CHECK(runs(scene, "ambient occlusion"));
    CHECK_FALSE(runs(scene, "shadow map of light0"));
    scene.output.images = {"irradiance"};
    CHECK_FALSE(runs(scene, "irradiance"));
    scene.environment.kind = EnvironmentKind::constant;
    scene.environment.constant = glm::dvec3(1);
    scene.environment.lighting = EnvironmentLightMethod::harmonics;
    for (const char* pass : {"irradiance", "environment light", "ambient occlusion"})
        CHECK_MESSAGE(runs(scene, pass), pass);
    CHECK_FALSE(runs(scene, "shadow map of light0"));
    scene.output.images = {"alpha", "window_depth"};
    CHECK_FALSE(runs(scene, "shading"));
}

TEST_CASE("EveryOutputIsFoundByItsName") {
    REQUIRE(outputNames().size() == outputDescriptions().size());
    for (size_t i = 0; i < outputNames().size(); i++)
        CHECK(findOutput(outputNames()[i]) == &outputDescriptions()[i]);
    CHECK(findOutput("glow") == nullptr);
    Scene scene = wallScene({"glow"});
    CHECK_THROWS_AS(frameOf(scene), InputError);
}
