#include "ar/environment_light.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "lighting/environment_lighting.h"
#include "probes/convert.h"
#include "probes/harmonics_lobes.h"
#include "probes/irradiance.h"
#include "probes/latlong.h"
#include "probes/median_cut.h"

using namespace etalon;

namespace {

constexpr double kPi = 3.141592653589793;

// The radiance 1 + x / 2 of an environment's own axes, turned by a quarter about +Y: its +X lies at -Z in the
// world. The irradiance is pi + pi / 3 times the cosine to that axis.
SurfaceScene sceneUnderSlope(int width) {
    SurfaceScene scene;
    scene.environment.latLong = Image<float>(width, width / 2, 3);
    const LatLongGrid grid(width, width / 2);
    for (int y = 0; y < width / 2; y++)
        for (int x = 0; x < width; x++)
            for (int c = 0; c < 3; c++)
                scene.environment.latLong.at(x, y, c) =
                    static_cast<float>((c + 1) * (1 + grid.direction(x, y).x / 2));
    scene.environment.cosRotation = 0;
    scene.environment.sinRotation = 1;
    return scene;
}

Environment environmentOf(EnvironmentLightMethod lighting) {
    Environment environment;
    environment.kind = EnvironmentKind::file;
    environment.lighting = lighting;
    return environment;
}

void addEnvironmentLight(const Environment& environment, const Profile& profile, int threads,
                         SurfaceScene& scene) {
    EnvironmentIllumination illumination =
        environmentIllumination(environment, scene.environment, profile, threads);
    for (const ProbeLight& light : illumination.lights) scene.lights.push_back(surfaceLightOf(light));
    scene.environment.light = std::move(illumination.diffuse);
}

glm::dvec3 irradianceOf(const SurfaceScene& scene, const glm::dvec3& n) {
    EnvironmentLighting<double> lighting(scene.environment.light, {});
    glm::dvec3 sum = lighting.environmentIrradiance(n);
    for (const SurfaceLight& light : scene.lights) {
        const double cosine = n.x * light.toLight.x + n.y * light.toLight.y + n.z * light.toLight.z;
        for (int c = 0; c < 3; c++) sum[c] += std::max(0.0, cosine) * light.irradiance[c];
    }
    return sum;
}

const glm::dvec3 kNormals[] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0},         {0, -1, 0},
                               {0, 0, 1}, {0, 0, -1}, {0.48, 0.6, 0.64}, {-0.48, -0.6, -0.64}};

}  // namespace

// Bounds: the midpoint rule of 64 x 32 texels and interpolation in a map of 32 texels a face; 256 lights.
TEST_CASE("EveryLightOfTheEnvironmentGivesTheIrradianceOfASlope") {
    const std::pair<EnvironmentLightMethod, double> kBounds[] = {{EnvironmentLightMethod::harmonics, 1e-3},
                                                                 {EnvironmentLightMethod::exact, 2e-3},
                                                                 {EnvironmentLightMethod::map, 4e-3},
                                                                 {EnvironmentLightMethod::lights, 2e-2}};
    for (const auto& [lighting, bound] : kBounds) {
        SurfaceScene scene = sceneUnderSlope(64);
        Environment environment = environmentOf(lighting);
        environment.lightCount = 256;
        addEnvironmentLight(environment, *findProfile("f64"), 1, scene);
        for (const glm::dvec3& n : kNormals)
            for (int c = 0; c < 3; c++)
                CHECK(irradianceOf(scene, n)[c] ==
                      doctest::Approx((c + 1) * (kPi - kPi / 3 * n.z)).epsilon(bound));
    }
}

