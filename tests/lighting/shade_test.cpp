// What light makes of a surface, where that is known without a program.
#include "lighting/shade.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>

#include "lighting/render_view.h"
#include "numeric/vectors.h"
#include "probes/convert.h"
#include "probes/harmonics_lobes.h"
#include "probes/irradiance.h"
#include "probes/texel_grid.h"
#include "tests/support/box_scene.h"
#include "tests/support/shaded_view.h"

using namespace etalon;
using test::kAllProfiles, test::render, test::requestOf, test::squareView, test::spacingOf;

namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr int kSize_px = 9;

// A plate that fills the view, its normals as given.
SurfaceScene plate(const SurfaceMaterial& material, glm::vec3 normal = {0, 0, 1}) {
    SurfaceScene scene;
    test::addObject(scene, test::rectangle({0, 0, -2}, {3, 0, 0}, {0, 3, 0}), material);
    for (glm::vec3& n : scene.meshes[0].normals) n = normal;
    return scene;
}
SurfaceMaterial coloured(const glm::dvec3& albedo) {
    SurfaceMaterial material;
    material.diffuse = albedo;
    return material;
}
SurfaceMaterial glossy() {
    SurfaceMaterial material;
    material.kind = MaterialKind::blinnPhong;
    material.diffuse = {0.5, 0.25, 0.75};
    material.specular = {0.25, 0.5, 0.125};
    material.exponent = 20;
    material.reflectance = glm::dvec3(0.5);
    return material;
}

// Unit vectors in front of the plate.
const glm::dvec3 kDirections[] = {{0, 0, 1}, {0.6, 0, 0.8}, {0, -0.96, 0.28}, {0.48, 0.6, 0.64}};

// A lat-long image of one radiance, and what it is for surfaces.
constexpr int kSkyWidth = 64, kSkyHeight = 32;
Probe constantProbe(const glm::dvec3& radiance) {
    Image<float> image(kSkyWidth, kSkyHeight, 3);
    for (int c = 0; c < 3; c++) std::ranges::fill(image.plane(c), static_cast<float>(radiance[c]));
    return probeOf(image, Mapping::latLong);
}
EnvironmentLight lightOf(EnvironmentLight::Kind kind, const Probe& probe) {
    EnvironmentLight light;
    light.kind = kind;
    if (kind == EnvironmentLight::Kind::harmonics)
        light.harmonics = irradianceOfHarmonics(projectHarmonics(probe, 2));
    if (kind == EnvironmentLight::Kind::map)
        light.map = cubeMapOf(irradianceProbe(probe, {Mapping::cube, 16, 16}, Arithmetic::fp64));
    if (kind != EnvironmentLight::Kind::texels) return light;
    const TexelGrid grid(probe.shape);
    for (int y = 0; y < kSkyHeight; y++)
        for (int x = 0; x < kSkyWidth; x++) {
            const Image<float>& image = probe.radiance[0];
            light.directions.push_back(grid.direction(0, x, y));
            light.flux.push_back(grid.solidAngle_sr(0, x, y) *
                                 glm::dvec3(image.at(x, y, 0), image.at(x, y, 1), image.at(x, y, 2)));
        }
    return light;
}
constexpr EnvironmentLight::Kind kKinds[] = {EnvironmentLight::Kind::harmonics,
                                             EnvironmentLight::Kind::texels, EnvironmentLight::Kind::map};

}  // namespace

// Albedo / pi times irradiance times cosine. Rounded are the light's direction and irradiance, 1 / pi, the
// albedo, the normal, and four products: within six units of the format.
TEST_CASE("LambertIsAlbedoOverPiTimesIrradianceTimesCosine") {
    const glm::dvec3 albedo(0.3, 0.6, 0.9), irradiance(1.5, 2.5, 0.7);
    SurfaceScene scene = plate(coloured(albedo));
    for (const glm::dvec3& direction : kDirections)
        for (const bool isBehind : {false, true}) {
            scene.lights = {{isBehind ? -direction : direction, irradiance}};
            for (const char* profile : kAllProfiles) {
                CAPTURE(profile);
                const auto image =
                    render(scene, squareView(kSize_px), requestOf({ShadeOutput::diffuse}), profile)
                        .images[ShadeOutput::diffuse];
                for (int c = 0; c < 3; c++) {
                    const double expected = isBehind ? 0 : albedo[c] / kPi * irradiance[c] * direction.z;
                    for (const float value : image.plane(c))
                        CHECK(std::fabs(value - expected) <= 6 * spacingOf(profile) * expected);
                }
            }
        }
}

