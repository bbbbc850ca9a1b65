#include "lighting/render_view.h"

#include <doctest/doctest.h>

#include <cmath>
#include <string>

#include "lighting/shading_passes.h"
#include "numeric/fp_environment.h"
#include "tests/support/box_scene.h"

using namespace etalon;

namespace {

constexpr double kPi = 3.141592653589793;

// A camera at the origin that looks along -Z with a field of view of 90 degrees.
View squareView(int size) {
    PinholeCamera camera;
    camera.width = camera.height = size;
    camera.fx = camera.fy = camera.cx = camera.cy = size / 2.0;
    return cameraView(camera);
}

struct Rendered {
    ShadedImages images;
    ShadeStatistics statistics;
};

Rendered render(const SurfaceScene& scene, const View& view, const ShadeRequest& request,
                const char* profileName = "f32", int samples = 1, const RasterOptions& options = {}) {
    const Profile& profile = *findProfile(profileName);
    const auto placed = placeMeshes(scene, profile.vertex, options.threads);
    const VisibleScene visible = findVisible(scene, placed, view, profile, samples, options);
    ShadeJob job;
    job.scene = &scene;
    job.view = &view;
    job.target = &visible.target;
    job.placed = &placed;
    job.instanceOfDraw = visible.instanceOfDraw;
    job.sceneCubes.assign(scene.instances.size(), nullptr);
    job.request = request;
    job.profile = &profile;
    job.threads = options.threads;
    job.tileSize = options.tileSize;
    Rendered result;
    result.images = shade(job, &result.statistics);
    return result;
}

ShadeRequest requestOf(std::initializer_list<ShadeOutput> outputs) {
    ShadeRequest request;
    for (ShadeOutput output : outputs) request[output] = true;
    return request;
}

const char* const kAllProfiles[] = {"f32",       "f64",       "truth",     "d3d11", "vulkan-min",
                                    "nv40-fp32", "nv40-fp16", "r300-fp24", "fp16",  "bf16"};

}  // namespace

// From inside a box, each face of the cube map shows its own wall: the face table end to end. The distance of
// a texel is that of the wall divided by the cosine. Snapping moves a vertex by up to half a subpixel, 2^-9
// texels, of 2 / size each on the face's plane at distance 1, in s and in t.
TEST_CASE("CubeMapOfABoxShowsItsWallsAtTheirDistances") {
    constexpr double kRelativeBound = 2 * 0x1p-9 * 2 / 33;
    const SurfaceScene scene = test::box(2, 3, 4);
    const Profile& profile = *findProfile("f32");
    const auto placed = placeMeshes(scene, profile.vertex, 0);
    CubeRenderRequest request;
    request.centre = {0.5, 0, 0};
    request.size = 33;
    request.near_m = 0.1;
    request.far_m = 50;
    const CubeRender cube = renderCubeMap(scene, placed, request, nullptr, profile, {});
    const double wall_m[6] = {1.5, 2.5, 3, 3, 4, 4};
    for (size_t face = 0; face < 6; face++) {
        const float centre = cube.distance.faces[face].at(16, 16);
        CHECK(centre == doctest::Approx(wall_m[face]).epsilon(kRelativeBound));
        CHECK(cube.radiance.faces[face].at(16, 16) ==
              static_cast<float>(0.1 * static_cast<double>(face + 1)));
        for (int y = 0; y < request.size; y++) {
            for (int x = 0; x < request.size; x++) {
                // The texel's direction, by its major axis and the distance to the nearest wall along it.
                const double s = (x + 0.5) / request.size * 2 - 1, t = (y + 0.5) / request.size * 2 - 1;
                const double length = std::sqrt(s * s + t * t + 1);
                CubeFaceKernel<double> kernel;
                const auto d = kernel.cubeDirection(static_cast<int>(face), (s + 1) / 2, (t + 1) / 2);
                double nearest = INFINITY;
                const double half[3] = {2, 3, 4};
                for (int k = 0; k < 3; k++)
                    if (d[k] != 0)
                        nearest =
                            std::min(nearest, ((d[k] > 0 ? half[k] : -half[k]) - request.centre[k]) / d[k]);
                CHECK(cube.distance.faces[face].at(x, y) ==
                      doctest::Approx(nearest * length).epsilon(kRelativeBound));
            }
        }
    }
}

