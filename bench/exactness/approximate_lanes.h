// A number type for the kernel texts that gives up exactness: lanes of float whose division and square root
// use the processor's approximate reciprocals (relative error below 1.5 2^-12 on AVX2, 2^-14 on AVX-512),
// without a correction step.
#pragma once

#include <immintrin.h>

#include "numeric/elementary.h"
#include "numeric/kernel_types.h"

namespace etalon::bench {

struct Approximate {
    using L = Lanes<float, kLanes>;
    L v;

    Approximate() = default;
    explicit Approximate(double value) : v(value) {}
    explicit Approximate(L lanes) : v(lanes) {}

    friend Approximate operator+(Approximate a, Approximate b) { return Approximate(a.v + b.v); }
    friend Approximate operator-(Approximate a, Approximate b) { return Approximate(a.v - b.v); }
    friend Approximate operator*(Approximate a, Approximate b) { return Approximate(a.v * b.v); }
    friend Approximate operator/(Approximate a, Approximate b) { return Approximate(a.v * reciprocal(b.v)); }
    friend Approximate operator-(Approximate a) { return Approximate(-a.v); }
    friend auto operator<(Approximate a, Approximate b) { return a.v < b.v; }
    friend auto operator>(Approximate a, Approximate b) { return a.v > b.v; }
    friend auto operator<=(Approximate a, Approximate b) { return a.v <= b.v; }
    friend auto operator>=(Approximate a, Approximate b) { return a.v >= b.v; }
    friend auto operator==(Approximate a, Approximate b) { return a.v == b.v; }
    friend auto operator!=(Approximate a, Approximate b) { return a.v != b.v; }

#if defined(__AVX512F__)
    static L reciprocal(L a) { return L(_mm512_rcp14_ps(a.v)); }
    static L reciprocalRoot(L a) { return L(_mm512_rsqrt14_ps(a.v)); }
#else
    static L reciprocal(L a) { return L(_mm256_rcp_ps(a.v)); }
    static L reciprocalRoot(L a) { return L(_mm256_rsqrt_ps(a.v)); }
#endif
};

inline Approximate select(Mask<float, kLanes> c, Approximate a, Approximate b) {
    return Approximate(etalon::select(c, a.v, b.v));
}
inline Approximate squareRoot(Approximate a) { return Approximate(a.v * Approximate::reciprocalRoot(a.v)); }
inline Approximate floorOf(Approximate a) { return Approximate(etalon::floorOf(a.v)); }

}  // namespace etalon::bench

namespace etalon {

template <>
struct NumberTraits<bench::Approximate> {
    static constexpr int lanes = kLanes;
    using Integer = Lanes<int32_t, kLanes>;
    using Stored = float;
};

#if defined(ETALON_BENCH_POWER_IN_FLOAT)
// 2^(y log2 x) in float: relative error about |y log2 x| 2^-22. For 0 <= x <= 1 and y >= 1.
template <>
struct ElementaryFunctions<bench::Approximate> {
    using A = bench::Approximate;
    using L = A::L;
    using Bits = Mask<float, kLanes>::Vector;

    static A powOf(A x, A y) {
        // x = 2^e m, 1 <= m < 2; below the smallest normal number the result is 0 for every y that matters.
        const Bits bits = __builtin_bit_cast(Bits, x.v.v);
        const L e = convertLanes<float>(Lanes<int32_t, kLanes>((bits >> 23) - 127));
        const L m(__builtin_bit_cast(L::Vector, (bits & 0x007fffff) | 0x3f800000));
        // log2 m = 2/ln 2 atanh(s), s = (m - c) / (m + c) with c = sqrt(2), plus log2 c; |s| <= 0.172.
        const L c(1.4142135623730951);
        const L s = (m - c) * A::reciprocal(m + c), s2 = s * s;
        const L series =
            L(2.8853900817779268) +
            s2 * (L(0.9617966939259756) + s2 * (L(0.5770780163555854) + s2 * L(0.4121985831111324)));
        const L p = y.v * (e + L(0.5) + s * series);
        // Results below 2^-60 are 0 in the text that calls this.
        const L bounded = etalon::select(p < L(-100.0), L(-100.0), p);
        const L whole = etalon::floorOf(bounded + L(0.5));
        const L z = (bounded - whole) * L(0.6931471805599453);
        const L exponential =
            L(1.0) +
            z * (L(1.0) +
                 z * (L(0.5) + z * (L(0.16666667) +
                                    z * (L(0.041666667) + z * (L(0.0083333333) + z * L(0.0013888889))))));
        const Bits scale = (convertLanes<int32_t>(whole).v + 127) << 23;
        return A(exponential * L(__builtin_bit_cast(L::Vector, scale)));
    }
};
#else
template <>
struct ElementaryFunctions<bench::Approximate> {
    using A = bench::Approximate;
    static A powOf(A x, A y) { return A(ElementaryFunctions<A::L>::powOf(x.v, y.v)); }
};
#endif

}  // namespace etalon
