#include "probes/texel_overlaps.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "numeric/check.h"
#include "numeric/vectors.h"
#include "probes/source_chart.h"
#include "probes/texel_grid.h"

namespace etalon {
namespace {

using Points = std::vector<glm::dvec2>;

// Between the line and the curve of one side of a cell, relative to the cell.
constexpr double kSideError = 0x1p-27;
// Between a piece and its curve, relative to how thick the cell is: sides of a thin cell do not cross each other.
constexpr double kThinPiece = 0.01;
// Between a straight piece of a source's rim and the arc, relative to the same: less than a tenth of it is misplaced.
constexpr double kRimError = 64.0;
// And its length.
constexpr double kRimPiece_texels = 0.25;
// Halvings of a curve, at most.
constexpr int kMostHalvings = 30;
// Overlaps that are smaller, relative to the texel, come from the rounding of borders.
constexpr double kSliver = 0x1p-36;
// A texel of the result of which a smaller part is shown counts as behind the ball.
constexpr double kLeastShown = 0x1p-17;
// A singular direction has the azimuth of the curve at this part of it.
constexpr double kNearSingular = 0x1p-20;

double crossOf(const glm::dvec2& a, const glm::dvec2& b) { return a.x * b.y - a.y * b.x; }
glm::dvec2 between(const glm::dvec2& a, const glm::dvec2& b, double t) {
    return {a.x * (1.0 - t) + b.x * t, a.y * (1.0 - t) + b.y * t};
}
bool isSame(const glm::dvec3& a, const glm::dvec3& b) {
    const glm::dvec3 d = a - b;
    return dotOf(d, d) < kSameDirection * kSameDirection;
}

// A side of a cell on the image of the result, or an arc of the rim of its disc.
struct Curve {
    int layer;
    glm::dvec2 from, to;
    bool isRim;
};
// A part of a side inside one patch of the source's chart, as a line of straight pieces.
struct Part {
    int patch;
    glm::dvec3 from, to;
    glm::dvec2 chartFrom, chartTo;
    size_t firstInner, endInner;  // of the row's inner points
};
// A side: its parts, and its ends on the image of the result. Without parts it is a point, or beyond the disc.
struct Side {
    glm::dvec2 from{0}, to{0};
    size_t firstPart = 0, endPart = 0;
    bool isOnDisc = true;
};

}  // namespace

struct TexelOverlaps::Shapes {
    ProbeShape target;
    TexelGrid grid;
    MappingKernel<double>::MappingSettings settings;
    glm::dmat3 turn;
    SourceChart chart;
    int cellsAcross, cellsDown;  // per texel
};

namespace {

// So that cells are small against a patch and the curves of their sides simple.
int cellsPerTexel(int texels, int least) { return (least + texels - 1) / texels; }
int leastCells(Mapping mapping, bool isAcross) {
    switch (mapping) {
        case Mapping::latLong:
        case Mapping::latLongPedersen:
            return isAcross ? 64 : 32;
        case Mapping::cube:
            return 16;
        case Mapping::octahedral:
            return 32;
        case Mapping::angular:
            return 64;
        case Mapping::mirrorBall:
            break;
    }
    return 128;
}

// The work on a row of texels.
template <class Shapes>
class RowCutter {
  public:
    RowCutter(const Shapes& shapes, int layer, int y) : s_(shapes), layer_(layer), y_(y) {}

    RowOverlaps run() {
        std::vector<std::vector<TexelOverlap>> texels(static_cast<size_t>(s_.target.width));
        for (int row = y_ * s_.cellsDown; row < (y_ + 1) * s_.cellsDown; row++) cutCells(row, texels);
        RowOverlaps result;
        result.first.push_back(0);
        for (int x = 0; x < s_.target.width; x++) {
            append(texels[static_cast<size_t>(x)], s_.grid.solidAngle_sr(layer_, x, y_), result.overlaps);
            result.first.push_back(result.overlaps.size());
        }
        return result;
    }