TEST_CASE("CubeMapLeavesOutTheExcludedObjectAndSeesInfinityBehindIt") {
    SurfaceScene scene;
    test::addObject(scene, test::rectangle({0, 0, -2}, {3, 0, 0}, {0, 3, 0}), test::lambertian(0.5));
    scene.ambient = glm::dvec3(1);
    const Profile& profile = *findProfile("f32");
    const auto placed = placeMeshes(scene, profile.vertex, 0);
    CubeRenderRequest request;
    request.size = 8;
    request.near_m = 0.1;
    request.far_m = 10;
    const size_t minusZ = 5;
    CHECK(renderCubeMap(scene, placed, request, nullptr, profile, {}).distance.faces[minusZ].at(4, 4) < 3);
    request.excluded = 0;
    const CubeRender cube = renderCubeMap(scene, placed, request, nullptr, profile, {});
    CHECK(std::isinf(cube.distance.faces[minusZ].at(4, 4)));
    CHECK(cube.radiance.faces[minusZ].at(4, 4) == 0);
}

// Cube faces are seen mirrored, and a mirroring transform turns the winding round: neither turns fronts into
// backs.
TEST_CASE("FrontsStayFrontsInCubeFacesAndMirroredInstances") {
    const Profile& profile = *findProfile("f32");
    for (const bool fromBehind : {false, true}) {
        for (const double mirror : {1.0, -1.0}) {
            SurfaceScene scene;
            const glm::vec3 u(1, 0, 0), v(0, 1, 0);
            test::addObject(
                scene, fromBehind ? test::rectangle({0, 0, -2}, v, u) : test::rectangle({0, 0, -2}, u, v),
                test::lambertian(0.5));
            scene.instances[0].twoSided = false;
            scene.instances[0].toWorld[0][0] = mirror;
            const auto placed = placeMeshes(scene, profile.vertex, 1);
            const VisibleScene camera = findVisible(scene, placed, squareView(9), profile, 1, {});
            CHECK((camera.target.id.at(4, 4) == kNoTriangle) == fromBehind);
            CubeRenderRequest request;
            request.size = 9;
            request.near_m = 0.1;
            request.far_m = 10;
            const CubeRender cube = renderCubeMap(scene, placed, request, nullptr, profile, {});
            CHECK(std::isinf(cube.distance.faces[5].at(4, 4)) == fromBehind);
        }
    }
}

TEST_CASE("NormalsPointTowardsTheViewerOnBothSides") {
    for (const bool fromBehind : {false, true}) {
        SurfaceScene scene;
        const glm::vec3 u(1, 0, 0), v(0, 1, 0);
        test::addObject(scene,
                        fromBehind ? test::rectangle({0, 0, -2}, v, u) : test::rectangle({0, 0, -2}, u, v),
                        test::lambertian(0.5));
        const auto result = render(scene, squareView(9), requestOf({ShadeOutput::normals}));
        CHECK(result.images[ShadeOutput::normals].at(4, 4, 2) == 1.0f);
        CHECK(result.images[ShadeOutput::normals].at(0, 0, 2) == 0.0f);
    }
}

// A white Lambertian plate that faces a light of irradiance pi reflects radiance 1: in every profile within
// two units of its format (1 / pi and the product are rounded).
TEST_CASE("WhitePlateFacingIrradiancePiReflectsOne") {
    SurfaceScene scene;
    test::addObject(scene, test::rectangle({0, 0, -2}, {3, 0, 0}, {0, 3, 0}), test::lambertian(1));
    scene.lights.push_back({{0, 0, 1}, glm::dvec3(kPi)});
    for (const char* profile : kAllProfiles) {
        const double unit = std::string(profile) == "bf16"        ? 0x1p-7
                            : std::string(profile) == "fp16"      ? 0x1p-10
                            : std::string(profile) == "nv40-fp16" ? 0x1p-10
                            : std::string(profile) == "r300-fp24" ? 0x1p-16
                                                                  : 0x1p-23;
        const auto result =
            render(scene, squareView(8), requestOf({ShadeOutput::beauty, ShadeOutput::diffuse}), profile);
        for (const float value : result.images[ShadeOutput::beauty].values())
            CHECK_MESSAGE(std::fabs(value - 1) <= 2 * unit, profile);
        CHECK(result.images[ShadeOutput::beauty] == result.images[ShadeOutput::diffuse]);
    }
}

