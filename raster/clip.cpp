#include "raster/clip.h"

#include <algorithm>

namespace etalon {
namespace {

constexpr double kMinW = 0x1p-80;
constexpr double kGuardBandWidth_px = 131072.0;

enum Plane { planeW, planeNear, planeFar, planeRight, planeLeft, planeTop, planeBottom, kPlaneCount };

double signedDistance(int plane, const ClipVertex& p, const GuardBand& guard) {
    switch (plane) {
        case planeW:
            return p.w - kMinW;
        case planeNear:
            return p.z;
        case planeFar:
            return p.w - p.z;
        case planeRight:
            return guard.x * p.w - p.x;
        case planeLeft:
            return guard.x * p.w + p.x;
        case planeTop:
            return guard.y * p.w - p.y;
        default:
            return guard.y * p.w + p.y;
    }
}

// Puts a point that was computed to be on the plane exactly onto it.
void placeOnPlane(int plane, ClipVertex& p, const GuardBand& guard) {
    switch (plane) {
        case planeW:
            p.w = kMinW;
            break;
        case planeNear:
            p.z = 0;
            break;
        case planeFar:
            p.z = p.w;
            break;
        case planeRight:
            p.x = guard.x * p.w;
            break;
        case planeLeft:
            p.x = -(guard.x * p.w);
            break;
        case planeTop:
            p.y = guard.y * p.w;
            break;
        default:
            p.y = -(guard.y * p.w);
            break;
    }
}

double between(double a, double b, double t) {
    return std::clamp(a + t * (b - a), std::min(a, b), std::max(a, b));
}

// The intersection of the edge from the inside vertex a to the outside vertex b. Taken in this direction from
// both triangles of a shared edge, so that both get the same bits.
PolygonVertex intersect(int plane, const PolygonVertex& a, double d_a, const PolygonVertex& b, double d_b,
                        const GuardBand& guard) {
    const double t = d_a / (d_a - d_b);
    PolygonVertex p;
    p.position = {between(a.position.x, b.position.x, t), between(a.position.y, b.position.y, t),
                  between(a.position.z, b.position.z, t), between(a.position.w, b.position.w, t)};
    for (size_t k = 0; k < 3; k++) p.barycentric[k] = between(a.barycentric[k], b.barycentric[k], t);
    placeOnPlane(plane, p.position, guard);
    return p;
}

void clipPolygon(int plane, const GuardBand& guard, const Polygon& in, Polygon& out) {
    out.count = 0;
    for (int i = 0; i < in.count; i++) {
        const PolygonVertex& here = in.vertices[static_cast<size_t>(i)];
        const PolygonVertex& next = in.vertices[static_cast<size_t>((i + 1) % in.count)];
        const double d_here = signedDistance(plane, here.position, guard);
        const double d_next = signedDistance(plane, next.position, guard);
        const bool hereInside = d_here >= 0, nextInside = d_next >= 0;
        if (hereInside) out.vertices[static_cast<size_t>(out.count++)] = here;
        if (hereInside == nextInside) continue;
        out.vertices[static_cast<size_t>(out.count++)] =
            hereInside ? intersect(plane, here, d_here, next, d_next, guard)
                       : intersect(plane, next, d_next, here, d_here, guard);
    }
}

}  // namespace

GuardBand::GuardBand(const Viewport& viewport)
    : x(kGuardBandWidth_px / viewport.width), y(kGuardBandWidth_px / viewport.height) {}

ClipResult clipTriangle(const std::array<ClipVertex, 3>& triangle, const GuardBand& guard, bool depthClamp,
                        Polygon& polygon) {
    unsigned outsideAny = 0, outsideAll = ~0u;
    for (const ClipVertex& p : triangle) {
        unsigned outside = 0;
        for (int plane = 0; plane < kPlaneCount; plane++) {
            if (depthClamp && (plane == planeNear || plane == planeFar)) continue;
            if (signedDistance(plane, p, guard) < 0) outside |= 1u << plane;
        }
        outsideAny |= outside;
        outsideAll &= outside;
    }
    if (outsideAll != 0) return ClipResult::rejected;
    if (outsideAny == 0) return ClipResult::inside;

    Polygon other;
    Polygon *from = &polygon, *to = &other;
    polygon.count = 3;
    for (size_t i = 0; i < 3; i++) {
        polygon.vertices[i] = {triangle[i], {}};
        polygon.vertices[i].barycentric[i] = 1;
    }
    for (int plane = 0; plane < kPlaneCount; plane++) {
        if ((outsideAny & (1u << plane)) == 0) continue;
        clipPolygon(plane, guard, *from, *to);
        std::swap(from, to);
        if (from->count < 3) return ClipResult::rejected;
    }
    if (from != &polygon) polygon = *from;
    return ClipResult::clipped;
}

}  // namespace etalon