  private:
    // Sorted, those of one texel of the source together, without slivers, relative to the largest.
    static void append(std::vector<TexelOverlap>& of, double texel_sr, std::vector<TexelOverlap>& to) {
        std::stable_sort(of.begin(), of.end(), [](const TexelOverlap& a, const TexelOverlap& b) {
            return std::array{a.layer, a.y, a.x} < std::array{b.layer, b.y, b.x};
        });
        size_t count = 0;
        double largest = 0.0, all = 0.0;
        for (const TexelOverlap& one : of) {
            if (count > 0 && of[count - 1].layer == one.layer && of[count - 1].y == one.y &&
                of[count - 1].x == one.x)
                of[count - 1].weight += one.weight;
            else
                of[count++] = one;
        }
        of.resize(count);
        for (const TexelOverlap& one : of) {
            all += one.weight;
            largest = std::max(largest, one.weight);
        }
        if (!(all > kLeastShown * texel_sr)) return;
        for (const TexelOverlap& one : of)
            if (one.weight > kSliver * all) to.push_back({one.layer, one.x, one.y, one.weight / largest});
    }

    glm::dvec3 directionAt(const Curve& curve, double t) const {
        glm::dvec2 p = between(curve.from, curve.to, t);
        if (curve.isRim) {
            // A little beyond the rim, which counts as on it.
            const double x = 2.0 * p.x - 1.0, y = 2.0 * p.y - 1.0;
            const double scale = (1.0 + 0x1p-48) / std::sqrt(x * x + y * y);
            p = {0.5 + 0.5 * x * scale, 0.5 + 0.5 * y * scale};
        }
        const glm::dvec3 d = MappingKernel<double>{}.mappingDirection(curve.layer, p.x, p.y, s_.settings);
        const glm::dmat3& r = s_.turn;
        return unitOf({r[0].x * d.x + (r[1].x * d.y + r[2].x * d.z),
                       r[0].y * d.x + (r[1].y * d.y + r[2].y * d.z),
                       r[0].z * d.x + (r[1].z * d.y + r[2].z * d.z)});
    }

    // Where a curve crosses a plane, between two places on both sides of it.
    double crossing(const Curve& curve, const glm::dvec3& normal, double t0, double f0, double t1,
                    double f1) const {
        for (int step = 0; step < 60; step++) {
            // The secant's zero, in the middle half, every third time the middle.
            double t = step % 3 == 2 ? 0.5 * (t0 + t1) : (t0 * f1 - t1 * f0) / (f1 - f0);
            t = std::clamp(t, t0, t1);
            const double f = dotOf(normal, directionAt(curve, t));
            if (std::abs(f) < 0x1p-52 || !(t0 < t && t < t1)) return t;
            if ((f < 0) == (f0 < 0))
                t0 = t, f0 = f;
            else
                t1 = t, f1 = f;
        }
        return 0.5 * (t0 + t1);
    }

    // The inner points of a line from p0 to p1 that stands for the curve at(t), which is at m in the middle: nothing
    // where it is straight; one where it is a parabola, as far beyond the curve as makes the areas equal; else those of
    // its halves.
    template <class At>
    void straighten(const At& at, double t0, const glm::dvec2& p0, double t1, const glm::dvec2& p1,
                    const glm::dvec2& m, double tolerance_sr, int halvings, Points& to) const {
        const glm::dvec2 chord = p1 - p0, middle = between(p0, p1, 0.5), off = m - middle;
        // At the rim of an angular map it vanishes.
        const double perArea = std::max(s_.chart.density(m), s_.chart.density(middle));
        const double parabola = (2.0 / 3.0) * crossOf(off, chord);
        const double t = 0.5 * (t0 + t1);
        const glm::dvec2 a = at(0.5 * (t0 + t)), b = at(0.5 * (t + t1));
        const double halves =
            0.5 * crossOf(off, chord) + (2.0 / 3.0) * (crossOf(a - between(p0, m, 0.5), m - p0) +
                                                       crossOf(b - between(m, p1, 0.5), p1 - m));
        // Against the cell: as many such pieces as halvings make are one of its sides.
        const double thickness = std::abs(parabola) * perArea * (1 << halvings);
        if (std::abs(parabola - halves) * perArea <= tolerance_sr &&
            thickness <= tolerance_sr * (kThinPiece / kSideError)) {
            if (std::abs(parabola) * perArea > tolerance_sr) to.push_back(middle + off * (4.0 / 3.0));
        } else if (halvings < kMostHalvings) {
            straighten(at, t0, p0, t, m, a, tolerance_sr, halvings + 1, to);
            to.push_back(m);
            straighten(at, t, m, t1, p1, b, tolerance_sr, halvings + 1, to);
        } else {
            to.push_back(m);
        }
    }

