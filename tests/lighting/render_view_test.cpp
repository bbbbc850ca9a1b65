#include "lighting/render_view.h"

#include <doctest/doctest.h>

#include <cmath>
#include <string>

#include "bitcheck/inputs.h"
#include "lighting/lit_points.h"
#include "lighting/shading_passes.h"
#include "numeric/door.h"
#include "numeric/fp_environment.h"
#include "tests/support/box_scene.h"
#include "tests/support/shaded_view.h"

using namespace etalon;
using test::kAllProfiles, test::Lights, test::render, test::requestOf, test::squareView;

namespace {

constexpr double kPi = 3.141592653589793;

}  // namespace

TEST_CASE("ReversedDepthsShowTheSameTriangles") {
    // Things before each other.
    const SurfaceScene scene = demoScene();
    for (const char* name : {"f32", "f64", "truth", "d3d11"}) {
        CAPTURE(name);
        Profile profile = *findProfile(name);
        const auto placed = placeMeshes(scene, profile.vertex, 0);
        const VisibleScene forward = findVisible(scene, placed, demoView(96, 72), profile, 4, {});
        profile.depthDirection = DepthDirection::reversed;
        const VisibleScene reversed = findVisible(scene, placed, demoView(96, 72), profile, 4, {});
        const auto a = forward.target.id.values(), b = reversed.target.id.values();
        size_t different = 0;
        for (size_t i = 0; i < a.size(); i++) different += a[i] != b[i];
        // Of depths that round alike the first is seen.
        CHECK(different <= (profile.vertex == RasterReal::fp64 ? 0 : a.size() / 1000));
    }
}

// Of a wall 1.5 m away.
TEST_CASE("DepthsInBothDirectionsAreThoseOfTheDistance") {
    const SurfaceScene scene = test::box(2, 3, 4);
    for (const char* name : {"f32", "f64", "truth", "d3d11"}) {
        CAPTURE(name);
        Profile profile = *findProfile(name);
        const auto placed = placeMeshes(scene, profile.vertex, 0);
        const View view = cubeFaceView(CubeFace::plusX, 64, {0.5, 0.1, 0.3}, 0.1, 50);
        const auto depth = [&](DepthDirection direction) {
            profile.depthDirection = direction;
            const RenderTarget target = findVisible(scene, placed, view, profile, 1, {}).target;
            return depthFromStored(target.format.depth, target.depth.at(32, 32),
                                   target.lowDepth.empty() ? 0 : target.lowDepth.at(32, 32));
        };
        CHECK(depth(DepthDirection::forward) == doctest::Approx((1 - 0.1 / 1.5) * 50 / 49.9).epsilon(1e-6));
        CHECK(depth(DepthDirection::reversed) == doctest::Approx((50 / 1.5 - 1) * 0.1 / 49.9).epsilon(1e-5));
    }
}

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
        const double unit = test::spacingOf(profile);
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
    ShadeJob job = shadeJobOf(visible, scene, placed, view, profile, {});
    job.request = requestOf({ShadeOutput::beauty, ShadeOutput::specular});
    const ShadedImages kept = shade(job);
    ShadedImages flushed = kept;
    for (Image<float>& image : flushed.images) image.fill(0);
    {
        const FlushToZeroScope flush;
        ShadeStatistics statistics;
        passesIn<ShadingPasses>(profile.fragment)
            ->makeTileShader(job)
            ->run(0, {0, 0, 64, 64}, flushed, statistics);
    }
    for (size_t o = 0; o < kShadeOutputs; o++) CHECK(flushed.images[o] == kept.images[o]);
}

