// What an operation in a number format must give, by MPFR: twice, so that no rounding is tested only against our own
// words.
#pragma once

#include <mpfr.h>

#include <bit>
#include <cmath>
#include <cstdint>

#include "numeric/format.h"

namespace etalon::test {

inline bool sameBits(double a, double b) { return std::bit_cast<int64_t>(a) == std::bit_cast<int64_t>(b); }
// MPFR has one NaN without a sign; the formats have one NaN.
inline bool agree(double result, double expected) {
    return std::isnan(expected) ? sameBits(result, kCanonicalNan) : sameBits(result, expected);
}

// MPFR set up to compute in one format, with its own rounding: nearestEven, towardZero, up and down. Puts the
// thread's exponent range back at the end.
class Reference {
  public:
    explicit Reference(Format f)
        : f_(f), rounding_(roundingOf(f.rounding)), emin_(mpfr_get_emin()), emax_(mpfr_get_emax()) {
        // MPFR's significands are in [1/2, 1), so its exponents are larger by one.
        mpfr_set_emin(f.minExponent - f.significandBits + 2);
        mpfr_set_emax(f.maxExponent + 1);
        for (mpfr_ptr x : {a_, b_, r_}) mpfr_init2(x, f.significandBits);
    }
    ~Reference() {
        for (mpfr_ptr x : {a_, b_, r_}) mpfr_clear(x);
        mpfr_set_emin(emin_);
        mpfr_set_emax(emax_);
    }
    Reference(const Reference&) = delete;
    Reference& operator=(const Reference&) = delete;

    static bool has(Rounding rounding) {
        return rounding != Rounding::nearestAway && roundingOf(rounding) != MPFR_RNDF;
    }

    void setOperands(double a, double b) {
        mpfr_set_d(a_, a, MPFR_RNDN);
        mpfr_set_d(b_, b, MPFR_RNDN);
    }
    double binary(int (*operation)(mpfr_ptr, mpfr_srcptr, mpfr_srcptr, mpfr_rnd_t)) {
        return finish(operation(r_, a_, b_, rounding_));
    }
    double unary(int (*operation)(mpfr_ptr, mpfr_srcptr, mpfr_rnd_t)) {
        return finish(operation(r_, a_, rounding_));
    }
    double root() { return unary(mpfr_sqrt); }
    double converted(double x) { return finish(mpfr_set_d(r_, x, rounding_)); }

  private:
    static mpfr_rnd_t roundingOf(Rounding rounding) {
        switch (rounding) {
            case Rounding::nearestEven:
                return MPFR_RNDN;
            case Rounding::towardZero:
                return MPFR_RNDZ;
            case Rounding::up:
                return MPFR_RNDU;
            case Rounding::down:
                return MPFR_RNDD;
            default:
                return MPFR_RNDF;
        }
    }
    double finish(int ternary) {
        mpfr_subnormalize(r_, ternary, rounding_);
        const double r = mpfr_get_d(r_, MPFR_RNDN);
        if (f_.overflow == Overflow::saturate && std::isnan(r)) return 0.0;
        if (f_.overflow == Overflow::saturate && std::isinf(r)) return std::copysign(largestFinite(f_), r);
        if (f_.subnormals == Subnormals::flush && std::abs(r) < smallestNormal(f_))
            return std::copysign(0.0, r);
        return r;
    }

    Format f_;
    mpfr_rnd_t rounding_;
    mpfr_exp_t emin_, emax_;
    mpfr_t a_, b_, r_;
};

// The same for every rounding: MPFR computes the value with many bits toward zero and says whether something is left
// over, and the value is rounded here on whole multiples of the format's quantum.
class ExactReference {
  public:
    explicit ExactReference(Format f) : f_(f) {
        for (mpfr_ptr x : {a_, b_, r_, whole_}) mpfr_init2(x, kBits);
    }
    ~ExactReference() {
        for (mpfr_ptr x : {a_, b_, r_, whole_}) mpfr_clear(x);
    }
    ExactReference(const ExactReference&) = delete;
    ExactReference& operator=(const ExactReference&) = delete;

