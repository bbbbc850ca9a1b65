#include "numeric/transform.h"

#include <doctest/doctest.h>

#include <array>

namespace etalon {
namespace {

// Bound for matrices made of a few rounded products of numbers up to 1.
constexpr double kTolerance = 1e-14;

double largestDifference(const glm::dmat4& a, const glm::dmat4& b) {
    double largest = 0;
    for (int c = 0; c < 4; c++)
        for (int r = 0; r < 4; r++) largest = std::max(largest, std::abs(a[c][r] - b[c][r]));
    return largest;
}

TEST_CASE("QuarterTurnsAreExact") {
    constexpr std::array<double, 4> kSin{0, 1, 0, -1}, kCos{1, 0, -1, 0};
    for (int quarter = -9; quarter <= 9; quarter++) {
        const SinCos turn = sinCosOfDegrees(90.0 * quarter);
        const size_t index = static_cast<size_t>(quarter & 3);
        CHECK(turn.sin == kSin[index]);
        CHECK(turn.cos == kCos[index]);
    }
}

TEST_CASE("SineAndCosineOfDegreesAgreeWithKnownAngles") {
    CHECK(sinCosOfDegrees(30).sin == doctest::Approx(0.5).epsilon(kTolerance));
    CHECK(sinCosOfDegrees(-150).sin == doctest::Approx(-0.5).epsilon(kTolerance));
    CHECK(sinCosOfDegrees(120).cos == doctest::Approx(-0.5).epsilon(kTolerance));
    CHECK(sinCosOfDegrees(420).cos == doctest::Approx(0.5).epsilon(kTolerance));
    CHECK(sinCosOfDegrees(45).sin == doctest::Approx(0.70710678118654752).epsilon(kTolerance));
}

TEST_CASE("RotationsAreCounterClockwise") {
    const glm::dvec3 aboutY = transformDirection(rotationAboutAxis({0, 1, 0}, 90), {0, 0, 1});
    CHECK(aboutY == glm::dvec3(1, 0, 0));
    const glm::dvec3 aboutX = transformDirection(rotationAboutAxis({1, 0, 0}, 90), {0, 1, 0});
    CHECK(aboutX == glm::dvec3(0, 0, 1));
}

TEST_CASE("EulerAnglesTurnAboutXFirst") {
    // +Y goes to +Z about X, stays there about a Y axis turn of 0, then Z keeps it.
    CHECK(transformDirection(rotationXyz({90, 0, 90}), {0, 1, 0}) == glm::dvec3(0, 0, 1));
    // +Z goes to -Y about X, then to +X about Z.
    CHECK(transformDirection(rotationXyz({90, 0, 90}), {0, 0, 1}) == glm::dvec3(1, 0, 0));
    // +Z stays about X by 0, goes to +X about Y, then to +Y about Z.
    CHECK(transformDirection(rotationXyz({0, 90, 90}), {0, 0, 1}) == glm::dvec3(0, 1, 0));
}

TEST_CASE("RigidInverseUndoesAPose") {
    const glm::dmat4 pose = lookAt({1, 2, 3}, {-4, 0.5, 2}, {0.1, 1, 0});
    CHECK(largestDifference(multiplied(pose, rigidInverse(pose)), glm::dmat4(1.0)) < kTolerance);
}

TEST_CASE("LookAtPutsTheTargetOnMinusZAndUpAboveIt") {
    const glm::dvec3 position(1, 2, 3), target(-4, 0.5, 2);
    const glm::dmat4 worldToCamera = rigidInverse(lookAt(position, target, {0, 1, 0}));
    const glm::dvec3 seen = transformPoint(worldToCamera, target);
    CHECK(std::abs(seen.x) < kTolerance);
    CHECK(std::abs(seen.y) < kTolerance);
    CHECK(seen.z < 0);
    const glm::dvec3 up = transformDirection(worldToCamera, {0, 1, 0});
    CHECK(std::abs(up.x) < kTolerance);
    CHECK(up.y > 0);
    CHECK(determinant3(worldToCamera) == doctest::Approx(1).epsilon(kTolerance));
}

TEST_CASE("NormalsStayPerpendicularAndOutward") {
    const glm::dmat4 m = multiplied(rotationXyz({20, 30, 40}), scaling({-2, 3, 0.5}));
    const glm::dvec3 tangent(1, 2, 0), normal(2, -1, 0), outward(2, -1, 0.5);
    CHECK(std::abs(dotOf(transformDirection(m, tangent), transformNormal(m, normal))) < 8 * kTolerance);
    CHECK(dotOf(transformDirection(m, outward), transformNormal(m, normal)) > 0);
}

TEST_CASE("ConditionTellsSingularMatricesAtAnyScale") {
    CHECK(conditionOf(scaling({1e-6, 1e6, -3})) == 1);
    CHECK(conditionOf(scaling({1, 0, 1})) == 0);
    glm::dmat4 flat(1.0);
    flat[2] = glm::dvec4(1, 1, 0, 0);
    CHECK(conditionOf(flat) == 0);
}

TEST_CASE("OrthonormalisedKeepsExactRotationsAndRepairsRoundedOnes") {
    const glm::dmat4 exact = rotationXyz({90, 180, 270});
    CHECK(orthonormalised(exact) == exact);
    glm::dmat4 rounded = rotationXyz({10, 20, 30});
    rounded[0][0] += 1e-6;
    rounded[1][2] -= 1e-6;
    const glm::dmat4 repaired = orthonormalised(rounded);
    CHECK(largestDifference(multiplied(repaired, rigidInverse(repaired)), glm::dmat4(1.0)) < kTolerance);
    CHECK(largestDifference(repaired, rounded) < 4e-6);
}

}  // namespace
}  // namespace etalon