// A rectangle across the view at distance 2, whose corners have normals of their own: in its plane the
// radiance of the vertices is interpolated linearly over each triangle, and in perspective where it is
// tilted. The oracle intersects the pixel's ray with the triangle in world space.
TEST_CASE("LightPerVertexIsInterpolatedOverTheSurface") {
    // Snapping moves a corner by up to 2^-9 pixels in x and y; the radiance changes by up to 0.03 per pixel.
    constexpr double kBound = 2 * 0x1p-9 * 0.03;
    const glm::dvec3 light(0.48, 0.6, 0.64);
    for (const float tilt : {0.0f, 1.2f}) {
        for (const bool fromBehind : {false, true}) {
            SurfaceScene scene;
            SurfaceMesh mesh = test::rectangle({0, 0, -3}, {1, 0, tilt}, {0, 1, 0});
            const glm::vec3 normals[] = {
                {-0.6f, 0, 0.8f}, {0.6f, 0, 0.8f}, {0.6f, 0.64f, 0.48f}, {0, 0.6f, 0.8f}};
            mesh.normals.assign(std::begin(normals), std::end(normals));
            if (fromBehind) {
                for (glm::vec3& n : mesh.normals) n = -n;
                std::swap(mesh.indices[1], mesh.indices[2]);
                std::swap(mesh.indices[4], mesh.indices[5]);
            }
            test::addObject(scene, mesh, test::lambertian(0.5));
            scene.lights.push_back({light, {1, 2, 4}});
            const View view = squareView(64);
            const auto result = render(scene, view, requestOf({ShadeOutput::diffuse, ShadeOutput::distance}),
                                       "f64", 1, {}, Lights::perVertex);
            // What the four corners reflect.
            double corner[4];
            for (size_t k = 0; k < 4; k++) {
                const glm::dvec3 n(normals[k]);
                const double cosine = (n.x * light.x + n.y * light.y + n.z * light.z) /
                                      std::sqrt(n.x * n.x + n.y * n.y + n.z * n.z);
                corner[k] = 0.5 / kPi * std::max(0.0, cosine);
            }
            int seen = 0;
            for (int y = 0; y < 64; y++) {
                for (int x = 0; x < 64; x++) {
                    if (std::isinf(result.images[ShadeOutput::distance].at(x, y))) continue;
                    // (dx, dy, -1) t = (a, b, -3 + a tilt)
                    const double dx = (x + 0.5) / 32 - 1, dy = 1 - (y + 0.5) / 32;
                    const double t = 3 / (1 + dx * tilt), a = dx * t, b = dy * t;
                    if (std::fabs(a - b) < 0.05) continue;  // near the diagonal either triangle
                    const double u = (a + 1) / 2, v = (b + 1) / 2;
                    const double expected = a > b ? (1 - u) * corner[0] + (u - v) * corner[1] + v * corner[2]
                                                  : (1 - v) * corner[0] + u * corner[2] + (v - u) * corner[3];
                    for (int c = 0; c < 3; c++)
                        CHECK(std::fabs(result.images[ShadeOutput::diffuse].at(x, y, c) -
                                        expected * (c == 0   ? 1
                                                    : c == 1 ? 2
                                                             : 4)) < kBound);
                    seen++;
                }
            }
            CHECK(seen > 300);
        }
    }
}

// A white plate that faces a point light at distance h, d beside the foot: I cos / r^2 = I h / (h^2 +
// d^2)^(3/2). Inside the inner cone of a spot the same, outside the outer cone nothing, between them 3 t^2 -
// 2 t^3.
TEST_CASE("PointAndSpotLightsFollowTheInverseSquare") {
    constexpr double kBound = 4e-7;  // relative, of the values in float
    SurfaceScene scene;
    test::addObject(scene, test::rectangle({0, 0, -4}, {4, 0, 0}, {0, 4, 0}), test::lambertian(1));
    SurfaceLight light;
    light.kind = LightKind::point;
    light.position_m = {0.5, -0.25, -2};
    light.intensity = {kPi, 2 * kPi, 4 * kPi};
    light.axis = {0, 0, -1};
    light.cosInner = 0.9;
    light.cosOuter = 0.8;
    for (const LightKind kind : {LightKind::point, LightKind::spot}) {
        light.kind = kind;
        scene.lights = {light};
        const auto result = render(scene, squareView(32), requestOf({ShadeOutput::diffuse}), "f64");
        int parts[3] = {0, 0, 0};
        for (int y = 0; y < 32; y++) {
            for (int x = 0; x < 32; x++) {
                const double px = 4 * ((x + 0.5) / 16 - 1), py = 4 * (1 - (y + 0.5) / 16);
                const double dx = px - 0.5, dy = py + 0.25, h = 2;
                const double r = std::sqrt(h * h + dx * dx + dy * dy);
                const double t = std::clamp((h / r - 0.8) / (0.9 - 0.8), 0.0, 1.0);
                const double part = kind == LightKind::point ? 1.0 : t * t * (3 - 2 * t);
                parts[part == 0 ? 0 : part == 1 ? 2 : 1]++;
                for (int c = 0; c < 3; c++)
                    CHECK(result.images[ShadeOutput::diffuse].at(x, y, c) ==
                          doctest::Approx(part * h / (r * r * r) * (1 << c)).epsilon(kBound));
            }
        }
        if (kind == LightKind::spot)
            for (const int count : parts) CHECK(count > 10);
    }
}

