#include "tests/support/coverage_oracle.h"

#include <algorithm>
#include <cmath>

namespace etalon::oracle {
namespace {

constexpr double kSmallestW = 0x1p-80;
constexpr double kTooLarge = 0x1p500;
constexpr double kGuardBandWidth = 131072;

enum Plane { kPlaneW, kPlaneNear, kPlaneFar, kPlaneRight, kPlaneLeft, kPlaneTop, kPlaneBottom, kPlaneCount };

struct Vertex {
    double x, y, z, w;
    std::array<double, 3> barycentric;
};

struct GuardBand {
    double x, y;
};

double distance(const Vertex& v, int plane, const GuardBand& g) {
    switch (plane) {
        case kPlaneW:
            return v.w - kSmallestW;
        case kPlaneNear:
            return v.z;
        case kPlaneFar:
            return v.w - v.z;
        case kPlaneRight:
            return g.x * v.w - v.x;
        case kPlaneLeft:
            return g.x * v.w + v.x;
        case kPlaneTop:
            return g.y * v.w - v.y;
        default:
            return g.y * v.w + v.y;
    }
}

void putOnPlane(Vertex& v, int plane, const GuardBand& g) {
    switch (plane) {
        case kPlaneW:
            v.w = kSmallestW;
            break;
        case kPlaneNear:
            v.z = 0;
            break;
        case kPlaneFar:
            v.z = v.w;
            break;
        case kPlaneRight:
            v.x = g.x * v.w;
            break;
        case kPlaneLeft:
            v.x = -(g.x * v.w);
            break;
        case kPlaneTop:
            v.y = g.y * v.w;
            break;
        default:
            v.y = -(g.y * v.w);
            break;
    }
}

Vertex intersection(const Vertex& inside, const Vertex& outside, int plane, const GuardBand& g) {
    const double d_a = distance(inside, plane, g), d_b = distance(outside, plane, g);
    const double t = d_a / (d_a - d_b);
    const auto between = [t](double a, double b) {
        const double value = a + t * (b - a);
        return std::clamp(value, std::min(a, b), std::max(a, b));
    };
    Vertex p;
    p.x = between(inside.x, outside.x);
    p.y = between(inside.y, outside.y);
    p.z = between(inside.z, outside.z);
    p.w = between(inside.w, outside.w);
    for (size_t i = 0; i < 3; i++) p.barycentric[i] = between(inside.barycentric[i], outside.barycentric[i]);
    putOnPlane(p, plane, g);
    return p;
}

std::vector<Vertex> cut(const std::vector<Vertex>& polygon, int plane, const GuardBand& g) {
    std::vector<Vertex> result;
    for (size_t i = 0; i < polygon.size(); i++) {
        const Vertex &current = polygon[i], &next = polygon[(i + 1) % polygon.size()];
        const bool currentInside = distance(current, plane, g) >= 0,
                   nextInside = distance(next, plane, g) >= 0;
        if (currentInside) result.push_back(current);
        if (currentInside && !nextInside) result.push_back(intersection(current, next, plane, g));
        if (!currentInside && nextInside) result.push_back(intersection(next, current, plane, g));
    }
    return result;
}

int signOf(Wide value) { return value > 0 ? 1 : value < 0 ? -1 : 0; }

Wide snap(double clip, double w, double scale, double origin, int subpixelBits) {
    const double position = clip / w * scale + origin;
    const double limited = std::clamp(position, origin - kGuardBandWidth / 2, origin + kGuardBandWidth / 2);
    return static_cast<Wide>(std::nearbyint(std::ldexp(limited, subpixelBits)));
}

}  // namespace

Polygon preparePolygon(const std::array<ClipVertex, 3>& triangle, const Viewport& viewport, int subpixelBits,
                       bool depthClamp) {
    Polygon result;
    // Rule 1.
    std::vector<Vertex> vertices;
    for (size_t i = 0; i < 3; i++) {
        const ClipVertex& v = triangle[i];
        for (double c : {v.x, v.y, v.z, v.w}) {
            if (std::isnan(c) || std::isinf(c) || std::abs(c) >= kTooLarge) {
                result.fate = Fate::nonFinite;
                return result;
            }
        }
        Vertex copy{v.x + 0.0, v.y + 0.0, v.z + 0.0, v.w + 0.0, {0, 0, 0}};
        copy.barycentric[i] = 1;
        vertices.push_back(copy);
    }
    // Rule 2: which planes matter.
    const GuardBand g{kGuardBandWidth / viewport.width, kGuardBandWidth / viewport.height};
    std::vector<int> planes;
    for (int plane = 0; plane < kPlaneCount; plane++) {
        if (depthClamp && (plane == kPlaneNear || plane == kPlaneFar)) continue;
        const auto outside = std::count_if(vertices.begin(), vertices.end(),
                                           [&](const Vertex& v) { return !(distance(v, plane, g) >= 0); });
        if (outside == 3) {
            result.fate = Fate::rejected;
            return result;
        }
        if (outside > 0) planes.push_back(plane);
    }
    result.clipped = !planes.empty();
    for (int plane : planes) vertices = cut(vertices, plane, g);
    // Rule 3.
    const double halfWidth = viewport.width / 2.0, halfHeight = viewport.height / 2.0;
    std::vector<std::array<Wide, 2>> snapped;
    for (const Vertex& v : vertices)
        snapped.push_back({snap(v.x, v.w, halfWidth, viewport.x + halfWidth, subpixelBits),
                           snap(v.y, v.w, -halfHeight, viewport.y + halfHeight, subpixelBits)});
    Wide total = 0;
    for (size_t i = 1; i + 1 < vertices.size(); i++) {
        std::array<size_t, 3> index = {0, i, i + 1};
        const auto &p0 = snapped[0], &p1 = snapped[i], &p2 = snapped[i + 1];
        const Wide area = (p1[0] - p0[0]) * (p2[1] - p0[1]) - (p2[0] - p0[0]) * (p1[1] - p0[1]);
        total += area;
        Piece piece;
        piece.sign = signOf(area);
        piece.area = area < 0 ? -area : area;
        if (area < 0) std::swap(index[1], index[2]);
        for (size_t k = 0; k < 3; k++) {
            const Vertex& v = vertices[index[k]];
            piece.x_subpx[k] = snapped[index[k]][0];
            piece.y_subpx[k] = snapped[index[k]][1];
            piece.z[k] = v.z;
            piece.w[k] = v.w;
            piece.barycentric[k] = v.barycentric;
            piece.corner[k] = static_cast<int>(index[k]);
        }
        result.pieces.push_back(piece);
    }
    result.sign = signOf(total);
    if (result.sign == 0) result.fate = Fate::zeroArea;
    return result;
}

std::array<Wide, 3> edgeValues(const Piece& piece, Wide x_subpx, Wide y_subpx) {
    std::array<Wide, 3> e;
    for (size_t i = 0; i < 3; i++) {
        const size_t a = (i + 1) % 3, b = (i + 2) % 3;
        e[i] = (piece.x_subpx[b] - piece.x_subpx[a]) * (y_subpx - piece.y_subpx[a]) -
               (piece.y_subpx[b] - piece.y_subpx[a]) * (x_subpx - piece.x_subpx[a]);
    }
    return e;
}

bool pieceCovers(const Piece& piece, Wide x_subpx, Wide y_subpx) {
    if (piece.area == 0) return false;
    const auto e = edgeValues(piece, x_subpx, y_subpx);
    for (size_t i = 0; i < 3; i++) {
        if (e[i] < 0) return false;
        if (e[i] > 0) continue;
        const size_t a = (i + 1) % 3, b = (i + 2) % 3;
        const bool top = piece.y_subpx[b] == piece.y_subpx[a] && piece.x_subpx[b] > piece.x_subpx[a];
        const bool left = piece.y_subpx[b] < piece.y_subpx[a];
        if (!top && !left) return false;
    }
    return true;
}

std::optional<size_t> coveringPiece(const Polygon& polygon, Wide x_subpx, Wide y_subpx) {
    if (polygon.fate != Fate::drawn) return std::nullopt;
    int same = 0, opposite = 0;
    std::optional<size_t> first;
    for (size_t i = 0; i < polygon.pieces.size(); i++) {
        if (!pieceCovers(polygon.pieces[i], x_subpx, y_subpx)) continue;
        if (polygon.pieces[i].sign == polygon.sign) {
            same++;
            if (!first) first = i;
        } else {
            opposite++;
        }
    }
    return same > opposite ? first : std::nullopt;
}

std::array<Wide, 2> samplePosition(int x, int y, int samples, int sample, int subpixelBits) {
    // Rule 4, in sixteenths of a pixel from the centre.
    static constexpr int kFour[4][2] = {{-2, -6}, {6, -2}, {-6, 2}, {2, 6}};
    static constexpr int kSixteen[16][2] = {{1, 1},  {-1, -3}, {-3, 2}, {4, -1}, {-5, -2}, {2, 5},
                                            {5, 3},  {3, -5},  {-2, 6}, {0, -7}, {-4, -6}, {-6, 4},
                                            {-8, 0}, {7, -4},  {6, 7},  {-7, -8}};
    int dx = 0, dy = 0;
    if (samples == 4) dx = kFour[sample][0], dy = kFour[sample][1];
    if (samples == 16) dx = kSixteen[sample][0], dy = kSixteen[sample][1];
    const Wide sixteenth = Wide(1) << (subpixelBits - 4);
    return {(Wide(x) * 16 + 8 + dx) * sixteenth, (Wide(y) * 16 + 8 + dy) * sixteenth};
}

}  // namespace etalon::oracle
