#include "lighting/surface_lighting.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "numeric/number.h"
#include "tests/support/random_numbers.h"

using namespace etalon;

namespace {

constexpr double kPi = 3.141592653589793;
const glm::dvec3 kUp{0, 1, 0};

SurfaceLight sun(const glm::dvec3& toLight, double irradiance) {
    SurfaceLight light;
    light.toLight = toLight;
    light.irradiance = glm::dvec3(irradiance);
    return light;
}
SurfaceLight bulb(const glm::dvec3& position, double intensity) {
    SurfaceLight light;
    light.kind = LightKind::point;
    light.position_m = position;
    light.intensity = glm::dvec3(intensity);
    return light;
}
SurfaceLight torch(const glm::dvec3& position, const glm::dvec3& axis, double cosInner, double cosOuter) {
    SurfaceLight light = bulb(position, 1);
    light.kind = LightKind::spot;
    light.axis = axis;
    light.cosInner = cosInner, light.cosOuter = cosOuter;
    return light;
}

SurfaceMaterial glossy() {
    SurfaceMaterial material;
    material.kind = MaterialKind::blinnPhong;
    material.diffuse = {0.8, 0.5, 0.25};
    material.specular = {0.5, 0.25, 1};
    material.exponent = 20;
    return material;
}

// A surface under lights, its material and what is asked of it, over T.
template <class T>
struct Lit {
    using Lighting = SurfaceLighting<T>;
    using vec3 = typename Lighting::vec3;
    using Visibility = typename Lighting::VisibilityBuffer;

    explicit Lit(std::vector<SurfaceLight> of, EnvironmentLight from = {}, std::vector<bool> shown = {},
                 const std::vector<bool>& casts = {})
        : lights(std::move(of)),
          environment(std::move(from)),
          shows(std::move(shown)),
          lighting({&lights, shows.empty() ? nullptr : &shows, &environment}, {}, casts) {
        parts.diffuse = parts.specular = true;
    }
    typename Lighting::Reflected at(const vec3& position, const vec3& normal, const vec3& toEye,
                                    const Visibility& visibility = {}) {
        const auto reflectances = Lighting::reflectancesOf(material);
        return lighting.reflectedLight(parts, {position, normal, toEye}, reflectances, reflectances.diffuse,
                                       surroundings, lighting.lights(), visibility);
    }
    // At the origin of a horizontal surface that is seen from above.
    typename Lighting::Reflected atOrigin(const Visibility& visibility = {}) {
        const vec3 up = Lighting::constant(kUp);
        return at(Lighting::constant({0, 0, 0}), up, up, visibility);
    }

    std::vector<SurfaceLight> lights;
    EnvironmentLight environment;
    std::vector<bool> shows;
    Lighting lighting;
    typename Lighting::SurfaceParts parts{};
    typename Lighting::Surroundings surroundings{};
    SurfaceMaterial material = glossy();
};

template <class V>
bool sameBits(const V& a, const V& b, int lane = 0) {
    for (int c = 0; c < 3; c++) {
        const double x = numberLane(a[c], lane), y = numberLane(b[c], lane);
        if (x != y || std::signbit(x) != std::signbit(y)) return false;
    }
    return true;
}

glm::dvec3 unit(const glm::dvec3& v) {
    const double length = std::sqrt(v.x * v.x + v.y * v.y + v.z * v.z);
    return {v.x / length, v.y / length, v.z / length};
}
glm::dvec3 randomUnit(RandomNumbers& random) {
    const double x = random.uniform(-1, 1), y = random.uniform(-1, 1), z = random.uniform(0.1, 1);
    return unit({x, y, random.below(2) == 0 ? z : -z});
}

}  // namespace

TEST_CASE_TEMPLATE("ALightBehindTheSurfaceAddsNothing", T, float, double, Lanes<float, 4>, Rounded<kFp16>) {
    const SurfaceLight front = sun(unit({1, 2, 0.5}), 3);
    const auto alone = Lit<T>({front}).atOrigin();
    CHECK(numberLane(alone.diffuse.x, 0) > 0);
    CHECK(numberLane(alone.specular.x, 0) > 0);
    for (const SurfaceLight& behind : {sun(unit({1, -1, 0}), 5), sun({1, 0, 0}, 5), bulb({0, -2, 0}, 7),
                                       bulb({3, 0, 0}, 7), torch({0, -2, 0}, {0, 1, 0}, 0.9, 0.5)}) {
        const auto both = Lit<T>({behind, front, behind}).atOrigin();
        CHECK(sameBits(both.diffuse, alone.diffuse));
        CHECK(sameBits(both.specular, alone.specular));
    }
}

