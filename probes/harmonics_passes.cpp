#include "probes/harmonics_passes.h"

#include "numeric/door.h"
#include "numeric/parallel.h"
#include "probes/term_sums.h"
#include "probes/texel_rows_over.h"

namespace etalon {
namespace {

// One row: adds radiance x harmonic of each texel to `sums`, a block for each of the kTexelGroup partial
// sums; in a block three channels for each coefficient.
template <class T>
void addRowHarmonics(HarmonicsKernel<T>& kernel, const TexelRow& row, int degree, size_t block,
                     std::vector<T>& accumulators, std::vector<typename Number<T>::Kept>& sums) {
    constexpr int kWidth = Number<T>::lanes;
    static_assert(kTexelGroup % kWidth == 0);
    const auto count = static_cast<size_t>(harmonicCount(degree));
    std::array<typename Number<T>::Kept, kWidth> lanes;
    for (int part = 0; part < kTexelGroup; part += kWidth) {
        std::fill(accumulators.begin(), accumulators.end(), T(0.0));
        for (size_t x = static_cast<size_t>(part); x < static_cast<size_t>(row.padded); x += kTexelGroup) {
            typename HarmonicsKernel<T>::vec3 direction, radiance;
            for (int c = 0; c < 3; c++) {
                const auto channel = static_cast<size_t>(c);
                direction[c] = Number<T>::load(row.direction[channel].data() + x);
                radiance[c] = Number<T>::load(row.radiance[channel].data() + x);
            }
            const auto flux = kernel.texelFlux(radiance, Number<T>::load(row.weight.data() + x));
            kernel.findHarmonics(direction, degree);
            T* to = accumulators.data();
            for (size_t i = 0; i < count; i++, to += 3) {
                const T value = kernel.harmonicValue(static_cast<int>(i));
                to[0] = to[0] + flux.x * value;
                to[1] = to[1] + flux.y * value;
                to[2] = to[2] + flux.z * value;
            }
        }
        for (size_t i = 0; i < 3 * count; i++) {
            Number<T>::storeKept(accumulators[i], lanes.data());
            for (int lane = 0; lane < kWidth; lane++)
                sums[static_cast<size_t>(part + lane) * block + i] = lanes[static_cast<size_t>(lane)];
        }
    }
}

template <class T>
SphericalHarmonics projectHarmonicsOver(const Probe& probe, int degree, int threads) {
    constexpr size_t kWidth = Number<T>::lanes;
    SphericalHarmonics result(degree);
    checkProbe(probe);
    const TexelGrid grid(probe.shape);
    const auto terms = 3 * result.coefficients.size();
    const size_t block = (terms + kWidth - 1) / kWidth * kWidth;
    const auto rows = static_cast<size_t>(probe.shape.layers() * probe.shape.height);
    std::vector<typename Number<T>::Kept> rowSums(rows * block, typename Number<T>::Kept(0.0));
    parallelFor(rows, threads, [&](size_t r) {
        const int layer = static_cast<int>(r) / probe.shape.height;
        const TexelRow row = readTexels(probe, grid, layer, static_cast<int>(r) % probe.shape.height);
        HarmonicsKernel<T> kernel;
        std::vector<T> accumulators(terms);
        std::vector<typename Number<T>::Kept> sums(kTexelGroup * block, typename Number<T>::Kept(0.0));
        addRowHarmonics<T>(kernel, row, degree, block, accumulators, sums);
        foldTerms<T>(sums.data(), block, kTexelGroup);
        std::copy(sums.begin(), sums.begin() + static_cast<ptrdiff_t>(block),
                  rowSums.begin() + static_cast<ptrdiff_t>(r * block));
    });
    addInPairs<T>(rowSums, block);
    for (size_t i = 0; i < terms; i++)
        result.coefficients[i / 3][static_cast<glm::length_t>(i % 3)] = termAsDouble(rowSums[i]) / kFluxScale;
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
