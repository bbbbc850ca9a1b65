// Sums over texels in any arithmetic, for sources that are compiled per arithmetic. Their shape depends on
// the number of terms only.
#pragma once

#include <vector>

#include "probes/flux.h"

namespace etalon {

// to[i] = to[i] + from[i] for i in [0, count), in T; count is a multiple of the lanes of T.
template <class T>
void addTerms(typename Number<T>::Kept* to, const typename Number<T>::Kept* from, size_t count) {
    for (size_t i = 0; i < count; i += Number<T>::lanes)
        Number<T>::storeKept(Number<T>::loadKept(to + i) + Number<T>::loadKept(from + i), to + i);
}

// Folds `parts` (a power of two) blocks of `count` terms into the first one: block j + parts / 2 is added to
// j, and so on down to one.
template <class T>
void foldTerms(typename Number<T>::Kept* blocks, size_t count, size_t parts) {
    for (size_t half = parts / 2; half > 0; half /= 2)
        for (size_t j = 0; j < half; j++) addTerms<T>(blocks + j * count, blocks + (j + half) * count, count);
}

// Adds blocks of `count` terms in pairs of neighbours, again and again, an odd last one kept as it is; the
// sum is in the first one. There is at least one block.
template <class T>
void addInPairs(std::vector<typename Number<T>::Kept>& blocks, size_t count) {
    for (size_t left = blocks.size() / count; left > 1; left = (left + 1) / 2) {
        for (size_t pair = 0; 2 * pair < left; pair++) {
            typename Number<T>::Kept* to = blocks.data() + pair * count;
            const typename Number<T>::Kept* from = blocks.data() + 2 * pair * count;
            if (pair > 0) std::copy(from, from + count, to);
            if (2 * pair + 1 < left) addTerms<T>(to, from + count, count);
        }
    }
}

// A kept number as a double, Truth rounded once.
template <class S>
double termAsDouble(const S& term) {
    return numberLane(term, 0);
}

}  // namespace etalon
