#include "shadows/surface_occlusion.h"

#include <doctest/doctest.h>

#include <cmath>

#include "lighting/render_view.h"
#include "tests/support/shadow_meshes.h"

using namespace etalon;
using namespace etalon::test;

namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr int kSize = 48, kDirections = 256;
// Points are as many as the measured bound of directionalErrorBound() is a mean of; one may be this many
// times off.
constexpr double kWorst = 3;

SurfaceScene sceneOf(std::vector<SurfaceMesh> meshes) {
    SurfaceScene scene;
    scene.meshes = std::move(meshes);
    scene.materials.emplace_back();
    scene.materials[0].diffuse = glm::dvec3(1);
    scene.ambient = glm::dvec3(1);
    for (uint32_t i = 0; i < scene.meshes.size(); i++) {
        scene.instances.emplace_back();
        scene.instances.back().mesh = i;
    }
    return scene;
}

// A square of 10 cm around (x, 0, 0), normal +Y.
SurfaceMesh patch(float x) { return rectangle({x, 0, 0}, {0, 0, 0.05f}, {0.05f, 0, 0}); }

// Everything that a test looks at: the patch fills the image of a camera above it, or below.
struct Shot {
    Shot(const SurfaceScene& surfaces, double x, double height_m, const char* profileName = "f32")
        : scene(surfaces), profile(*findProfile(profileName)) {
        PinholeCamera camera;
        camera.width = camera.height = kSize;
        camera.fx = camera.fy = kSize / 2.0 / (0.04 / std::fabs(height_m));
        camera.cx = camera.cy = kSize / 2.0;
        camera.position = {x, height_m, 0};
        camera.backward = {0, height_m > 0 ? 1 : -1, 0};
        camera.up = {0, 0, -1};
        camera.right = {height_m > 0 ? 1 : -1, 0, 0};
        camera.near_m = 0.001;
        camera.far_m = 100;
        view = cameraView(camera);
        placed = placeMeshes(scene, profile.vertex, 1);
        visible.emplace(findVisible(scene, placed, view, profile, 1, {}));
        job = shadeJobOf(*visible, scene, placed, view, profile, {});
        job.request[ShadeOutput::ambient] = job.request[ShadeOutput::diffuse] = true;
    }
    ShadedImages perPixel() {
        occlusion = fragmentOcclusion(job, options);
        job.occlusion = &occlusion;
        return shade(job);
    }
    ShadedImages perVertex() {
        vertices = vertexOcclusion(job, options);
        const std::vector<VertexRadiance> radiance = lightVerticesOf(job, vertices);
        job.vertexRadiance = &radiance;
        return shade(job);
    }
    Occlusion truthAt(const glm::dvec3& position_m) const {
        const OcclusionPoint point{position_m, {0, 1, 0}};
        HemicubeOptions hemicube;
        hemicube.size = 256;
        hemicube.threads = 1;
        return hemicubeOcclusion(placed, std::span(&point, 1), hemicube)[0];
    }

    const SurfaceScene& scene;
    const Profile& profile;
    View view;
    std::vector<PlacedMesh> placed;
    std::optional<VisibleScene> visible;
    ShadeJob job;
    DirectionalOptions options{kDirections, 256, {}};
    TileOcclusion occlusion;
    std::vector<VertexOcclusion> vertices;
};

}  // namespace