// What the pass makes is what the probes' own functions make in the arithmetic, and not what they make in double.
TEST_CASE("EnvironmentLightIsMadeInTheProfilesArithmetic") {
    constexpr int kMapSize = 8;
    SurfaceScene scene = sceneUnderSlope(32);
    // Not turned: its own axes are the world's.
    scene.environment.cosRotation = 1;
    scene.environment.sinRotation = 0;
    Probe probe;
    probe.shape = {Mapping::latLong, 32, 16};
    probe.radiance.push_back(scene.environment.latLong);
    const ProbeShape cube{Mapping::cube, kMapSize, kMapSize};
    const auto made = [&](EnvironmentLightMethod method, const Arithmetic& arithmetic) {
        Environment environment = environmentOf(method);
        environment.mapSize = kMapSize;
        environment.lightCount = 16;
        Profile profile = *findProfile("f32");
        profile.environment = arithmetic;
        return environmentIllumination(environment, scene.environment, profile, 1);
    };
    const auto isMap = [](const CubeMap<float>& map, const Probe& expected, double factor) {
        for (size_t f = 0; f < map.faces.size(); f++)
            for (size_t i = 0; i < map.faces[f].values().size(); i++)
                if (map.faces[f].values()[i] != static_cast<float>(expected.radiance[f].values()[i] * factor))
                    return false;
        return true;
    };
    for (const Arithmetic& arithmetic : {Arithmetic::fp32, Arithmetic::fp16, Arithmetic::fp24R300}) {
        CAPTURE(arithmeticName(arithmetic));
        const auto is = [&](EnvironmentLightMethod method, auto&& expected) {
            CHECK(expected(made(method, arithmetic)));
            CHECK_FALSE(expected(made(method, Arithmetic::fp64)));
        };
        is(EnvironmentLightMethod::harmonics, [&](const EnvironmentIllumination& of) {
            return of.diffuse.harmonics.coefficients ==
                   irradianceOfHarmonics(projectHarmonics(probe, 2, arithmetic)).coefficients;
        });
        is(EnvironmentLightMethod::exact, [&](const EnvironmentIllumination& of) {
            const TexelLights texels = texelLights(probe, arithmetic);
            return of.diffuse.directions == texels.directions && of.diffuse.flux == texels.flux;
        });
        is(EnvironmentLightMethod::map, [&](const EnvironmentIllumination& of) {
            return isMap(of.diffuse.map, irradianceProbe(probe, cube, arithmetic), 1);
        });
        is(EnvironmentLightMethod::blurred, [&](const EnvironmentIllumination& of) {
            const Probe reflective = convertProbe(probe, {.shape = cube}, arithmetic);
            return isMap(of.diffuse.map,
                         blurredDiffuseMap(reflective, kMapSize, kMapSize / 2.0, Arithmetic::fp32),
                         3.14159265358979323846);
        });
        is(EnvironmentLightMethod::lights, [&](const EnvironmentIllumination& of) {
            const auto expected = medianCutLights(probe, {.log2Count = 4}, arithmetic).lights;
            return std::ranges::equal(of.lights, expected, [](const ProbeLight& a, const ProbeLight& b) {
                return a.direction == b.direction && a.energy == b.energy;
            });
        });
    }
}

// The blurred map of [Karlsson2005] is no irradiance: it keeps a constant, and knows which side is brighter.
TEST_CASE("TheBlurredMapKeepsAConstantAndTheBrightSide") {
    SurfaceScene white;
    white.environment.constant = {1, 2, 3};
    addEnvironmentLight(environmentOf(EnvironmentLightMethod::blurred), *findProfile("f32"), 1, white);
    SurfaceScene slope = sceneUnderSlope(64);
    addEnvironmentLight(environmentOf(EnvironmentLightMethod::blurred), *findProfile("f32"), 1, slope);
    for (const glm::dvec3& n : kNormals)
        for (int c = 0; c < 3; c++)
            CHECK(irradianceOf(white, n)[c] == doctest::Approx((c + 1) * kPi).epsilon(1e-5));
    CHECK(irradianceOf(slope, {0, 0, -1}).x > 1.1 * kPi);
    CHECK(irradianceOf(slope, {0, 0, 1}).x < 0.9 * kPi);
}

