#include "probes/spherical_harmonics.h"

#include <doctest/doctest.h>

#include <cmath>

#include "probes/harmonics_passes.h"
#include "probes/probe_errors.h"
#include "tests/probes/defined_harmonics.h"
#include "tests/probes/made_probes.h"

namespace etalon {

namespace {

constexpr double kPi = 0x1.921fb54442d18p+1;

// The sum over texels as it is defined, in long double and with the harmonics of the definition up to
// rounding.
std::vector<long double> directCoefficients(const Probe& probe, int degree) {
    const TexelGrid grid(probe.shape);
    std::vector<long double> sums(3 * static_cast<size_t>(harmonicCount(degree)));
    for (int layer = 0; layer < probe.shape.layers(); layer++)
        for (int y = 0; y < probe.shape.height; y++)
            for (int x = 0; x < probe.shape.width; x++) {
                const std::vector<double> values =
                    harmonicsAt(probe.rotation * grid.direction(layer, x, y), degree);
                for (size_t i = 0; i < values.size(); i++)
                    for (int c = 0; c < 3; c++)
                        sums[3 * i + static_cast<size_t>(c)] +=
                            static_cast<long double>(values[i]) * grid.solidAngle_sr(layer, x, y) *
                            probe.radiance[static_cast<size_t>(layer)].at(x, y, c);
            }
    return sums;
}
double largestDifference(const SphericalHarmonics& f, const std::vector<long double>& sums) {
    double largest = 0;
    for (size_t i = 0; i < f.coefficients.size(); i++)
        for (size_t c = 0; c < 3; c++)
            largest = std::max(
                largest, static_cast<double>(
                             std::abs(f.coefficients[i][static_cast<glm::length_t>(c)] - sums[3 * i + c])));
    return largest;
}

SphericalHarmonics randomHarmonics(int degree, uint64_t seed) {
    RandomNumbers random(seed);
    SphericalHarmonics f(degree);
    for (glm::dvec3& c : f.coefficients)
        c = {random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
    return f;
}

}  // namespace

TEST_CASE("HarmonicsHaveTheSignsAndFactorsOfTheTable") {
    const glm::dvec3 d(0.36, 0.48, -0.8);
    const double x = d.x, y = d.y, z = d.z;
    // [RamamoorthiHanrahan2001], with the signs of the Condon-Shortley phase.
    const double table[] = {0.282095,
                            -0.488603 * y,
                            0.488603 * z,
                            -0.488603 * x,
                            1.092548 * x * y,
                            -1.092548 * y * z,
                            0.315392 * (3 * z * z - 1),
                            -1.092548 * x * z,
                            0.546274 * (x * x - y * y)};
    const std::vector<double> values = harmonicsAt(d, 2);
    for (size_t i = 0; i < values.size(); i++) {
        CAPTURE(i);
        CHECK(std::abs(values[i] - table[i]) < 1e-6);
    }
}

TEST_CASE("RecurrencesAgreeWithTheDefinitionInTruth") {
    RandomNumbers random(1);
    double worstDouble = 0, worstFloat = 0;
    Truth worstTruth(0.0);
    std::vector<glm::dvec3> directions = {{0, 0, 1}, {0, 0, -1}, {0, 1, 0}, {-1, 0, 0}, {1e-9, 0, 1}};
    for (int i = 0; i < 15; i++) directions.push_back(randomUnitVector(random));
    HarmonicsKernel<double> inDouble;
    HarmonicsKernel<float> inFloat;
    HarmonicsKernel<Truth> inTruth;
    const std::vector<DefinedHarmonic<Truth>> defined = definedHarmonics<Truth>(kMaxHarmonicDegree);
    for (const glm::dvec3& given : directions) {
        // Exact in float.
        const glm::vec3 narrow(given);
        const glm::dvec3 d(narrow);
        inDouble.findHarmonics(d, kMaxHarmonicDegree);
        inFloat.findHarmonics(narrow, kMaxHarmonicDegree);
        inTruth.findHarmonics({Truth(d.x), Truth(d.y), Truth(d.z)}, kMaxHarmonicDegree);
        for (int l = 0; l <= kMaxHarmonicDegree; l++)
            for (int m = -l; m <= l; m++) {
                const int i = harmonicIndex(l, m);
                const Truth truth = defined[static_cast<size_t>(i)].at(Truth(d.x), Truth(d.y), Truth(d.z));
                const auto errorOf = [&](double value) {
                    return std::abs((Truth(value) - truth).toDouble());
                };
                worstDouble = std::max(worstDouble, errorOf(inDouble.harmonicValue(i)));
                worstFloat = std::max(worstFloat, errorOf(static_cast<double>(inFloat.harmonicValue(i))));
                // The constants are doubles there too.
                REQUIRE(std::abs((inTruth.harmonicValue(i) - truth).toDouble()) <= kHarmonicDoubleError);
            }
    }
    CHECK(worstDouble <= kHarmonicDoubleError);
    CHECK(worstFloat <= kHarmonicFloatError);
}

TEST_CASE("HarmonicsAreOrthonormal") {
    constexpr int kCount = harmonicCount(kMaxHarmonicDegree);
    std::vector<double> gram(static_cast<size_t>(kCount * kCount));
    for (const WeightedDirection& point : exactQuadrature(12, 24)) {
        const std::vector<double> y = harmonicsAt(point.direction, kMaxHarmonicDegree);
        for (size_t a = 0; a < y.size(); a++)
            for (size_t b = 0; b < y.size(); b++) gram[a * kCount + b] += point.weight * y[a] * y[b];
    }
    double worst = 0;
    for (size_t a = 0; a < kCount; a++)
        for (size_t b = 0; b < kCount; b++)
            worst = std::max(worst, std::abs(gram[a * kCount + b] - (a == b ? 1 : 0)));
    CHECK(worst < 1e-13);
}

TEST_CASE("ProjectionIsTheSumOverTexels") {
    RandomNumbers random(5);
    const glm::dmat3 turned = randomRotation(random);
    for (const ProbeShape& shape : kSmallShapes)
        for (const int degree : {0, 4, 10})
            for (const bool turns : {false, true}) {
                Probe probe = randomProbe(shape, 3);
                if (turns) probe.rotation = turned;
                const std::vector<long double> direct = directCoefficients(probe, degree);
                CAPTURE(shape.width);
                CAPTURE(degree);
                CHECK(largestDifference(projectHarmonics(probe, degree), direct) <= kProjectionDoubleError);
                CHECK(largestDifference(projectHarmonics(probe, degree, Arithmetic::fp64), direct) <=
                      kProjectionDoubleError);
            }
}

TEST_CASE("BlindTexelsAreBlack") {
    for (const ProbeShape& shape : kSmallShapes) {
        Probe probe = randomProbe(shape, 4), black = probe;
        for (int layer = 0; layer < shape.layers(); layer++) {
            const auto l = static_cast<size_t>(layer);
            Image<uint8_t>& mask = probe.valid.emplace_back(shape.width, shape.height);
            mask.fill(1);
            mask.at(3, 2) = 0;
            for (int c = 0; c < 3; c++) {
                probe.radiance[l].at(3, 2, c) = std::nanf("");
                black.radiance[l].at(3, 2, c) = 0;
            }
        }
        CHECK(projectHarmonics(probe, 3).coefficients == projectHarmonics(black, 3).coefficients);
        CHECK(projectHarmonics(probe, 3, Arithmetic::fp32).coefficients ==
              projectHarmonics(black, 3, Arithmetic::fp32).coefficients);
    }
}

TEST_CASE("ProjectionOfHarmonicsConvergesWithTheSquareOfTheTexelSize") {
    const SphericalHarmonics f = randomHarmonics(4, 7);
    for (const Mapping mapping : {Mapping::latLong, Mapping::cube}) {
        double before = 0;
        for (const int size : {8, 16, 32}) {
            const ProbeShape shape{mapping, mapping == Mapping::cube ? size : 2 * size, size};
            const TexelGrid grid(shape);
            const Probe probe = madeProbe(shape, [&](int layer, int x, int y, int c) {
                return evaluate(f, grid.direction(layer, x, y))[c];
            });
            const SphericalHarmonics g = projectHarmonics(probe, 4);
            double error = 0;
            for (size_t i = 0; i < f.coefficients.size(); i++)
                for (int c = 0; c < 3; c++)
                    error = std::max(error, std::abs(f.coefficients[i][c] - g.coefficients[i][c]));
            if (before > 0) CHECK(error < before / 3.5);
            before = error;
        }
        CHECK(before < 0.02);
    }
}

TEST_CASE("HarmonicsOfThreadsAreTheSame") {
    const Probe probe = randomProbe({Mapping::latLong, 61, 33}, 8);
    const Probe cube = randomProbe({Mapping::cube, 17, 17}, 8);
    for (const Probe* p : {&probe, &cube}) {
        CHECK(projectHarmonics(*p, 5, 1).coefficients == projectHarmonics(*p, 5, 4).coefficients);
        CHECK(projectHarmonics(*p, 5, Arithmetic::fp24R300, 1).coefficients ==
              projectHarmonics(*p, 5, Arithmetic::fp24R300, 3).coefficients);
    }
}

TEST_CASE("EvaluationInEveryArithmeticIsNearTheFunction") {
    const SphericalHarmonics f = randomHarmonics(6, 9);
    RandomNumbers random(10);
    std::vector<glm::dvec3> directions;
    for (int i = 0; i < 40; i++) directions.push_back(randomUnitVector(random));
    for (const Arithmetic a : kAllArithmetics) {
        const std::vector<glm::dvec3> values = evaluateHarmonics(f, directions, a);
        double worst = 0;
        for (size_t i = 0; i < directions.size(); i++)
            for (int c = 0; c < 3; c++)
                worst = std::max(worst, std::abs(values[i][c] - evaluate(f, directions[i])[c]));
        CAPTURE(arithmeticName(a));
        CHECK(worst <= 8 * probeErrors(a).harmonic);
    }
}

TEST_CASE("WhiteFurnaceHasTheMeanOfTwoRootPi") {
    for (const Furnace& furnace : kFurnaces) {
        CAPTURE(static_cast<int>(furnace.shape.mapping));
        CAPTURE(furnace.shape.ballDistance_radii);
        const Probe white = constantProbe(furnace.shape, 1);
        const SphericalHarmonics exact = projectHarmonics(white, 4, Arithmetic::truth);
        const double expected = 2 * std::sqrt(kPi) * (furnace.shown_sr() / (4 * kPi));
        CHECK(std::abs(exact.coefficients[0].x / expected - 1) <= 1e-14);
        CHECK(std::abs(projectHarmonics(white, 4).coefficients[0].x / expected - 1) <= 1e-14);
        for (const Arithmetic a : kAllArithmetics) {
            const SphericalHarmonics f = projectHarmonics(white, 4, a);
            CAPTURE(arithmeticName(a));
            CAPTURE(f.coefficients[0].x / expected - 1);
            CHECK(std::abs(f.coefficients[0].x / expected - 1) <= probeErrors(a).harmonic);
            for (size_t i = 1; i < f.coefficients.size(); i++)
                CHECK(std::abs(f.coefficients[i].x - exact.coefficients[i].x) <=
                      4 * probeErrors(a).harmonic * 2 * std::sqrt(kPi));
        }
    }
}

TEST_CASE("ExtremeProbesHaveFiniteHarmonicsThatKeepTheirEnergy") {
    const double largestHalf = 65504;
    for (const Arithmetic a : kAllArithmetics) {
        const bool isHalf = a == Arithmetic::fp16 || a == Arithmetic::fp16Nv40;
        CAPTURE(arithmeticName(a));
        const auto check = [&](const Probe& probe) {
            // Half floats limit radiance to their largest number.
            Probe limited = probe;
            if (isHalf)
                for (Image<float>& image : limited.radiance)
                    for (float& v : image.values()) v = std::min(v, static_cast<float>(largestHalf));
            const double energy = projectHarmonics(limited, 2).coefficients[0].x;
            const SphericalHarmonics f = projectHarmonics(probe, 2, a);
            for (const glm::dvec3& c : f.coefficients) REQUIRE(std::isfinite(c.x));
            CHECK(std::abs(f.coefficients[0].x - energy) <= probeErrors(a).harmonic * energy);
        };
        for (const ProbeShape& shape : {ProbeShape{Mapping::latLong, 16, 8}, {Mapping::cube, 5, 5}}) {
            Probe sun = constantProbe(shape, 1e-3);
            for (int c = 0; c < 3; c++) sun.radiance[0].at(4, 3, c) = 1e6f;
            check(sun);
            Probe atPole = constantProbe(shape, 0);
            for (int c = 0; c < 3; c++) atPole.radiance[0].at(0, 0, c) = 1e4f;
            check(atPole);
            check(constantProbe(shape, largestHalf));
        }
        check(constantProbe({Mapping::latLong, 1, 1}, 1));
        check(constantProbe({Mapping::latLong, 1, 7}, 1));
        check(constantProbe({Mapping::cube, 1, 1}, 1));
    }
}

}  // namespace etalon
