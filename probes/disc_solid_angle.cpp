#include "probes/disc_solid_angle.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "probes/mapping.h"
#include "probes/texel_grid.h"

namespace etalon {
namespace {

// Nodes and weights of the Gauss-Legendre rule of 5 points on [-1, 1].
constexpr std::array<double, 5> kNodes = {-0.90617984593866399, -0.53846931010568309, 0.0,
                                          0.53846931010568309, 0.90617984593866399};
constexpr std::array<double, 5> kWeights = {0.23692688505618909, 0.47862867049936647, 0.56888888888888889,
                                            0.47862867049936647, 0.23692688505618909};
// The longest piece that one rule integrates.
constexpr double kPiece = 0.03125;

// Magnitudes of coordinates on the disc in units of half a texel, so that the rim is at `size`, by their
// squares: whole numbers, whose differences are exact where those of the coordinates would lose digits.
class Disc {
  public:
    explicit Disc(const ProbeShape& shape)
        : size_(shape.width),
          isOrthographic_(shape.mapping == Mapping::mirrorBall && 1.0 / shape.ballDistance_radii == 0.0),
          isAngular_(shape.mapping == Mapping::angular),
          settings_(mappingSettingsOf<MappingKernel<double>>(shape)) {}

    // Border i of size + 1, in [-1, 1]; borders i and size - i are of opposite sign.
    double border(int i) const { return (2.0 * i - size_) / size_; }

    // The integral of G / r^2 over the part on the disc of edge i at height border(j). i is in the left half.
    double edge(int i, int j) const {
        const Extent x = extent(i);
        const double height = 2.0 * j - size_, reachSquare = square(size_) - square(height);
        const double innerSquare = square(x.inner), outerSquare = std::min(square(x.outer), reachSquare);
        if (!(innerSquare < outerSquare)) return 0.0;
        const double y = height / size_, inner = x.inner / size_, outer = std::sqrt(outerSquare) / size_;
        const double length = (outerSquare - innerSquare) / square(size_) / (outer + inner);
        if (isOrthographic_) return x.count * (2.0 * length);
        if (isAngular_)
            return x.count *
                   integral(inner, length, [&](double at) { return discTerm(at, y, true, settings_); });
        // x = reach sin(psi) takes the square root at the rim away.
        const double reach = std::sqrt(reachSquare) / size_;
        const double psi = arc(reachSquare, innerSquare, 0.0);
        return x.count * integral(psi, arc(reachSquare, outerSquare, innerSquare), [&](double at) {
                   return reach * cosOf(at) * discTerm(reach * sinOf(at), y, false, settings_);
               });
    }

    // G at the rim times the angle of the rim inside texel (x, y) of the upper left quarter.
    double rim(int x, int y) const {
        const Extent across = extent(x), along = extent(y);
        const double all = square(size_);
        const double from = std::max(square(across.inner), all - square(along.outer));
        const double to = std::min(square(across.outer), all - square(along.inner));
        if (!(from < to)) return 0.0;
        return across.count * along.count * arc(all, to, from) * (isAngular_ ? 2.0 : 1.0 + settings_.root);
    }

  private:
    static double square(double a) { return a * a; }

    // The magnitudes of column i or row i of the left or upper half; those of the middle of an odd size count
    // twice.
    struct Extent {
        double inner, outer, count;
    };
    Extent extent(int i) const {
        const double outer = size_ - 2.0 * i;
        return outer > 1.0 ? Extent{outer - 2.0, outer, 1.0} : Extent{0.0, outer, 2.0};
    }

    // asin(sqrt(upper / whole)) - asin(sqrt(lower / whole)) for 0 <= lower < upper <= whole and 0 for lower =
    // upper, each of them exact. With sines s and t of the two angles, sin^2 = s^2 - t^2 over the sum.
    static double arc(double whole, double upper, double lower) {
        const double s = std::sqrt(upper), c = std::sqrt(whole - upper);
        const double t = std::sqrt(lower), d = std::sqrt(whole - lower);
        const double sum = s * d + t * c;
        return sum > 0.0 ? atan2Of((upper - lower) * (whole / sum), d * c + t * s) : 0.0;
    }

    // Over [from, from + length].
    template <class F>
    static double integral(double from, double length, F&& f) {
        const int pieces = std::max(1, static_cast<int>(floorOf(length / kPiece + 0.99)));
        const double half = 0.5 * length / pieces;
        double sum = 0.0;
        for (int piece = 0; piece < pieces; piece++) {
            const double middle = from + (2.0 * piece + 1.0) * half;
            for (size_t k = 0; k < kNodes.size(); k++)
                sum += half * kWeights[k] * f(middle + half * kNodes[k]);
        }
        return sum;
    }

    int size_;
    bool isOrthographic_, isAngular_;
    MappingKernel<double>::MappingSettings settings_;
};

}  // namespace

double discTerm(double x, double y, bool isAngular, const MappingKernel<double>::MappingSettings& settings) {
    const double square = x * x + y * y;
    if (isAngular) {
        // 2 sin^2(pi r / 2) / r^2
        const double radius = std::sqrt(square);
        const double s = radius > 0.0 ? sinOf(1.5707963267948966 * radius) / radius : 1.5707963267948966;
        return 2.0 * (s * s);
    }
    // sin^2 / (1 + cos) or, in the lower half of the sphere, 1 - cos, over r^2.
    const double slope = (2.0 - settings.k) / settings.root;
    if (square == 0.0) return 0.5 * slope * slope;
    const glm::dvec3 d = MappingKernel<double>{}.ballDirection(x, y, settings);
    return (d.z < 0.0 ? 1.0 - d.z : (d.x * d.x + d.y * d.y) / (1.0 + d.z)) / square;
}

std::vector<double> discSolidAngles_sr(const ProbeShape& shape) {
    const Disc disc(shape);
    const int size = shape.width, half = (size + 1) / 2;
    const auto at = [&](int i, int j) {
        return static_cast<size_t>(j) * static_cast<size_t>(half) + static_cast<size_t>(i);
    };
    // Edge i at height border(j); the same numbers serve the vertical edges.
    std::vector<double> edges(at(0, half + 1));
    for (int j = 0; j <= half; j++)
        for (int i = 0; i < half; i++)
            // The border behind the middle of an odd size mirrors the one before it.
            edges[at(i, j)] = 2 * j > size ? edges[at(i, size - j)] : disc.edge(i, j);
    std::vector<double> solidAngle_sr(at(0, half));
    for (int y = 0; y < half; y++)
        for (int x = 0; x < half; x++) {
            if (!showsDirection(shape, x, y)) continue;
            // Counterclockwise with y downwards is the same by symmetry.
            const double along = disc.border(y + 1) * edges[at(x, y + 1)] - disc.border(y) * edges[at(x, y)];
            const double across = disc.border(x + 1) * edges[at(y, x + 1)] - disc.border(x) * edges[at(y, x)];
            solidAngle_sr[at(x, y)] = (along + across) + disc.rim(x, y);
        }
    return solidAngle_sr;
}

}  // namespace etalon