// Zero times infinity is no zero: what is not finite is seen, and so is a light behind the surface that is not.
TEST_CASE_TEMPLATE("AnInfiniteLightBehindTheSurfaceIsSeen", T, float, double, Lanes<float, 4>) {
    const double infinity = std::numeric_limits<double>::infinity();
    for (const SurfaceLight& behind : {sun({0, -1, 0}, infinity), bulb({0, -1, 0}, infinity)}) {
        const auto reflected = Lit<T>({behind}).atOrigin();
        CHECK(std::isnan(numberLane(reflected.diffuse.x, 0)));
        CHECK(std::isnan(numberLane(reflected.specular.x, 0)));
    }
    Lit<T> lit({sun({0, -1, 0}, 1)});
    const auto origin = Lit<T>::Lighting::constant({0, 0, 0}), up = Lit<T>::Lighting::constant(kUp);
    const auto toEye = Lit<T>::Lighting::constant({infinity, 0, 0});
    CHECK(std::isnan(numberLane(lit.at(origin, up, toEye).specular.x, 0)));
}

// A light is left out where it is behind all lanes, which must not show in any of them.
TEST_CASE("LanesReflectWhatEachOfThemReflectsAlone") {
    using L = Lanes<float, 4>;
    RandomNumbers random(11);
    std::vector<SurfaceLight> lights;
    for (int i = 0; i < 40; i++) {
        const glm::dvec3 d = randomUnit(random);
        const double power = random.uniform(0.1, 2);
        if (i % 3 == 0)
            lights.push_back(sun(d, power));
        else if (i % 3 == 1)
            lights.push_back(bulb(2.0 * d, power));
        else
            lights.push_back(torch(2.0 * d, unit(-1.0 * d + 0.3 * randomUnit(random)), 0.95, 0.8));
    }
    Lit<L> inLanes(lights);
    Lit<float> alone(lights);
    for (int group = 0; group < 50; group++) {
        glm::vec3 normals[4], toEyes[4], positions[4];
        // Neighbours mostly face alike, as on a mesh.
        const glm::dvec3 common = randomUnit(random);
        for (int i = 0; i < 4; i++) {
            normals[i] = unit(common + (group % 2 == 0 ? 0.1 : 2) * randomUnit(random));
            toEyes[i] = randomUnit(random);
            positions[i] = 0.5 * randomUnit(random);
        }
        const auto gathered = [&](const glm::vec3(&from)[4]) {
            const auto component = [&](int c) { return L::generate([&](int i) { return from[i][c]; }); };
            return glm::vec<3, L>(component(0), component(1), component(2));
        };
        const auto four = inLanes.at(gathered(positions), gathered(normals), gathered(toEyes));
        for (int i = 0; i < 4; i++) {
            const auto one = alone.at(positions[i], normals[i], toEyes[i]);
            for (int c = 0; c < 3; c++) {
                CHECK(four.diffuse[c][i] == one.diffuse[c]);
                CHECK(four.specular[c][i] == one.specular[c]);
            }
        }
    }
}

// In float 2^24 + 1 + 1 is 2^24, and 1 + 1 + 2^24 is 2^24 + 2.
TEST_CASE("LightsAreAddedInTheirOrder") {
    const auto redOf = [](std::vector<SurfaceLight> lights) {
        Lit<float> lit(std::move(lights));
        lit.material = SurfaceMaterial();
        lit.material.diffuse = glm::dvec3(1);
        return lit.atOrigin().diffuse.x;
    };
    const float one = redOf({sun(kUp, kPi)});
    CHECK(one == doctest::Approx(1).epsilon(0x1p-22));
    const SurfaceLight strong = sun(kUp, 0x1p24 * kPi), weak = sun(kUp, kPi);
    const float large = redOf({strong});
    CHECK(redOf({strong, weak, weak}) == (large + one) + one);
    CHECK(redOf({weak, weak, strong}) == (one + one) + large);
    CHECK(redOf({strong, weak, weak}) != redOf({weak, weak, strong}));
}