TEST_CASE("BeautyIsTheSumOfItsComponents") {
    SurfaceScene scene = test::box(2, 3, 4);
    for (SurfaceMaterial& material : scene.materials) {
        material.kind = MaterialKind::blinnPhong;
        material.specular = glm::dvec3(0.3);
        material.exponent = 20;
    }
    scene.lights.push_back({{0.6, 0.0, 0.8}, {1, 2, 3}});
    scene.lights.push_back({{0.0, 1.0, 0.0}, {3, 1, 2}});
    const auto all = render(scene, squareView(40),
                            requestOf({ShadeOutput::beauty, ShadeOutput::ambient, ShadeOutput::diffuse,
                                       ShadeOutput::specular, ShadeOutput::mirror}));
    const auto alone = render(scene, squareView(40), requestOf({ShadeOutput::beauty}));
    CHECK(all.images[ShadeOutput::beauty] == alone.images[ShadeOutput::beauty]);
    bool hasSpecular = false;
    for (size_t i = 0; i < all.images[ShadeOutput::beauty].values().size(); i++) {
        const auto value = [&](ShadeOutput o) { return all.images[o].values()[i]; };
        hasSpecular = hasSpecular || value(ShadeOutput::specular) > 0;
        CHECK(value(ShadeOutput::beauty) ==
              (value(ShadeOutput::ambient) + value(ShadeOutput::diffuse)) + value(ShadeOutput::specular));
        CHECK(value(ShadeOutput::mirror) == 0);
    }
    CHECK(hasSpecular);
}

TEST_CASE("MirrorShowsTheConstantEnvironmentTimesItsReflectance") {
    SurfaceScene scene;
    SurfaceMaterial chrome;
    chrome.kind = MaterialKind::mirror;
    chrome.reflectance = {0.5, 0.25, 1};
    test::addObject(scene, test::rectangle({0, 0, -2}, {1, 0, 0}, {0, 1, 0}), chrome);
    scene.environment.constant = {2, 2, 2};
    const auto result = render(scene, squareView(32), requestOf({ShadeOutput::beauty}));
    CHECK(result.images[ShadeOutput::beauty].at(16, 16, 0) == 1.0f);
    CHECK(result.images[ShadeOutput::beauty].at(16, 16, 1) == 0.5f);
    CHECK(result.images[ShadeOutput::beauty].at(0, 0, 1) == 2.0f);
}

TEST_CASE("EachVisiblePixelIsShadedOnce") {
    const int size = 100;
    SurfaceScene scene = test::box(2, 3, 4);
    // Rectangles behind each other, nearest last and first: hidden ones are never shaded.
    for (float z : {-3.f, -1.f, -2.f})
        test::addObject(scene, test::rectangle({0, 0, z}, {0.4f, 0, 0}, {0, 0.4f, 0}), test::lambertian(0.5));
    const auto one = render(scene, squareView(size), requestOf({ShadeOutput::beauty}));
    CHECK(one.statistics.surfaceFragments == size * size);
    CHECK(one.statistics.backgroundFragments == 0);
    // With samples, a pixel has one fragment for each triangle that is visible in it.
    const auto four = render(scene, squareView(size), requestOf({ShadeOutput::beauty}), "f32", 4);
    CHECK(four.statistics.surfaceFragments > size * size);
    CHECK(four.statistics.surfaceFragments < size * size * 3 / 2);
}

// A pixel that an edge cuts is the mean of its samples: with a white plate on black, the covered fraction
// exactly.
TEST_CASE("ResolveIsTheMeanOfTheSamples") {
    SurfaceScene scene;
    test::addObject(scene, test::rectangle({0.3f, 0.1f, -1}, {0.5f, 0, 0}, {0.2f, 0.5f, 0}),
                    test::lambertian(1));
    scene.ambient = glm::dvec3(1);
    for (int samples : {4, 16}) {
        const View view = squareView(40);
        const Profile& profile = *findProfile("f32");
        const auto placed = placeMeshes(scene, profile.vertex, 1);
        const VisibleScene visible = findVisible(scene, placed, view, profile, samples, {});
        const auto result = render(scene, view, requestOf({ShadeOutput::beauty}), "f32", samples);
        int partial = 0;
        for (size_t p = 0; p < visible.target.id.pixelCount(); p++) {
            int covered = 0;
            for (int s = 0; s < samples; s++) covered += visible.target.id.plane(s)[p] != kNoTriangle ? 1 : 0;
            partial += covered > 0 && covered < samples ? 1 : 0;
            CHECK(result.images[ShadeOutput::beauty].plane(0)[p] ==
                  static_cast<float>(covered) / static_cast<float>(samples));
        }
        CHECK(partial > 20);
    }
}

