#include "probes/source_chart.h"

#include <array>
#include <cmath>

#include "numeric/vectors.h"
#include "probes/disc_solid_angle.h"

namespace etalon {
namespace {

using Kernel = MappingKernel<double>;

double crossOf(const glm::dvec2& a, const glm::dvec2& b) { return a.x * b.y - a.y * b.x; }
double signOf(bool isPositive) { return isPositive ? 1.0 : -1.0; }

}  // namespace

SourceChart::SourceChart(const ProbeShape& shape)
    : kind_(isLatLong(shape.mapping)               ? Kind::latLong
            : shape.mapping == Mapping::cube       ? Kind::cube
            : shape.mapping == Mapping::octahedral ? Kind::octahedral
                                                   : Kind::disc),
      isPedersen_(shape.mapping == Mapping::latLongPedersen),
      isAngular_(shape.mapping == Mapping::angular),
      size_(shape.width),
      settings_(mappingSettingsOf<Kernel>(shape)) {
    const glm::dvec3 x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
    switch (kind_) {
        case Kind::latLong:
            planes_ = {x, z};
            constantDensity_ = 2.0 * kPi / size_;
            break;
        case Kind::cube:
            planes_ = {{1, 1, 0}, {1, -1, 0}, {1, 0, 1}, {1, 0, -1}, {0, 1, 1}, {0, 1, -1}};
            for (int face = 0; face < kCubeFaces; face++) {
                const auto at = [&](double s, double t) { return Kernel{}.cubeDirection(face, s, t); };
                const glm::dvec3 major = at(0.5, 0.5);
                faces_.push_back({major, at(1.0, 0.5) - major, at(0.5, 1.0) - major});
            }
            break;
        case Kind::octahedral:
            planes_ = {x, y, z};
            constantDensity_ = kPi * (2.0 / size_) * (2.0 / size_);
            break;
        case Kind::disc:
            planes_ = {x, y};
            if (!isAngular_ && settings_.newtonSteps > 0) rimRadius_ = 2.0 - settings_.root;
            if (!isAngular_ && settings_.newtonSteps == 0)
                constantDensity_ = 4.0 * (2.0 / size_) * (2.0 / size_);
            break;
    }
    hasConstantDensity_ = constantDensity_ > 0.0;
    for (int i = 0; i <= shape.width; i++) columns_.push_back(i);
    for (int j = 0; j <= shape.height; j++)
        rows_.push_back(kind_ == Kind::latLong ? -sinOf(0.5 * kPi * ((shape.height - 2.0 * j) / shape.height))
                                               : j);
}

int SourceChart::patchOf(const glm::dvec3& d) const {
    const bool isX = d.x >= 0, isY = d.y >= 0, isZ = d.z >= 0;
    switch (kind_) {
        case Kind::latLong:
            return isX + 2 * isZ;
        case Kind::cube: {
            const double x = std::abs(d.x), y = std::abs(d.y), z = std::abs(d.z);
            if (z >= x && z >= y) return isZ ? 4 : 5;
            if (y >= x) return isY ? 2 : 3;
            return isX ? 0 : 1;
        }
        case Kind::octahedral:
            return isX + 2 * isY + 4 * isZ;
        case Kind::disc:
            break;
    }
    return isX + 2 * isY;
}

glm::dvec3 SourceChart::cornerNear(const glm::dvec3& d) const {
    switch (kind_) {
        case Kind::latLong:
            return {0, signOf(d.y >= 0), 0};
        case Kind::cube:
            return unitOf({signOf(d.x >= 0), signOf(d.y >= 0), signOf(d.z >= 0)});
        case Kind::octahedral: {
            const double x = std::abs(d.x), y = std::abs(d.y), z = std::abs(d.z);
            if (z >= x && z >= y) return {0, 0, signOf(d.z >= 0)};
            if (y >= x) return {0, signOf(d.y >= 0), 0};
            return {signOf(d.x >= 0), 0, 0};
        }
        case Kind::disc:
            break;
    }
    return {0, 0, signOf(d.z >= 0)};
}

bool SourceChart::isSingular(const glm::dvec3& d) const {
    if (kind_ == Kind::latLong) return d.x * d.x + d.z * d.z < kSameDirection * kSameDirection;
    return kind_ == Kind::disc && d.z < 0 && d.x * d.x + d.y * d.y < kSameDirection * kSameDirection;
}

glm::dvec2 SourceChart::at(int patch, const glm::dvec3& d) const {
    const bool isX = (patch & 1) != 0, isSecond = (patch & 2) != 0;
    switch (kind_) {
        case Kind::latLong: {
            // From the middle of the quarter's own side: a direction on the border has the azimuth of the patch.
            const glm::dvec3 a(std::abs(d.x), d.y, std::abs(d.z));
            const double quarter_rad = isPedersen_ ? atan2Of(a.z, a.x) : atan2Of(a.x, a.z);
            const bool isAhead = isPedersen_ ? !isX : isSecond, isLeft = isPedersen_ ? !isSecond : isX;
            const double longitude_rad = signOf(isLeft) * (isAhead ? quarter_rad : kPi - quarter_rad);
            return {(0.5 - longitude_rad / (2.0 * kPi)) * size_, -d.y};
        }
        case Kind::cube: {
            const FaceAxes& face = faces_[static_cast<size_t>(patch)];
            const double major = dotOf(d, face.major);
            return {(0.5 + 0.5 * (dotOf(d, face.s) / major)) * size_,
                    (0.5 + 0.5 * (dotOf(d, face.t) / major)) * size_};
        }
        case Kind::octahedral: {
            const glm::dvec2 q = Kernel{}.octahedralPoint({std::abs(d.x), std::abs(d.y), std::abs(d.z)});
            const bool isFront = (patch & 4) != 0;
            return inTexels(signOf(isX) * (isFront ? q.x : 1.0 - q.y),
                            signOf(isSecond) * (isFront ? q.y : 1.0 - q.x));
        }
        case Kind::disc:
            break;
    }
    if (isAngular_) {
        const glm::dvec2 q = Kernel{}.angularPoint(d);
        return inTexels(q.x, q.y);
    }
    if (settings_.newtonSteps > 0 && !Kernel{}.isOnBall(d, settings_)) {
        const double ring = std::sqrt(d.x * d.x + d.y * d.y);
        const double radius = 1.0 + (-settings_.root - d.z);
        return ring > 0.0 ? inTexels(radius * d.x / ring, radius * d.y / ring) : inTexels(radius, 0.0);
    }
    const glm::dvec2 q = Kernel{}.ballPoint(d, settings_);
    return inTexels(q.x, q.y);
}

glm::dvec2 SourceChart::singularPoint(const glm::dvec3& d, const glm::dvec2& point) const {
    if (kind_ == Kind::latLong) return {point.x, d.y > 0 ? -1.0 : 1.0};
    return rimPoint(point, point, 0.0);
}

glm::dvec2 SourceChart::rimPoint(const glm::dvec2& from, const glm::dvec2& to, double part) const {
    const glm::dvec2 a = onSquare(from), b = onSquare(to);
    const double x = a.x * (1.0 - part) + b.x * part, y = a.y * (1.0 - part) + b.y * part;
    const double radius = std::sqrt(x * x + y * y);
    return radius > 0.0 ? inTexels(rimRadius_ * x / radius, rimRadius_ * y / radius) : from;
}

double SourceChart::density(const glm::dvec2& p) const {
    if (hasConstantDensity_) return constantDensity_;
    const glm::dvec2 q = onSquare(p);
    const double perTexel = (2.0 / size_) * (2.0 / size_);
    if (rimRadius_ > 1.0 && q.x * q.x + q.y * q.y > 1.0) return 0.0;
    if (kind_ == Kind::disc) return perTexel * Kernel{}.discDensity(q.x, q.y, settings_);
    const double square = 1.0 + (q.x * q.x + q.y * q.y);
    return perTexel / (square * std::sqrt(square));
}

double SourceChart::solidAngle_sr(std::span<const glm::dvec2> polygon) const {
    if (kind_ == Kind::cube) return cubeSolidAngle_sr(polygon);
    if (!hasConstantDensity_) return discSolidAngle_sr(polygon);
    double twice = 0.0;
    for (size_t i = 2; i < polygon.size(); i++)
        twice += crossOf(polygon[i - 1] - polygon[0], polygon[i] - polygon[0]);
    return 0.5 * constantDensity_ * twice;
}

// Triangles from the first corner [Oosterom83]: the tangent of half of each solid angle is the slope of a complex
// number, and half of their sum the angle of the product.
double SourceChart::cubeSolidAngle_sr(std::span<const glm::dvec2> polygon) const {
    const auto corner = [&](size_t i) -> glm::dvec3 {
        const glm::dvec2 q = onSquare(polygon[i]);
        return {q.x, -q.y, 1.0};
    };
    const glm::dvec3 a = corner(0);
    const double lengthA = lengthOf(a);
    glm::dvec3 b = corner(1);
    double lengthB = lengthOf(b), re = 1.0, im = 0.0;
    for (size_t i = 2; i < polygon.size(); i++) {
        const glm::dvec3 c = corner(i);
        const double lengthC = lengthOf(c), all = lengthA * lengthB * lengthC;
        const double triple = crossOf({b.x - a.x, b.y - a.y}, {c.x - a.x, c.y - a.y});
        const double sum = all + (dotOf(a, b) * lengthC + (dotOf(b, c) * lengthA + dotOf(c, a) * lengthB));
        const double y = triple / all, x = sum / all;
        const double next = re * x - im * y;
        im = 0.25 * (re * y + im * x);
        re = 0.25 * next;
        b = c;
        lengthB = lengthC;
    }
    return 2.0 * atan2Of(im, re);
}

// The integral of G dphi = G / r^2 (x dy - y dx) along the border (probes/disc_solid_angle.h).
double SourceChart::discSolidAngle_sr(std::span<const glm::dvec2> polygon) const {
    // Gauss-Legendre of 3 points on pieces this long.
    constexpr double kPiece = 0.03125;
    constexpr double kNode = 0.3872983346207417;
    double sum = 0.0;
    for (size_t i = 0; i < polygon.size(); i++) {
        const glm::dvec2 a = onSquare(polygon[i]), b = onSquare(polygon[(i + 1) % polygon.size()]);
        const double dx = b.x - a.x, dy = b.y - a.y;
        const int pieces = 1 + static_cast<int>(std::sqrt(dx * dx + dy * dy) / kPiece);
        double integral = 0.0;
        for (int piece = 0; piece < pieces; piece++) {
            const auto term = [&](double node) {
                const double t = (piece + node) / pieces;
                return discTerm(a.x + dx * t, a.y + dy * t, isAngular_, settings_);
            };
            integral += 5.0 * (term(0.5 - kNode) + term(0.5 + kNode)) + 8.0 * term(0.5);
        }
        sum += crossOf(a, {dx, dy}) * (integral / (18.0 * pieces));
    }
    return sum;
}

}  // namespace etalon
