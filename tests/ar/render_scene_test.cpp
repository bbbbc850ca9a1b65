#include "ar/render_scene.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <fstream>

#include "files/image_io.h"
#include "golden/compare.h"
#include "numeric/transform.h"
#include "scene/outputs.h"
#include "scene/scene.h"
#include "tests/support/scratch_folder.h"

using namespace etalon;

namespace {

bool sameBits(const Frame& a, const Frame& b) {
    const Comparison comparison = compareFrames(a, b);
    return comparison.identical();
}

RenderOptions withRaster(int threads, int tileSize) {
    RenderOptions options;
    options.raster.threads = threads;
    options.raster.tileSize = tileSize;
    return options;
}

Frame frameOf(const Scene& scene, const RenderOptions& options = {}) {
    return renderScene(scene, options).frame;
}

// shadow: of the scene.
Frame withMethod(const Scene& scene, LightShadow& shadow, ShadowMethod method) {
    shadow.method = method;
    return frameOf(scene);
}

std::span<const float> valuesOf(const Frame& frame, size_t channel) {
    return std::get<Image<float>>(frame.channels[channel].values).values();
}
double sumOf(const Frame& frame) {
    double sum = 0;
    for (size_t c = 0; c < frame.channels.size(); c++)
        for (const float value : valuesOf(frame, c)) sum += static_cast<double>(value);
    return sum;
}

// The sum of differences of a frame to another is less than `part` of that to a third, in each channel.
void checkCloser(const Frame& frame, const Frame& other, const Frame& third, double part) {
    for (size_t c = 0; c < frame.channels.size(); c++) {
        const auto difference = [&](const Frame& to) {
            double sum = 0;
            for (size_t i = 0; i < valuesOf(frame, c).size(); i++)
                sum += std::fabs(static_cast<double>(valuesOf(frame, c)[i]) -
                                 static_cast<double>(valuesOf(to, c)[i]));
            return sum;
        };
        CHECK(difference(third) > 0);
        CHECK(difference(other) < part * difference(third));
    }
}

}  // namespace

TEST_CASE("ThreadsAndTilesChangeNoBitOfAFrame") {
    for (const char* file : {"scenes/minimal.toml", "scenes/stress.toml"}) {
        const Scene scene = loadScene(file);
        const Frame reference = frameOf(scene, withRaster(1, 64));
        for (const auto& [threads, tile] :
             {std::pair(2, 64), std::pair(7, 32), std::pair(2, 16), std::pair(1, 256)})
            CHECK(sameBits(frameOf(scene, withRaster(threads, tile)), reference));
    }
}

TEST_CASE("ThreadsAndTilesChangeNoBitOfOcclusion") {
    for (const bool perVertex : {false, true}) {
        Scene scene = loadScene("golden/scenes/environment_occlusion.toml");
        scene.render.perVertex = perVertex;
        scene.render.occlusionDirections = 24;
        scene.render.occlusionMapSize = 128;
        scene.meshes[1].cubeSize = 16;
        const Frame reference = frameOf(scene, withRaster(1, 64));
        for (const auto& [threads, tile] : {std::pair(2, 32), std::pair(7, 16)})
            CHECK(sameBits(frameOf(scene, withRaster(threads, tile)), reference));
        scene.render.occlusionDirections = 0;
        CHECK_FALSE(sameBits(frameOf(scene), reference));
    }
}

TEST_CASE("AnEffectThatNoOutputNeedsChangesNoBit") {
    Scene scene = loadScene("scenes/minimal.toml");
    scene.output.images = {"depth", "ids", "normals", "diffuse"};
    const Frame before = frameOf(scene);
    const Plan planBefore = planScene(scene, {});
    // A specular sheen, an ambient term, an environment image and tone mapping settings: none is an output.
    scene.ambient = glm::dvec3(0.3);
    scene.materials[0].kind = MaterialKind::blinnPhong;
    scene.materials[0].specular = glm::dvec3(0.5);
    scene.materials[0].exponent = 30;
    scene.environment.kind = EnvironmentKind::file;
    scene.environment.file = "scenes/synthetic_64x32.hdr";
    scene.output.toneMap = ToneMap::filmic;
    CHECK(sameBits(frameOf(scene), before));
    const Plan planAfter = planScene(scene, {});
    for (size_t i = 0; i < planBefore.passes.size(); i++)
        CHECK(planAfter.passes[i].runs == planBefore.passes[i].runs);
}

