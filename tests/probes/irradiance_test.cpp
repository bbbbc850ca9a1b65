#include "probes/irradiance.h"

#include <doctest/doctest.h>

#include <cmath>

#include "probes/harmonics_lobes.h"
#include "probes/harmonics_rotation.h"
#include "probes/probe_errors.h"
#include "tests/probes/made_probes.h"

namespace etalon {

namespace {

constexpr double kPi = 0x1.921fb54442d18p+1;
constexpr Arithmetic kDouble = Arithmetic::fp64;

std::vector<glm::dvec3> someNormals() {
    std::vector<glm::dvec3> normals = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
    RandomNumbers random(1);
    for (int i = 0; i < 31; i++) normals.push_back(randomUnitVector(random));
    return normals;
}

// Relative to each value of `exact`.
double largestRelative(const std::vector<glm::dvec3>& values, const std::vector<glm::dvec3>& exact) {
    double largest = 0;
    for (size_t i = 0; i < values.size(); i++)
        for (int c = 0; c < 3; c++)
            largest = std::max(largest, std::abs(values[i][c] - exact[i][c]) / exact[i][c]);
    return largest;
}

}  // namespace

TEST_CASE("IrradianceIsTheSumOverTexels") {
    RandomNumbers random(2);
    for (const ProbeShape& shape : kSmallShapes) {
        Probe probe = randomProbe(shape, 3);
        probe.rotation = randomRotation(random);
        const TexelGrid grid(shape);
        const std::vector<glm::dvec3> normals = someNormals();
        const std::vector<glm::dvec3> values = irradianceAt(probe, normals, kDouble);
        for (size_t i = 0; i < normals.size(); i++) {
            long double sum = 0;
            for (int layer = 0; layer < shape.layers(); layer++)
                for (int y = 0; y < shape.height; y++)
                    for (int x = 0; x < shape.width; x++) {
                        const glm::dvec3 d = probe.rotation * grid.direction(layer, x, y);
                        const double cosine = d.x * normals[i].x + d.y * normals[i].y + d.z * normals[i].z;
                        sum += static_cast<long double>(std::max(0.0, cosine)) *
                               grid.solidAngle_sr(layer, x, y) *
                               probe.radiance[static_cast<size_t>(layer)].at(x, y, 1);
                    }
            CHECK(std::abs(static_cast<double>(sum) - values[i].y) < 1e-13);
        }
    }
}

TEST_CASE("WhiteFurnaceIsPi") {
    const std::vector<glm::dvec3> normals = someNormals();
    for (const Furnace& furnace : kFurnaces) {
        CAPTURE(static_cast<int>(furnace.shape.mapping));
        CAPTURE(furnace.shape.ballDistance_radii);
        const Probe white = constantProbe(furnace.shape, 1);
        const std::vector<glm::dvec3> exact = irradianceAt(white, normals, Arithmetic::truth);
        // A near ball hides a cone around -Z, which takes sin^2 of its half angle from a plane that faces it.
        const double taken = furnace.sineOfHidden() * furnace.sineOfHidden();
        for (const glm::dvec3& e : exact) {
            CHECK(e.x / kPi - 1 < furnace.quadrature);
            CHECK(e.x / kPi - 1 > -furnace.quadrature - taken);
        }
        CHECK(std::abs(exact[4].x / kPi - 1) <= furnace.quadrature);
        CHECK(std::abs(exact[5].x / kPi - (1 - taken)) <= furnace.quadrature);
        // From harmonics there is no midpoint rule in the cosine.
        const SphericalHarmonics f = irradianceOfHarmonics(projectHarmonics(white, 2, Arithmetic::fp64));
        const std::vector<glm::dvec3> smooth = evaluateHarmonics(f, normals, kDouble);
        if (taken == 0)
            for (const glm::dvec3& e : smooth) CHECK(std::abs(e.x / kPi - 1) <= furnace.quadrature);
        for (const Arithmetic a : kAllArithmetics) {
            CAPTURE(arithmeticName(a));
            const double error = largestRelative(irradianceAt(white, normals, a), exact);
            CAPTURE(error);
            CHECK(error <= probeErrors(a).irradiance);
            CHECK(largestRelative(evaluateHarmonics(f, normals, a), smooth) <= probeErrors(a).irradiance);
        }
    }
}

TEST_CASE("IrradianceInEveryArithmeticKeepsItsBound") {
    const Probe probe = randomProbe({Mapping::latLong, 48, 24}, 4);
    const std::vector<glm::dvec3> normals = someNormals();
    const std::vector<glm::dvec3> exact = irradianceAt(probe, normals, Arithmetic::truth);
    for (const Arithmetic a : kAllArithmetics) {
        CAPTURE(arithmeticName(a));
        const double error = largestRelative(irradianceAt(probe, normals, a), exact);
        CAPTURE(error);
        CHECK(error <= probeErrors(a).irradiance);
    }
}

TEST_CASE("IrradianceConvergesWithTheSquareOfTheTexelSize") {
    // Radiance of degree 3: its irradiance is known.
    SphericalHarmonics f(3);
    RandomNumbers random(5);
    for (glm::dvec3& c : f.coefficients) c = glm::dvec3(random.uniform(-0.2, 0.2));
    f.at(0, 0) = glm::dvec3(3);
    const std::vector<glm::dvec3> normals = someNormals();
    const std::vector<glm::dvec3> exact = evaluateHarmonics(irradianceOfHarmonics(f), normals, kDouble);
    double before = 0;
    for (const int size : {8, 16, 32}) {
        const ProbeShape shape{Mapping::cube, size, size};
        const TexelGrid grid(shape);
        const Probe probe = madeProbe(shape, [&](int layer, int x, int y, int c) {
            return evaluate(f, grid.direction(layer, x, y))[c];
        });
        const double error = largestRelative(irradianceAt(probe, normals, kDouble), exact);
        if (before > 0) CHECK(error < before / 2.5);
        before = error;
    }
    CHECK(before < 1e-3);
}

TEST_CASE("HarmonicsOfDegreeTwoMissALittleOfASun") {
    // Of a single direction 3/32 of the largest irradiance at right angles to it, 1/16 towards it.
    const ProbeShape shape{Mapping::cube, 32, 32};
    const Probe sun = madeProbe(
        shape, [](int layer, int x, int y, int) { return layer == 2 && x == 20 && y == 9 ? 1e4 : 0; });
    const std::vector<glm::dvec3> normals = texelDirections({Mapping::cube, 6, 6});
    const std::vector<glm::dvec3> exact = irradianceAt(sun, normals, kDouble);
    const SphericalHarmonics f = irradianceOfHarmonics(projectHarmonics(sun, 2));
    double largest = 0, worst = 0;
    for (size_t i = 0; i < normals.size(); i++) {
        largest = std::max(largest, exact[i].x);
        worst = std::max(worst, std::abs(evaluate(f, normals[i]).x - exact[i].x));
    }
    CHECK(worst < 3.01 / 32 * largest);
    CHECK(worst > 1.0 / 16 * largest);
}

TEST_CASE("IrradianceProbesShowTheirDirections") {
    const Probe probe = randomProbe({Mapping::latLong, 16, 8}, 6);
    const ProbeShape shape{Mapping::cube, 3, 3};
    const Probe map = irradianceProbe(probe, shape, Arithmetic::fp32);
    const std::vector<glm::dvec3> values = irradianceAt(probe, texelDirections(shape), Arithmetic::fp32);
    CHECK(map.shape == shape);
    CHECK(map.radiance[1].at(2, 1, 0) == static_cast<float>(values[9 + 5].x));
    const Probe smooth = irradianceProbe(projectHarmonics(probe, 4), shape, probe, Arithmetic::fp32);
    for (size_t i = 0; i < 9; i++)
        CHECK(std::abs(smooth.radiance[0].plane(0)[i] / map.radiance[0].plane(0)[i] - 1) < 0.03);
}

TEST_CASE("ExtremeProbesHaveFiniteIrradiance") {
    const std::vector<glm::dvec3> normals = someNormals();
    for (const Arithmetic a : kAllArithmetics) {
        const bool isHalf = a == Arithmetic::fp16 || a == Arithmetic::fp16Nv40;
        CAPTURE(arithmeticName(a));
        const auto check = [&](const Probe& probe) {
            const std::vector<glm::dvec3> values = irradianceAt(probe, normals, a);
            const std::vector<glm::dvec3> exact = irradianceAt(probe, normals, kDouble);
            double largest = 0, worst = 0;
            for (size_t i = 0; i < values.size(); i++) {
                REQUIRE(std::isfinite(values[i].x));
                largest = std::max(largest, exact[i].x);
                worst = std::max(worst, std::abs(values[i].x - exact[i].x));
            }
            CAPTURE(worst / largest);
            CHECK(worst <= probeErrors(a).irradiance * largest);
        };
        for (const ProbeShape& shape : {ProbeShape{Mapping::latLong, 16, 8}, {Mapping::cube, 5, 5}}) {
            // Half floats limit the sun to 65504 (probes/flux.h).
            Probe sun = constantProbe(shape, 1e-3);
            for (int c = 0; c < 3; c++) sun.radiance[0].at(4, 3, c) = isHalf ? 65504.0f : 1e6f;
            check(sun);
            Probe atPole = constantProbe(shape, 0);
            for (int c = 0; c < 3; c++) atPole.radiance[0].at(0, 0, c) = 1e4f;
            check(atPole);
            check(constantProbe(shape, 65504));
        }
        for (const ProbeShape& shape : {ProbeShape{Mapping::latLong, 1, 1}, {Mapping::cube, 1, 1}})
            for (const glm::dvec3& e : irradianceAt(constantProbe(shape, 1), normals, a))
                REQUIRE(std::isfinite(e.x));
    }
    // Six texels of a cube are a crude sphere: the mean of the three that a normal sees.
    const std::vector<glm::dvec3> axis = {{0, 0, 1}};
    CHECK(std::abs(irradianceAt(constantProbe({Mapping::cube, 1, 1}, 1), axis, kDouble)[0].x - 4 * kPi / 6) <
          1e-14);
}

// Radiance of 2^k times a probe's, inside the finite numbers of the arithmetic, gives 2^k times its light.
TEST_CASE("LightOfScaledRadianceIsScaledToTheBit") {
    const std::vector<glm::dvec3> normals = someNormals();
    for (const ProbeShape& shape : {ProbeShape{Mapping::latLong, 37, 19}, {Mapping::cube, 9, 9}}) {
        const Probe probe = randomProbe(shape, 8);
        for (const auto& [arithmetic, k] : {std::pair{Arithmetic::fp32, -100},
                                            {Arithmetic::fp32, -60},
                                            {Arithmetic::fp32, 100},
                                            {Arithmetic::fp64, -100},
                                            {Arithmetic::fp64, 120},
                                            {Arithmetic::truth, -60},
                                            {Arithmetic::fp24R300, -40},
                                            {Arithmetic::fp16, 3}}) {
            CAPTURE(arithmeticName(arithmetic));
            CAPTURE(k);
            Probe scaled = probe;
            for (Image<float>& layer : scaled.radiance)
                for (int c = 0; c < 3; c++)
                    for (float& v : layer.plane(c)) v = std::ldexp(v, k);
            const double scale = std::ldexp(1.0, k);
            const std::vector<glm::dvec3> before = irradianceAt(probe, normals, arithmetic),
                                          after = irradianceAt(scaled, normals, arithmetic);
            for (size_t i = 0; i < normals.size(); i++) CHECK(after[i] == scale * before[i]);
            const SphericalHarmonics f = projectHarmonics(probe, 4, arithmetic),
                                     g = projectHarmonics(scaled, 4, arithmetic);
            for (size_t i = 0; i < f.coefficients.size(); i++)
                CHECK(g.coefficients[i] == scale * f.coefficients[i]);
            const std::vector<glm::dvec3> smooth = evaluateHarmonics(f, normals, Arithmetic::fp32),
                                          scaledSmooth = evaluateHarmonics(g, normals, Arithmetic::fp32);
            for (size_t i = 0; i < normals.size(); i++) CHECK(scaledSmooth[i] == scale * smooth[i]);
        }
    }
}

// The lights of texels are what the sum adds: one texel at a time it is their product with the cosine.
TEST_CASE("TexelLightsAreWhatTheSumAdds") {
    const ProbeShape shape{Mapping::cube, 3, 3};
    const std::vector<glm::dvec3> axis = {{0, 0, 1}};
    for (const Arithmetic& arithmetic :
         {Arithmetic::fp64, Arithmetic::fp32, Arithmetic::fp16, Arithmetic::fp24R300, Arithmetic::truth}) {
        const TexelLights white = texelLights(constantProbe(shape, 1), arithmetic, 2);
        REQUIRE(white.directions.size() == 54);
        REQUIRE(white.flux.size() == 54);
        for (size_t lit = 0; lit < 54; lit++) {
            Probe probe = constantProbe(shape, 0);
            for (int c = 0; c < 3; c++) probe.radiance[lit / 9].plane(c)[lit % 9] = 1;
            const TexelLights texels = texelLights(probe, arithmetic);
            for (size_t i = 0; i < 54; i++) {
                CHECK(texels.directions[i] == white.directions[i]);
                CHECK(texels.flux[i] == (i == lit ? white.flux[i] : glm::dvec3(0)));
            }
            const double sum = irradianceAt(probe, axis, arithmetic)[0].x;
            const double product = white.flux[lit].x * std::max(0.0, white.directions[lit].z);
            CHECK(std::abs(sum - product) <= 0x1p-10 * product);
        }
    }
}

TEST_CASE("BlurredMapOfAConstantIsTheConstant") {
    const Probe map = blurredDiffuseMap(constantProbe({Mapping::cube, 8, 8}, 3), 5, 2.5, Arithmetic::fp32);
    for (const Image<float>& face : map.radiance)
        for (const float v : face.values()) CHECK(std::abs(v / 3 - 1) < 1e-6);
    CHECK_THROWS_AS(blurredDiffuseMap(constantProbe({Mapping::latLong, 8, 4}, 3), 5, 2.5, Arithmetic::fp32),
                    PreconditionError);
}

TEST_CASE("BlurredMapIsNoIrradiance") {
    // A bright upper hemisphere [Karlsson2005]: a side face that is blurred over its own half sees neither
    // the top nor the ground.
    const ProbeShape shape{Mapping::cube, 16, 16};
    const TexelGrid grid(shape);
    const Probe sky = madeProbe(
        shape, [&](int layer, int x, int y, int) { return grid.direction(layer, x, y).y > 0 ? 1.0 : 0.0; });
    const Probe map = blurredDiffuseMap(sky, 16, 8, Arithmetic::fp64);
    const std::vector<glm::dvec3> exact = irradianceAt(sky, texelDirections(shape), kDouble);
    double worst = 0;
    for (size_t i = 0; i < exact.size(); i++)
        worst = std::max(worst, std::abs(map.radiance[i / 256].plane(0)[i % 256] - exact[i].x / kPi));
    CHECK(worst > 0.1);
    CHECK(worst < 0.35);
}

}  // namespace etalon
