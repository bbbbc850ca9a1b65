// The elementary functions of kernel texts for Truth, through MPFR: correctly rounded to Truth::kBits bits.
// Link etalon::truth.
#pragma once

#include "numeric/elementary.h"
#include "numeric/truth.h"

namespace etalon {

// Domains and special cases as in numeric/elementary.h, but that no small number is taken as 0.
template <>
struct ElementaryFunctions<Truth> {
    static Truth atan2Of(const Truth& y, const Truth& x);
    static Truth powOf(const Truth& x, const Truth& y);
    static Truth sinOf(const Truth& x);
    static Truth cosOf(const Truth& x);
};

}  // namespace etalon
