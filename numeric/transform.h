// Small 3D transforms in double with a written order of operations, so that they give the same bits
// everywhere. Matrices are glm's column-major m[column][row]; points are columns: p_world = M * p_object.
#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include "numeric/vectors.h"

namespace etalon {

// Sine and cosine of an angle in degrees, |degrees| <= 1e6. Multiples of 90 degrees are exact; elsewhere
// within 4 units in the last place (sinOf and cosOf of numeric/elementary.h after an exact reduction to +-45
// degrees).
struct SinCos {
    double sin, cos;
};
SinCos sinCosOfDegrees(double degrees);

// a * b; each entry is (a0 b0 + a1 b1) + (a2 b2 + a3 b3).
glm::dmat4 multiplied(const glm::dmat4& a, const glm::dmat4& b);

// M * (p, 1) and M * (d, 0) for a matrix whose last row is 0 0 0 1.
glm::dvec3 transformPoint(const glm::dmat4& m, const glm::dvec3& p);
glm::dvec3 transformDirection(const glm::dmat4& m, const glm::dvec3& d);

// The direction of a surface normal after M: the cofactors of the upper 3x3 part times n, with the sign of
// the determinant, so that an outward normal stays outward under a mirroring. Not normalised; M not singular.
glm::dvec3 transformNormal(const glm::dmat4& m, const glm::dvec3& n);

// Determinant of the upper 3x3 part. Negative: M mirrors, and the winding of triangles turns round.
double determinant3(const glm::dmat4& m);

// |determinant| divided by the product of the column lengths: 1 for orthogonal columns, 0 for a singular
// matrix (also when a column is zero). Independent of scale.
double conditionOf(const glm::dmat4& m);

// Inverse of a rotation and translation: transposed rotation.
glm::dmat4 rigidInverse(const glm::dmat4& m);

glm::dmat4 translation(const glm::dvec3& t);
glm::dmat4 scaling(const glm::dvec3& s);

// Rotation about a unit axis, counter-clockwise when the axis points at the viewer (Rodrigues' formula).
glm::dmat4 rotationAboutAxis(const glm::dvec3& unitAxis, double degrees);

// First about X, then about Y, then about Z, all fixed axes: Rz * Ry * Rx.
glm::dmat4 rotationXyz(const glm::dvec3& degrees);

// Camera-to-world matrix of a camera at `position` that looks along -Z of its own frame at `target`; +Y of
// its frame is the part of `up` perpendicular to the view. target != position, up not parallel to the view.
glm::dmat4 lookAt(const glm::dvec3& position, const glm::dvec3& target, const glm::dvec3& up);

// The rotation nearest in the Gram-Schmidt sense: column z keeps its direction, y is made perpendicular to
// it, x = y cross z. Translation unchanged. An exact rotation with entries 0 and +-1 comes back with the same
// bits.
glm::dmat4 orthonormalised(const glm::dmat4& m);

}  // namespace etalon
