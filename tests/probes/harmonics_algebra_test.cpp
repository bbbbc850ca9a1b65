// Rotation, products, lobes, windows and layouts of spherical harmonics.
#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "probes/harmonics_layout.h"
#include "probes/harmonics_lobes.h"
#include "probes/harmonics_product.h"
#include "probes/harmonics_rotation.h"
#include "tests/probes/made_probes.h"

namespace etalon {

namespace {

constexpr double kPi = 0x1.921fb54442d18p+1;

SphericalHarmonics randomHarmonics(int degree, uint64_t seed) {
    RandomNumbers random(seed);
    SphericalHarmonics f(degree);
    for (glm::dvec3& c : f.coefficients)
        c = {random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
    return f;
}

double largestComponent(const glm::dvec3& a) {
    return std::max(std::abs(a.x), std::max(std::abs(a.y), std::abs(a.z)));
}

}  // namespace

TEST_CASE("RotatedHarmonicsShowTheFunctionTurned") {
    RandomNumbers random(1);
    const SphericalHarmonics f = randomHarmonics(kMaxHarmonicDegree, 2);
    std::vector<glm::dmat3> rotations = {glm::dmat3(1),
                                         rotationAbout({0, 0, 1}, kPi / 2),
                                         rotationAbout({0, 1, 0}, kPi),
                                         rotationAbout({1, 0, 0}, -kPi / 2),
                                         {{0, 0, 1}, {1, 0, 0}, {0, 1, 0}}};
    for (int i = 0; i < 4; i++) rotations.push_back(randomRotation(random));
    for (const glm::dmat3& r : rotations) {
        const SphericalHarmonics turned = rotateHarmonics(f, r);
        for (int i = 0; i < 10; i++) {
            const glm::dvec3 d = randomUnitVector(random);
            CHECK(largestComponent(evaluate(turned, r * d) - evaluate(f, d)) < 1e-12);
        }
    }
    CHECK(rotateHarmonics(f, glm::dmat3(1)).coefficients == f.coefficients);
}

TEST_CASE("HarmonicRotationsAreOrthogonalAndCompose") {
    RandomNumbers random(3);
    for (int round = 0; round < 3; round++) {
        const glm::dmat3 a = randomRotation(random), b = randomRotation(random);
        const HarmonicRotation ofA(a, kMaxHarmonicDegree), ofB(b, kMaxHarmonicDegree),
            ofBoth(a * b, kMaxHarmonicDegree);
        for (int l = 0; l <= kMaxHarmonicDegree; l++)
            for (int m = -l; m <= l; m++)
                for (int n = -l; n <= l; n++) {
                    double gram = 0, product = 0;
                    for (int k = -l; k <= l; k++) {
                        gram += ofA.at(l, m, k) * ofA.at(l, n, k);
                        product += ofA.at(l, m, k) * ofB.at(l, k, n);
                    }
                    REQUIRE(std::abs(gram - (m == n ? 1 : 0)) < kHarmonicRotationError);
                    REQUIRE(std::abs(product - ofBoth.at(l, m, n)) < kHarmonicRotationError);
                }
    }
}

TEST_CASE("ReflectionsAndScalesAreNoRotations") {
    for (const glm::dmat3& m :
         {glm::dmat3(2), glm::dmat3(-1), glm::dmat3(0), glm::dmat3(std::numeric_limits<double>::quiet_NaN())})
        CHECK_THROWS_AS(HarmonicRotation(m, 2), PreconditionError);
}

TEST_CASE("ZonalRotationAgreesWithTheFullOne") {
    RandomNumbers random(4);
    for (int round = 0; round < 5; round++) {
        std::vector<double> zonal;
        SphericalHarmonics f(kMaxHarmonicDegree);
        for (int l = 0; l <= kMaxHarmonicDegree; l++) {
            zonal.push_back(random.uniform(-1, 1));
            f.at(l, 0) = glm::dvec3(zonal.back());
        }
        // A rotation takes z to the axis, whatever it does around it.
        const glm::dmat3 r = randomRotation(random);
        const SphericalHarmonics turned = rotateHarmonics(f, r);
        const std::vector<double> direct = rotateZonal(zonal, r[2]);
        for (size_t i = 0; i < direct.size(); i++)
            CHECK(std::abs(direct[i] - turned.coefficients[i].x) < 1e-12);
    }
}

TEST_CASE("ProductsAreProductsOfTheFunctions") {
    RandomNumbers random(5);
    const SphericalHarmonics f = randomHarmonics(4, 6), g = randomHarmonics(6, 7);
    const HarmonicProduct product(4, 6, 10);
    const SphericalHarmonics h = product.multiply(f, g);
    for (int i = 0; i < 50; i++) {
        const glm::dvec3 d = randomUnitVector(random);
        CHECK(largestComponent(evaluate(h, d) - evaluate(f, d) * evaluate(g, d)) < 1e-11);
    }
    // The matrix is the same product.
    const std::vector<double> matrix = product.matrix(f, 1);
    for (size_t c = 0; c < h.coefficients.size(); c++) {
        double sum = 0;
        for (size_t b = 0; b < g.coefficients.size(); b++)
            sum += matrix[c * g.coefficients.size() + b] * g.coefficients[b].y;
        CHECK(std::abs(sum - h.coefficients[c].y) < 1e-12);
    }
}

TEST_CASE("ProductTensorIsSymmetricAndSparse") {
    const HarmonicProduct product(3, 3, 3);
    const auto valueOf = [&](int a, int b, int c) {
        for (const HarmonicProduct::Term& t : product.terms())
            if (t.a == a && t.b == b && t.c == c) return t.value;
        return 0.0;
    };
    for (const HarmonicProduct::Term& t : product.terms()) {
        REQUIRE(std::abs(valueOf(t.b, t.a, t.c) - t.value) < kProductTensorError);
        REQUIRE(std::abs(valueOf(t.c, t.b, t.a) - t.value) < kProductTensorError);
    }
    // y_0^0 is a constant; the cube of y_2^0 integrates to sqrt(5 / pi) / 7.
    for (int i = 0; i < 16; i++) CHECK(std::abs(valueOf(0, i, i) - 1 / std::sqrt(4 * kPi)) < 1e-14);
    CHECK(std::abs(valueOf(6, 6, 6) - std::sqrt(5 / kPi) / 7) < 1e-14);
    // All others of the 16^3 integrals are 0.
    std::vector<double> integrals(16 * 16 * 16);
    for (const WeightedDirection& point : exactQuadrature(5, 10)) {
        const std::vector<double> y = harmonicsAt(point.direction, 3);
        for (size_t i = 0; i < integrals.size(); i++)
            integrals[i] += point.weight * y[i / 256] * y[i / 16 % 16] * y[i % 16];
    }
    for (const HarmonicProduct::Term& t : product.terms())
        integrals[static_cast<size_t>(t.a) * 256 + static_cast<size_t>(t.b) * 16 + t.c] -= t.value;
    for (const double left : integrals) REQUIRE(std::abs(left) < kProductTensorError);
    CHECK(product.terms().size() < integrals.size() / 10);
}

TEST_CASE("LobesAreTheirIntegrals") {
    const auto legendre = [](int l, double t) {
        double before = 1, value = l == 0 ? 1 : t;
        for (int n = 2; n <= l; n++) {
            const double next = ((2 * n - 1) * t * value - (n - 1) * before) / n;
            before = value, value = next;
        }
        return value;
    };
    // Simpson's rule on [0, 1].
    const auto integral = [](auto&& f) {
        constexpr int kSteps = 20000;
        double sum = f(0.0) + f(1.0);
        for (int i = 1; i < kSteps; i++) sum += (i % 2 == 0 ? 2 : 4) * f(static_cast<double>(i) / kSteps);
        return sum / (3 * kSteps);
    };
    const std::vector<double> cosine = cosineLobe(10), phong = phongLobe(10, 5.5);
    for (int l = 0; l <= 10; l++) {
        const auto i = static_cast<size_t>(l);
        CHECK(std::abs(cosine[i] - 2 * kPi * integral([&](double t) { return t * legendre(l, t); })) < 1e-11);
        CHECK(std::abs(phong[i] -
                       7.5 * integral([&](double t) { return std::pow(t, 5.5) * legendre(l, t); })) < 1e-11);
    }
    CHECK(std::abs(cosine[1] - 2 * kPi / 3) < 1e-15);
    CHECK(std::abs(cosine[2] - kPi / 4) < 1e-15);
    CHECK(cosine[3] == 0);
    CHECK(mirrorLobe(2) == std::vector<double>{1, 1, 1});
    CHECK(std::abs(zonalOfLobe(cosine)[0] - std::sqrt(kPi) / 2) < 1e-15);
}

TEST_CASE("WindowsFallFromOneToZero") {
    for (const auto& factors : {hanningWindow(10, 8.0), lanczosWindow(10, 8.0)}) {
        CHECK(factors[0] == 1);
        for (size_t l = 1; l <= 10; l++) {
            CHECK(factors[l] <= factors[l - 1]);
            CHECK((l < 8) == (factors[l] > 0));
        }
    }
    CHECK(std::abs(hanningWindow(4, 4)[2] - 0.5) < 1e-15);
    CHECK(std::abs(lanczosWindow(4, 4)[2] - 2 / kPi) < 1e-15);
    CHECK_THROWS_AS(hanningWindow(2, 0), PreconditionError);
}

TEST_CASE("MinimalWindowRemovesOnlyWhatIsNegative") {
    // A sun: its harmonics ring.
    SphericalHarmonics sun(6);
    const std::vector<double> delta = rotateZonal(zonalOfLobe(mirrorLobe(6)), {0.48, 0.6, 0.64});
    for (size_t i = 0; i < delta.size(); i++) sun.coefficients[i] = glm::dvec3(1, 0.5, 2) * delta[i];
    REQUIRE(smallestValue(sun) < -0.1);
    const MinimalWindow window = minimalWindow(sun);
    const SphericalHarmonics windowed = scaleBands(sun, window.factors);
    const double peak = evaluate(windowed, {0.48, 0.6, 0.64}).z;
    CHECK(smallestValue(windowed) >= 0);
    CHECK(smallestValue(windowed) < 1e-9 * peak);
    RandomNumbers random(8);
    for (int i = 0; i < 2000; i++) CHECK(evaluate(windowed, randomUnitVector(random)).z >= -1e-9 * peak);
    // A weaker one leaves something negative.
    std::vector<double> weaker;
    for (int l = 0; l <= 6; l++)
        weaker.push_back(1 / (1 + 0.99 * window.strength * (l * (l + 1)) * (l * (l + 1))));
    CHECK(smallestValue(scaleBands(sun, weaker)) < 0);

    // Nothing negative: nothing changes. Black stays black. No mean, no window.
    SphericalHarmonics soft(2);
    soft.at(0, 0) = glm::dvec3(1);
    soft.at(1, 0) = glm::dvec3(0.1);
    CHECK(minimalWindow(soft).strength == 0);
    CHECK(minimalWindow(soft).factors == std::vector<double>{1, 1, 1});
    CHECK(minimalWindow(SphericalHarmonics(3)).strength == 0);
    soft.at(0, 0) = glm::dvec3(0);
    CHECK(minimalWindow(soft).strength == std::numeric_limits<double>::infinity());
    CHECK(minimalWindow(soft).factors == std::vector<double>{1, 0, 0});
}

TEST_CASE("SmallestValueOfALinearFunctionIsBehindIt") {
    SphericalHarmonics f(1);
    f.at(1, -1) = {0.3, 0, 0};
    f.at(1, 0) = {-0.4, 0, 0};
    f.at(1, 1) = {1.2, 0, 0};
    CHECK(std::abs(smallestValue(f) + std::sqrt(3 / (4 * kPi)) * 1.3) < 1e-10);
}

TEST_CASE("LayoutsHoldTheCoefficientsInTheirOrder") {
    SphericalHarmonics f(2);
    for (size_t i = 0; i < 9; i++)
        f.coefficients[i] = {static_cast<double>(i), 10 + static_cast<double>(i),
                             20 + static_cast<double>(i)};
    const std::vector<double> interleaved = layOut(f, CoefficientLayout::interleaved);
    const std::vector<double> planar = layOut(f, CoefficientLayout::planar);
    REQUIRE(interleaved.size() == 27);
    CHECK(std::vector<double>(interleaved.begin(), interleaved.begin() + 6) ==
          std::vector<double>{0, 10, 20, 1, 11, 21});
    CHECK(std::vector<double>(planar.begin() + 8, planar.begin() + 11) == std::vector<double>{8, 10, 11});
    for (const CoefficientLayout layout : {CoefficientLayout::interleaved, CoefficientLayout::planar})
        CHECK(fromLayout(layOut(f, layout), layout).coefficients == f.coefficients);
    CHECK(degreeOfLayout(3) == 0);
    CHECK(degreeOfLayout(363) == 10);
    CHECK(!degreeOfLayout(28));
    CHECK(!degreeOfLayout(0));
    CHECK_THROWS_AS(fromLayout(std::vector<double>(5), CoefficientLayout::planar), PreconditionError);
}

TEST_CASE("ArCoreFactorsAreTheCosineLobeOverPi") {
    // What ARCore's sample multiplies its coefficients with, for irradiance over pi [ARCore, LightEstimate].
    const double factors[] = {0.282095,  -0.325735, 0.325735,  -0.325735, 0.273137,
                              -0.273137, 0.078848,  -0.273137, 0.136569};
    const glm::dvec3 n(0.36, 0.48, 0.8);
    const double polynomials[] = {
        1, n.y, n.z, n.x, n.y * n.x, n.y * n.z, 3 * n.z * n.z - 1, n.z * n.x, n.x * n.x - n.y * n.y};
    const std::vector<double> lobe = cosineLobe(2), values = harmonicsAt(n, 2);
    for (int l = 0; l <= 2; l++)
        for (int m = -l; m <= l; m++) {
            const auto i = static_cast<size_t>(harmonicIndex(l, m));
            CHECK(std::abs(values[i] * lobe[static_cast<size_t>(l)] / kPi - factors[i] * polynomials[i]) <
                  1e-6);
        }
}

}  // namespace etalon
