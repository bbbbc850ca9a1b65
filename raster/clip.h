// Clipping of one triangle in clip space (rule 2).
//
// Not here: planes of the user, clip and cull distances, and the clipping of attributes: a vertex that clipping
// makes has barycentric coordinates. Polygons stay whole; their fans are made by raster/setup.h.
#pragma once

#include <array>

#include "raster/draw.h"
#include "raster/projection.h"

namespace etalon {

// A vertex of a clipped polygon: its position, and its barycentric coordinates in the source triangle.
struct PolygonVertex {
    ClipVertex position;
    std::array<double, 3> barycentric{};
};

// A plane adds one vertex to a convex polygon. Rounding can make a polygon slightly concave; then a plane can
// add as many vertices as there are pairs of neighbours on either side of it, n / 2: 3, 4, 6, 9, 13, 19,
// 28, 42.
inline constexpr int kMaxPolygonVertices = 42;

// A polygon; count 0: nothing is left.
struct Polygon {
    std::array<PolygonVertex, kMaxPolygonVertices> vertices;
    int count = 0;
};

// Clips the triangle against the planes of rule 2 that `planes` (bits of an outcode, raster/projection.h)
// names. False when nothing is left. Coordinates must be finite and below 2^500 in magnitude.
bool clipTriangle(const std::array<ClipVertex, 3>& triangle, const ViewportTransform& transform, int planes,
                  Polygon& polygon);

}  // namespace etalon
