// Lane access that works for every number type of the kernel texts.
#pragma once

#include "numeric/kernel_types.h"

namespace etalon {

// The number whose lane i is f(i) (a double), rounded once to T.
template <class T, class F>
T generateNumber(F&& f) {
    constexpr int lanes = NumberTraits<T>::lanes;
    if constexpr (lanes == 1)
        return static_cast<T>(f(0));
    else if constexpr (requires { T::generate(f); })
        return T::generate(f);
    else
        return T(Lanes<double, lanes>::generate(f));
}

// Lane i as a double (exact for every format; Truth is rounded once).
template <class T>
double numberLane(const T& a, int i) {
    if constexpr (requires { a.toDouble(); })
        return a.toDouble();
    else if constexpr (requires { a[i]; })
        return static_cast<double>(a[i]);
    else if constexpr (requires { a.v[i]; })
        return a.v[i];
    else if constexpr (requires { a.v; })
        return a.v;
    else
        return static_cast<double>(a);
}

}  // namespace etalon
