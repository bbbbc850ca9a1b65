#include "probes/harmonics_layout.h"

#include "numeric/check.h"

namespace etalon {

namespace {

size_t positionOf(size_t coefficient, size_t channel, size_t count, CoefficientLayout layout) {
    return layout == CoefficientLayout::interleaved ? 3 * coefficient + channel
                                                    : channel * count + coefficient;
}

}  // namespace

std::vector<double> layOut(const SphericalHarmonics& harmonics, CoefficientLayout layout) {
    const size_t count = harmonics.coefficients.size();
    std::vector<double> numbers(3 * count);
    for (size_t i = 0; i < count; i++)
        for (size_t c = 0; c < 3; c++)
            numbers[positionOf(i, c, count, layout)] =
                harmonics.coefficients[i][static_cast<glm::length_t>(c)];
    return numbers;
}

std::optional<int> degreeOfLayout(size_t numbers) {
    for (int degree = 0; degree <= kMaxHarmonicDegree; degree++)
        if (3 * static_cast<size_t>(harmonicCount(degree)) == numbers) return degree;
    return std::nullopt;
}

SphericalHarmonics fromLayout(std::span<const double> numbers, CoefficientLayout layout) {
    const std::optional<int> degree = degreeOfLayout(numbers.size());
    ETALON_CHECK(degree, "{} numbers are the coefficients of no degree", numbers.size());
    SphericalHarmonics harmonics(*degree);
    const size_t count = harmonics.coefficients.size();
    for (size_t i = 0; i < count; i++)
        for (size_t c = 0; c < 3; c++)
            harmonics.coefficients[i][static_cast<glm::length_t>(c)] =
                numbers[positionOf(i, c, count, layout)];
    return harmonics;
}

}  // namespace etalon
