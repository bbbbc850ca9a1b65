#include "probes/harmonics_rotation.h"

#include <cmath>
#include <cstdlib>

#include "numeric/check.h"

namespace etalon {

namespace {

constexpr double kFourPi = 4 * 0x1.921fb54442d18p+1;
constexpr double kOrthogonalTolerance = 1e-6;

bool isRotation(const glm::dmat3& r) {
    const auto dotOf = [&](int a, int b) { return r[a].x * r[b].x + (r[a].y * r[b].y + r[a].z * r[b].z); };
    for (int a = 0; a < 3; a++)
        for (int b = 0; b < 3; b++)
            if (!(std::abs(dotOf(a, b) - (a == b ? 1 : 0)) <= kOrthogonalTolerance)) return false;
    const double determinant =
        r[0].x * (r[1].y * r[2].z - r[1].z * r[2].y) -
        (r[1].x * (r[0].y * r[2].z - r[0].z * r[2].y) - r[2].x * (r[0].y * r[1].z - r[0].z * r[1].y));
    return determinant > 0;
}

// The recurrence of [Ivanic1996] with its corrections of 1998, for harmonics without Condon-Shortley phase.
// Blocks are square, indices run from -l to l.
class Block {
  public:
    explicit Block(int l) : l_(l), values_(static_cast<size_t>((2 * l + 1) * (2 * l + 1))) {}
    double& at(int m, int n) { return values_[static_cast<size_t>((m + l_) * (2 * l_ + 1) + n + l_)]; }
    double at(int m, int n) const { return values_[static_cast<size_t>((m + l_) * (2 * l_ + 1) + n + l_)]; }
    const std::vector<double>& values() const { return values_; }

  private:
    int l_;
    std::vector<double> values_;
};

struct BandStep {
    const Block& first;   // the block of l = 1
    const Block& before;  // the block of l - 1
    int l;

    // P_i(l, a, n)
    double part(int i, int a, int n) const {
        if (n == l) return first.at(i, 1) * before.at(a, l - 1) - first.at(i, -1) * before.at(a, 1 - l);
        if (n == -l) return first.at(i, 1) * before.at(a, 1 - l) + first.at(i, -1) * before.at(a, l - 1);
        return first.at(i, 0) * before.at(a, n);
    }
    double v(int m, int n) const {
        if (m == 0) return part(1, 1, n) + part(-1, -1, n);
        const double root2 = std::sqrt(2.0);
        if (m > 0) return m == 1 ? part(1, 0, n) * root2 : part(1, m - 1, n) - part(-1, 1 - m, n);
        return m == -1 ? part(-1, 0, n) * root2 : part(1, m + 1, n) + part(-1, -m - 1, n);
    }
    double w(int m, int n) const {
        return m > 0 ? part(1, m + 1, n) + part(-1, -m - 1, n) : part(1, m - 1, n) - part(-1, 1 - m, n);
    }
    double element(int m, int n) const {
        const int absM = std::abs(m);
        const double divisor = std::abs(n) < l ? (l + n) * (l - n) : 2 * l * (2 * l - 1);
        double sum = 0;
        if (absM < l) sum = std::sqrt((l + m) * (l - m) / divisor) * part(0, m, n);
        if (m == 0)
            sum = sum - 0.5 * std::sqrt(2.0 * (l - 1) * l / divisor) * v(m, n);
        else
            sum = sum + 0.5 * std::sqrt((l + absM - 1.0) * (l + absM) / divisor) * v(m, n);
        if (m != 0 && absM < l - 1)
            sum = sum - 0.5 * std::sqrt((l - absM - 1.0) * (l - absM) / divisor) * w(m, n);
        return sum;
    }
};

}  // namespace

HarmonicRotation::HarmonicRotation(const glm::dmat3& rotation, int degree) {
    ETALON_CHECK(degree >= 0 && degree <= kMaxHarmonicDegree, "degree {}", degree);
    ETALON_CHECK(isRotation(rotation), "not a rotation: x to {} {} {}", rotation[0].x, rotation[0].y,
                 rotation[0].z);
    // Band 1 without phase is y, z, x.
    constexpr int kAxisOf[] = {1, 2, 0};
    Block first(1);
    for (int m = -1; m <= 1; m++)
        for (int n = -1; n <= 1; n++) first.at(m, n) = rotation[kAxisOf[n + 1]][kAxisOf[m + 1]];
    Block block(0);
    block.at(0, 0) = 1;
    for (int l = 0; l <= degree; l++) {
        if (l == 1) block = first;
        if (l > 1) {
            const BandStep step{first, block, l};
            Block next(l);
            for (int m = -l; m <= l; m++)
                for (int n = -l; n <= l; n++) next.at(m, n) = step.element(m, n);
            block = next;
        }
        blocks_.push_back(block.values());
    }
    // The phase of row and column.
    for (int l = 1; l <= degree; l++)
        for (int m = -l; m <= l; m++)
            for (int n = -l; n <= l; n++)
                if ((m + n) % 2 != 0) {
                    double& value = blocks_[static_cast<size_t>(l)][index(l, m, n)];
                    value = -value;
                }
}

SphericalHarmonics rotateHarmonics(const SphericalHarmonics& f, const glm::dmat3& rotation) {
    if (rotation == glm::dmat3(1)) return f;
    const HarmonicRotation matrices(rotation, f.degree);
    SphericalHarmonics turned(f.degree);
    for (int l = 0; l <= f.degree; l++)
        for (int m = -l; m <= l; m++)
            for (int n = -l; n <= l; n++) {
                const double element = matrices.at(l, m, n);
                for (int c = 0; c < 3; c++) turned.at(l, m)[c] += element * f.at(l, n)[c];
            }
    return turned;
}

std::vector<double> rotateZonal(const std::vector<double>& zonal, const glm::dvec3& axis) {
    const int degree = static_cast<int>(zonal.size()) - 1;
    std::vector<double> turned = harmonicsAt(axis, degree);
    for (int l = 0; l <= degree; l++) {
        const double scale = std::sqrt(kFourPi / (2 * l + 1)) * zonal[static_cast<size_t>(l)];
        for (int m = -l; m <= l; m++) turned[static_cast<size_t>(harmonicIndex(l, m))] *= scale;
    }
    return turned;
}

}  // namespace etalon
