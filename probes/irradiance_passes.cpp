#include "probes/irradiance_passes.h"

#include "numeric/door.h"
#include "numeric/parallel.h"
#include "probes/term_sums.h"
#include "probes/texel_rows_over.h"

namespace etalon {
namespace {

// What a texel adds, in the arithmetic: direction and flux.
template <class T>
struct TexelTerms {
    typename Number<T>::Kept x, y, z, red, green, blue;
};

// Of all texels in order, the last run filled up with black ones.
template <class T>
std::vector<TexelTerms<T>> texelTerms(const Probe& probe, int threads) {
    constexpr int kWidth = Number<T>::lanes;
    checkProbe(probe);
    const TexelGrid grid(probe.shape);
    const auto width = static_cast<size_t>(probe.shape.width);
    const auto rows = static_cast<size_t>(probe.shape.layers() * probe.shape.height);
    const size_t runs = (rows * width + kIrradianceRun - 1) / kIrradianceRun;
    const typename Number<T>::Kept zero(0.0);
    std::vector<TexelTerms<T>> terms(runs * kIrradianceRun, {zero, zero, zero, zero, zero, zero});
    parallelFor(rows, threads, [&](size_t r) {
        const TexelRow row = readTexels(probe, grid, static_cast<int>(r) / probe.shape.height,
                                        static_cast<int>(r) % probe.shape.height);
        IrradianceKernel<T> kernel;
        std::array<std::array<typename Number<T>::Kept, kWidth>, 6> lanes;
        forEachLaneGroup<kWidth>(width, [&](size_t first, int active) {
            typename IrradianceKernel<T>::vec3 direction, radiance;
            for (int c = 0; c < 3; c++) {
                const auto channel = static_cast<size_t>(c);
                direction[c] = Number<T>::load(row.direction[channel].data() + first);
                radiance[c] = Number<T>::load(row.radiance[channel].data() + first);
            }
            const auto d = kernel.flooredTerm3(direction);
            const auto flux = kernel.texelFlux(radiance, Number<T>::load(row.weight.data() + first));
            for (int c = 0; c < 3; c++) {
                Number<T>::storeKept(d[c], lanes[static_cast<size_t>(c)].data());
                Number<T>::storeKept(flux[c], lanes[static_cast<size_t>(c) + 3].data());
            }
            for (size_t i = 0; i < static_cast<size_t>(active); i++)
                terms[r * width + first + i] = {lanes[0][i], lanes[1][i], lanes[2][i],
                                                lanes[3][i], lanes[4][i], lanes[5][i]};
        });
    });
    return terms;
}

// A sum in pairs of neighbours of a sequence of terms: `pending` holds the sums of 2^k terms for the bits k
// that are set in the count, the longest first.
template <class Vector>
class PairSum {
  public:
    template <class Add>
    void push(Vector term, const Add& add) {
        for (size_t carry = count_++; (carry & 1) != 0; carry >>= 1) term = add(pending_[--depth_], term);
        pending_[depth_++] = term;
    }
    // At least one term was pushed.
    template <class Add>
    Vector total(const Add& add) const {
        Vector sum = pending_[depth_ - 1];
        for (size_t i = depth_ - 1; i > 0; i--) sum = add(pending_[i - 1], sum);
        return sum;
    }

  private:
    std::array<Vector, 40> pending_;
    size_t depth_ = 0, count_ = 0;
};

template <class T>
std::vector<glm::dvec3> irradianceAtOver(const Probe& probe, std::span<const glm::dvec3> normals,
                                         int threads) {
    using Kernel = IrradianceKernel<T>;
    using vec3 = typename Kernel::vec3;
    constexpr size_t kWidth = Number<T>::lanes;
    // Groups of lanes that share a walk over the texels.
    constexpr size_t kGroups = 4, kItem = kGroups * kWidth;
    const std::vector<TexelTerms<T>> terms = texelTerms<T>(probe, threads);
    std::vector<glm::dvec3> values(normals.size());
    parallelFor((normals.size() + kItem - 1) / kItem, threads, [&](size_t item) {
        Kernel kernel;
        std::array<vec3, kGroups> normal;
        for (size_t g = 0; g < kGroups; g++) {
            for (int c = 0; c < 3; c++)
                normal[g][c] = Number<T>::generate([&](int lane) {
                    const size_t i = item * kItem + g * kWidth + static_cast<size_t>(lane);
                    return normals[std::min(i, normals.size() - 1)][c];
                });
            normal[g] = kernel.flooredTerm3(normal[g]);
        }
        const auto add = [&](const vec3& a, const vec3& b) { return kernel.add3(a, b); };
        std::array<PairSum<vec3>, kGroups> sums;
        for (size_t first = 0; first < terms.size(); first += kIrradianceRun)
            for (size_t g = 0; g < kGroups && item * kItem + g * kWidth < normals.size(); g++) {
                const vec3 n = normal[g];
                vec3 sum{T(0.0), T(0.0), T(0.0)};
                for (size_t i = first; i < first + kIrradianceRun; i++) {
                    const TexelTerms<T>& t = terms[i];
                    sum = kernel.addIrradiance(
                        sum, n,
                        {Number<T>::broadcast(t.x), Number<T>::broadcast(t.y), Number<T>::broadcast(t.z)},
                        {Number<T>::broadcast(t.red), Number<T>::broadcast(t.green),
                         Number<T>::broadcast(t.blue)});
                }
                sums[g].push(sum, add);
            }
        for (size_t i = item * kItem; i < std::min(normals.size(), (item + 1) * kItem); i++) {
            const size_t lane = i % kWidth;
            const vec3 total = sums[i % kItem / kWidth].total(add);
            for (int c = 0; c < 3; c++)
                values[i][c] = numberLane(total[c], static_cast<int>(lane)) / kFluxScale;
        }
    });
    return values;
}

}  // namespace

template <class T>
constexpr IrradiancePasses kPassesOver<IrradiancePasses, T> = {irradianceAtOver<T>};
template const IrradiancePasses& ETALON_LEVEL::passesOf<IrradiancePasses>(NumberType);

}  // namespace etalon