TEST_CASE("AmbientLightAloneIsAlbedoTimesAmbient") {
    SurfaceScene scene = plate(coloured({0.5, 0.25, 1}));
    scene.ambient = {0.75, 2, 0.125};
    for (const char* profile : kAllProfiles) {
        CAPTURE(profile);
        const auto images = render(scene, squareView(kSize_px),
                                   requestOf({ShadeOutput::ambient, ShadeOutput::beauty}), profile)
                                .images;
        // Every product is a number of every format.
        for (int c = 0; c < 3; c++)
            for (const float value : images[ShadeOutput::ambient].plane(c))
                CHECK(value == std::array{0.375f, 0.5f, 0.125f}[static_cast<size_t>(c)]);
        CHECK(images[ShadeOutput::beauty] == images[ShadeOutput::ambient]);
    }
}

// Irradiance pi L from all sides. Bound: the midpoint rule of 64 x 32 texels, as in WhiteFurnaceIsPi.
TEST_CASE("AConstantEnvironmentIsReflectedAsAlbedoTimesItsRadiance") {
    constexpr double kBound = 1.5e-3;
    const glm::dvec3 albedo(0.5, 0.25, 0.75), radiance(1, 3, 0.2);
    const Probe probe = constantProbe(radiance);
    for (const EnvironmentLight::Kind kind : kKinds)
        for (const glm::dvec3& normal : kDirections) {
            SurfaceScene scene = plate(coloured(albedo), glm::vec3(normal));
            scene.environment.light = lightOf(kind, probe);
            for (const char* profile : {"f32", "f64"}) {
                CAPTURE(static_cast<int>(kind));
                CAPTURE(normal.y);
                const auto image =
                    render(scene, squareView(kSize_px), requestOf({ShadeOutput::diffuse}), profile)
                        .images[ShadeOutput::diffuse];
                for (int c = 0; c < 3; c++)
                    for (const float value : image.plane(c))
                        CHECK(std::fabs(value / (albedo[c] * radiance[c]) - 1) <= kBound);
            }
        }
}

// Irradiance is not negative: where the harmonics ring below 0 there is no light.
TEST_CASE("NegativeIrradianceOfHarmonicsIsDark") {
    for (const double z : {-1.0, 1.0}) {
        SurfaceScene scene = plate(coloured(glm::dvec3(1)));
        EnvironmentLight& light = scene.environment.light;
        light.kind = EnvironmentLight::Kind::harmonics;
        light.harmonics = SphericalHarmonics(1);
        light.harmonics.at(1, 0) = glm::dvec3(z);
        const auto image = render(scene, squareView(kSize_px), requestOf({ShadeOutput::diffuse}))
                               .images[ShadeOutput::diffuse];
        for (const float value : image.values()) CHECK((z < 0 ? value == 0 : value > 0.1f));
    }
}