// Inverse square; all inside the inner cone, nothing outside the outer one, smooth in the cosine between them.
TEST_CASE_TEMPLATE("ASpotLightFallsFromItsInnerToItsOuterCone", T, float, double) {
    const double cosInner = 0.9, cosOuter = 0.5;
    const auto irradianceAt = [&](double cosine, double distance) {
        const double sine = std::sqrt(1 - cosine * cosine);
        // The surface faces the light: the angle is between the axis and the way to the surface.
        const glm::dvec3 place{0, distance, 0};
        Lit<T> lit({torch(place, {sine, -cosine, 0}, cosInner, cosOuter)});
        lit.material.diffuse = glm::dvec3(1);
        return static_cast<double>(lit.atOrigin().diffuse.x) * kPi;
    };
    const double bound = std::is_same_v<T, float> ? 1e-6 : 1e-14;
    for (const double distance : {0.5, 1.0, 4.0}) {
        const double full = 1 / (distance * distance);
        for (const double inside : {1.0, 0.95, 0.901})
            CHECK(irradianceAt(inside, distance) == doctest::Approx(full).epsilon(bound));
        for (const double outside : {0.499, 0.0, -0.7, -1.0}) CHECK(irradianceAt(outside, distance) == 0);
        // 3 t^2 - 2 t^3 of the quarters between.
        const std::pair<double, double> between[] = {{0.25, 0.15625}, {0.5, 0.5}, {0.75, 0.84375}};
        for (const auto& [t, part] : between)
            CHECK(irradianceAt(cosOuter + t * (cosInner - cosOuter), distance) ==
                  doctest::Approx(full * part).epsilon(bound * 10));
    }
}

// Rows are the numbers of the lights, those that are not shown included.
TEST_CASE("EachLightHasItsOwnVisibility") {
    const std::vector<SurfaceLight> lights = {sun(kUp, 8), sun(kUp, kPi), sun(kUp, kPi), sun(kUp, kPi)};
    const double visibility[] = {77, 77, 0.5, 77, 0, 77, 99, 77};  // a row of two points each
    Lit<double> lit(lights, {}, {false, true, true, true}, {true, true, true, false});
    lit.material.diffuse = glm::dvec3(1);
    // Half of the second one, nothing of the third, all of the fourth.
    CHECK(lit.atOrigin({visibility, 2}).diffuse.x == doctest::Approx(1.5).epsilon(1e-15));
}

TEST_CASE_TEMPLATE("HarmonicsBelowZeroGiveNoLight", T, float, double, Lanes<float, 4>) {
    EnvironmentLight light;
    light.kind = EnvironmentLight::Kind::harmonics;
    light.harmonics = SphericalHarmonics(1);
    // In the direction of z: 1 + 2 z, 1 - 2 z and 1.
    light.harmonics.at(0, 0) = glm::dvec3(1 / 0.28209479177387814);
    light.harmonics.at(1, 0) = glm::dvec3(2, -2, 0) / 0.48860251190291992;
    EnvironmentLighting<T> lighting(light, {});
    const auto along = [&](double z) {
        const auto e = lighting.environmentIrradiance({T(0.0), T(std::sqrt(1 - z * z)), T(z)});
        return glm::dvec3(numberLane(e.x, 0), numberLane(e.y, 0), numberLane(e.z, 0));
    };
    CHECK(along(-1).x == 0);
    CHECK_FALSE(std::signbit(along(-1).x));
    CHECK(along(1).y == 0);
    CHECK(along(-0.8).x == 0);
    for (const double z : {-0.25, 0.0, 0.25}) {
        CHECK(along(z).x == doctest::Approx(1 + 2 * z).epsilon(1e-6));
        CHECK(along(z).y == doctest::Approx(1 - 2 * z).epsilon(1e-6));
    }
    CHECK(along(1).x == doctest::Approx(3).epsilon(1e-6));
    CHECK(along(1).z == doctest::Approx(1).epsilon(1e-6));
}

