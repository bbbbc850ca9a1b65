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
    explicit Truth(double value);

    // The value as MPFR reads it. Valid until the object is changed, copied over or destroyed, and, because
    // MPFR's header points at the digits and copies of an object keep the old address, only until the calling
    // thread has called get() on kViews other const objects: use it in the expression that calls it. Several
    // threads may call it on one object.
    mpfr_srcptr get() const;
    // The value as the target of an MPFR function. Valid until the object is copied over or destroyed.
    mpfr_ptr get();

    // Rounded once to double, nearest even; infinite beyond its range.
    double toDouble() const;

    friend Truth operator+(const Truth& a, const Truth& b);
    friend Truth operator-(const Truth& a, const Truth& b);
    friend Truth operator*(const Truth& a, const Truth& b);
    friend Truth operator/(const Truth& a, const Truth& b);
    friend Truth operator-(const Truth& a);

    friend bool operator<(const Truth& a, const Truth& b);
    friend bool operator<=(const Truth& a, const Truth& b);
    friend bool operator>(const Truth& a, const Truth& b);
    friend bool operator>=(const Truth& a, const Truth& b);
    friend bool operator==(const Truth& a, const Truth& b);
    friend bool operator!=(const Truth& a, const Truth& b);

  private:
    // More than any MPFR function takes as operands.
    static constexpr size_t kViews = 16;
    static constexpr size_t kLimbs = (kBits + GMP_NUMB_BITS - 1) / GMP_NUMB_BITS;

    __mpfr_struct header_;
    std::array<mp_limb_t, kLimbs> limbs_;
};

inline Truth select(bool c, const Truth& a, const Truth& b) { return c ? a : b; }
// -0 gives -0; a negative number gives NaN.
Truth squareRoot(const Truth& a);
// Largest whole number that is not greater; -0 stays -0.
Truth floorOf(const Truth& a);

template <>
struct NumberTraits<Truth> {
    static constexpr int lanes = 1;
    using Integer = int32_t;
    using Stored = double;
};
// Truncates; the value must be inside int32.
int32_t toInteger(const Truth& a);
template <>
struct FromInteger<Truth> {
    static Truth of(int32_t a) { return Truth(static_cast<double>(a)); }
};

}  // namespace etalon
