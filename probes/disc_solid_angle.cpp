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

double squareRootOfPositive(double a) { return a > 0.0 ? std::sqrt(a) : 0.0; }

// Angles of the first quarter of the unit circle, by sine or cosine in [0, 1].
double angleOfSine(double s) { return atan2Of(s, squareRootOfPositive((1.0 - s) * (1.0 + s))); }
double angleOfCosine(double c) { return atan2Of(squareRootOfPositive((1.0 - c) * (1.0 + c)), c); }

class Disc {
  public:
    explicit Disc(const ProbeShape& shape)
        : size_(shape.width),
          isOrthographic_(shape.mapping == Mapping::mirrorBall && 1.0 / shape.ballDistance_radii == 0.0),
          isAngular_(shape.mapping == Mapping::angular),
          settings_(mappingSettingsOf<MappingKernel<double>>(shape)) {}

    // Border i of size + 1, in [-1, 1]; borders i and size - i are of opposite sign.
    double border(int i) const { return (2.0 * i - size_) / size_; }

    // The integral of G / r^2 over the part on the disc of edge i at height border(j).
    double edge(int i, int j) const {
        const double y = border(j), reach = squareRootOfPositive((1.0 - y) * (1.0 + y));
        const double from = std::clamp(border(i), -reach, reach),
                     to = std::clamp(border(i + 1), -reach, reach);
        if (!(from < to)) return 0.0;
        if (isOrthographic_) return 2.0 * (to - from);
        if (isAngular_) return integral(from, to, [&](double x) { return gOverSquare(x, y); });
        // x = reach sin(psi) takes the square root at the rim away.
        return integral(angle(from / reach), angle(to / reach),
                        [&](double psi) { return reach * cosOf(psi) * gOverSquare(reach * sinOf(psi), y); });
    }

    // G at the rim times the angle of the rim inside texel (x, y).
    double rim(int x, int y) const {
        double angle_rad = 0.0;
        for (const auto& [a0, a1] : halves(x))
            for (const auto& [b0, b1] : halves(y)) {
                if (!(a0 < a1 && b0 < b1)) continue;
                const double from = std::max(angleOfCosine(a1), angleOfSine(b0));
                const double to = std::min(angleOfCosine(a0), angleOfSine(b1));
                if (from < to) angle_rad += to - from;
            }
        return angle_rad * (isAngular_ ? 2.0 : 1.0 + settings_.root);
    }

  private:
    static double angle(double sine) { return sine < 0.0 ? -angleOfSine(-sine) : angleOfSine(sine); }

    // The parts of a texel's extent on both sides of 0, as magnitudes; empty ones have equal ends.
    std::array<std::array<double, 2>, 2> halves(int i) const {
        const double from = border(i), to = border(i + 1);
        return {{{std::max(0.0, from), std::max(0.0, to)}, {std::max(0.0, -to), std::max(0.0, -from)}}};
    }

    template <class F>
    static double integral(double from, double to, F&& f) {
        const int pieces = std::max(1, static_cast<int>(floorOf((to - from) / kPiece + 0.99)));
        const double half = 0.5 * (to - from) / pieces;
        double sum = 0.0;
        for (int piece = 0; piece < pieces; piece++) {
            const double middle = from + (2.0 * piece + 1.0) * half;
            for (size_t k = 0; k < kNodes.size(); k++)
                sum += half * kWeights[k] * f(middle + half * kNodes[k]);
        }
        return sum;
    }

    // G(r) / r^2
    double gOverSquare(double x, double y) const {
        const double square = x * x + y * y;
        if (isAngular_) {
            // 2 sin^2(pi r / 2) / r^2
            const double radius = std::sqrt(square);
            const double s = radius > 0.0 ? sinOf(1.5707963267948966 * radius) / radius : 1.5707963267948966;
            return 2.0 * (s * s);
        }
        // sin^2 / (1 + cos)
        const double slope = (2.0 - settings_.k) / settings_.root;
        if (square == 0.0) return 0.5 * slope * slope;
        const glm::dvec3 d = MappingKernel<double>{}.ballDirection(x, y, settings_);
        return (d.x * d.x + d.y * d.y) / square / (1.0 + d.z);
    }

    int size_;
    bool isOrthographic_, isAngular_;
    MappingKernel<double>::MappingSettings settings_;
};

}  // namespace

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
