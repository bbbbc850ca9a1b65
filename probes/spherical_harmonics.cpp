#include "probes/spherical_harmonics.h"

#include <cmath>

#include "numeric/check.h"
#include "numeric/door.h"
#include "probes/harmonics_passes.h"
#include "probes/harmonics_rotation.h"

namespace etalon {

namespace {

constexpr double kFourPi = 4 * 0x1.921fb54442d18p+1;

HarmonicConstants makeConstants() {
    HarmonicConstants constants{};
    // y_m^m = start (x + iy)^m: start^2 is (2m + 1)!! / ((2m)!! 4 pi), twice that for m > 0.
    double square = 1 / kFourPi;
    for (int m = 0; m <= kMaxHarmonicDegree; m++) {
        if (m > 0) square *= (2.0 * m + 1) / (2.0 * m);
        const double start = std::sqrt(m > 0 ? 2 * square : square);
        constants.rise[static_cast<size_t>(harmonicIndex(m, m))] = m % 2 == 0 ? start : -start;
        for (int l = m + 1; l <= kMaxHarmonicDegree; l++) {
            const auto i = static_cast<size_t>(harmonicIndex(l, m));
            const double span = l * l - m * m, before = (l - 1) * (l - 1) - m * m;
            constants.rise[i] = std::sqrt((4.0 * l * l - 1) / span);
            constants.fall[i] =
                std::sqrt((4.0 * l * l - 1) * before / (span * (4.0 * (l - 1) * (l - 1) - 1)));
        }
    }
    return constants;
}

}  // namespace

SphericalHarmonics::SphericalHarmonics(int newDegree) : degree(newDegree) {
    ETALON_CHECK(newDegree >= 0 && newDegree <= kMaxHarmonicDegree, "degree {}", newDegree);
    coefficients.assign(static_cast<size_t>(harmonicCount(newDegree)), glm::dvec3(0));
}

const HarmonicConstants& harmonicConstants() {
    static const HarmonicConstants constants = makeConstants();
    return constants;
}

std::vector<double> harmonicsAt(const glm::dvec3& direction, int degree) {
    ETALON_CHECK(degree >= 0 && degree <= kMaxHarmonicDegree, "degree {}", degree);
    HarmonicsKernel<double> kernel;
    kernel.findHarmonics(direction, degree);
    std::vector<double> values(static_cast<size_t>(harmonicCount(degree)));
    for (size_t i = 0; i < values.size(); i++) values[i] = kernel.harmonicValue(static_cast<int>(i));
    return values;
}

glm::dvec3 evaluate(const SphericalHarmonics& harmonics, const glm::dvec3& direction) {
    HarmonicsKernel<double> kernel;
    kernel.setCoefficients(harmonics);
    return kernel.sumOfHarmonics(direction, harmonics.degree);
}

SphericalHarmonics projectHarmonics(const Probe& probe, int degree, Arithmetic arithmetic, int threads) {
    return passesIn<HarmonicsPasses>(arithmetic)->project(probe, degree, threads);
}

SphericalHarmonics projectHarmonics(const Probe& probe, int degree, int threads) {
    if (probe.shape.mapping != Mapping::latLong)
        return projectHarmonics(probe, degree, Arithmetic::fp64, threads);
    // The third axis of the sums is the image's vertical axis: they see directions (z, x, y) for (x, y, z).
    const SphericalHarmonics aboutVertical =
        levelPasses<LatLongHarmonicsPasses>().project(probe, degree, threads);
    const glm::dmat3 unturned(glm::dvec3(0, 0, 1), glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0));
    return rotateHarmonics(aboutVertical, probe.rotation * unturned);
}

std::vector<glm::dvec3> evaluateHarmonics(const SphericalHarmonics& harmonics,
                                          std::span<const glm::dvec3> directions, Arithmetic arithmetic,
                                          int threads) {
    return passesIn<HarmonicsPasses>(arithmetic)->evaluate(harmonics, directions, threads);
}

}  // namespace etalon