// Each is a term of one sum that begins with 0.
TEST_CASE("TwoLightsAddUp") {
    SurfaceLight lamp;
    lamp.kind = LightKind::point;
    lamp.position_m = {1, 0.5, 0.5};
    lamp.intensity = {2, 1, 3};
    const SurfaceLight sun{{0.48, 0.6, 0.64}, {1, 2, 3}};
    for (const char* profile : {"f32", "f64", "fp16"}) {
        CAPTURE(profile);
        SurfaceScene scene = plate(glossy());
        const ShadeRequest request = requestOf({ShadeOutput::diffuse, ShadeOutput::specular});
        const auto under = [&](std::vector<SurfaceLight> lights) {
            scene.lights = std::move(lights);
            return render(scene, squareView(kSize_px), request, profile).images;
        };
        const ShadedImages first = under({sun}), second = under({lamp}), both = under({sun, lamp});
        for (const ShadeOutput output : {ShadeOutput::diffuse, ShadeOutput::specular}) {
            double largest = 0;
            for (size_t i = 0; i < both[output].values().size(); i++) {
                const float sum = first[output].values()[i] + second[output].values()[i];
                // The images of f64 are rounded, each once; those of fp16 are sums that fp16 rounds.
                CHECK(both[output].values()[i] == doctest::Approx(sum).epsilon(spacingOf(profile)));
                if (std::string(profile) == "f32") CHECK(both[output].values()[i] == sum);
                largest = std::max(largest, double{sum});
            }
            CHECK(largest > 0.01);
        }
    }
}

// A cube map whose texels hold the directions of their centres, of the length where the largest component is
// 1: between centres bilinear look-up gives the direction itself. The mirror shows it where the ray from the
// eye goes on, turned with the environment; not compared is the seam of half a texel between faces.
TEST_CASE("AMirrorShowsTheEnvironmentInTheMirrorDirection") {
    constexpr int kTexels = 16, kView_px = 48;
    // Snapping moves a vertex, and so the ray to what a pixel shows, by up to 2^-9 pixels in x and y.
    constexpr double kBound = 2 * 0x1p-9 * 2 / kView_px;
    CubeMap<float> cube(kTexels, 3);
    for (int f = 0; f < kCubeFaces; f++)
        for (int y = 0; y < kTexels; y++)
            for (int x = 0; x < kTexels; x++) {
                CubeFaceKernel<double> kernel;
                const auto d = kernel.cubeDirection(f, (x + 0.5) / kTexels, (y + 0.5) / kTexels);
                for (int c = 0; c < 3; c++)
                    cube.faces[static_cast<size_t>(f)].at(x, y, c) = static_cast<float>(d[c]);
            }
    SurfaceMaterial chrome;
    chrome.kind = MaterialKind::mirror;
    chrome.reflectance = {0.5, 0.25, 1};
    SurfaceScene scene;
    test::addObject(scene, test::rectangle({0, 0, -2}, {8, 0, 3}, {0, 8, -2}), chrome);
    const glm::dvec3 normal = unitOf(glm::dvec3(scene.meshes[0].normals[0]));
    scene.environment.latLong = Image<float>(4 * kTexels, 2 * kTexels, 3);
    scene.environment.cosRotation = 0.28;
    scene.environment.sinRotation = 0.96;
    const auto image = render(scene, squareView(kView_px), requestOf({ShadeOutput::mirror}), "f32", 1, {},
                              test::Lights::perPixel, [&](ShadeJob& job) { job.environmentCube = &cube; })
                           .images[ShadeOutput::mirror];
    std::array<int, kCubeFaces> seen{};
    for (int y = 0; y < kView_px; y++)
        for (int x = 0; x < kView_px; x++) {
            const glm::dvec3 ray((x + 0.5) * 2 / kView_px - 1, 1 - (y + 0.5) * 2 / kView_px, -1);
            const glm::dvec3 r = ray - 2 * dotOf(ray, normal) * normal;
            // Back by the turn of the environment about +Y, which takes Z to X.
            const glm::dvec3 d(0.28 * r.x - 0.96 * r.z, r.y, 0.28 * r.z + 0.96 * r.x);
            int major = 0;
            for (int c = 1; c < 3; c++)
                if (std::fabs(d[c]) > std::fabs(d[major])) major = c;
            bool isSeam = false;
            for (int c = 0; c < 3; c++)
                isSeam = isSeam || (c != major && std::fabs(d[c] / d[major]) > 1 - 1.01 / kTexels);
            if (isSeam) continue;
            seen[static_cast<size_t>(2 * major + (d[major] < 0 ? 1 : 0))]++;
            for (int c = 0; c < 3; c++)
                CHECK(std::fabs(image.at(x, y, c) - chrome.reflectance[c] * d[c] / std::fabs(d[major])) <
                      kBound);
        }
    CHECK(std::ranges::count_if(seen, [](int count) { return count > 30; }) >= 2);
}

