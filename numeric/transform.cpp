#include "numeric/transform.h"

#include "numeric/check.h"
#include "numeric/elementary.h"

namespace etalon {

namespace {

glm::dvec3 column(const glm::dmat4& m, int i) { return {m[i].x, m[i].y, m[i].z}; }

glm::dmat4 fromColumns(const glm::dvec3& x, const glm::dvec3& y, const glm::dvec3& z, const glm::dvec3& t) {
    return {glm::dvec4(x.x, x.y, x.z, 0), glm::dvec4(y.x, y.y, y.z, 0), glm::dvec4(z.x, z.y, z.z, 0),
            glm::dvec4(t.x, t.y, t.z, 1)};
}

glm::dvec3 added(const glm::dvec3& a, const glm::dvec3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }

}  // namespace

SinCos sinCosOfDegrees(double degrees) {
    ETALON_CHECK(degrees >= -1e6 && degrees <= 1e6, "angle of {} degrees", degrees);
    // Quarter turns are taken off in degrees, where the subtraction is exact.
    const double quarters = __builtin_floor(degrees / 90 + 0.5);
    const double rest_rad = (degrees - quarters * 90) * (kPi / 180);
    const double s = sinOf(rest_rad), c = cosOf(rest_rad);
    switch (static_cast<int>(quarters) & 3) {
        case 0:
            return {s, c};
        case 1:
            return {c, 0 - s};
        case 2:
            return {0 - s, 0 - c};
        default:
            return {0 - c, s};
    }
}

glm::dmat4 multiplied(const glm::dmat4& a, const glm::dmat4& b) {
    glm::dmat4 r;
    for (int c = 0; c < 4; c++)
        for (int i = 0; i < 4; i++)
            r[c][i] = (a[0][i] * b[c][0] + a[1][i] * b[c][1]) + (a[2][i] * b[c][2] + a[3][i] * b[c][3]);
    return r;
}

glm::dvec3 transformDirection(const glm::dmat4& m, const glm::dvec3& d) {
    const auto row = [&](int i) { return m[0][i] * d.x + (m[1][i] * d.y + m[2][i] * d.z); };
    return {row(0), row(1), row(2)};
}

glm::dvec3 transformPoint(const glm::dmat4& m, const glm::dvec3& p) {
    return added(transformDirection(m, p), column(m, 3));
}

double determinant3(const glm::dmat4& m) { return dotOf(column(m, 0), crossOf(column(m, 1), column(m, 2))); }

glm::dvec3 transformNormal(const glm::dmat4& m, const glm::dvec3& n) {
    const glm::dvec3 x = column(m, 0), y = column(m, 1), z = column(m, 2);
    const glm::dvec3 r = added(scaledBy(crossOf(y, z), n.x),
                               added(scaledBy(crossOf(z, x), n.y), scaledBy(crossOf(x, y), n.z)));
    return determinant3(m) < 0 ? glm::dvec3(-r.x, -r.y, -r.z) : r;
}

double conditionOf(const glm::dmat4& m) {
    const glm::dvec3 x = unitOf(column(m, 0)), y = unitOf(column(m, 1)), z = unitOf(column(m, 2));
    const double d = dotOf(x, crossOf(y, z));
    return d < 0 ? -d : d;
}

glm::dmat4 rigidInverse(const glm::dmat4& m) {
    const glm::dvec3 x = column(m, 0), y = column(m, 1), z = column(m, 2), t = column(m, 3);
    return fromColumns({x.x, y.x, z.x}, {x.y, y.y, z.y}, {x.z, y.z, z.z},
                       {0 - dotOf(x, t), 0 - dotOf(y, t), 0 - dotOf(z, t)});
}

glm::dmat4 translation(const glm::dvec3& t) { return fromColumns({1, 0, 0}, {0, 1, 0}, {0, 0, 1}, t); }

glm::dmat4 scaling(const glm::dvec3& s) {
    return fromColumns({s.x, 0, 0}, {0, s.y, 0}, {0, 0, s.z}, {0, 0, 0});
}

glm::dmat4 rotationAboutAxis(const glm::dvec3& a, double degrees) {
    const auto [s, c] = sinCosOfDegrees(degrees);
    const double t = 1 - c;
    return fromColumns({t * a.x * a.x + c, t * a.x * a.y + s * a.z, t * a.x * a.z - s * a.y},
                       {t * a.x * a.y - s * a.z, t * a.y * a.y + c, t * a.y * a.z + s * a.x},
                       {t * a.x * a.z + s * a.y, t * a.y * a.z - s * a.x, t * a.z * a.z + c}, {0, 0, 0});
}

glm::dmat4 rotationXyz(const glm::dvec3& degrees) {
    const glm::dmat4 x = rotationAboutAxis({1, 0, 0}, degrees.x);
    const glm::dmat4 y = rotationAboutAxis({0, 1, 0}, degrees.y);
    const glm::dmat4 z = rotationAboutAxis({0, 0, 1}, degrees.z);
    return multiplied(z, multiplied(y, x));
}

glm::dmat4 lookAt(const glm::dvec3& position, const glm::dvec3& target, const glm::dvec3& up) {
    const glm::dvec3 z = unitOf({position.x - target.x, position.y - target.y, position.z - target.z});
    const glm::dvec3 x = unitOf(crossOf(up, z));
    return fromColumns(x, crossOf(z, x), z, position);
}

glm::dmat4 orthonormalised(const glm::dmat4& m) {
    const glm::dvec3 z = unitOf(column(m, 2)), yGiven = column(m, 1);
    const glm::dvec3 y = unitOf(added(yGiven, scaledBy(z, 0 - dotOf(yGiven, z))));
    return fromColumns(crossOf(y, z), y, z, column(m, 3));
}

}  // namespace etalon
