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

// The functions of longitude that a row is multiplied with, each `padded` long and 0 behind the width:
// 1, cos, sin, cos 2, sin 2, ...
struct LongitudeTable {
    LongitudeTable(int width, int degree)
        : padded((static_cast<size_t>(width) + kMomentParts - 1) / kMomentParts * kMomentParts),
          count(2 * static_cast<size_t>(degree) + 1),
          values(count * padded) {
        const LatLongGrid equator(width, 1);
        for (int x = 0; x < width; x++) {
            const glm::dvec3 d = equator.direction(x, 0);
            double cosine = 1, sine = 0;
            for (size_t m = 0; m <= static_cast<size_t>(degree); m++) {
                const auto i = static_cast<size_t>(x);
                if (m > 0) values[(2 * m - 1) * padded + i] = cosine;
                values[2 * m * padded + i] = m > 0 ? sine : 1;
                const double next = cosine * d.z - sine * d.x;
                sine = cosine * d.x + sine * d.z;
                cosine = next;
            }
        }
    }
    size_t padded, count;
    std::vector<double> values;
};

// The sums over x of the row's three channels times `functions` rows of the table, kMomentParts partial sums
// folded; moments[function * 3 + channel].
template <class D, int functions>
void findMoments(const TexelRow& row, const double* table, size_t padded, double* moments) {
    constexpr int kWidth = Number<D>::lanes;
    static_assert(kMomentParts % kWidth == 0);
    std::array<double, 3 * functions * kMomentParts> parts;
    for (int part = 0; part < kMomentParts; part += kWidth) {
        std::array<D, 3 * functions> sums;
        sums.fill(D(0.0));
        for (size_t x = static_cast<size_t>(part); x < padded; x += kMomentParts)
            for (size_t c = 0; c < 3; c++) {
                const D radiance = Number<D>::load(row.radiance[c].data() + x);
                for (size_t f = 0; f < functions; f++)
                    sums[3 * f + c] =
                        sums[3 * f + c] + radiance * Number<D>::loadKept(table + f * padded + x);
            }
        for (size_t i = 0; i < sums.size(); i++)
            Number<D>::storeKept(sums[i], &parts[i * kMomentParts] + part);
    }
    for (size_t i = 0; i < 3 * functions; i++) {
        double* p = &parts[i * kMomentParts];
        for (int half = kMomentParts / 2; half > 0; half /= 2)
            for (int j = 0; j < half; j++) p[j] = p[j] + p[j + half];
        moments[i] = p[0];
    }
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
    const LongitudeTable table(probe.shape.width, degree);
    const size_t terms = 3 * result.coefficients.size();
    const auto rows = static_cast<size_t>(probe.shape.height);
    std::vector<double> rowSums(rows * terms);
    parallelFor(rows, threads, [&](size_t r) {
        const int y = static_cast<int>(r);
        const TexelRow row = readRadiance(probe, 0, y);
        std::vector<double> moments(3 * table.count);
        for (size_t f = 0; f < table.count;) {
            const double* functions = table.values.data() + f * table.padded;
            double* to = moments.data() + 3 * f;
            const size_t left = table.count - f;
            if (left >= 3)
                findMoments<D, 3>(row, functions, table.padded, to), f += 3;
            else if (left == 2)
                findMoments<D, 2>(row, functions, table.padded, to), f += 2;
            else
                findMoments<D, 1>(row, functions, table.padded, to), f += 1;
        }
        // On the meridian of longitude 0 the harmonics of m >= 0 are their functions of latitude.
        const glm::dvec3 d = meridian.direction(0, y);
        HarmonicsKernel<double> kernel;
        kernel.findHarmonics({d.z, d.x, d.y}, degree);
        for (int l = 0; l <= degree; l++)
            for (int m = -l; m <= l; m++) {
                const double weight =
                    kernel.harmonicValue(harmonicIndex(l, m < 0 ? -m : m)) * grid.solidAngle_sr(0, 0, y);
                const auto moment = static_cast<size_t>(m == 0 ? 0 : m > 0 ? 2 * m - 1 : -2 * m);
                const auto term = r * terms + 3 * static_cast<size_t>(harmonicIndex(l, m));
                for (size_t c = 0; c < 3; c++) rowSums[term + c] = moments[3 * moment + c] * weight;
            }
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
