// Shadows on a plane: where a light casts a point, as matrices [Karlsson2005, sec. 3.2.1; Heckbert1997].
//
// Lights are homogeneous: (x, y, z, 1) is a place in metres, (x, y, z, 0) the direction towards a light that
// is infinitely far; the length of a direction has no influence.
#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

namespace etalon {

// The points x with normal . x + offset_m = 0. normal: unit, towards the side that is lit and that casters
// are on.
struct ShadowPlane {
    glm::dvec3 normal{0, 1, 0};
    double offset_m = 0;
};

// The rows of a 4x4 matrix that is applied to (point, 1).
using ProjectionRows = std::array<glm::dvec4, 4>;

// Projects onto the plane away from the light l: M = (n . l + d l_w) I - l (n, d)^T. The result is
// homogeneous; its w is the height of the light above the plane minus that of the point (of a direction: n .
// l), so it is positive for points that are below a light in front of the plane. Points on the plane stay.
// The matrix itself also moves what casts no shadow: points behind the plane (false shadows) and, with w <=
// 0, points beyond the light (anti-shadows); shadows/planar_casters.h cuts both off. All zero when the light
// is in the plane and a place on it. Each element has the order of operations of the formula, with n . l =
// n.x l.x + (n.y l.y + n.z l.z).
ProjectionRows planeShadowMatrix(const ShadowPlane& plane, const glm::dvec4& light);

// A parallelogram: corner + a edgeX + b edgeY with a and b in [0, 1].
struct Parallelogram {
    glm::dvec3 corner{0};
    glm::dvec3 edgeX{1, 0, 0}, edgeY{0, 0, 1};
};

// Heckbert and Herf's form: maps the pyramid from the light over the parallelogram to a box. After division
// by w a point has x = a and y = b of its shadow; z is 1 on the parallelogram's plane, more between it and
// the light, and less behind the plane. w is 1 on the plane (of a direction: everywhere), 0 at the light's
// height and negative beyond. So z >= w and w > 0 holds exactly for what casts. The light must not be in the
// parallelogram's plane, and the edges must not be parallel: PreconditionError.
ProjectionRows unitBoxShadowMatrix(const Parallelogram& receiver, const glm::dvec4& light);

// The rows applied to (point, 1), each as r.x p.x + (r.y p.y + (r.z p.z + r.w)).
glm::dvec4 applyRows(const ProjectionRows& rows, const glm::dvec3& point);

// A plane's own coordinates: as seen from its front, s to the right and t down, both in metres, and the
// height above it. s, t and normal are orthonormal, s x t = -normal.
struct PlaneFrame {
    glm::dvec3 origin_m{0};
    glm::dvec3 s{1, 0, 0}, t{0, 0, 1}, normal{0, 1, 0};

    // (s, t, height); of a light, its fourth coordinate is kept.
    glm::dvec3 toFrame(const glm::dvec3& point) const;
    glm::dvec4 toFrame(const glm::dvec4& light) const;
    glm::dvec3 toWorld(double s_m, double t_m) const;
    ShadowPlane plane() const;
};

// The frame of a plane around a point of it: s is world +X laid into the plane (+Z where the normal is within
// 26 degrees of +-X). normal: not zero; any length.
PlaneFrame planeFrame(const glm::dvec3& origin_m, const glm::dvec3& normal);

}  // namespace etalon