// Of one light's shadows, in the view and in the mirror ball's cube map.
TEST_CASE("ShadowVolumesAreWhereTheMapsAre") {
    for (size_t light = 0; light < 3; light++) {
        Scene scene = loadScene("golden/scenes/shadows.toml");
        scene.lights = {scene.lights[light]};
        LightShadow& shadow = scene.lights[0].shadow;
        shadow.map = defaultShadowMap();
        shadow.map.size = 512;
        scene.output.images = {"diffuse", "mirror"};
        const Frame none = withMethod(scene, shadow, ShadowMethod::none);
        checkCloser(withMethod(scene, shadow, ShadowMethod::volume),
                    withMethod(scene, shadow, ShadowMethod::map), none, 0.25);
    }
}

// Where only a plane receives shadows the methods show the same.
TEST_CASE("LightsOfAnEnvironmentCastShadows") {
    Scene scene = loadScene("golden/scenes/environment_lights.toml");
    scene.lights.clear();
    scene.meshes[0].material = scene.planes[0].material;
    scene.materials[scene.meshes[0].material].kind = MaterialKind::lambert;
    scene.output.images = {"diffuse"};
    LightShadow& shadow = scene.environment.shadow;
    shadow.map.size = 512;
    shadow.planar.samples = 1;
    scene.environment.shadowLights = 3;
    const Frame none = withMethod(scene, shadow, ShadowMethod::none);
    const Frame volumes = withMethod(scene, shadow, ShadowMethod::volume);
    checkCloser(volumes, withMethod(scene, shadow, ShadowMethod::map), none, 0.25);
    // Each light more takes more away; a light that is not there takes nothing.
    double before = sumOf(none);
    for (const int lights : {1, 3, 16}) {
        scene.environment.shadowLights = lights;
        const Frame frame = withMethod(scene, shadow, ShadowMethod::volume);
        CHECK(sumOf(frame) < before);
        before = sumOf(frame);
        scene.environment.shadowLights = 16 + lights;
        CHECK(sumOf(withMethod(scene, shadow, ShadowMethod::volume)) <= before);
    }
    // Planar shadows fall on the plane alone.
    scene.environment.shadowLights = 3;
    const Frame planar = withMethod(scene, shadow, ShadowMethod::planar);
    CHECK(sumOf(planar) < sumOf(none));
    CHECK(sumOf(planar) > sumOf(volumes));
    // All of them cast where no number is asked for, and it is said how much of the energy casts.
    const auto saidOf = [&](int lights) {
        scene.environment.shadowLights = lights;
        shadow.method = ShadowMethod::volume;
        return renderScene(scene, {}).plan.find("environment light")->reason;
    };
    CHECK(saidOf(Environment{}.shadowLights)
              .ends_with("; 16 of its 16 lights may cast shadows, with 100 % of the energy"));
    CHECK(saidOf(3).find("; 3 of its 16 lights may cast shadows, with ") != std::string::npos);
    // By their part of the energy: 16 lights of about the same.
    scene.environment.shadowShare = 0.5;
    CHECK(sameBits(withMethod(scene, shadow, ShadowMethod::volume), none));
    CHECK(renderScene(scene, {}).plan.find("shadows of environment lights")->reason ==
          "no light has so large a share of its energy");
}