TEST_CASE("AmbientLightIsMultipliedWithWhatIsOpen") {
    // A lid of 2 m x 2 m, 1 m above.
    const SurfaceScene scene = sceneOf({patch(0), rectangle({0, 1, 0}, {1, 0, 0}, {0, 0, 1})});
    Shot shot(scene, 0, 0.05);
    const ShadedImages images = shot.perPixel();
    const double open = shot.truthAt({0, 0, 0}).open;
    CHECK(open > 0.4);
    CHECK(open < 0.5);
    REQUIRE(shot.occlusion.size() == 1);
    for (int y = 0; y < kSize; y++)
        for (int x = 0; x < kSize; x++) {
            const float value = images[ShadeOutput::ambient].at(x, y, 1);
            CHECK(value ==
                  static_cast<float>(
                      shot.occlusion[0][static_cast<size_t>(y) * kSize + static_cast<size_t>(x)].open));
            CHECK(std::fabs(static_cast<double>(value) - open) < kWorst * directionalErrorBound(kDirections));
        }
    // Of the other side nothing is hidden.
    Shot below(scene, 0, -0.05);
    const ShadedImages ofBelow = below.perPixel();
    for (const float value : ofBelow[ShadeOutput::ambient].values()) CHECK(value == 1);
}

TEST_CASE("LightOfTheEnvironmentComesFromTheOpenSide") {
    // A wall of 4 m x 2 m at x = 0, the patch 3 to 13 cm beside it; irradiance 2 + 2 n.x.
    SurfaceScene scene = sceneOf({patch(0.08f), rectangle({0, 1, 0}, {0, 0, 2}, {0, 1, 0})});
    EnvironmentLight& light = scene.environment.light;
    light.kind = EnvironmentLight::Kind::harmonics;
    light.harmonics = SphericalHarmonics(1);
    light.harmonics.at(0, 0) = glm::dvec3(2 * std::sqrt(4 * kPi));
    for (const int m : {-1, 0, 1}) {
        SphericalHarmonics one(1);
        one.at(1, m) = glm::dvec3(1);
        HarmonicsKernel<double> kernel;
        kernel.setCoefficients(one);
        light.harmonics.at(1, m) = glm::dvec3(kernel.sumOfHarmonics({1, 0, 0}, 1).x * 8 * kPi / 3);
    }
    for (const char* profile : {"f32", "fp16"}) {
        CAPTURE(std::string(profile));
        Shot shot(scene, 0.08, 0.05, profile);
        const Occlusion truth = shot.truthAt({0.08, 0, 0});
        CHECK(std::fabs(truth.open - 0.5) < 0.05);
        const double expected = truth.open * (2 + 2 * truth.bentNormal.x) / kPi;
        const double value =
            static_cast<double>(shot.perPixel()[ShadeOutput::diffuse].at(kSize / 2, kSize / 2, 0));
        CHECK(std::fabs(value - expected) < kWorst * directionalErrorBound(kDirections));
        // The normal in the place of the bent normal would be off by far more.
        CHECK(truth.open * 2 * truth.bentNormal.x / kPi > 2 * kWorst * directionalErrorBound(kDirections));
        // At the vertices, and between them.
        Shot gouraud(scene, 0.08, 0.05, profile);
        const ShadedImages images = gouraud.perVertex();
        CHECK(std::fabs(static_cast<double>(images[ShadeOutput::diffuse].at(kSize / 2, kSize / 2, 0)) -
                        expected) < kWorst * directionalErrorBound(kDirections));
        CHECK(std::fabs(static_cast<double>(images[ShadeOutput::ambient].at(kSize / 2, kSize / 2, 0)) -
                        truth.open) < kWorst * directionalErrorBound(kDirections));
        CHECK(gouraud.vertices[1][0].empty());  // not visible
    }
}

TEST_CASE("VerticesHaveTheOcclusionOfTheirSide") {
    const SurfaceScene scene = sceneOf({patch(0), rectangle({0, 1, 0}, {1, 0, 0}, {0, 0, 1})});
    Shot above(scene, 0, 0.05);
    const double open = above.truthAt({0, 0, 0}).open;
    const ShadedImages ofAbove = above.perVertex();
    for (const float value : ofAbove[ShadeOutput::ambient].values())
        CHECK(std::fabs(static_cast<double>(value) - open) < kWorst * directionalErrorBound(kDirections));
    Shot below(scene, 0, -0.05);
    const ShadedImages ofBelow = below.perVertex();
    for (const float value : ofBelow[ShadeOutput::ambient].values()) CHECK(value == 1);
}
