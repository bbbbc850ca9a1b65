// Spherical harmonics of a lat-long probe by azimuthal moments.
#include "numeric/door.h"
#include "numeric/parallel.h"
#include "probes/harmonics_passes.h"
#include "probes/latlong.h"
#include "probes/spherical_harmonics.h"
#include "probes/term_sums.h"

namespace etalon {
namespace {

// Partial sums along a row: the texels x, x + 8, x + 16, ... belong to one.
inline constexpr int kMomentParts = 8;

// The texts over T, and what they read and write.
template <class T>
struct LatLongMomentsKernel {
#include "numeric/kernel_scope.inc"
#include "numeric/kernels/vector.glsl"

    // Functions of longitude, each `padded` long and 0 behind the width.
    double* longitudes = nullptr;
    size_t padded = 0, column = 0;
    const TexelRow* row = nullptr;
    const double* moments = nullptr;  // of the functions, three channels each
    HarmonicsKernel<T>* harmonics = nullptr;

    real longitudeValue(int function, int x) const {
        return Number<T>::load(longitudes + static_cast<size_t>(function) * padded + x);
    }
    void setLongitudeValue(int function, real value) {
        longitudes[static_cast<size_t>(function) * padded + column] = numberLane(value, 0);
    }
    vec3 texelRadiance(int x) const {
        const auto channel = [&](size_t c) { return Number<T>::load(row->radiance[c].data() + x); };
        return {channel(0), channel(1), channel(2)};
    }
    vec3 azimuthalMoment(int function) const {
        const double* of = moments + 3 * static_cast<size_t>(function);
        return {T(of[0]), T(of[1]), T(of[2])};
    }
    void findHarmonics(vec3 direction, int degree) { harmonics->findHarmonics(direction, degree); }
    real harmonicValue(int i) const { return harmonics->harmonicValue(i); }
    void setProjectedSum(int i, const vec3& sum) { harmonics->setProjectedSum(i, sum); }
#include "probes/kernels/latlong_moments.glsl"
};

// The functions of longitude that a row is multiplied with.
struct LongitudeTable {
    LongitudeTable(int width, int degree)
        : padded((static_cast<size_t>(width) + kMomentParts - 1) / kMomentParts * kMomentParts),
          count(2 * static_cast<size_t>(degree) + 1),
          values(count * padded) {
        const LatLongGrid equator(width, 1);
        LatLongMomentsKernel<double> kernel{.longitudes = values.data(), .padded = padded};
        for (; kernel.column < static_cast<size_t>(width); kernel.column++)
            kernel.findLongitudes(equator.direction(static_cast<int>(kernel.column), 0), degree);
    }
    size_t padded, count;
    std::vector<double> values;
};

// With a number of functions that is known where it is compiled, so that the sums stay in registers.
template <class D, int functions>
[[gnu::flatten]] typename LatLongMomentsKernel<D>::Moments momentsOf(LatLongMomentsKernel<D> kernel,
                                                                     int function, int part) {
    return kernel.momentsOf(function, functions, part, static_cast<int>(kernel.padded), kMomentParts);
}

// The moments of a row, kMomentParts partial sums folded: the first 3 table.count of `sums`, which holds
// kMomentParts times as many, padded to lanes of D.
template <class D>
void findMoments(const TexelRow& row, LongitudeTable& table, std::vector<double>& sums) {
    constexpr int kWidth = Number<D>::lanes;
    static_assert(kMomentParts % kWidth == 0);
    LatLongMomentsKernel<D> kernel{.longitudes = table.values.data(), .padded = table.padded, .row = &row};
    const size_t terms = sums.size() / kMomentParts;
    const auto count = static_cast<int>(table.count);
    std::array<double, kWidth> lanes;
    for (int part = 0; part < kMomentParts; part += kWidth)
        for (int f = 0; f < count; f += 3) {
            const int functions = std::min(3, count - f);
            const auto found = functions == 3   ? momentsOf<D, 3>(kernel, f, part)
                               : functions == 2 ? momentsOf<D, 2>(kernel, f, part)
                                                : momentsOf<D, 1>(kernel, f, part);
            const std::array of = {found.ofFirst, found.ofSecond, found.ofThird};
            for (int i = 0; i < 3 * functions; i++) {
                Number<D>::storeKept(of[static_cast<size_t>(i / 3)][i % 3], lanes.data());
                for (int lane = 0; lane < kWidth; lane++)
                    sums[static_cast<size_t>(part + lane) * terms + static_cast<size_t>(3 * f + i)] =
                        lanes[static_cast<size_t>(lane)];
            }
        }
    foldTerms<D>(sums.data(), terms, kMomentParts);
}

// See projectHarmonics. The coefficients of a probe about its image's axis: the harmonics are those of the
// directions (z, x, y), so that their polar axis is the image's vertical axis and their azimuth the
// longitude.
template <class D>
SphericalHarmonics projectLatLongOver(const Probe& probe, int degree, int threads) {
    SphericalHarmonics result(degree);
    checkProbe(probe);
    const TexelGrid grid(probe.shape);
    const LatLongGrid meridian(1, probe.shape.height);
    LongitudeTable table(probe.shape.width, degree);
    const size_t terms = 3 * result.coefficients.size();
    const auto rows = static_cast<size_t>(probe.shape.height);
    std::vector<double> rowSums(rows * terms);
    parallelFor(rows, threads, [&](size_t r) {
        const int y = static_cast<int>(r);
        const TexelRow row = readRadiance(probe, 0, y);
        std::vector<double> moments(kMomentParts * paddedTerms<D>(3 * table.count));
        findMoments<D>(row, table, moments);
        HarmonicsKernel<double> harmonics;
        std::vector<glm::dvec3> sums(result.coefficients.size());
        harmonics.projectedSums = sums.data();
        LatLongMomentsKernel<double> kernel{.moments = moments.data(), .harmonics = &harmonics};
        const glm::dvec3 d = meridian.direction(0, y);
        kernel.projectMoments({d.z, d.x, d.y}, grid.solidAngle_sr(0, 0, y), degree);
        for (size_t i = 0; i < terms; i++)
            rowSums[r * terms + i] = sums[i / 3][static_cast<glm::length_t>(i % 3)];
    });
    addInPairs<double>(rowSums, terms);
    for (size_t i = 0; i < terms; i++)
        result.coefficients[i / 3][static_cast<glm::length_t>(i % 3)] = rowSums[i];
    return result;
}

}  // namespace

template <>
constexpr LatLongHarmonicsPasses kPassesOver<LatLongHarmonicsPasses, void> = {
    projectLatLongOver<Native<double>>};
template const LatLongHarmonicsPasses& ETALON_LEVEL::passesOf<LatLongHarmonicsPasses>();

}  // namespace etalon