// The same map times a number: its mean over directions is that of the irradiance. Under a small sun in the corner of
// a face, which the blur repeats beyond the borders, the factor is large.
TEST_CASE("TheNormalisedMapHasTheMeanOfTheIrradiance") {
    const auto mapOf = [](EnvironmentLightMethod lighting, const SurfaceEnvironment& environment) {
        return environmentIllumination(environmentOf(lighting), environment, *findProfile("f32"), 1)
            .diffuse.map;
    };
    const auto meanOf = [](const CubeMap<float>& map, int c) {
        const TexelGrid grid({Mapping::cube, map.size(), map.size()});
        double sum = 0;
        for (int f = 0; f < 6; f++)
            for (int y = 0; y < map.size(); y++)
                for (int x = 0; x < map.size(); x++)
                    sum += grid.solidAngle_sr(f, x, y) *
                           static_cast<double>(map.faces[static_cast<size_t>(f)].at(x, y, c));
        return sum / (4 * kPi);
    };
    SurfaceScene white;
    white.environment.constant = {1, 2, 3};
    const CubeMap<float> furnace = mapOf(EnvironmentLightMethod::blurredNormalised, white.environment);
    for (const Image<float>& face : furnace.faces)
        for (int c = 0; c < 3; c++)
            for (const float v : face.plane(c)) CHECK(std::abs(v / ((c + 1) * kPi) - 1) <= 1e-6);

    SurfaceScene sun;
    sun.environment.latLong = Image<float>(64, 32, 3);
    sun.environment.latLong.fill(0.001f);
    // Near the direction (1, 1, 1), where three faces meet.
    for (int c = 0; c < 3; c++) sun.environment.latLong.at(24, 9, c) = static_cast<float>(100 * (c + 1));
    const LatLongGrid grid(64, 32);
    const glm::dvec3 toSun = grid.direction(24, 9);
    CHECK(std::min({toSun.x, toSun.y, toSun.z}) > 0.5);
    const CubeMap<float> plain = mapOf(EnvironmentLightMethod::blurred, sun.environment),
                         normalised = mapOf(EnvironmentLightMethod::blurredNormalised, sun.environment);
    for (int c = 0; c < 3; c++) {
        const double flux = 100 * (c + 1) * grid.solidAngle_sr(9) + 0.001 * (4 * kPi - grid.solidAngle_sr(9));
        CHECK(meanOf(normalised, c) == doctest::Approx(flux / 4).epsilon(1e-5));
        const double factor = meanOf(plain, c) / (flux / 4);
        CAPTURE(factor);
        CHECK(factor > 2);
        for (size_t f = 0; f < 6; f++)
            for (size_t i = 0; i < plain.faces[f].plane(c).size(); i++)
                CHECK(normalised.faces[f].plane(c)[i] * factor ==
                      doctest::Approx(static_cast<double>(plain.faces[f].plane(c)[i])).epsilon(1e-5));
        double brightest = 0, brightestPlain = 0;
        for (size_t f = 0; f < 6; f++)
            for (size_t i = 0; i < plain.faces[f].plane(c).size(); i++) {
                brightest = std::max(brightest, static_cast<double>(normalised.faces[f].plane(c)[i]));
                brightestPlain = std::max(brightestPlain, static_cast<double>(plain.faces[f].plane(c)[i]));
            }
        MESSAGE("factor ", factor, ", brightest over exact ", brightest / flux, " and ",
                brightestPlain / flux);
    }
}

// A sun of one texel in a dark sky is found as one dominant light, with its energy.
TEST_CASE("TheDominantLightIsTheSun") {
    SurfaceScene scene;
    scene.environment.latLong = Image<float>(64, 32, 3);
    scene.environment.latLong.fill(0.001f);
    for (int c = 0; c < 3; c++) scene.environment.latLong.at(10, 8, c) = 1000;
    addEnvironmentLight(environmentOf(EnvironmentLightMethod::dominant), *findProfile("f64"), 1, scene);
    REQUIRE(scene.lights.size() == 1);
    const LatLongGrid grid(64, 32);
    const glm::dvec3 sun = grid.direction(10, 8), &found = scene.lights[0].toLight;
    CHECK(sun.x * found.x + sun.y * found.y + sun.z * found.z > 0.99);
    CHECK(scene.lights[0].irradiance.x == doctest::Approx(1000 * grid.solidAngle_sr(8)).epsilon(0.01));
}

TEST_CASE("WithoutLightingNothingIsAdded") {
    SurfaceScene scene = sceneUnderSlope(8);
    addEnvironmentLight(environmentOf(EnvironmentLightMethod::none), *findProfile("f64"), 1, scene);
    CHECK(scene.lights.empty());
    CHECK(scene.environment.light.kind == EnvironmentLight::Kind::none);
}

// One bright texel stays whole from the first cut that finds it; black regions give no light.
TEST_CASE("FewerLightsOfAnEnvironmentThanAskedForAreNamed") {
    Environment environment = environmentOf(EnvironmentLightMethod::lights);
    environment.lightCount = 64;
    SurfaceEnvironment radiance;
    radiance.latLong = Image<float>(64, 32, 3);
    for (int c = 0; c < 3; c++) radiance.latLong.at(20, 10, c) = 1;
    const EnvironmentIllumination sun = environmentIllumination(environment, radiance, profiles()[0], 1);
    CHECK(sun.lights.size() == 1);
    REQUIRE(sun.warnings.size() == 1);
    CHECK(sun.warnings[0].find("1 of 64 lights") != std::string::npos);
    for (float& value : radiance.latLong.values()) value = 1;
    const EnvironmentIllumination white = environmentIllumination(environment, radiance, profiles()[0], 1);
    CHECK(white.lights.size() == 64);
    CHECK(white.warnings.empty());
}