// Two plates side by side, one in front of the other's edge, on black: every mixture of three values.
TEST_CASE("APixelOfFourSamplesIsTheMeanOfWhatTheyShow") {
    SurfaceScene scene;
    test::addObject(scene, test::rectangle({-0.4f, 0.1f, -2}, {0.8f, 0.3f, 0}, {0.1f, 0.9f, 0}),
                    coloured({0.25, 0.5, 1}));
    test::addObject(scene, test::rectangle({0.6f, -0.1f, -1.9f}, {0.9f, 0.2f, 0}, {-0.3f, 0.7f, 0}),
                    coloured({0.75, 0.125, 0}));
    scene.ambient = glm::dvec3(1);
    const Profile& profile = *findProfile("f32");
    const View view = squareView(40);
    const auto placed = placeMeshes(scene, profile.vertex, 1);
    const VisibleScene visible = findVisible(scene, placed, view, profile, 4, {});
    ShadeJob job = shadeJobOf(visible, scene, placed, view, profile, {});
    job.request = requestOf({ShadeOutput::beauty});
    const Image<float> beauty = shade(job)[ShadeOutput::beauty];
    int mixed = 0;
    for (size_t p = 0; p < beauty.pixelCount(); p++) {
        glm::dvec3 sum(0);
        bool shows[2] = {false, false};
        for (int s = 0; s < 4; s++) {
            const uint32_t id = visible.target.id.plane(s)[p];
            if (id == kNoTriangle) continue;
            const uint32_t instance = visible.instanceOfDraw[visible.target.triangles[id].draw];
            sum = sum + scene.materials[instance].diffuse;
            shows[instance] = true;
        }
        mixed += shows[0] && shows[1] ? 1 : 0;
        // Sums of a few eighths are exact.
        for (int c = 0; c < 3; c++) CHECK(beauty.plane(c)[p] == static_cast<float>(sum[c] / 4));
    }
    CHECK(mixed > 10);
}

namespace {

// Half of what surrounds a pixel of an even sum of coordinates is open, else a quarter, upwards.
double openOf(uint32_t x_px, uint32_t y_px) { return (x_px + y_px) % 2 == 0 ? 0.5 : 0.25; }
TileOcclusion checkeredOcclusion(const ShadeJob& job) {
    TileOcclusion occlusion;
    for (const LitPoints& points : fragmentPoints(job)) {
        occlusion.emplace_back();
        for (size_t i = 0; i < points.size(); i++)
            occlusion.back().push_back({openOf(points.x_px[i], points.y_px[i]), {0, 1, 0}});
    }
    return occlusion;
}

}  // namespace

// What comes from everywhere is cut to what is open: the ambient light, and the irradiance in the bent
// normal. Lights are not.
TEST_CASE("OcclusionTakesOfWhatComesFromEverywhere") {
    SurfaceScene scene = plate(coloured({1, 0.5, 0.25}));
    scene.ambient = glm::dvec3(1);
    const ShadeRequest request = requestOf({ShadeOutput::ambient, ShadeOutput::diffuse});
    const auto shaded = [&](bool isOccluded) {
        TileOcclusion occlusion;
        return render(scene, squareView(kSize_px), request, "f32", 1, {}, test::Lights::perPixel,
                      [&](ShadeJob& job) {
                          occlusion = checkeredOcclusion(job);
                          if (isOccluded) job.occlusion = &occlusion;
                      })
            .images;
    };
    scene.lights = {{{0, 0, 1}, glm::dvec3(1)}};
    CHECK(shaded(true)[ShadeOutput::diffuse] == shaded(false)[ShadeOutput::diffuse]);
    const Image<float> ambient = shaded(true)[ShadeOutput::ambient],
                       open = shaded(false)[ShadeOutput::ambient];
    scene.lights.clear();
    // Irradiance pi from the side of +Y, 0 in the plate's own normal.
    EnvironmentLight& light = scene.environment.light;
    light.kind = EnvironmentLight::Kind::harmonics;
    light.harmonics = SphericalHarmonics(1);
    light.harmonics.at(1, -1) = glm::dvec3(-kPi / 0.4886025119029199);
    const Image<float> bent = shaded(true)[ShadeOutput::diffuse],
                       straight = shaded(false)[ShadeOutput::diffuse];
    for (const float value : straight.values()) CHECK(value == 0);
    for (int y = 0; y < kSize_px; y++)
        for (int x = 0; x < kSize_px; x++)
            for (int c = 0; c < 3; c++) {
                const double part = openOf(static_cast<uint32_t>(x), static_cast<uint32_t>(y));
                CHECK(ambient.at(x, y, c) == static_cast<float>(part) * open.at(x, y, c));
                CHECK(bent.at(x, y, c) ==
                      doctest::Approx(part * scene.materials[0].diffuse[c]).epsilon(1e-6));
            }
}

