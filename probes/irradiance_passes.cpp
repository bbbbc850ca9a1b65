#include "probes/irradiance_passes.h"

#include "numeric/door.h"
#include "numeric/parallel.h"
#include "probes/texel_rows_over.h"

namespace etalon {
namespace {

template <class T>
using Terms = std::vector<typename Number<T>::Kept>;
constexpr size_t kTermNumbers = 6;

// What each texel adds, in the arithmetic, in order: direction and flux. The last run is filled up with black ones.
template <class T>
Terms<T> texelTerms(const ScaledTexels<T>& texels, int threads) {
    using Kept = typename Number<T>::Kept;
    constexpr int kWidth = Number<T>::lanes;
    const auto width = static_cast<size_t>(texels.probe.shape.width);
    const size_t rows = texels.rowCount();
    const size_t runs = (rows * width + kIrradianceRun - 1) / kIrradianceRun;
    Terms<T> terms(runs * kIrradianceRun * kTermNumbers, Kept(0.0));
    parallelFor(rows, threads, [&](size_t r) {
        const TexelRow row = readTexels(texels, r);
        IrradianceKernel<T> kernel;
        const T radianceScale(std::ldexp(1.0, texels.scale.radiance));
        std::array<Kept, kWidth> lanes;
        forEachLaneGroup<kWidth>(width, [&](size_t first, int active) {
            typename IrradianceKernel<T>::vec3 direction, radiance;
            for (int c = 0; c < 3; c++) {
                const auto channel = static_cast<size_t>(c);
                direction[c] = Number<T>::load(row.direction[channel].data() + first);
                radiance[c] = Number<T>::load(row.radiance[channel].data() + first);
            }
            const auto d = kernel.flooredTerm3(direction);
            const auto flux =
                kernel.texelFlux(radiance, radianceScale, Number<T>::load(row.weight.data() + first));
            Kept* to = terms.data() + (r * width + first) * kTermNumbers;
            for (size_t number = 0; number < kTermNumbers; number++) {
                const auto c = static_cast<glm::length_t>(number % 3);
                Number<T>::storeKept(number < 3 ? d[c] : flux[c], lanes.data());
                for (size_t i = 0; i < static_cast<size_t>(active); i++)
                    to[i * kTermNumbers + number] = lanes[i];
            }
        });
    });
    return terms;
}

template <class T>
TexelLights texelLightsOver(const Probe& probe, int threads) {
    checkProbe(probe);
    const ScaledTexels<T> scaled(probe, threads);
    const Terms<T> terms = texelTerms<T>(scaled, threads);
    const ProbeShape& shape = probe.shape;
    const size_t texels = static_cast<size_t>(shape.layers()) * static_cast<size_t>(shape.width) *
                          static_cast<size_t>(shape.height);
    TexelLights lights{std::vector<glm::dvec3>(texels), std::vector<glm::dvec3>(texels)};
    for (size_t i = 0; i < texels; i++)
        for (size_t c = 0; c < 3; c++) {
            const auto* term = terms.data() + i * kTermNumbers + c;
            lights.directions[i][static_cast<glm::length_t>(c)] = numberLane(term[0], 0);
            lights.flux[i][static_cast<glm::length_t>(c)] = scaled.scale.takenOut(numberLane(term[3], 0));
        }
    return lights;
}

template <class T>
std::vector<glm::dvec3> irradianceAtOver(const Probe& probe, std::span<const glm::dvec3> normals,
                                         int threads) {
    using Kernel = IrradianceKernel<T>;
    using vec3 = typename Kernel::vec3;
    constexpr size_t kWidth = Number<T>::lanes;
    // Groups of lanes that share a walk over the texels.
    constexpr size_t kGroups = 4, kItem = kGroups * kWidth;
    checkProbe(probe);
    const ScaledTexels<T> scaled(probe, threads);
    const Terms<T> terms = texelTerms<T>(scaled, threads);
    const auto runs = static_cast<int>(terms.size() / (kTermNumbers * kIrradianceRun));
    std::vector<glm::dvec3> values(normals.size());
    parallelFor((normals.size() + kItem - 1) / kItem, threads, [&](size_t item) {
        const size_t first = item * kItem, count = std::min(normals.size() - first, kItem);
        Kernel kernel;
        std::array<vec3, kGroups> normal;
        for (size_t g = 0; g < kGroups; g++) {
            for (int c = 0; c < 3; c++)
                normal[g][c] = Number<T>::generate([&](int lane) {
                    const size_t i = first + g * kWidth + static_cast<size_t>(lane);
                    return normals[std::min(i, normals.size() - 1)][c];
                });
            normal[g] = kernel.flooredTerm3(normal[g]);
        }
        std::array<vec3, kGroups * Kernel::kPendingSums> sums;
        kernel.sources = terms.data();
        kernel.planeNormals = normal.data();
        kernel.pendingSums = sums.data();
        kernel.irradianceOfPlanes(static_cast<int>((count + kWidth - 1) / kWidth), runs, kIrradianceRun);
        for (size_t i = 0; i < count; i++) {
            const vec3 total = kernel.pendingSum(static_cast<int>(i / kWidth), 0);
            for (int c = 0; c < 3; c++)
                values[first + i][c] =
                    scaled.scale.takenOut(numberLane(total[c], static_cast<int>(i % kWidth)));
        }
    });
    return values;
}

}  // namespace

template <class T>
constexpr IrradiancePasses kPassesOver<IrradiancePasses, T> = {irradianceAtOver<T>, texelLightsOver<T>};
template const IrradiancePasses& ETALON_LEVEL::passesOf<IrradiancePasses>(NumberType);

}  // namespace etalon