    // Appends the parts of a curve whose ends have these directions.
    Side sideOf(const Curve& curve, const glm::dvec3& from, const glm::dvec3& to, double tolerance_sr) {
        Side side{curve.from, curve.to, parts_.size(), 0, true};
        const glm::dvec3 middle = directionAt(curve, 0.5);
        cuts_.assign(1, 0.0);
        for (const glm::dvec3& normal : s_.chart.planes()) {
            const double f0 = dotOf(normal, from), f = dotOf(normal, middle), f1 = dotOf(normal, to);
            const auto isOff = [](double v) { return std::abs(v) > kSameDirection; };
            if (isOff(f)) {
                if (isOff(f0) && (f0 < 0) != (f < 0))
                    cuts_.push_back(crossing(curve, normal, 0.0, f0, 0.5, f));
                if (isOff(f1) && (f1 < 0) != (f < 0))
                    cuts_.push_back(crossing(curve, normal, 0.5, f, 1.0, f1));
            } else if (isOff(f0) || isOff(f1)) {
                // Crosses it, or turns back.
                cuts_.push_back(0.5);
            }
        }
        std::sort(cuts_.begin(), cuts_.end());
        cuts_.push_back(1.0);
        glm::dvec3 a = from;
        for (size_t i = 1; i < cuts_.size(); i++) {
            const double t0 = cuts_[i - 1], t1 = cuts_[i], t = 0.5 * (t0 + t1);
            const glm::dvec3 b = t1 == 1.0 ? to : directionAt(curve, t1);
            const glm::dvec3 m = t0 == 0.0 && t1 == 1.0 ? middle : directionAt(curve, t);
            // A point: all of its directions are one.
            if (!(t0 < t1) || (isSame(a, b) && isSame(a, m)) ||
                (s_.chart.isSingular(a) && s_.chart.isSingular(m)))
                continue;
            addPart(curve, t0, a, t1, b, m, tolerance_sr);
            a = b;
        }
        side.endPart = parts_.size();
        return side;
    }
    void addPart(const Curve& curve, double t0, const glm::dvec3& a, double t1, const glm::dvec3& b,
                 const glm::dvec3& m, double tolerance_sr) {
        const SourceChart& chart = s_.chart;
        const int patch = chart.patchOf(m);
        const auto at = [&](double t) { return chart.at(patch, directionAt(curve, t)); };
        const auto end = [&](const glm::dvec3& d, double nearIt) {
            return chart.isSingular(d) ? chart.singularPoint(d, at(nearIt)) : chart.at(patch, d);
        };
        const double nearBy = kNearSingular * (t1 - t0);
        Part part{patch, a, b, end(a, t0 + nearBy), end(b, t1 - nearBy), inner_.size(), 0};
        straighten(at, t0, part.chartFrom, t1, part.chartTo, chart.at(patch, m), tolerance_sr, 0, inner_);
        part.endInner = inner_.size();
        parts_.push_back(part);
    }

    // A side of the grid of cells, cut off at the rim of a disc.
    Side gridSide(const glm::dvec2& from, const glm::dvec2& to, const glm::dvec3& directionFrom,
                  const glm::dvec3& directionTo, double tolerance_sr) {
        Curve curve{layer_, from, to, false};
        if (!isDisc(s_.target.mapping)) return sideOf(curve, directionFrom, directionTo, tolerance_sr);
        // |a + (b - a) t| = 1
        const glm::dvec2 a = 2.0 * from - 1.0, d = 2.0 * (to - from);
        const double dd = d.x * d.x + d.y * d.y, ad = a.x * d.x + a.y * d.y, aa = a.x * a.x + a.y * a.y;
        const double root = ad * ad - dd * (aa - 1.0);
        const double half = root > 0.0 ? std::sqrt(root) : 0.0;
        const double t0 = std::max(0.0, (-ad - half) / dd), t1 = std::min(1.0, (-ad + half) / dd);
        Side beyond;
        beyond.isOnDisc = false;
        if (!(root > 0.0) || !(t1 - t0 > kSameDirection)) return beyond;
        const auto onRim = [&](double t) {
            const glm::dvec2 p = between(from, to, t);
            return directionAt({layer_, p, p, true}, 0.0);
        };
        if (t0 > 0.0) curve.from = between(from, to, t0);
        if (t1 < 1.0) curve.to = between(from, to, t1);
        return sideOf(curve, t0 > 0.0 ? onRim(t0) : directionFrom, t1 < 1.0 ? onRim(t1) : directionTo,
                      tolerance_sr);
    }

