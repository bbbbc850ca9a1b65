// Where in the world a scene stands, and what positions are relative to.
#include <doctest/doctest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "ar/render_scene.h"
#include "numeric/text.h"
#include "scene/scene.h"
#include "tests/support/scratch_folder.h"

using namespace etalon;
using test::ScratchFolder;

namespace {

// A cube of 10 cm on a ground of 2 m, (away, 0, away) from the world's origin, lit at 45 degrees.
Scene cubeAt(double away_m, const std::string& shadow, const std::string& profile,
             const std::string& origin) {
    const ScratchFolder folder;
    const std::filesystem::path file = folder.path() / "scene.toml";
    const std::string x = formatText("{:.1f}", away_m),
                      mesh = std::filesystem::absolute("scenes/meshes/cube.gltf");
    std::ofstream(file)
        << "[camera]\nwidth = 80\nheight = 60\nfov_y_deg = 30\nnear = 0.05\nfar = 10\nposition = [" << x
        << ", 0.5, " << formatText("{:.1f}", away_m + 0.8) << "]\nlook_at = [" << x << ", 0.05, " << x
        << "]\n[material.grey]\nkind = 'lambert'\ndiffuse = [0.6, 0.6, 0.6]\n[[plane]]\npoint = [" << x
        << ", 0, " << x << "]\nnormal = [0, 1, 0]\nsize_m = [2, 2]\nmaterial = 'grey'\n[[mesh]]\nfile = '"
        << mesh << "'\nmaterial = 'grey'\nscale = 0.1\ntranslate = [" << x << ", 0.05, " << x
        << "]\n[[light]]\nkind = 'directional'\ndirection = [1, -1, 0]\nirradiance = [3, 3, 3]\n"
        << "shadow = '" << shadow << "'\n[output]\nimages = ['diffuse']\n[render]\nprofile = '" << profile
        << "'\norigin = '" << origin << "'\n";
    return loadScene(file);
}

std::span<const float> firstChannel(const RenderResult& result) {
    return std::get<Image<float>>(result.frame.channels[0].values).values();
}
int darkPixels(const Scene& scene) {
    int dark = 0;
    const RenderResult result = renderScene(scene, {});
    for (const float value : firstChannel(result)) dark += value == 0;
    return dark;
}

}  // namespace

// Pixels that a border crosses may differ: positions are rounded to 2^-31 m at 4e6 m.
TEST_CASE("ShadowsDoNotDependOnThePlaceInTheWorld") {
    for (const char* shadow : {"volume", "map", "planar"})
        for (const char* profile : {"f64", "truth"}) {
            CAPTURE(shadow);
            CAPTURE(profile);
            const int home = darkPixels(cubeAt(0, shadow, profile, "world"));
            CHECK(home > 100);
            for (const double away_m : {1e6, 4e6}) {
                CAPTURE(away_m);
                CHECK(std::abs(darkPixels(cubeAt(away_m, shadow, profile, "world")) - home) <= 6);
            }
        }
    // In fp32 coordinates are 1/16 m apart there; relative to the eye they are not.
    const int home = darkPixels(cubeAt(0, "volume", "f32", "world"));
    CHECK(std::abs(darkPixels(cubeAt(1e6, "volume", "f32", "eye")) - home) <= 6);
    CHECK(std::abs(darkPixels(cubeAt(1e6, "volume", "f32", "world")) - home) > 60);
}

TEST_CASE("CoarsePositionsAreNamed") {
    const auto warnings = [](double away_m, const char* profile, const char* origin) {
        return renderScene(cubeAt(away_m, "volume", profile, origin), {}).warnings;
    };
    CHECK(warnings(0, "f32", "world").empty());
    CHECK(warnings(1e6, "f64", "world").empty());
    CHECK(warnings(1e6, "f32", "eye").empty());
    const std::vector<std::string> found = warnings(1e6, "f32", "world");
    REQUIRE(found.size() == 2);
    CHECK(found[0].find("mesh0") != std::string::npos);
    CHECK(found[0].find("0.0625 m apart") != std::string::npos);
}

// Every golden scene, moved by up to 1e7 m: what is relative to the eye in double is rounded to 2^-30 m.
TEST_CASE("GoldenScenesMayStandAnywhereWithTheEyeAsOrigin") {
    std::vector<std::filesystem::path> files = {"scenes/minimal.toml", "scenes/stress.toml"};
    for (const auto& entry : std::filesystem::directory_iterator("golden/scenes"))
        if (entry.path().extension() == ".toml") files.push_back(entry.path());
    REQUIRE(files.size() > 15);
    for (const std::filesystem::path& file : files) {
        CAPTURE(file.string());
        const auto frameAt = [&](const glm::dvec3& away_m) {
            Scene scene = loadScene(file);
            scene.camera.width /= 4, scene.camera.height /= 4;
            for (double* f : {&scene.camera.intrinsics.fx, &scene.camera.intrinsics.fy,
                              &scene.camera.intrinsics.cx, &scene.camera.intrinsics.cy})
                *f /= 4;
            scene.output.images = {"beauty"};
            moveOrigin(scene, -away_m);
            moveOrigin(scene, glm::dvec3(scene.camera.cameraToWorld[3]));
            return renderScene(scene, {});
        };
        const RenderResult home = frameAt(glm::dvec3(0)), away = frameAt({1e7, -3e6, 7e6});
        const std::span<const float> a = firstChannel(home), b = firstChannel(away);
        REQUIRE(a.size() == b.size());
        int different = 0;
        for (size_t i = 0; i < a.size(); i++)
            different += !(std::abs(a[i] - b[i]) <= 0x1p-10f * std::abs(a[i]));
        CHECK(different == 0);
    }
}
