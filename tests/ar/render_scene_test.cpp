#include "ar/render_scene.h"

#include <doctest/doctest.h>

#include <cmath>
#include <fstream>

#include "ar/compare.h"
#include "ar/image_io.h"
#include "ar/scene_loader.h"
#include "ar/transform.h"
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
    scene.output.toneMap = "filmic";
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
        scene.lights[0].shadowMap = defaultShadowMap();
        scene.lights[0].shadowMap->size = 512;
        scene.output.images = {"diffuse", "mirror"};
        const Frame map = frameOf(scene);
        scene.lights[0].shadowMap.reset();
        const Frame none = frameOf(scene);
        scene.lights[0].shadowVolumes = true;
        const Frame volume = frameOf(scene);
        for (size_t c = 0; c < volume.channels.size(); c++) {
            double toMap = 0, toNone = 0;
            for (size_t i = 0; i < std::get<Image<float>>(volume.channels[c].values).pixelCount(); i++) {
                const auto at = [&](const Frame& frame) {
                    return static_cast<double>(std::get<Image<float>>(frame.channels[c].values).values()[i]);
                };
                toMap += std::fabs(at(volume) - at(map));
                toNone += std::fabs(at(volume) - at(none));
            }
            CHECK(toNone > 0);
            CHECK(toMap < 0.25 * toNone);
        }
    }
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
    for (const std::string_view name : kOutputNames) options.request.outputs.emplace_back(name);
    const Frame frame = frameOf(scene, options);
    for (const char* name : {"R", "G", "B", "Z", "distance", "N.X", "N.Y", "N.Z", "id.object", "id.triangle",
                             "coverage", "diffuse.R", "specular.G", "mirror.B", "background.R", "ambient.G"})
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
    for (const float value : result.beauty.values()) CHECK((value >= 0 && value < 10));
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
