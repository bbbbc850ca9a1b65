#include "probes/harmonics_passes.h"

#include "numeric/door.h"
#include "numeric/parallel.h"
#include "probes/term_sums.h"
#include "probes/texel_rows_over.h"

namespace etalon {
namespace {

// One row: adds flux x harmonic of each texel to `sums`, a block for each of the kTexelGroup partial
// sums; in a block three channels for each coefficient.
template <class T>
void addRowHarmonics(HarmonicsKernel<T>& kernel, const TexelRow& row, int degree, size_t block,
                     std::vector<typename Number<T>::Kept>& sums) {
    constexpr int kWidth = Number<T>::lanes;
    static_assert(kTexelGroup % kWidth == 0);
    const auto count = static_cast<size_t>(harmonicCount(degree));
    std::vector<typename HarmonicsKernel<T>::vec3> accumulators(count);
    kernel.row = &row;
    kernel.projectedSums = accumulators.data();
    std::array<typename Number<T>::Kept, kWidth> lanes;
    for (int part = 0; part < kTexelGroup; part += kWidth) {
        kernel.projectTexels(part, row.padded, kTexelGroup, degree);
        for (size_t i = 0; i < 3 * count; i++) {
            Number<T>::storeKept(accumulators[i / 3][static_cast<glm::length_t>(i % 3)], lanes.data());
            for (int lane = 0; lane < kWidth; lane++)
                sums[static_cast<size_t>(part + lane) * block + i] = lanes[static_cast<size_t>(lane)];
        }
    }
}

template <class T>
SphericalHarmonics projectHarmonicsOver(const Probe& probe, int degree, int threads) {
    SphericalHarmonics result(degree);
    checkProbe(probe);
    const ScaledTexels<T> texels(probe, threads);
    const auto terms = 3 * result.coefficients.size();
    const size_t block = paddedTerms<T>(terms);
    const size_t rows = texels.rowCount();
    std::vector<typename Number<T>::Kept> rowSums(rows * block, typename Number<T>::Kept(0.0));
    parallelFor(rows, threads, [&](size_t r) {
        const TexelRow row = readTexels(texels, r);
        HarmonicsKernel<T> kernel;
        kernel.scaleOfRadiance = T(std::ldexp(1.0, texels.scale.radiance));
        std::vector<typename Number<T>::Kept> sums(kTexelGroup * block, typename Number<T>::Kept(0.0));
        addRowHarmonics<T>(kernel, row, degree, block, sums);
        foldTerms<T>(sums.data(), block, kTexelGroup);
        std::copy(sums.begin(), sums.begin() + static_cast<ptrdiff_t>(block),
                  rowSums.begin() + static_cast<ptrdiff_t>(r * block));
    });
    addInPairs<T>(rowSums, block);
    for (size_t i = 0; i < terms; i++)
        result.coefficients[i / 3][static_cast<glm::length_t>(i % 3)] =
            texels.scale.takenOut(termAsDouble(rowSums[i]));
    return result;
}

template <class T>
std::vector<glm::dvec3> evaluateHarmonicsOver(const SphericalHarmonics& harmonics,
                                              std::span<const glm::dvec3> directions, int threads) {
    constexpr size_t kWidth = Number<T>::lanes, kItem = 1024;
    std::vector<glm::dvec3> values(directions.size());
    parallelFor((directions.size() + kItem - 1) / kItem, threads, [&](size_t item) {
        const size_t begin = item * kItem, end = std::min(directions.size(), begin + kItem);
        HarmonicsKernel<T> kernel;
        kernel.setCoefficients(harmonics);
        forEachLaneGroup<kWidth>(end - begin, [&](size_t first, int active) {
            typename HarmonicsKernel<T>::vec3 d;
            for (int c = 0; c < 3; c++)
                d[c] = Number<T>::generate([&](int lane) {
                    return directions[begin + first + static_cast<size_t>(std::min(lane, active - 1))][c];
                });
            const auto value = kernel.sumOfHarmonics(d, harmonics.degree);
            for (int lane = 0; lane < active; lane++)
                for (int c = 0; c < 3; c++)
                    values[begin + first + static_cast<size_t>(lane)][c] = numberLane(value[c], lane);
        });
    });
    return values;
}

}  // namespace

template <class T>
constexpr HarmonicsPasses kPassesOver<HarmonicsPasses, T> = {projectHarmonicsOver<T>,
                                                             evaluateHarmonicsOver<T>};
template const HarmonicsPasses& ETALON_LEVEL::passesOf<HarmonicsPasses>(NumberType);

}  // namespace etalon