    void cutCells(int row, std::vector<std::vector<TexelOverlap>>& texels) {
        const int across = s_.target.width * s_.cellsAcross, down = s_.target.height * s_.cellsDown;
        parts_.clear();
        inner_.clear();
        const auto point = [&](int column, int line) {
            return glm::dvec2(static_cast<double>(column) / across, static_cast<double>(line) / down);
        };
        const auto directionsOf = [&](int line) {
            std::vector<glm::dvec3> directions;
            for (int column = 0; column <= across; column++)
                directions.push_back(
                    directionAt({layer_, point(column, line), point(column, line), false}, 0.0));
            return directions;
        };
        const std::vector<glm::dvec3> upper = directionsOf(row), lower = directionsOf(row + 1);
        // Of a texel's cells; of the smaller of two texels at their common side, whichever of them is cut.
        const auto tolerance_sr = [&](int column, int y) {
            const double texel_sr = s_.grid.solidAngle_sr(layer_, column / s_.cellsAcross, y);
            return kSideError * texel_sr / (s_.cellsAcross * s_.cellsDown);
        };
        const auto sideTolerance_sr = [&](int column, int line) {
            const int above = std::max(0, (line - 1) / s_.cellsDown),
                      below = std::min(s_.target.height - 1, line / s_.cellsDown);
            return std::min(tolerance_sr(column, above), tolerance_sr(column, below));
        };
        Side left = gridSide(point(0, row), point(0, row + 1), upper[0], lower[0], tolerance_sr(0, y_));
        for (int column = 0; column < across; column++) {
            const auto i = static_cast<size_t>(column);
            const double error_sr = tolerance_sr(column, y_);
            const Side top = gridSide(point(column, row), point(column + 1, row), upper[i], upper[i + 1],
                                      sideTolerance_sr(column, row));
            const Side bottom = gridSide(point(column, row + 1), point(column + 1, row + 1), lower[i],
                                         lower[i + 1], sideTolerance_sr(column, row + 1));
            const Side right = gridSide(point(column + 1, row), point(column + 1, row + 1), upper[i + 1],
                                        lower[i + 1], error_sr);
            cutCell({{{&top, false}, {&right, false}, {&bottom, true}, {&left, true}}}, error_sr,
                    texels[static_cast<size_t>(column / s_.cellsAcross)]);
            left = right;
        }
    }

    struct TurnedSide {
        const Side* side;
        bool isBackwards;
    };
    struct TurnedPart {
        const Part* part;
        bool isBackwards;
        const glm::dvec3& from() const { return isBackwards ? part->to : part->from; }
        const glm::dvec3& to() const { return isBackwards ? part->from : part->to; }
        const glm::dvec2& chartFrom() const { return isBackwards ? part->chartTo : part->chartFrom; }
        const glm::dvec2& chartTo() const { return isBackwards ? part->chartFrom : part->chartTo; }
    };