TEST_CASE("AskingForMoreOutputsChangesNoBitOfTheOthers") {
    Scene scene = loadScene("scenes/minimal.toml");
    scene.output.images = {"beauty"};
    const Frame alone = frameOf(scene);
    scene.output.images = {"ids", "diffuse", "beauty", "coverage", "normals"};
    const Frame many = frameOf(scene);
    for (const Channel& channel : alone.channels) {
        REQUIRE(many.find(channel.name));
        CHECK(std::get<Image<float>>(many.find(channel.name)->values) ==
              std::get<Image<float>>(channel.values));
    }
}

// Also the empty scene: nothing but the environment. A quarter turn is exact, so the bits agree.
TEST_CASE("TurningTheEnvironmentIsTurningTheCameraBack") {
    Scene scene = loadScene("scenes/minimal.toml");
    scene.meshes.clear();
    scene.environment.kind = EnvironmentKind::file;
    scene.environment.file = "scenes/synthetic_64x32.hdr";
    scene.camera.cameraToWorld = glm::dmat4(1);
    scene.environment.rotation_deg = -90;
    const Frame turned = frameOf(scene);
    scene.environment.rotation_deg = 0;
    const Frame straight = frameOf(scene);
    CHECK_FALSE(sameBits(turned, straight));
    scene.camera.cameraToWorld = rotationAboutAxis({0, 1, 0}, 90);
    CHECK(sameBits(frameOf(scene), turned));
}

TEST_CASE("OutputsNameTheirChannelsForTheUsualViewers") {
    const Scene scene = loadScene("scenes/minimal.toml");
    RenderOptions options;
    for (const std::string_view name : outputNames()) options.request.outputs.emplace_back(name);
    const Frame frame = frameOf(scene, options);
    for (const char* name : {"R",
                             "G",
                             "B",
                             "A",
                             "Z",
                             "depth.window",
                             "distance",
                             "N.X",
                             "N.Y",
                             "N.Z",
                             "id.object",
                             "id.triangle",
                             "coverage",
                             "diffuse.R",
                             "specular.G",
                             "mirror.B",
                             "background.R",
                             "ambient.G",
                             "occlusion.open",
                             "occlusion.X",
                             "irradiance.G",
                             "environment.B"})
        CHECK_MESSAGE(frame.find(name) != nullptr, name);
    CHECK(frame.metadata.at("etalon.profile") == "f32");
    CHECK(frame.metadata.at("etalon.scene") == "minimal.toml");
    CHECK(frame.metadata.count("etalon.rules") == 1);
}

TEST_CASE("AFrameSurvivesItsExrFile") {
    const test::ScratchFolder folder;
    const Frame frame = frameOf(loadScene("scenes/minimal.toml"));
    writeExr(frame, folder / "frame.exr");
    CHECK(sameBits(readFrame(folder / "frame.exr"), frame));
}

TEST_CASE("NegativeAndNaNRadianceIsClampedAndCountedOrRefused") {
    const test::ScratchFolder folder;
    Frame probe;
    probe.width = 8;
    probe.height = 4;
    for (const char* name : {"R", "G", "B"}) {
        Image<float> plane(8, 4);
        plane.fill(1);
        plane.at(0, 0) = -1;
        plane.at(1, 0) = NAN;
        plane.at(2, 0) = INFINITY;
        probe.channels.push_back({name, plane});
    }
    writeExr(probe, folder / "probe.exr");
    Scene scene = loadScene("scenes/minimal.toml");
    scene.environment.kind = EnvironmentKind::file;
    scene.environment.file = folder / "probe.exr";
    const RenderResult result = renderScene(scene, {});
    REQUIRE(result.warnings.size() == 1);
    CHECK(result.warnings[0].find("3 negative and 6 non-finite values were set to 0") != std::string::npos);
    for (size_t c = 0; c < 3; c++)
        for (const float value : valuesOf(result.frame, c)) CHECK((value >= 0 && value < 10));
    RenderOptions strict;
    strict.strict = true;
    CHECK_THROWS_AS(renderScene(scene, strict), InputError);
}

