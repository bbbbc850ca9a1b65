// Truth: a binary floating-point number with 192 bits, the value that errors are measured against. MPFR does
// the arithmetic; link etalon::truth. Never used for speed.
#pragma once

#include <gmp.h>
#include <mpfr.h>

#include <array>
#include <cstddef>
#include <cstdint>

#include "numeric/kernel_types.h"

namespace etalon {

// + - * / and the square root are correctly rounded (nearest even) to kBits bits: relative error at most
// 2^-192. The exponent range is MPFR's default (about +-2^62), so that nothing overflows or is subnormal in
// practice. Signed zeros, infinities, NaN and comparisons as in IEEE 754. Trivially copyable, 56 bytes, no
// allocation; a default-constructed value is not initialised, as for double.
class Truth {
  public:
    static constexpr int kBits = 192;

    Truth() = default;
    // Exact.
    explicit Truth(double value) { mpfr_set_d(get(), value, MPFR_RNDN); }

    // The value as MPFR reads it. Valid until the object is changed, copied over or destroyed, and, because
    // MPFR's header points at the digits and copies of an object keep the old address, only until the calling
    // thread has called get() on kViews other const objects: use it in the expression that calls it. Several
    // threads may call it on one object.
    mpfr_srcptr get() const {
        if (header_._mpfr_d == limbs_.data()) return &header_;
        static thread_local std::array<__mpfr_struct, kViews> views;
        static thread_local size_t next = 0;
        mpfr_ptr view = &views[next++ % kViews];
        *view = header_;
        mpfr_custom_move(view, const_cast<mp_limb_t*>(limbs_.data()));
        return view;
    }
    // The value as the target of an MPFR function. Valid until the object is copied over or destroyed.
    mpfr_ptr get() {
        header_._mpfr_prec = kBits;
        mpfr_custom_move(&header_, limbs_.data());
        return &header_;
    }

    // Rounded once to double, nearest even; infinite beyond its range.
    double toDouble() const { return mpfr_get_d(get(), MPFR_RNDN); }

    friend Truth operator+(const Truth& a, const Truth& b) { return apply(mpfr_add, a, b); }
    friend Truth operator-(const Truth& a, const Truth& b) { return apply(mpfr_sub, a, b); }
    friend Truth operator*(const Truth& a, const Truth& b) { return apply(mpfr_mul, a, b); }
    friend Truth operator/(const Truth& a, const Truth& b) { return apply(mpfr_div, a, b); }
    friend Truth operator-(const Truth& a) {
        Truth r;
        mpfr_neg(r.get(), a.get(), MPFR_RNDN);
        return r;
    }

    friend bool operator<(const Truth& a, const Truth& b) { return mpfr_less_p(a.get(), b.get()) != 0; }
    friend bool operator<=(const Truth& a, const Truth& b) { return mpfr_lessequal_p(a.get(), b.get()) != 0; }
    friend bool operator>(const Truth& a, const Truth& b) { return mpfr_greater_p(a.get(), b.get()) != 0; }
    friend bool operator>=(const Truth& a, const Truth& b) {
        return mpfr_greaterequal_p(a.get(), b.get()) != 0;
    }
    friend bool operator==(const Truth& a, const Truth& b) { return mpfr_equal_p(a.get(), b.get()) != 0; }
    friend bool operator!=(const Truth& a, const Truth& b) { return mpfr_equal_p(a.get(), b.get()) == 0; }

  private:
    // More than any MPFR function takes as operands.
    static constexpr size_t kViews = 16;
    static constexpr size_t kLimbs = (kBits + GMP_NUMB_BITS - 1) / GMP_NUMB_BITS;

    using Binary = int (*)(mpfr_ptr, mpfr_srcptr, mpfr_srcptr, mpfr_rnd_t);
    static Truth apply(Binary operation, const Truth& a, const Truth& b) {
        Truth r;
        operation(r.get(), a.get(), b.get(), MPFR_RNDN);
        return r;
    }

    __mpfr_struct header_;
    std::array<mp_limb_t, kLimbs> limbs_;
};

inline Truth select(bool c, const Truth& a, const Truth& b) { return c ? a : b; }
// -0 gives -0; a negative number gives NaN.
inline Truth squareRoot(const Truth& a) {
    Truth r;
    mpfr_sqrt(r.get(), a.get(), MPFR_RNDN);
    return r;
}
// Largest whole number that is not greater; -0 stays -0.
inline Truth floorOf(const Truth& a) {
    Truth r;
    mpfr_floor(r.get(), a.get());
    return r;
}

template <>
struct NumberTraits<Truth> {
    static constexpr int lanes = 1;
    using Integer = int32_t;
};
// Truncates; the value must be inside int32.
inline int32_t toInteger(const Truth& a) { return static_cast<int32_t>(mpfr_get_si(a.get(), MPFR_RNDZ)); }
template <>
struct FromInteger<Truth> {
    static Truth of(int32_t a) { return Truth(static_cast<double>(a)); }
};

}  // namespace etalon