// A view with everything that shading reads, four samples a pixel, occlusion of its own for every tile.
TEST_CASE("TilesAndThreadsChangeNoBitUnderAnEnvironment") {
    SurfaceScene scene = test::box(2, 3, 4);
    test::addObject(scene, test::rectangle({0.3f, 0.2f, -2}, {0.7f, 0.2f, 0}, {0.1f, 0.8f, 0.3f}), glossy());
    scene.materials[5].checker = true;
    scene.materials[5].checkerSize_m = 0.3;
    scene.lights = {{{0.6, 0, 0.8}, {1, 2, 3}}};
    scene.environment.light = lightOf(EnvironmentLight::Kind::harmonics, constantProbe({1, 2, 3}));
    const ShadeRequest request =
        requestOf({ShadeOutput::beauty, ShadeOutput::ambient, ShadeOutput::diffuse, ShadeOutput::mirror});
    const auto shaded = [&](const RasterOptions& options) {
        TileOcclusion occlusion;
        return render(scene, squareView(90), request, "f32", 4, options, test::Lights::perPixel,
                      [&](ShadeJob& job) {
                          occlusion = checkeredOcclusion(job);
                          job.occlusion = &occlusion;
                      })
            .images;
    };
    const ShadedImages reference = shaded({1, 64});
    for (const int threads : {1, 2, 7})
        for (const int tile : {16, 40, 128}) {
            const ShadedImages other = shaded({threads, tile});
            for (size_t o = 0; o < kShadeOutputs; o++) CHECK(other.images[o] == reference.images[o]);
        }
}

// To the bit, of every kind, whether or not the parts that reflect nothing are evaluated.
TEST_CASE("ABlackMaterialReflectsNothing") {
    SurfaceScene scene = plate(glossy());
    SurfaceMaterial& black = scene.materials[0];
    black.diffuse = black.specular = black.reflectance = glm::dvec3(0);
    scene.ambient = glm::dvec3(1);
    scene.lights = {{{0.6, 0, 0.8}, {1, 2, 3}}};
    scene.environment.constant = glm::dvec3(5);
    scene.environment.light = lightOf(EnvironmentLight::Kind::harmonics, constantProbe({1, 2, 3}));
    for (const MaterialKind kind : {MaterialKind::lambert, MaterialKind::blinnPhong, MaterialKind::mirror})
        for (const bool everyPart : {false, true}) {
            black.kind = kind;
            const auto images =
                render(scene, squareView(kSize_px),
                       requestOf({ShadeOutput::ambient, ShadeOutput::diffuse, ShadeOutput::specular,
                                  ShadeOutput::mirror, ShadeOutput::beauty}),
                       "f32", 1, {}, test::Lights::perPixel,
                       [&](ShadeJob& job) { job.everyPart = everyPart; })
                    .images;
            for (const Image<float>& image : images.images)
                for (const float value : image.values()) CHECK(value == 0);
        }
}