TEST_CASE("ImagesThatNeedMoreMemoryThanThereIsAreRefusedBeforeTheWork") {
    Scene scene = loadScene("scenes/minimal.toml");
    scene.camera.width = scene.camera.height = 65536;
    scene.render.samples = 16;
    try {
        renderScene(scene, {});
        FAIL("a 65536x65536 image with 16 samples was rendered");
    } catch (const InputError& error) {
        const std::string text = error.what();
        CHECK(text.find("GiB") != std::string::npos);
        CHECK(text.find("minimal.toml:") != std::string::npos);
    }
}

// A plane alone: nothing can occlude it.
TEST_CASE("OcclusionDoesNotRunWhereNothingCanOcclude") {
    Scene scene = loadScene("golden/scenes/environment_occlusion.toml");
    scene.meshes.clear();
    scene.environment.kind = EnvironmentKind::none;
    const auto occlusionOf = [](const Scene& of) {
        return *renderScene(of, {}).plan.find("ambient occlusion");
    };
    CHECK_FALSE(occlusionOf(scene).runs);
    const char* const kReason = "nothing can occlude the diffuse surfaces that are visible";
    CHECK(occlusionOf(scene).reason == kReason);
    CHECK(planScene(scene, {}).find("ambient occlusion")->reason == kReason);
    // A second plane below it changes nothing, one above it does.
    scene.planes.push_back(scene.planes[0]);
    scene.planes[1].name = "second";
    scene.planes[1].point.y -= 1;
    CHECK_FALSE(occlusionOf(scene).runs);
    scene.planes[1].point.y += 1.5;
    scene.planes[1].normal = -scene.planes[1].normal;
    scene.planes[1].v = -scene.planes[1].v;
    CHECK(occlusionOf(scene).runs);
}

TEST_CASE("ShadowsOfLightsBehindAllThatIsVisibleDoNotRun") {
    Scene scene = loadScene("golden/scenes/shadows.toml");
    scene.meshes.clear();
    scene.planes.resize(1);
    scene.planes.push_back(scene.planes[0]);
    scene.planes[1].name = "cellar";
    scene.planes[1].point.y -= 1;
    scene.lights.resize(1);
    SceneLight& light = scene.lights[0];
    light.kind = LightKind::directional;
    light.irradiance = glm::dvec3(1);
    light.toLight = {0, -1, 0};
    light.shadow.method = ShadowMethod::map;
    const Plan plan = renderScene(scene, {}).plan;
    CHECK_FALSE(plan.find("shadow map of light0")->runs);
    CHECK(plan.find("shadow map of light0")->reason ==
          "the light is behind all that is visible, and no output shows its shadow");
    CHECK(plan.find("diffuse")->reason == "the lights are behind each diffuse surface that is visible");
    light.toLight = {0, 1, 0};
    CHECK(renderScene(scene, {}).plan.find("diffuse")->runs);
}

// Which outputs are asked for changes no bit of the others, with shadows that are fitted to what they fall on.
TEST_CASE("ShadowsDoNotDependOnTheOutputs") {
    Scene scene = loadScene("golden/scenes/shadows.toml");
    // What only the mirror's cube map may show: it widens the maps, whether the mirror is an output or not.
    scene.planes.push_back(scene.planes[0]);
    scene.planes.back().name = "cellar";
    scene.planes.back().point.y -= 3;
    scene.output.images = {"diffuse"};
    const Frame alone = frameOf(scene);
    scene.output.images = {"diffuse", "mirror", "beauty"};
    const Frame many = frameOf(scene);
    for (const Channel& channel : alone.channels)
        CHECK(std::get<Image<float>>(many.find(channel.name)->values) ==
              std::get<Image<float>>(channel.values));
}

