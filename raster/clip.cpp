#include "raster/clip.h"

#include <algorithm>

namespace etalon {
namespace {

using Kernel = Projection<double>;

double signedDistance(int plane, const ClipVertex& p, const ViewportTransform& t) {
    return Kernel::signedDistance(plane, {p.x, p.y, p.z, p.w}, t);
}

// Puts a point that was computed to be on the plane exactly onto it.
void placeOnPlane(int plane, ClipVertex& p, const ViewportTransform& t) {
    switch (plane) {
        case planeW:
            p.w = Kernel::kMinW;
            break;
        case planeNear:
            p.z = 0;
            break;
        case planeFar:
            p.z = p.w;
            break;
        case planeRight:
            p.x = t.guardX * p.w;
            break;
        case planeLeft:
            p.x = -(t.guardX * p.w);
            break;
        case planeTop:
            p.y = t.guardY * p.w;
            break;
        default:
            p.y = -(t.guardY * p.w);
            break;
    }
}

double between(double a, double b, double t) {
    return std::clamp(a + t * (b - a), std::min(a, b), std::max(a, b));
}

// The intersection of the edge from the inside vertex a to the outside vertex b. Taken in this direction from
// both triangles of a shared edge, so that both get the same bits.
PolygonVertex intersect(int plane, const PolygonVertex& a, double d_a, const PolygonVertex& b, double d_b,
                        const ViewportTransform& t) {
    const double along = d_a / (d_a - d_b);
    PolygonVertex p;
    p.position = {between(a.position.x, b.position.x, along), between(a.position.y, b.position.y, along),
                  between(a.position.z, b.position.z, along), between(a.position.w, b.position.w, along)};
    for (size_t k = 0; k < 3; k++) p.barycentric[k] = between(a.barycentric[k], b.barycentric[k], along);
    placeOnPlane(plane, p.position, t);
    return p;
}

void clipPolygon(int plane, const ViewportTransform& t, const Polygon& in, Polygon& out) {
    out.count = 0;
    for (int i = 0; i < in.count; i++) {
        const PolygonVertex& here = in.vertices[static_cast<size_t>(i)];
        const PolygonVertex& next = in.vertices[static_cast<size_t>((i + 1) % in.count)];
        const double d_here = signedDistance(plane, here.position, t);
        const double d_next = signedDistance(plane, next.position, t);
        const bool hereInside = d_here >= 0, nextInside = d_next >= 0;
        if (hereInside) out.vertices[static_cast<size_t>(out.count++)] = here;
        if (hereInside == nextInside) continue;
        out.vertices[static_cast<size_t>(out.count++)] =
            hereInside ? intersect(plane, here, d_here, next, d_next, t)
                       : intersect(plane, next, d_next, here, d_here, t);
    }
}

}  // namespace

bool clipTriangle(const std::array<ClipVertex, 3>& triangle, const ViewportTransform& transform, int planes,
                  Polygon& polygon) {
    Polygon other;
    Polygon *from = &polygon, *to = &other;
    polygon.count = 3;
    for (size_t i = 0; i < 3; i++) {
        polygon.vertices[i] = {triangle[i], {}};
        polygon.vertices[i].barycentric[i] = 1;
    }
    for (int plane = 0; plane < kClipPlanes; plane++) {
        if ((planes & (1 << plane)) == 0) continue;
        clipPolygon(plane, transform, *from, *to);
        std::swap(from, to);
        if (from->count < 3) return false;
    }
    if (from != &polygon) polygon = *from;
    return true;
}

}  // namespace etalon