// Of a light with NaN in its red: the other channels, what no light makes, what is not evaluated, and all of
// it where the light is not shown.
TEST_CASE("ALightThatIsNoNumberStaysInItsChannelAndItsComponents") {
    SurfaceScene scene = plate(glossy());
    scene.ambient = glm::dvec3(0.5);
    scene.environment.constant = glm::dvec3(1);
    const SurfaceLight good{{0.6, 0, 0.8}, {1, 2, 3}};
    SurfaceLight bad = good;
    bad.irradiance.x = kNan;
    ShadeRequest request = requestOf({ShadeOutput::ambient, ShadeOutput::diffuse, ShadeOutput::specular,
                                      ShadeOutput::mirror, ShadeOutput::beauty, ShadeOutput::normals});
    const std::vector<bool> firstOnly = {true, false};
    const auto under = [&](const SurfaceLight& light, bool showsSecond) {
        scene.lights = {good, light};
        return render(scene, squareView(kSize_px), request, "f32", 1, {}, test::Lights::perPixel,
                      [&](ShadeJob& job) {
                          if (!showsSecond) job.sources.shows = &firstOnly;
                      })
            .images;
    };
    const ShadedImages clean = under(good, true), spoilt = under(bad, true);
    for (const ShadeOutput output : {ShadeOutput::ambient, ShadeOutput::mirror, ShadeOutput::normals})
        CHECK(spoilt[output] == clean[output]);
    for (const ShadeOutput output : {ShadeOutput::diffuse, ShadeOutput::specular, ShadeOutput::beauty}) {
        for (const float value : spoilt[output].plane(0)) CHECK(std::isnan(value));
        for (const int c : {1, 2}) CHECK(std::ranges::equal(spoilt[output].plane(c), clean[output].plane(c)));
    }
    const ShadedImages hidden = under(bad, false), alone = under(good, false);
    for (size_t o = 0; o < kShadeOutputs; o++) CHECK(hidden.images[o] == alone.images[o]);
    for (const ShadeOutput component : {ShadeOutput::diffuse, ShadeOutput::specular})
        request.evaluated[static_cast<size_t>(component)] = false;
    const ShadedImages without = under(bad, true);
    for (const float value : without[ShadeOutput::diffuse].values()) CHECK(value == 0);
    for (size_t i = 0; i < without[ShadeOutput::beauty].values().size(); i++)
        CHECK(without[ShadeOutput::beauty].values()[i] ==
              without[ShadeOutput::ambient].values()[i] + without[ShadeOutput::mirror].values()[i]);
}

// Wanted are images, evaluated components: the beauty is the sum of those, whether or not they are images.
TEST_CASE("TheBeautyAddsWhatIsEvaluated") {
    SurfaceScene scene = plate(glossy());
    scene.ambient = glm::dvec3(0.5);
    scene.lights = {{{0.6, 0, 0.8}, {1, 2, 3}}};
    scene.environment.constant = glm::dvec3(1);
    const ShadedImages all = render(scene, squareView(kSize_px),
                                    requestOf({ShadeOutput::ambient, ShadeOutput::diffuse,
                                               ShadeOutput::specular, ShadeOutput::mirror}))
                                 .images;
    for (int mask = 0; mask < 16; mask++) {
        ShadeRequest request = requestOf({ShadeOutput::beauty});
        for (int o = 0; o < 4; o++) request.evaluated[o] = (mask >> o & 1) != 0;
        const ShadedImages images = render(scene, squareView(kSize_px), request).images;
        for (size_t o = 0; o < kShadeOutputs; o++)
            CHECK(images.images[o].empty() == (o != static_cast<size_t>(ShadeOutput::beauty)));
        for (size_t i = 0; i < images[ShadeOutput::beauty].values().size(); i++) {
            float sum = 0;
            for (size_t o = 0; o < 4; o++)
                if (request.evaluated[o]) sum += all.images[o].values()[i];
            CHECK(images[ShadeOutput::beauty].values()[i] == sum);
        }
    }
}
