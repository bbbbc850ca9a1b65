// The number type of the arithmetic `truth`; apart, because it needs MPFR.
#pragma once

#include "numeric/truth.h"
#include "numeric/truth_elementary.h"
#include "raster/fragment_numbers.h"

namespace etalon {

template <>
struct FragmentNumber<FragmentArithmetic::truth> {
    using Type = Truth;
};

}  // namespace etalon
