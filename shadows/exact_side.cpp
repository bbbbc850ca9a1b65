#include "shadows/exact_side.h"

#include <array>
#include <cmath>
#include <cstddef>

namespace etalon {
namespace {

// A number as the exact sum of two doubles.
struct Pair {
    double head, tail;
};

// a + b [Knuth1998, sec. 4.2.2].
Pair exactSum(double a, double b) {
    const double sum = a + b;
    const double b_part = sum - a, a_part = sum - b_part;
    return {sum, (a - a_part) + (b - b_part)};
}

// a b [Dekker1971]; exact while nothing overflows or becomes subnormal.
Pair exactProduct(double a, double b) {
    constexpr double kSplit = 0x1p27 + 1;
    const auto upper = [](double v) {
        const double scaled = kSplit * v;
        return scaled - (scaled - v);
    };
    const double product = a * b;
    const double a_high = upper(a), a_low = a - a_high, b_high = upper(b), b_low = b - b_high;
    return {product, a_low * b_low - (((product - a_high * b_high) - a_low * b_high) - a_high * b_low)};
}

// A sum of doubles without rounding: a non-overlapping expansion, smallest part first [Shewchuk97, sec. 2.2].
class ExactSum {
  public:
    void add(double v) {
        size_t kept = 0;
        for (size_t i = 0; i < count_; i++) {
            const Pair sum = exactSum(v, parts_[i]);
            if (sum.tail != 0) parts_[kept++] = sum.tail;
            v = sum.head;
        }
        if (v != 0) parts_[kept++] = v;
        count_ = kept;
    }
    int sign() const {
        if (count_ == 0) return 0;
        return parts_[count_ - 1] > 0 ? 1 : -1;
    }

  private:
    // A determinant of pairs: six products, each of 2 * 2 * 2 parts of four doubles.
    std::array<double, 6 * 8 * 4> parts_{};
    size_t count_ = 0;
};

// A vector of pairs: the difference of two points, or a direction.
struct Vector {
    std::array<Pair, 3> component;
    double operator[](size_t i) const { return component[i].head; }
};

Vector between(const glm::dvec3& from, const glm::dvec3& to) {
    return {exactSum(to.x, -from.x), exactSum(to.y, -from.y), exactSum(to.z, -from.z)};
}

Vector direction(const glm::dvec3& d) { return {Pair{d.x, 0}, Pair{d.y, 0}, Pair{d.z, 0}}; }

void addProduct(ExactSum& sum, double sign, Pair a, Pair b, Pair c) {
    for (const double x : {a.head, a.tail})
        for (const double y : {b.head, b.tail}) {
            const Pair xy = exactProduct(sign * x, y);
            for (const double v : {xy.head, xy.tail})
                for (const double z : {c.head, c.tail}) {
                    const Pair product = exactProduct(v, z);
                    sum.add(product.tail);
                    sum.add(product.head);
                }
        }
}

int exactSign(const Vector& u, const Vector& v, const Vector& w) {
    ExactSum sum;
    for (size_t i = 0; i < 3; i++) {
        const size_t j = (i + 1) % 3, k = (i + 2) % 3;
        addProduct(sum, 1, u.component[i], v.component[j], w.component[k]);
        addProduct(sum, -1, u.component[i], v.component[k], w.component[j]);
    }
    return sum.sign();
}

// The sign of u . (v x w).
int signOfDeterminant(const Vector& u, const Vector& v, const Vector& w) {
    // At most 7 (1 + 2^-50) roundings of 2^-53 in each product and sum of products [Shewchuk97, sec. 4.3].
    constexpr double kErrorBound = 0x1p-50;
    double determinant = 0, magnitude = 0;
    for (size_t i = 0; i < 3; i++) {
        const size_t j = (i + 1) % 3, k = (i + 2) % 3;
        const double p = v[j] * w[k], q = v[k] * w[j];
        determinant = determinant + u[i] * (p - q);
        magnitude = magnitude + std::fabs(u[i]) * (std::fabs(p) + std::fabs(q));
    }
    if (std::fabs(determinant) > kErrorBound * magnitude) return determinant > 0 ? 1 : -1;
    return exactSign(u, v, w);
}

}  // namespace

bool isExactCoordinate(double v) {
    const double magnitude = std::fabs(v);
    return v == 0 || (magnitude >= 0x1p-240 && magnitude <= 0x1p300);
}

bool isExactPoint(const glm::dvec3& p) {
    return isExactCoordinate(p.x) && isExactCoordinate(p.y) && isExactCoordinate(p.z);
}

int sideOfTriangle(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& p) {
    return signOfDeterminant(between(a, p), between(a, b), between(a, c));
}

int sideOfTriangleTowards(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c,
                          const glm::dvec3& towards) {
    return signOfDeterminant(direction(towards), between(a, b), between(a, c));
}

int sideOfEdge(const glm::dvec3& p, const glm::dvec3& q, const glm::dvec3& a, const glm::dvec3& b) {
    return signOfDeterminant(between(p, q), between(p, a), between(p, b));
}

int sideOfEdgeTowards(const glm::dvec3& p, const glm::dvec3& towards, const glm::dvec3& a,
                      const glm::dvec3& b) {
    return signOfDeterminant(direction(towards), between(p, a), between(p, b));
}

}  // namespace etalon