// At the light itself, and with a cone that no point is in, the result is 0 and finite in every profile.
TEST_CASE("ALightInTheSurfaceIsDarkAndFinite") {
    SurfaceScene scene;
    test::addObject(scene, test::rectangle({0, 0, -4}, {4, 0, 0}, {0, 4, 0}), test::lambertian(1));
    SurfaceLight light;
    light.kind = LightKind::point;
    light.position_m = {0, 0, -4};
    light.intensity = glm::dvec3(1);
    scene.lights = {light};
    for (const char* profile : kAllProfiles) {
        const auto result = render(scene, squareView(7), requestOf({ShadeOutput::diffuse}), profile);
        CHECK(result.images[ShadeOutput::diffuse].at(3, 3) == 0.0f);
        for (const float v : result.images[ShadeOutput::diffuse].values()) CHECK(std::isfinite(v));
    }
}

// A visibility of each point of 0, 1/2 and 1 takes that part of the light, and points and normals are those
// of the surface.
TEST_CASE("VisibilityScalesEachLightAndSeesTheSurface") {
    struct Halves final : LightVisibility {
        bool casts(size_t light) const override { return light == 1; }
        void find(size_t, const LitPoints& points, std::span<double> visibility) const override {
            for (size_t i = 0; i < points.size(); i++) {
                if (points.instance[i] == std::numeric_limits<uint32_t>::max()) continue;
                CHECK(points.position_m[2][i] == doctest::Approx(-4).epsilon(1e-6));
                CHECK(points.faceNormal[2][i] == 1.0);
                CHECK(points.normal[2][i] == 1.0);
                CHECK(points.instance[i] == 0);
                // Pixels of 1/8 metre at this distance.
                CHECK(points.position_m[0][i] ==
                      doctest::Approx((points.x_px[i] + 0.5) / 4 - 4).epsilon(1e-5));
                visibility[i] = points.x_px[i] % 3 / 2.0;
            }
        }
    };
    SurfaceScene scene;
    test::addObject(scene, test::rectangle({0, 0, -4}, {4, 0, 0}, {0, 4, 0}), test::lambertian(1));
    for (const bool mirrored : {false, true}) {
        if (mirrored) {
            scene.instances[0].toWorld[0][0] = -1;
            scene.instances[0].normalToWorld[0][0] = -1;
        }
        scene.lights = {{{0, 0, 1}, glm::dvec3(1)}};
        const View view = squareView(32);
        const Profile& profile = *findProfile("f32");
        const auto placed = placeMeshes(scene, profile.vertex, 1);
        const VisibleScene visible = findVisible(scene, placed, view, profile, 1, {});
        const auto diffuse = [&](const LightVisibility* visibility) {
            ShadeJob job = shadeJobOf(visible, scene, placed, view, profile, {});
            job.request = requestOf({ShadeOutput::diffuse});
            job.visibility = visibility;
            return shade(job)[ShadeOutput::diffuse];
        };
        const Image<float> one = diffuse(nullptr);
        scene.lights.push_back({{0, 0, 1}, glm::dvec3(1)});
        const Halves halves;
        const Image<float> both = diffuse(&halves);
        for (int y = 0; y < 32; y++)
            for (int x = 0; x < 32; x++)
                CHECK(both.at(x, y) == one.at(x, y) + one.at(x, y) * static_cast<float>(x % 3) / 2);
    }
}

// A light that shines along the normals of a flat surface is the same at every vertex and pixel.
TEST_CASE("LightPerVertexOfAFlatSurfaceIsThatPerPixel") {
    SurfaceScene scene = test::box(2, 3, 4);
    scene.lights.push_back({{0.6, 0.0, 0.8}, {1, 2, 3}});
    for (const char* profile : {"f32", "f64"}) {
        const ShadeRequest request = requestOf({ShadeOutput::diffuse});
        const auto pixels = render(scene, squareView(48), request, profile);
        const auto vertices = render(scene, squareView(48), request, profile, 1, {}, Lights::perVertex);
        for (size_t i = 0; i < pixels.images[ShadeOutput::diffuse].values().size(); i++)
            CHECK(pixels.images[ShadeOutput::diffuse].values()[i] ==
                  doctest::Approx(vertices.images[ShadeOutput::diffuse].values()[i]).epsilon(2e-7));
    }
}

