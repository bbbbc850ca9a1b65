// On which side, exactly: signs of 3 x 3 determinants of differences of doubles [Shewchuk97].
//
// Coordinates are 0 or of magnitude 2^-240 to 2^300 (isExactCoordinate); then every result is the sign of the
// determinant in exact arithmetic. Most are decided by an error bound in double, the others by an expansion
// of the determinant.
#pragma once

#include <glm/vec3.hpp>

namespace etalon {

// Whether the sign functions are exact for a coordinate; false for NaN and infinities.
bool isExactCoordinate(double v);
bool isExactPoint(const glm::dvec3& p);

// The sign (-1, 0, 1) of ((b - a) x (c - a)) . (p - a): 1 where p sees a, b, c counter-clockwise. 0: the four
// points lie in one plane.
int sideOfTriangle(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& p);

// The same for p infinitely far away in a direction: the sign of ((b - a) x (c - a)) . towards.
int sideOfTriangleTowards(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c,
                          const glm::dvec3& towards);

// On which side of the directed edge a -> b the line from p to q passes: the sign of (q - p) . ((a - p) x (b
// - p)). Exchanging a and b changes the sign and nothing else.
int sideOfEdge(const glm::dvec3& p, const glm::dvec3& q, const glm::dvec3& a, const glm::dvec3& b);
// The same for the line from p in a direction.
int sideOfEdgeTowards(const glm::dvec3& p, const glm::dvec3& towards, const glm::dvec3& a,
                      const glm::dvec3& b);

}  // namespace etalon