    void cutCell(const std::array<TurnedSide, 4>& sides, double error_sr, std::vector<TexelOverlap>& to) {
        // Along the rim from where one side ends to where the next begins. Arcs are parts of this cell alone.
        const size_t partsBefore = parts_.size(), innerBefore = inner_.size();
        std::array<Side, 4> arcs;
        std::array<TurnedSide, 8> border;
        size_t count = 0;
        const auto startOf = [](const TurnedSide& s) { return s.isBackwards ? s.side->to : s.side->from; };
        const auto endOf = [](const TurnedSide& s) { return s.isBackwards ? s.side->from : s.side->to; };
        for (size_t i = 0; i < 4; i++) {
            if (!sides[i].side->isOnDisc) continue;
            border[count++] = sides[i];
            size_t next = (i + 1) % 4;
            while (!sides[next].side->isOnDisc) next = (next + 1) % 4;
            const glm::dvec2 from = endOf(sides[i]), until = startOf(sides[next]);
            if (std::max(std::abs(from.x - until.x), std::abs(from.y - until.y)) <= kSameDirection) continue;
            const Curve arc{layer_, from, until, true};
            arcs[i] = sideOf(arc, directionAt(arc, 0.0), directionAt(arc, 1.0), error_sr);
            border[count++] = {&arcs[i], false};
        }
        cycle_.clear();
        unsigned patches = 0;
        for (size_t b = 0; b < count; b++) {
            const Side& side = *border[b].side;
            for (size_t k = side.firstPart; k < side.endPart; k++) {
                const bool isBackwards = border[b].isBackwards;
                const Part& part = parts_[isBackwards ? side.firstPart + side.endPart - 1 - k : k];
                cycle_.push_back({&part, isBackwards});
                patches |= 1u << part.patch;
            }
        }
        for (int patch = 0; patches >> patch != 0; patch++)
            if ((patches >> patch & 1u) != 0) cutPatch(patch, error_sr, to);
        parts_.resize(partsBefore);
        inner_.resize(innerBefore);
    }

    // What of the cell lies in a patch.
    void cutPatch(int patch, double error_sr, std::vector<TexelOverlap>& to) {
        polygon_.clear();
        const TurnedPart *first = nullptr, *last = nullptr;
        for (const TurnedPart& turned : cycle_) {
            const Part& part = *turned.part;
            if (part.patch != patch) continue;
            if (last == nullptr)
                first = &turned;
            else
                bridge(patch, *last, turned, error_sr);
            polygon_.push_back(turned.chartFrom());
            const auto begin = inner_.begin() + static_cast<ptrdiff_t>(part.firstInner),
                       end = inner_.begin() + static_cast<ptrdiff_t>(part.endInner);
            if (turned.isBackwards)
                polygon_.insert(polygon_.end(), std::make_reverse_iterator(end),
                                std::make_reverse_iterator(begin));
            else
                polygon_.insert(polygon_.end(), begin, end);
            polygon_.push_back(turned.chartTo());
            last = &turned;
        }
        bridge(patch, *last, *first, error_sr);
        scan(patch, to);
    }

    // Points from the end of a part to the start of the next one in the patch, along the patch's border.
    void bridge(int patch, const TurnedPart& before, const TurnedPart& after, double error_sr) {
        const SourceChart& chart = s_.chart;
        const glm::dvec3 &a = before.to(), &b = after.from();
        const bool isA = chart.isSingular(a), isB = chart.isSingular(b);
        if (!isA && !isB) {
            if (isSame(a, b)) return;
            for (const glm::dvec3& normal : chart.planes())
                if (std::abs(dotOf(normal, a)) <= 4.0 * kSameDirection &&
                    std::abs(dotOf(normal, b)) <= 4.0 * kSameDirection)
                    return;
            const glm::dvec3 corner = chart.cornerNear(a + b);
            if (!chart.isSingular(corner)) {
                polygon_.push_back(chart.at(patch, corner));
                return;
            }
            addSingular(chart.singularPoint(corner, before.chartTo()),
                        chart.singularPoint(corner, after.chartFrom()), error_sr);
            return;
        }
        const glm::dvec3& singular = isA ? a : b;
        addSingular(chart.singularPoint(singular, before.chartTo()),
                    chart.singularPoint(singular, after.chartFrom()), error_sr);
    }
    // Along the border that shows one direction.
    void addSingular(const glm::dvec2& from, const glm::dvec2& to, double error_sr) {
        polygon_.push_back(from);
        if (s_.chart.isDisc()) addRim(from, to, kRimError * error_sr, 0);
        polygon_.push_back(to);
    }

    // The inner points of an arc of the source's rim. No texel has the rest of what a straight piece cuts off.
    void addRim(const glm::dvec2& from, const glm::dvec2& to, double error_sr, int halvings) {
        const glm::dvec2 m = s_.chart.rimPoint(from, to, 0.5), middle = between(from, to, 0.5),
                         off = m - middle;
        const double area = (2.0 / 3.0) * crossOf(off, to - from);
        const glm::dvec2 chord = to - from;
        const bool isShort = std::max(std::abs(chord.x), std::abs(chord.y)) <= kRimPiece_texels;
        if ((isShort && std::abs(area) * s_.chart.density(middle) <= error_sr) || halvings == kMostHalvings) {
            polygon_.push_back(middle + off * (4.0 / 3.0));
            return;
        }
        addRim(from, m, error_sr, halvings + 1);
        polygon_.push_back(m);
        addRim(m, to, error_sr, halvings + 1);
    }