// A texel is a light of its flux; the sum starts from 0 and is in their order.
TEST_CASE("TexelsLightAsTheLightsThatTheyAre") {
    EnvironmentLight light;
    light.kind = EnvironmentLight::Kind::texels;
    light.directions = {kUp, {0.6, 0.8, 0}, {0, -1, 0}, {1, 0, 0}};
    light.flux = {{0x1p24, 1, 0}, {2.5, 10, 0}, {100, 100, 100}, {7, 7, 7}};
    EnvironmentLighting<float> lighting(light, {});
    const auto up = lighting.environmentIrradiance({0, 1, 0});
    CHECK(up.x == 0x1p24f + 2.0f);
    CHECK(up.y == 9);
    CHECK(up.z == 0);
    // In the other order, with flux that one by one is lost beside the large one.
    light.flux[1].x = 1.25, light.flux[3] = {1.25, 0, 0}, light.directions[3] = {-0.6, 0.8, 0};
    EnvironmentLighting<float> largeFirst(light, {});
    CHECK(largeFirst.environmentIrradiance({0, 1, 0}).x == 0x1p24f);
    std::swap(light.flux[0], light.flux[3]), std::swap(light.directions[0], light.directions[3]);
    EnvironmentLighting<float> largeLast(light, {});
    CHECK(largeLast.environmentIrradiance({0, 1, 0}).x == 0x1p24f + 2.0f);
}

namespace {

// Texels of equal flux in a spiral around the sphere.
EnvironmentLight manyTexels(size_t count, double flux) {
    EnvironmentLight light;
    light.kind = EnvironmentLight::Kind::texels;
    for (size_t i = 0; i < count; i++) {
        const double y = 1 - (2 * static_cast<double>(i) + 1) / static_cast<double>(count);
        const double angle_rad = 2.399963229728653 * static_cast<double>(i), r = std::sqrt(1 - y * y);
        light.directions.push_back({r * std::cos(angle_rad), y, r * std::sin(angle_rad)});
        light.flux.push_back(flux * glm::dvec3(1, 0.5, 0.1));
    }
    return light;
}

}  // namespace

// Of the texels as T has them; a running sum of floats is off by 1e-4 here.
TEST_CASE_TEMPLATE("TheSumOverManyTexelsKeepsItsBound", T, float, double, Lanes<float, 4>) {
    constexpr size_t kCount = 1 << 18;
    const EnvironmentLight light = manyTexels(kCount, 4 * kPi / kCount);
    EnvironmentLighting<T> lighting(light, {});
    constexpr double kRoundoff = std::numeric_limits<typename Number<T>::Stored>::epsilon() / 2;
    const double bound = (kIrradianceRun + std::log2(double{kCount} / kIrradianceRun) + 8) * kRoundoff;
    for (const glm::dvec3& n : {glm::dvec3(0, 1, 0), {0.6, 0, 0.8}, {0.48, -0.6, 0.64}}) {
        long double exact = 0;
        for (size_t i = 0; i < kCount; i++) {
            const glm::dvec3& d = light.directions[i];
            exact += static_cast<long double>(std::max(0.0, n.x * d.x + (n.y * d.y + n.z * d.z))) *
                     light.flux[i].x;
        }
        const auto found = lighting.environmentIrradiance({T(n.x), T(n.y), T(n.z)});
        CHECK(std::abs(numberLane(found.x, 0) / static_cast<double>(exact) - 1) <= bound);
    }
}

// 2^k times the light gives 2^k times the irradiance, whether of texels or of harmonics; nothing is too dark.
TEST_CASE_TEMPLATE("TheIrradianceOfScaledLightIsScaledToTheBit", T, float, double, Lanes<float, 4>) {
    const glm::dvec3 n(0.48, -0.6, 0.64);
    const auto irradianceOf = [&](const EnvironmentLight& light) {
        EnvironmentLighting<T> lighting(light, {});
        const auto e = lighting.environmentIrradiance({T(n.x), T(n.y), T(n.z)});
        return glm::dvec3(numberLane(e.x, 0), numberLane(e.y, 0), numberLane(e.z, 0));
    };
    const EnvironmentLight texels = manyTexels(999, 0.01);
    EnvironmentLight harmonics;
    harmonics.kind = EnvironmentLight::Kind::harmonics;
    harmonics.harmonics = SphericalHarmonics(2);
    for (size_t i = 0; i < 9; i++)
        harmonics.harmonics.coefficients[i] = glm::dvec3(3, 2, 1) / (1.0 + 2 * static_cast<double>(i));
    for (const int k : {-110, -60, -40, 40, 100}) {
        CAPTURE(k);
        const double scale = std::ldexp(1.0, k);
        EnvironmentLight scaled = texels;
        for (glm::dvec3& flux : scaled.flux) flux *= scale;
        CHECK(irradianceOf(scaled) == scale * irradianceOf(texels));
        scaled = harmonics;
        for (glm::dvec3& c : scaled.harmonics.coefficients) c *= scale;
        CHECK(irradianceOf(scaled) == scale * irradianceOf(harmonics));
    }
    CHECK(irradianceOf(texels).x > 0);
    CHECK(irradianceOf(harmonics).z > 0);
}