// Two mirrors that show the scene: each shows the environment in the other, which a white one makes white.
TEST_CASE("MirrorsShowTheEnvironmentInEachOther") {
    const test::ScratchFolder folder;
    Frame probe;
    probe.width = 8;
    probe.height = 4;
    for (const char* name : {"R", "G", "B"}) {
        Image<float> plane(8, 4);
        plane.fill(1);
        probe.channels.push_back({name, plane});
    }
    writeExr(probe, folder / "white.exr");
    Scene scene = loadScene("scenes/minimal.toml");
    scene.planes.clear();
    scene.lights.clear();
    scene.ambient = glm::dvec3(0);
    Material mirror;
    mirror.kind = MaterialKind::mirror;
    mirror.reflectance = glm::dvec3(1);
    scene.materials = {mirror};
    scene.meshes.resize(1);
    MeshObject ball = scene.meshes[0];
    ball.material = 0;
    ball.reflection = Reflection::scene;
    ball.cubeSize = 16;
    ball.objectToWorld = {translation({-0.8, 0, 0})};
    scene.meshes = {ball, ball};
    scene.meshes[1].name = "other";
    scene.meshes[1].objectToWorld = {translation({0.8, 0, 0})};
    scene.environment.kind = EnvironmentKind::file;
    scene.environment.file = folder / "white.exr";
    scene.output.images = {"beauty", "mirror", "ids"};
    const RenderResult result = renderScene(scene, {});
    CHECK(result.plan.find("cube map of other")->runs);
    for (size_t c = 0; c < 3; c++)
        for (const float value : valuesOf(result.frame, c)) CHECK(value == doctest::Approx(1).epsilon(1e-5));
}

TEST_CASE("APlanRunsNothingButTheGeometry") {
    const Scene scene = loadScene("scenes/stress.toml");
    RenderOptions options;
    std::vector<std::string> run;
    options.progress = [&](const RenderProgress& at) {
        if (at.step == 0) run.push_back(at.plan->passes[at.pass].name());
    };
    const Plan plan = planScene(scene, options);
    CHECK(run == std::vector<std::string>{"geometry"});
    for (const Pass& pass : plan.passes) CHECK(pass.isDone == (pass.name() == "geometry"));
    // A render runs what it says, and the plan that it leaves is that which ran.
    run.clear();
    const RenderResult result = renderScene(scene, options);
    std::vector<std::string> expected;
    for (const Pass& pass : result.plan.passes) {
        CHECK(pass.isDone);
        if (pass.runs) expected.push_back(pass.name());
        CHECK(pass.dependsOn.empty());
    }
    CHECK(run == expected);
}

TEST_CASE("ResultsHoldNoMoreThanThePlanSays") {
    size_t checked = 0;
    for (const char* name : {"shadow_methods", "shadows", "environment_occlusion", "environment_shadows",
                             "environment_blurred", "environment_occlusion_vertices", "shadow_hard_volume"})
        for (const char* profile : {"f32", "r300-fp24"}) {
            Scene scene = loadScene(std::string("golden/scenes/") + name + ".toml");
            scene.render.profile = *findProfile(profile);
            scene.render.samples = 4;
            scene.camera.width /= 4, scene.camera.height /= 4;
            for (SceneLight& light : scene.lights)
                light.shadow.map.size = light.shadow.planar.resolution = 64;
            scene.environment.shadow.map.size = 64;
            scene.output.images.assign(outputNames().begin(), outputNames().end());
            RenderOptions options;
            options.request.png = true;
            const RenderResult result = renderScene(scene, options);
            uint64_t sum = 0;
            for (const Pass& pass : result.plan.passes) {
                if (!pass.runs) CHECK(pass.held.all_bytes() == 0);
                if (!pass.runs) continue;
                CAPTURE(name + (", " + pass.name()));
                CHECK(pass.held.planes_bytes <= pass.memory_bytes());
                sum += pass.held.planes_bytes;
                checked += pass.held.planes_bytes > 0 ? 1 : 0;
            }
            CHECK(sum <= result.plan.memory_bytes());
            // The frame is what it has channels for.
            CHECK(result.plan.find("frame")->held.planes_bytes ==
                  result.frame.channels.size() * 4 * static_cast<size_t>(scene.camera.width) *
                      static_cast<size_t>(scene.camera.height));
            CHECK(result.plan.find("geometry")->held.lists_bytes > 0);
        }
    CHECK(checked > 100);
}

