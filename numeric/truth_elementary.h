// The elementary functions of kernel texts for Truth, through MPFR: correctly rounded to Truth::kBits bits.
// Link etalon::truth.
#pragma once

#include "numeric/elementary.h"
#include "numeric/truth.h"

namespace etalon {

// Domains and special cases as in numeric/elementary.h, but that no small number is taken as 0.
template <>
struct ElementaryFunctions<Truth> {
    static Truth atan2Of(const Truth& y, const Truth& x) {
        // A sum with +0 turns -0 into +0.
        const Truth unsignedY = y + Truth(0.0), unsignedX = x + Truth(0.0);
        Truth r;
        mpfr_atan2(r.get(), unsignedY.get(), unsignedX.get(), MPFR_RNDN);
        return r;
    }
    static Truth powOf(const Truth& x, const Truth& y) {
        const Truth base = x + Truth(0.0);
        Truth r;
        if (base < Truth(0.0) || base != base || y != y)
            mpfr_set_nan(r.get());
        else
            mpfr_pow(r.get(), base.get(), y.get(), MPFR_RNDN);
        return r;
    }
    static Truth sinOf(const Truth& x) {
        Truth r;
        mpfr_sin(r.get(), x.get(), MPFR_RNDN);
        return r;
    }
    static Truth cosOf(const Truth& x) {
        Truth r;
        mpfr_cos(r.get(), x.get(), MPFR_RNDN);
        return r;
    }
};

}  // namespace etalon