TEST_CASE("OccludedSurroundingsLightAlongTheBentNormal") {
    EnvironmentLight light;
    light.kind = EnvironmentLight::Kind::texels;
    light.directions = {{0.6, 0.8, 0}};
    light.flux = {glm::dvec3(kPi)};
    Lit<double> lit({sun(kUp, kPi)}, light);
    lit.material.diffuse = glm::dvec3(0.5);
    lit.surroundings = {0.25, {1, 0, 0}};
    CHECK(lit.atOrigin().diffuse.x == doctest::Approx(0.5 + 0.5 * 0.8).epsilon(1e-15));
    // Lights are not occluded by surroundings: they have shadows.
    lit.parts.isOccluded = true;
    CHECK(lit.atOrigin().diffuse.x == doctest::Approx(0.5 + 0.5 * 0.6 * 0.25).epsilon(1e-15));
}

// ambient Al Am, diffuse Kd D Dm, specular, mirror Kr R: each alone, none, and all of them.
TEST_CASE("TheCompositionIsTheSumOfItsParts") {
    EnvironmentLight light;
    light.kind = EnvironmentLight::Kind::texels;
    light.directions = {kUp};
    light.flux = {glm::dvec3(kPi)};
    Lit<double> lit({sun(kUp, kPi)}, light);
    lit.material.reflectance = {0.5, 0.25, 0.125};
    using Lighting = SurfaceLighting<double>;
    const glm::dvec3 origin(0), ambient{0.25, 0.5, 1}, mirrored{4, 8, 16};
    const auto reflectances = Lighting::reflectancesOf(lit.material);
    const glm::dvec3 albedo = lit.material.diffuse;
    const double lobe = (20 + 8) / (8 * kPi) * kPi;  // of the light along the normal
    const glm::dvec3 expected[] = {albedo * ambient, 2.0 * albedo, lobe * lit.material.specular,
                                   glm::dvec3(2)};
    for (int chosen = 0; chosen < 16; chosen++) {
        for (const bool isOccluded : {false, true}) {
            Lighting::SurfaceParts parts{};
            parts.ambient = chosen & 1, parts.diffuse = chosen & 2, parts.specular = chosen & 4;
            parts.mirror = chosen & 8, parts.isOccluded = isOccluded;
            const auto r = lit.lighting.surfaceRadiance(parts, {origin, kUp, kUp}, reflectances, albedo,
                                                        {0.5, kUp}, ambient, lit.lighting.lights(), {},
                                                        {{-1, -1, -1}, {-1, -1, -1}}, mirrored);
            const glm::dvec3 found[] = {r.ambient, r.diffuse, r.specular, r.mirror};
            const double open[] = {isOccluded ? 0.5 : 1, isOccluded ? 0.75 : 1, 1, 1};
            glm::dvec3 sum(0);
            for (int part = 0; part < 4; part++)
                for (int c = 0; c < 3; c++) {
                    const double value = (chosen >> part & 1) ? open[part] * expected[part][c] : 0;
                    CHECK(found[part][c] == doctest::Approx(value).epsilon(1e-14));
                    sum[c] += found[part][c];
                }
            CHECK(sameBits(sum, glm::dvec3(r.beauty)));
        }
    }
}

// What the vertices reflect takes the place of the lights, and of the lights alone.
TEST_CASE("LightOfVerticesReplacesThatOfLights") {
    Lit<double> lit({sun(kUp, kPi)});
    using Lighting = SurfaceLighting<double>;
    Lighting::SurfaceParts parts{};
    parts.ambient = parts.diffuse = parts.specular = parts.mirror = parts.isPerVertex = true;
    const auto reflectances = Lighting::reflectancesOf(lit.material);
    const Lighting::Reflected ofVertices{{1, 2, 3}, {4, 5, 6}};
    const auto r = lit.lighting.surfaceRadiance(parts, {{0, 0, 0}, kUp, kUp}, reflectances, {1, 1, 1}, {},
                                                {7, 7, 7}, lit.lighting.lights(), {}, ofVertices, {9, 9, 9});
    CHECK(r.diffuse == ofVertices.diffuse);
    CHECK(r.specular == ofVertices.specular);
    CHECK(r.beauty == glm::dvec3(1 + 4 + 7, 2 + 5 + 7, 3 + 6 + 7));
}