    void setOperands(double a, double b) {
        mpfr_set_d(a_, a, MPFR_RNDN);
        mpfr_set_d(b_, b, MPFR_RNDN);
    }
    // `threshold` in (0, 1): stochastic rounding takes the larger magnitude if the fraction is beyond it.
    double binary(int (*operation)(mpfr_ptr, mpfr_srcptr, mpfr_srcptr, mpfr_rnd_t), double threshold = 0.5) {
        const int ternary = operation(r_, a_, b_, MPFR_RNDZ);
        // The sign of an exact difference of equal numbers is the rounding's.
        if (mpfr_zero_p(r_) && f_.rounding == Rounding::down) operation(r_, a_, b_, MPFR_RNDD);
        return finish(ternary, threshold);
    }
    double unary(int (*operation)(mpfr_ptr, mpfr_srcptr, mpfr_rnd_t), double threshold = 0.5) {
        return finish(operation(r_, a_, MPFR_RNDZ), threshold);
    }
    double root(double threshold = 0.5) { return unary(mpfr_sqrt, threshold); }
    double converted(double x, double threshold = 0.5) {
        return finish(mpfr_set_d(r_, x, MPFR_RNDZ), threshold);
    }

  private:
    static constexpr int kBits = 256;

    double finish(int ternary, double threshold) {
        const bool isSaturated = f_.overflow == Overflow::saturate;
        if (mpfr_nan_p(r_)) return isSaturated ? 0.0 : kCanonicalNan;
        const bool isNegative = mpfr_signbit(r_) != 0;
        const auto withSign = [=](double magnitude) { return isNegative ? -magnitude : magnitude; };
        if (mpfr_inf_p(r_)) return withSign(isSaturated ? largestFinite(f_) : HUGE_VAL);
        if (mpfr_zero_p(r_)) return withSign(0.0);

        const int exponent = static_cast<int>(mpfr_get_exp(r_)) - 1;
        const int quantum = (exponent < f_.minExponent ? f_.minExponent : exponent) - f_.significandBits + 1;
        mpfr_abs(r_, r_, MPFR_RNDZ);
        mpfr_mul_2si(r_, r_, -quantum, MPFR_RNDZ);
        mpfr_trunc(whole_, r_);
        mpfr_sub(r_, r_, whole_, MPFR_RNDZ);  // the fraction, but for what is left over
        double multiple = mpfr_get_d(whole_, MPFR_RNDZ);
        if (isAwayFromZero(isNegative, std::fmod(multiple, 2.0) == 1.0, ternary != 0, threshold))
            multiple += 1.0;

        const double magnitude = std::ldexp(multiple, quantum);
        if (f_.subnormals == Subnormals::flush && magnitude < smallestNormal(f_)) return withSign(0.0);
        if (magnitude <= largestFinite(f_)) return withSign(magnitude);
        const bool isCut = f_.rounding == Rounding::towardZero ||
                           f_.rounding == (isNegative ? Rounding::up : Rounding::down);
        return withSign(isCut || isSaturated ? largestFinite(f_) : HUGE_VAL);
    }
    // 1 if the fraction is beyond the bound, 0 if it is the bound.
    int comparedWith(double bound, bool hasMore) const {
        const int order = mpfr_cmp_d(r_, bound);
        return order == 0 && hasMore ? 1 : order;
    }
    bool isAwayFromZero(bool isNegative, bool isOdd, bool hasMore, double threshold) const {
        const int half = comparedWith(0.5, hasMore);
        const bool hasFraction = comparedWith(0.0, hasMore) > 0;
        switch (f_.rounding) {
            case Rounding::nearestEven:
                return half > 0 || (half == 0 && isOdd);
            case Rounding::nearestAway:
                return half >= 0;
            case Rounding::towardZero:
                return false;
            case Rounding::up:
                return hasFraction && !isNegative;
            case Rounding::down:
                return hasFraction && isNegative;
            default:
                return comparedWith(threshold, hasMore) > 0;
        }
    }

    Format f_;
    mpfr_t a_, b_, r_, whole_;
};

}  // namespace etalon::test