// Two mirror balls that reflect half of the light, in a white furnace: what n mirrors reflect one after the other is 2^-n,
// and the cube maps of n reflections show n + 1 of them.
TEST_CASE("MirrorsShowAsManyReflectionsAsAreAskedFor") {
    const test::ScratchFolder folder;
    const std::filesystem::path file = folder.path() / "scene.toml";
    const std::string ball = "[[mesh]]\nfile = \"" +
                             std::filesystem::absolute("scenes/meshes/sphere.ply").string() +
                             "\"\nmaterial = \"m\"\nreflection = \"scene\"\ncube_size = 128\nscale = 0.5\n";
    std::ofstream(file) << "[camera]\nwidth = 256\nheight = 192\nfov_y_deg = 40\nnear = 0.1\nfar = 20\n"
                           "position = [0, 0, 3]\nlook_at = [0, 0, 0]\n[environment]\nconstant = [1, 1, 1]\n"
                           "[material.m]\nkind = \"mirror\"\nreflectance = [0.5, 0.5, 0.5]\n"
                        << ball << "translate = [-0.52, 0, 0]\n"
                        << ball << "translate = [0.52, 0, 0]\n[output]\nimages = [\"beauty\"]\n";
    Scene scene = loadScene(file);
    for (int reflections = 1; reflections <= 3; reflections++) {
        scene.render.reflections = reflections;
        const Frame frame = frameOf(scene);
        const std::span<const float> values = valuesOf(frame, 0);
        CHECK(*std::ranges::min_element(values) == std::ldexp(1.0f, -1 - reflections));
        CHECK(*std::ranges::max_element(values) == 1);
    }
    // What is nearer than the camera's near plane is reflected nevertheless.
    scene.camera.near = 2;
    const Frame frame = frameOf(scene);
    CHECK(*std::ranges::min_element(valuesOf(frame, 0)) == 0x1p-4f);
}

// Two planes 50 m apart at 5 km, with a near plane at 0.01 m: floats that are 1 on the far plane have 150 m there.
TEST_CASE("TheNearerOfTwoFarPlanesIsSeen") {
    const test::ScratchFolder folder;
    const std::filesystem::path file = folder.path() / "planes.toml";
    const auto plane = [](const char* z_m) {
        return std::string("[[plane]]\npoint = [0, 0, ") + z_m +
               "]\nnormal = [0, 0, 1]\nsize_m = [20000, 20000]\nmaterial = 'm'\n";
    };
    std::ofstream(file) << "[camera]\nwidth = 64\nheight = 48\nfov_y_deg = 45\nnear = 0.01\nfar = 10000\n"
                        << "position = [0, 0, 0]\nlook_at = [0.1, 0.03, -1]\n[material.m]\nkind = 'lambert'\n"
                        << "diffuse = [1, 1, 1]\n" + plane("-5000") + plane("-4950")
                        << "[output]\nimages = ['ids']\n";
    const Scene scene = loadScene(file);
    const auto hiddenSeen = [&](const char* name, DepthFormat depth, DepthDirection direction) {
        Profile profile = *findProfile(name);
        profile.depth = depth, profile.depthDirection = direction;
        if (depth != DepthFormat::d64f) profile.depthOrder = DepthOrder::stored;
        RenderOptions options;
        options.profile = profile;
        const Frame frame = frameOf(scene, options);
        int hidden = 0;
        for (const uint32_t id : std::get<Image<uint32_t>>(frame.channels[0].values).values())
            hidden += id != 2;
        return hidden;
    };
    using enum DepthDirection;
    for (const DepthDirection direction : {forward, reversed}) {
        CHECK(hiddenSeen("truth", DepthFormat::d64f, direction) == 0);
        CHECK(hiddenSeen("f64", DepthFormat::d64f, direction) == 0);
    }
    CHECK(hiddenSeen("f32", DepthFormat::d32f, reversed) == 0);
    // As before there were depths of double.
    CHECK(hiddenSeen("f64", DepthFormat::d32f, forward) > 1000);
}