// A mirror below Blinn-Phong's lobe [Karlsson2005]: the components are those of the two materials alone.
TEST_CASE("ReflectanceAddsAMirrorToBlinnPhong") {
    SurfaceScene scene = test::box(2, 3, 4);
    scene.environment.constant = {0.5, 1, 2};
    scene.lights.push_back({{0.6, 0.0, 0.8}, {1, 2, 3}});
    for (SurfaceMaterial& material : scene.materials) {
        material.kind = MaterialKind::blinnPhong;
        material.specular = glm::dvec3(0.25);
        material.exponent = 12;
    }
    const ShadeRequest request = requestOf({ShadeOutput::beauty, ShadeOutput::ambient, ShadeOutput::diffuse,
                                            ShadeOutput::specular, ShadeOutput::mirror});
    const auto plain = render(scene, squareView(32), request);
    for (SurfaceMaterial& material : scene.materials) material.reflectance = {0.5, 0.25, 0.125};
    const auto combined = render(scene, squareView(32), request);
    for (const ShadeOutput output : {ShadeOutput::ambient, ShadeOutput::diffuse, ShadeOutput::specular})
        CHECK(combined.images[output] == plain.images[output]);
    for (int y = 0; y < 32; y++)
        for (int x = 0; x < 32; x++)
            for (int c = 0; c < 3; c++) {
                CHECK(plain.images[ShadeOutput::mirror].at(x, y, c) == 0.0f);
                CHECK(combined.images[ShadeOutput::mirror].at(x, y, c) == 0.25f);
                CHECK(combined.images[ShadeOutput::beauty].at(x, y, c) ==
                      plain.images[ShadeOutput::beauty].at(x, y, c) + 0.25f);
            }
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

// What shading asks about is what the images of normals and distances show.
TEST_CASE("LitPointsAreThoseOfTheImages") {
    const SurfaceScene scene = test::box(2, 3, 4);
    for (const char* name : {"f32", "f64", "fp16"}) {
        const Profile& profile = *findProfile(name);
        const auto placed = placeMeshes(scene, profile.vertex, 1);
        PinholeCamera camera;
        camera.width = 70;
        camera.height = 40;
        camera.fx = camera.fy = 30;
        camera.cx = 35;
        camera.cy = 20;
        camera.position = {0.5, 3.5, 1};
        const View view = cameraView(camera);
        const VisibleScene visible = findVisible(scene, placed, view, profile, 1, {});
        ShadeJob job = shadeJobOf(visible, scene, placed, view, profile, {});
        job.tileSize = 16;
        job.request = requestOf({ShadeOutput::normals, ShadeOutput::distance});
        const ShadedImages images = shade(job);
        const LitPoints points = litPointsOf(job);
        size_t covered = 0;
        for (const float d : images[ShadeOutput::distance].values()) covered += std::isfinite(d) ? 1 : 0;
        CHECK(points.size() == covered);
        CHECK(covered > 0);
        CHECK(covered < images[ShadeOutput::distance].pixelCount());
        for (size_t i = 0; i < points.size(); i++) {
            const int x = static_cast<int>(points.x_px[i]), y = static_cast<int>(points.y_px[i]);
            double squared = 0;
            for (int c = 0; c < 3; c++) {
                const auto k = static_cast<size_t>(c);
                CHECK(static_cast<float>(points.normal[k][i]) == images[ShadeOutput::normals].at(x, y, c));
                CHECK(std::fabs(points.faceNormal[k][i] - points.normal[k][i]) < 1e-3);
                const double d = points.position_m[k][i] - camera.position[c];
                squared += d * d;
            }
            CHECK(std::sqrt(squared) ==
                  doctest::Approx(images[ShadeOutput::distance].at(x, y)).epsilon(2e-3));
            const uint32_t id = visible.target.id.at(x, y);
            CHECK(points.instance[i] == visible.instanceOfDraw[visible.target.triangles[id].draw]);
        }
        const LitPoints left =
            litPointsOf(job, [](const LitPoints& all, size_t i) { return all.x_px[i] < 35; });
        CHECK(left.size() > 0);
        for (const uint32_t x : left.x_px) CHECK(x < 35);
    }
}
