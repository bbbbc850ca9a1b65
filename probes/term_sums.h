// Sums over texels in any arithmetic, for sources that are compiled per arithmetic. Their shape depends on
// the number of terms only. The text is probes/kernels/term_sums.glsl.
#pragma once

#include <vector>

#include "numeric/kernel_types.h"
#include "numeric/number.h"

namespace etalon {

// What the text folds, and the text, over T: sums of `termsPerSum` kept terms each, a multiple of the lanes of T, one
// behind the other. Folds the terms from `term` on, as many as T has lanes.
template <class T>
class TermSumsKernel {
  public:
    using Kept = typename Number<T>::Kept;

    TermSumsKernel(Kept* sums, size_t termsPerSum) : sums_(sums), termsPerSum_(termsPerSum) {}

#include "numeric/kernel_scope.inc"
    size_t term = 0;
    real partialSum(int i) const { return Number<T>::loadKept(at(i)); }
    void setPartialSum(int i, real a) { Number<T>::storeKept(a, at(i)); }
#include "probes/kernels/term_sums.glsl"

  private:
    Kept* at(int i) const { return sums_ + static_cast<size_t>(i) * termsPerSum_ + term; }

    Kept* sums_;
    size_t termsPerSum_;
};

// The terms of one sum, in lanes: at least `terms` of them.
template <class T>
constexpr size_t paddedTerms(size_t terms) {
    constexpr size_t kWidth = Number<T>::lanes;
    return (terms + kWidth - 1) / kWidth * kWidth;
}

// Folds `parts` (a power of two) sums of `count` terms into the first one: sum j + parts / 2 is added to sum j, and so
// on down to one. count is a multiple of the lanes of T.
template <class T>
void foldTerms(typename Number<T>::Kept* sums, size_t count, size_t parts) {
    TermSumsKernel<T> kernel(sums, count);
    for (; kernel.term < count; kernel.term += Number<T>::lanes) kernel.foldInHalves(static_cast<int>(parts));
}

// Adds sums of `count` terms in pairs of neighbours, again and again, an odd last one kept as it is; the
// sum is in the first one. There is at least one sum; count is a multiple of the lanes of T.
template <class T>
void addInPairs(std::vector<typename Number<T>::Kept>& sums, size_t count) {
    TermSumsKernel<T> kernel(sums.data(), count);
    for (; kernel.term < count; kernel.term += Number<T>::lanes)
        kernel.foldInPairs(static_cast<int>(sums.size() / count));
}

// A kept number as a double, Truth rounded once.
template <class S>
double termAsDouble(const S& term) {
    return numberLane(term, 0);
}

}  // namespace etalon
