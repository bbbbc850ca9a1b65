// Vectors in double on the host, with a written order of operations (never the library's dot, whose order may
// change), so that they give the same bits everywhere. Kernel texts have numeric/kernels/vector.glsl.
#pragma once

#include <glm/vec3.hpp>

namespace etalon {

inline constexpr double kPi = 0x1.921fb54442d18p+1;  // pi rounded to nearest

// a.x b.x + (a.y b.y + a.z b.z).
inline double dotOf(const glm::dvec3& a, const glm::dvec3& b) { return a.x * b.x + (a.y * b.y + a.z * b.z); }

// Right-handed cross product; component x is a.y b.z - a.z b.y, the others by rotation of the letters.
inline glm::dvec3 crossOf(const glm::dvec3& a, const glm::dvec3& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

// sqrt(dotOf(a, a)); components up to 1e150 in magnitude.
inline double lengthOf(const glm::dvec3& a) { return __builtin_sqrt(dotOf(a, a)); }

// a / |a|. The zero vector comes back unchanged.
inline glm::dvec3 unitOf(const glm::dvec3& a) {
    const double length = lengthOf(a);
    if (!(length > 0)) return a;
    return {a.x / length, a.y / length, a.z / length};
}

inline bool isFinite(const glm::dvec3& a) {
    return __builtin_isfinite(a.x) && __builtin_isfinite(a.y) && __builtin_isfinite(a.z);
}

inline glm::dvec3 scaledBy(const glm::dvec3& a, double s) { return {a.x * s, a.y * s, a.z * s}; }

}  // namespace etalon