    static size_t indexOf(const std::vector<double>& lines, double at) {
        const auto above = std::upper_bound(lines.begin() + 1, lines.end() - 1, at);
        return static_cast<size_t>(above - lines.begin()) - 1;
    }
    // The parts of a polygon with coordinate `axis` up to `line` and from it on.
    static void split(const Points& polygon, int axis, double line, Points& below, Points& above) {
        below.clear();
        above.clear();
        for (size_t i = 0; i < polygon.size(); i++) {
            const glm::dvec2 &a = polygon[i], &b = polygon[i + 1 < polygon.size() ? i + 1 : 0];
            const double da = a[axis] - line, db = b[axis] - line;
            if (da <= 0) below.push_back(a);
            if (da >= 0) above.push_back(a);
            if ((da < 0 && db > 0) || (da > 0 && db < 0)) {
                // The same both ways.
                glm::dvec2 cut = (a * db - b * da) / (db - da);
                cut[axis] = line;
                below.push_back(cut);
                above.push_back(cut);
            }
        }
    }
    // piece(index, polygon) for what lies in each column or row.
    template <class Piece>
    static void cutAlong(int axis, const std::vector<double>& lines, Points& rest, Points& part,
                         Points& scratch, const Piece& piece) {
        const auto [least, most] =
            std::minmax_element(rest.begin(), rest.end(),
                                [&](const glm::dvec2& a, const glm::dvec2& b) { return a[axis] < b[axis]; });
        const size_t first = indexOf(lines, (*least)[axis]), last = indexOf(lines, (*most)[axis]);
        for (size_t i = first; i < last; i++) {
            split(rest, axis, lines[i + 1], part, scratch);
            std::swap(rest, scratch);
            if (part.size() > 2) piece(i, part);
        }
        if (rest.size() > 2) piece(last, rest);
    }
    void scan(int patch, std::vector<TexelOverlap>& to) {
        if (polygon_.size() < 3) return;
        const SourceChart& chart = s_.chart;
        const size_t before = to.size();
        double all_sr = 0.0;
        cutAlong(1, chart.rows(), polygon_, strip_, scratch_, [&](size_t y, Points& strip) {
            column_ = strip;
            cutAlong(0, chart.columns(), column_, texel_, scratchColumn_, [&](size_t x, const Points& texel) {
                const double solidAngle_sr = chart.solidAngle_sr(texel);
                all_sr += solidAngle_sr;
                to.push_back(
                    {chart.layerOf(patch), static_cast<int32_t>(x), static_cast<int32_t>(y), solidAngle_sr});
            });
        });
        if (all_sr < 0.0)
            for (size_t i = before; i < to.size(); i++) to[i].weight = -to[i].weight;
    }

    const Shapes& s_;
    int layer_, y_;
    std::vector<Part> parts_;
    Points inner_;
    std::vector<double> cuts_;
    std::vector<TurnedPart> cycle_;
    Points polygon_, strip_, scratch_, column_, texel_, scratchColumn_;
};

}  // namespace

TexelOverlaps::TexelOverlaps(const ProbeShape& source, const ProbeShape& target, const glm::dmat3& turn)
    : shapes_(std::make_unique<Shapes>(
          Shapes{target, TexelGrid(target), mappingSettingsOf<MappingKernel<double>>(target), turn,
                 SourceChart(source), cellsPerTexel(target.width, leastCells(target.mapping, true)),
                 cellsPerTexel(target.height, leastCells(target.mapping, false))})) {}
TexelOverlaps::~TexelOverlaps() = default;

RowOverlaps TexelOverlaps::ofRow(int layer, int y) const {
    ETALON_CHECK(layer >= 0 && layer < shapes_->target.layers() && y >= 0 && y < shapes_->target.height,
                 "row {} of layer {}", y, layer);
    return RowCutter<Shapes>(*shapes_, layer, y).run();
}

}  // namespace etalon