TEST_CASE("MirrorsAndBackgroundShowTheTurnedEnvironment") {
    // A lat-long image whose red is its column, by quarters: -Z in the middle of the columns.
    ShadingKernels<double> kernels;
    Image<float> image(4, 2, 3);
    for (int y = 0; y < 2; y++)
        for (int x = 0; x < 4; x++) image.at(x, y, 0) = static_cast<float>(x + 1);
    SamplerSettings nearest;
    nearest.filter = Filter::nearest;
    const TextureView texture(image);
    const auto sampling = samplingOf<ShadingKernels<double>>(nearest, 4, 2);
    using View = ShadingKernels<double>::EnvironmentView;
    const ShadingKernels<double>::PixelRays rays{2, 2, {1, 0, 1}, {0, 0, 0}, {0, 0, 0}};
    const auto redOf = [&](double cosTurn, double sinTurn) {
        return kernels.backgroundRadiance(View{0, {9, 9, 9}, cosTurn, sinTurn}, texture, sampling, rays, 0, 0)
            .x;
    };
    // A quarter turn is a column of this image, the other way round the column before.
    const double straight = redOf(1, 0);
    const auto columnAfter = [&](int quarters) { return std::fmod(straight - 1 + quarters + 4, 4.0) + 1; };
    CHECK(redOf(0, 1) == columnAfter(-1));
    CHECK(redOf(0, -1) == columnAfter(1));
    CHECK(redOf(-1, 0) == columnAfter(2));
    CHECK(kernels.backgroundRadiance(View{1, {9, 9, 9}, 0, 1}, texture, sampling, rays, 0, 0).x == 9);

    // A cube map whose red is its face; seen along +Z by a mirror that faces the eye.
    CubeMap<float> cube;
    for (size_t face = 0; face < 6; face++) {
        cube.faces[face] = Image<float>(1, 1, 3);
        cube.faces[face].at(0, 0, 0) = static_cast<float>(face);
    }
    const TextureView faces(cube);
    const auto ofCube = samplingOf<ShadingKernels<double>>(nearest, 1, 1);
    const auto shown = [&](int shows) {
        return kernels.mirroredRadiance(View{0, {9, 9, 9}, 0, 1}, shows, faces, ofCube, {0, 0, 1}, {0, 0, 1})
            .x;
    };
    CHECK(shown(0) == 9);
    CHECK(shown(1) == 0);  // a quarter turn takes +Z to +X
    CHECK(shown(2) == 4);
}

TEST_CASE("ACheckerboardTakesItsSecondColourOnOddSquares") {
    SurfaceMaterial material = glossy();
    material.checker = true;
    material.diffuse2 = {0.125, 0.125, 0.125};
    material.checkerSize_m = 0.5;
    ShadingKernels<float> kernels;
    const auto reflectances = SurfaceLighting<float>::reflectancesOf(material);
    const glm::vec3 even(material.diffuse), odd(material.diffuse2);
    CHECK(kernels.albedoAt(reflectances, 0.25f, 0.25f) == even);
    CHECK(kernels.albedoAt(reflectances, 0.75f, 0.25f) == odd);
    CHECK(kernels.albedoAt(reflectances, 0.25f, -0.25f) == odd);
    CHECK(kernels.albedoAt(reflectances, -0.25f, -0.25f) == even);
    material.checker = false;
    CHECK(kernels.albedoAt(SurfaceLighting<float>::reflectancesOf(material), 0.75f, 0.25f) == even);
}

TEST_CASE("ResolvedSamplesAreAddedInTheirOrder") {
    ShadingKernels<float> kernels;
    const float largeFirst[] = {0x1p24f, 1, 1, 0}, largeLast[] = {1, 1, 0, 0x1p24f};
    CHECK(kernels.resolvedSamples({largeFirst}, 4, 0.25f) == 0x1p22f);
    CHECK(kernels.resolvedSamples({largeLast}, 4, 0.25f) == 0x1p22f + 0.5f);
    CHECK(kernels.resolvedSamples({largeFirst}, 1, 1.0f) == 0x1p24f);
}
