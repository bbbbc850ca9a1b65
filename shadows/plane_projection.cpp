#include "shadows/plane_projection.h"

#include <cmath>

#include "numeric/check.h"
#include "numeric/vectors.h"

namespace etalon {
namespace {

glm::dvec3 xyz(const glm::dvec4& v) { return {v.x, v.y, v.z}; }

}  // namespace

ProjectionRows planeShadowMatrix(const ShadowPlane& plane, const glm::dvec4& light) {
    const glm::dvec4 p(plane.normal, plane.offset_m);
    const double lightHeight = dotOf(plane.normal, xyz(light)) + plane.offset_m * light.w;
    ProjectionRows rows;
    for (int r = 0; r < 4; r++)
        for (int c = 0; c < 4; c++)
            rows[static_cast<size_t>(r)][c] = (r == c ? lightHeight : 0.0) - light[r] * p[c];
    // n . l itself, which the sum above would round twice.
    rows[3].w = dotOf(plane.normal, xyz(light));
    return rows;
}

ProjectionRows unitBoxShadowMatrix(const Parallelogram& receiver, const glm::dvec4& light) {
    // Along edge w from the light to the parallelogram; n_x is perpendicular to edges y and w, and so on.
    const glm::dvec3 a = xyz(light), corner = receiver.corner;
    const glm::dvec3 edgeW = light.w == 0 ? glm::dvec3(-a.x, -a.y, -a.z)
                                          : glm::dvec3(corner.x - a.x, corner.y - a.y, corner.z - a.z);
    const glm::dvec3 nX = crossOf(edgeW, receiver.edgeY), nY = crossOf(receiver.edgeX, edgeW),
                     nW = crossOf(receiver.edgeY, receiver.edgeX);
    const double volumeX = dotOf(nX, receiver.edgeX), volumeY = dotOf(nY, receiver.edgeY),
                 volumeW = dotOf(nW, edgeW);
    ETALON_CHECK(std::isfinite(volumeX) && volumeX != 0 && std::isfinite(volumeY) && volumeY != 0 &&
                     std::isfinite(volumeW) && volumeW != 0,
                 "volumes {} {} {}", volumeX, volumeY, volumeW);
    const auto row = [&](const glm::dvec3& n, double volume, const glm::dvec3& zero) {
        return glm::dvec4(n.x / volume, n.y / volume, n.z / volume, -(dotOf(n, zero) / volume));
    };
    const glm::dvec4 x = row(nX, volumeX, corner), y = row(nY, volumeY, corner);
    if (light.w != 0) return {x, y, glm::dvec4(0, 0, 0, 1), row(nW, volumeW, a)};
    const glm::dvec4 depth = row(nW, -volumeW, corner);
    return {x, y, glm::dvec4(depth.x, depth.y, depth.z, depth.w + 1.0), glm::dvec4(0, 0, 0, 1)};
}

glm::dvec4 applyRows(const ProjectionRows& rows, const glm::dvec3& point) {
    glm::dvec4 result;
    for (int r = 0; r < 4; r++) {
        const glm::dvec4& row = rows[static_cast<size_t>(r)];
        result[r] = row.x * point.x + (row.y * point.y + (row.z * point.z + row.w));
    }
    return result;
}

glm::dvec3 PlaneFrame::toFrame(const glm::dvec3& point) const {
    const glm::dvec3 d(point.x - origin_m.x, point.y - origin_m.y, point.z - origin_m.z);
    return {dotOf(d, s), dotOf(d, t), dotOf(d, normal)};
}

glm::dvec4 PlaneFrame::toFrame(const glm::dvec4& light) const {
    const glm::dvec3 l = xyz(light);
    if (light.w == 0) return {dotOf(l, s), dotOf(l, t), dotOf(l, normal), 0};
    return glm::dvec4(toFrame(l), 1.0);
}

glm::dvec3 PlaneFrame::toWorld(double s_m, double t_m) const {
    return {origin_m.x + (s.x * s_m + t.x * t_m), origin_m.y + (s.y * s_m + t.y * t_m),
            origin_m.z + (s.z * s_m + t.z * t_m)};
}

ShadowPlane PlaneFrame::plane() const { return {normal, -dotOf(normal, origin_m)}; }

PlaneFrame planeFrame(const glm::dvec3& origin_m, const glm::dvec3& normal) {
    const double square = dotOf(normal, normal);
    ETALON_CHECK(square > 0 && std::isfinite(square), "normal ({}, {}, {})", normal.x, normal.y, normal.z);
    PlaneFrame frame;
    frame.origin_m = origin_m;
    frame.normal = unitOf(normal);
    const glm::dvec3 n = frame.normal;
    const bool alongX = n.x * n.x > 0.8;
    const glm::dvec3 axis = alongX ? glm::dvec3(0, 0, 1) : glm::dvec3(1, 0, 0);
    const double part = dotOf(axis, n);
    frame.s = unitOf({axis.x - n.x * part, axis.y - n.y * part, axis.z - n.z * part});
    frame.t = crossOf(frame.s, n);
    return frame;
}

}  // namespace etalon