TEST_CASE("ShadingDoesNotDependOnTilesOrThreads") {
    SurfaceScene scene = test::box(2, 3, 4);
    scene.lights.push_back({{0.6, 0.0, 0.8}, {1, 2, 3}});
    const ShadeRequest request =
        requestOf({ShadeOutput::beauty, ShadeOutput::normals, ShadeOutput::distance, ShadeOutput::diffuse});
    const auto reference = render(scene, squareView(150), request, "f32", 4, {1, 64});
    for (int threads : {1, 2, 7}) {
        for (int tile : {16, 32, 64, 256}) {
            const auto other = render(scene, squareView(150), request, "f32", 4, {threads, tile});
            for (size_t o = 0; o < kShadeOutputs; o++)
                CHECK(other.images.images[o] == reference.images.images[o]);
        }
    }
}

// The f32 profile has no subnormal intermediate: a processor that flushes them gives the same bits. The
// narrow lobe of a faint light on a faint gloss falls through the whole range of float.
TEST_CASE("FlushingSubnormalsChangesNoBitOfTheShading") {
    SurfaceScene scene = test::box(2, 3, 4);
    for (SurfaceMaterial& material : scene.materials) {
        material.kind = MaterialKind::blinnPhong;
        material.specular = glm::dvec3(1e-4);
        material.exponent = 4000;
    }
    scene.lights.push_back({{0.6, 0.0, 0.8}, {1e-3, 2e-3, 3e-3}});
    const View view = squareView(64);
    const Profile& profile = *findProfile("f32");
    const auto placed = placeMeshes(scene, profile.vertex, 1);
    const VisibleScene visible = findVisible(scene, placed, view, profile, 1, {});
    ShadeJob job;
    job.scene = &scene;
    job.view = &view;
    job.target = &visible.target;
    job.placed = &placed;
    job.instanceOfDraw = visible.instanceOfDraw;
    job.sceneCubes.assign(scene.instances.size(), nullptr);
    job.request = requestOf({ShadeOutput::beauty, ShadeOutput::specular});
    job.profile = &profile;
    const ShadedImages kept = shade(job);
    ShadedImages flushed = kept;
    for (Image<float>& image : flushed.images) image.fill(0);
    {
        const FlushToZeroScope flush;
        ShadeStatistics statistics;
        shadingPasses(profile.fragment).makeTileShader(job)->run({0, 0, 64, 64}, flushed, statistics);
    }
    for (size_t o = 0; o < kShadeOutputs; o++) CHECK(flushed.images[o] == kept.images[o]);
}

// Each profile's distance from the truth, largest first: bf16, fp16, fp24, fp32, and almost none in double.
TEST_CASE("WiderFormatsAreCloserToTheTruth") {
    SurfaceScene scene = test::box(2, 3, 4);
    for (SurfaceMaterial& material : scene.materials) {
        material.kind = MaterialKind::blinnPhong;
        material.specular = glm::dvec3(0.3);
        material.exponent = 20;
    }
    scene.lights.push_back({{0.6, 0.0, 0.8}, {1, 2, 3}});
    const ShadeRequest request = requestOf({ShadeOutput::beauty});
    const auto truth = render(scene, squareView(24), request, "truth");
    double previous = INFINITY;
    for (const char* profile : {"bf16", "fp16", "r300-fp24", "f32", "f64"}) {
        const auto result = render(scene, squareView(24), request, profile);
        double sum = 0;
        for (size_t i = 0; i < truth.images[ShadeOutput::beauty].values().size(); i++)
            sum += std::fabs(double{result.images[ShadeOutput::beauty].values()[i]} -
                             double{truth.images[ShadeOutput::beauty].values()[i]});
        MESSAGE(std::string(profile) << ": mean error " << sum / (24 * 24 * 3));
        CHECK(sum < previous / 4);
        previous = sum;
    }
}
