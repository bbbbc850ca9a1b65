// Lanes<S, N>: N numbers of the scalar type S that are computed side by side (SIMD), with the operations that
// kernel texts use. The scalar instance is Lanes<S, 1>. Every operation is the IEEE operation per lane, so
// the number of lanes changes no bit.
//
// Built on the vector types that g++ and clang++ share; intrinsics only where those have no operation
// (laneBits). std::experimental::simd was tried first: with libstdc++ 12, clang++ 14 and 16 drop masked
// assignments (where(m, v) = w leaves v unchanged) on x86-64-v4.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>
#include <utility>

#include "numeric/lanes_registers.h"

namespace etalon {

// Bytes of the widest vector register of the target that this object is compiled for; 0: one lane at a time.
#if defined(ETALON_SCALAR_LANES)
inline constexpr int kVectorBytes = 0;
#elif defined(__AVX512F__)
inline constexpr int kVectorBytes = 64;
#elif defined(__AVX2__)
inline constexpr int kVectorBytes = 32;
#else
inline constexpr int kVectorBytes = 16;
#endif

// Lanes of S that fill one vector register.
template <class S>
inline constexpr int kNativeLanes = std::max(1, kVectorBytes / static_cast<int>(sizeof(S)));

// The width at which mixed work (float, double and integer lanes together) runs: one register of float.
inline constexpr int kLanes = kNativeLanes<float>;

// The signed integer of the same size as S: the element of a comparison's result.
template <class S>
using MaskElement =
    std::conditional_t<sizeof(S) == 8, int64_t, std::conditional_t<sizeof(S) == 4, int32_t, int8_t>>;

template <class S, int N>
struct Mask;

template <class S, int N = kNativeLanes<S>>
struct Lanes {
    static_assert(N > 0 && (N & (N - 1)) == 0, "the number of lanes is a power of two");
    using Scalar = S;
    typedef S Vector __attribute__((vector_size(N * sizeof(S))));
    static constexpr int size = N;

    Vector v;

    Lanes() = default;
    // The same value in each lane, rounded once to S. x - 0 is x for every x; 0 + x would turn -0 into 0.
    explicit Lanes(double value) : v(static_cast<S>(value) - Vector{}) {}
    explicit Lanes(Vector vector) : v(vector) {}

    // Lane i holds f(i).
    template <class F>
    static Lanes generate(F&& f) {
        Lanes r;
        for (int i = 0; i < N; i++) r.v[i] = static_cast<S>(f(i));
        return r;
    }
    static Lanes load(const S* from) {
        Lanes r;
        std::memcpy(&r.v, from, sizeof(Vector));
        return r;
    }
    void store(S* to) const { std::memcpy(to, &v, sizeof(Vector)); }

    S operator[](int lane) const { return v[lane]; }
    void set(int lane, S value) { v[lane] = value; }

    friend Lanes operator+(Lanes a, Lanes b) { return Lanes(a.v + b.v); }
    friend Lanes operator-(Lanes a, Lanes b) { return Lanes(a.v - b.v); }
    friend Lanes operator*(Lanes a, Lanes b) { return Lanes(a.v * b.v); }
    friend Lanes operator/(Lanes a, Lanes b) { return Lanes(a.v / b.v); }
    friend Lanes operator-(Lanes a) { return Lanes(-a.v); }

    // Bits; S is an integer type.
    friend Lanes operator&(Lanes a, Lanes b) { return Lanes(a.v & b.v); }
    friend Lanes operator|(Lanes a, Lanes b) { return Lanes(a.v | b.v); }
    friend Lanes operator<<(Lanes a, int bits) { return Lanes(a.v << bits); }
    friend Lanes operator>>(Lanes a, int bits) { return Lanes(a.v >> bits); }

    using M = Mask<S, N>;
    friend M operator<(Lanes a, Lanes b) { return M(a.v < b.v); }
    friend M operator<=(Lanes a, Lanes b) { return M(a.v <= b.v); }
    friend M operator>(Lanes a, Lanes b) { return M(a.v > b.v); }
    friend M operator>=(Lanes a, Lanes b) { return M(a.v >= b.v); }
    friend M operator==(Lanes a, Lanes b) { return M(a.v == b.v); }
    friend M operator!=(Lanes a, Lanes b) { return M(a.v != b.v); }
};

// The numbers of the scalar type S that an object of this level computes side by side: lanes that fill a
// register, or S itself where there is one lane.
template <class S>
using Native = std::conditional_t<kNativeLanes<S> == 1, S, Lanes<S>>;

// The result of a comparison of Lanes<S, N>: all bits of a lane set (true) or none (false).
template <class S, int N>
struct Mask {
    using Element = MaskElement<S>;
    typedef Element Vector __attribute__((vector_size(N * sizeof(Element))));
    Vector m;

    Mask() = default;
    explicit Mask(Vector mask) : m(mask) {}
    explicit Mask(bool value) : m(Vector{} - static_cast<Element>(value)) {}

    bool operator[](int lane) const { return m[lane] != 0; }
    friend Mask operator&&(Mask a, Mask b) { return Mask(a.m & b.m); }
    friend Mask operator||(Mask a, Mask b) { return Mask(a.m | b.m); }
    friend Mask operator!(Mask a) { return Mask(~a.m); }
};

// Per lane: c ? a : b.
template <class S, int N>
Lanes<S, N> select(Mask<S, N> c, Lanes<S, N> a, Lanes<S, N> b) {
    return Lanes<S, N>(c.m ? a.v : b.v);
}
template <class S, int N>
Lanes<S, N> squareRoot(Lanes<S, N> a) {
    if constexpr (registers::Functions<S, N>::kNative)
        return Lanes<S, N>(registers::Functions<S, N>::squareRoot(a.v));
    for (int i = 0; i < N; i++)
        a.v[i] = static_cast<S>(sizeof(S) == 4 ? __builtin_sqrtf(static_cast<float>(a.v[i]))
                                               : __builtin_sqrt(a.v[i]));
    return a;
}
// Largest whole number that is not greater; -0 stays -0.
template <class S, int N>
Lanes<S, N> floorOf(Lanes<S, N> a) {
    if constexpr (registers::Functions<S, N>::kNative)
        return Lanes<S, N>(registers::Functions<S, N>::floor(a.v));
    for (int i = 0; i < N; i++)
        a.v[i] = static_cast<S>(sizeof(S) == 4 ? __builtin_floorf(static_cast<float>(a.v[i]))
                                               : __builtin_floor(a.v[i]));
    return a;
}
// Bit i of the result is lane i of the mask.
template <class S, int N>
uint32_t laneBits(Mask<S, N> c) {
    static_assert(N <= 32);
#if defined(__AVX512DQ__)
    if constexpr (sizeof(c.m) == 64 && N == 16) return _mm512_movepi32_mask(reinterpret_cast<__m512i>(c.m));
    if constexpr (sizeof(c.m) == 64 && N == 8) return _mm512_movepi64_mask(reinterpret_cast<__m512i>(c.m));
#endif
#if defined(__AVX2__)
    if constexpr (sizeof(c.m) == 32 && N == 8)
        return static_cast<uint32_t>(_mm256_movemask_ps(reinterpret_cast<__m256>(c.m)));
    if constexpr (sizeof(c.m) == 32 && N == 4)
        return static_cast<uint32_t>(_mm256_movemask_pd(reinterpret_cast<__m256d>(c.m)));
#endif
#if defined(__SSE2__)
    if constexpr (sizeof(c.m) == 16 && N == 4)
        return static_cast<uint32_t>(_mm_movemask_ps(reinterpret_cast<__m128>(c.m)));
    if constexpr (sizeof(c.m) == 16 && N == 2)
        return static_cast<uint32_t>(_mm_movemask_pd(reinterpret_cast<__m128d>(c.m)));
#endif
    uint32_t bits = 0;
    for (int i = 0; i < N; i++) bits |= (c.m[i] != 0 ? 1u : 0u) << i;
    return bits;
}
template <class S, int N>
bool anyOf(Mask<S, N> c) {
    return laneBits(c) != 0;
}

// Converts each lane to the scalar type To (value conversion, rounded to nearest-even where To is narrower;
// to an integer: truncated, the value must be inside To's range).
template <class To, class S, int N>
Lanes<To, N> convertLanes(Lanes<S, N> a) {
    using Vector = typename Lanes<To, N>::Vector;
    if constexpr (registers::Conversion<To, S, N>::kNative)
        return Lanes<To, N>(registers::Conversion<To, S, N>::template of<Vector>(a.v));
    else
        return Lanes<To, N>(__builtin_convertvector(a.v, Vector));
}
// The lanes of a, then those of b. Compilers take vectors wider than a register apart lane by lane; work on
// registers and joining them is faster.
template <class S, int N>
Lanes<S, 2 * N> joinLanes(Lanes<S, N> a, Lanes<S, N> b) {
    return [&]<int... I>(std::integer_sequence<int, I...>) {
        return Lanes<S, 2 * N>(__builtin_shufflevector(a.v, b.v, I...));
    }
    (std::make_integer_sequence<int, 2 * N>{});
}
// The lanes first, first + 1 ... of a, as many as half of it has.
template <int first, class S, int N>
Lanes<S, N / 2> halfOfLanes(Lanes<S, N> a) {
    return [&]<int... I>(std::integer_sequence<int, I...>) {
        return Lanes<S, N / 2>(__builtin_shufflevector(a.v, a.v, (first + I)...));
    }
    (std::make_integer_sequence<int, N / 2>{});
}
template <class S, int N>
Lanes<S, N / 2> lowerLanes(Lanes<S, N> a) {
    return halfOfLanes<0>(a);
}
template <class S, int N>
Lanes<S, N / 2> upperLanes(Lanes<S, N> a) {
    return halfOfLanes<N / 2>(a);
}
// Lane first of a, that of b, the next of a and so on.
template <int first, class S, int N>
Lanes<S, N> interleavedLanes(Lanes<S, N> a, Lanes<S, N> b) {
    return [&]<int... I>(std::integer_sequence<int, I...>) {
        return Lanes<S, N>(__builtin_shufflevector(a.v, b.v, (first + I / 2 + I % 2 * N)...));
    }
    (std::make_integer_sequence<int, N>{});
}
// Lane i of row j changes places with lane j of row i.
template <class S, int N>
[[gnu::always_inline]] inline void transposeLanes(std::array<Lanes<S, N>, static_cast<size_t>(N)>& rows) {
    // Each stage interleaves the lanes of the rows of the first half with those of the second.
    constexpr auto kHalf = static_cast<size_t>(N / 2);
#pragma GCC unroll 4
    for (int stage = 1; stage < N; stage *= 2) {
        std::array<Lanes<S, N>, static_cast<size_t>(N)> next;
#pragma GCC unroll 8
        for (size_t i = 0; i < kHalf; i++) {
            next[2 * i] = interleavedLanes<0>(rows[i], rows[i + kHalf]);
            next[2 * i + 1] = interleavedLanes<N / 2>(rows[i], rows[i + kHalf]);
        }
        rows = next;
    }
}
// The entry of the table at each lane's index, which is inside it. Count is 16 or 32.
template <size_t Count, int N>
[[gnu::always_inline]] inline Lanes<float, N> entriesOf(const float (&table)[Count],
                                                        Lanes<int32_t, N> index) {
    using L = Lanes<float, N>;
    if constexpr (requires { registers::entriesOf(table, index.v); })
        return L(registers::entriesOf(table, index.v));
    else if constexpr (N > kNativeLanes<float>)
        return joinLanes(entriesOf(table, lowerLanes(index)), entriesOf(table, upperLanes(index)));
    else
        return L::generate([&](int i) { return table[index.v[i]]; });
}
template <size_t Count>
float entriesOf(const float (&table)[Count], int32_t index) {
    return table[index];
}
// The same mask for lanes of another scalar type.
template <class To, class S, int N>
Mask<To, N> convertMask(Mask<S, N> c) {
    return Mask<To, N>(__builtin_convertvector(c.m, typename Mask<To, N>::Vector));
}

// Calls body(first, active) for consecutive groups of N items: active is N for all but the last group, whose
// `active` says how many items are left. The one place where tails are cut.
template <int N, class F>
void forEachLaneGroup(size_t count, F&& body) {
    for (size_t first = 0; first < count; first += static_cast<size_t>(N)) {
        const size_t left = count - first;
        body(first, left < static_cast<size_t>(N) ? static_cast<int>(left) : N);
    }
}

// Loads `active` values; the lanes behind them repeat the last one, so that they compute on valid numbers.
// active >= 1.
template <class S, int N>
Lanes<S, N> loadActive(const S* from, int active) {
    if (active == N) return Lanes<S, N>::load(from);
    return Lanes<S, N>::generate([&](int i) { return from[i < active ? i : active - 1]; });
}

// Lane i of first and second: the numbers at from[i] + offset and behind it. Both are loaded at once, so that
// each lane costs one access.
template <int N>
[[gnu::always_inline]] inline void loadPairs(const std::array<const float*, static_cast<size_t>(N)>& from,
                                             size_t offset, Lanes<float, N>& first, Lanes<float, N>& second) {
    static_assert(sizeof(double) == 2 * sizeof(float));
    if constexpr (N == 1) {
        first.v[0] = from[0][offset], second.v[0] = from[0][offset + 1];
    } else {
        // The bits of two floats move as those of a double.
        const auto pair = [&](int i) {
            double bits;
            std::memcpy(&bits, from[static_cast<size_t>(i)] + offset, sizeof(bits));
            return bits;
        };
        const auto half = [&]<int... I>(int start, std::integer_sequence<int, I...>) {
            typedef double Pairs __attribute__((vector_size(N / 2 * sizeof(double))));
            return __builtin_bit_cast(typename Lanes<float, N>::Vector, Pairs{pair(start + I)...});
        };
        const auto lower = half(0, std::make_integer_sequence<int, N / 2>{});
        const auto upper = half(N / 2, std::make_integer_sequence<int, N / 2>{});
        [&]<int... I>(std::integer_sequence<int, I...>) {
            first = Lanes<float, N>(__builtin_shufflevector(lower, upper, 2 * I...));
            second = Lanes<float, N>(__builtin_shufflevector(lower, upper, 2 * I + 1 ...));
        }
        (std::make_integer_sequence<int, N>{});
    }
}

// Stores the first `active` lanes and touches nothing behind them.
template <class S, int N>
void storeActive(Lanes<S, N> a, S* to, int active) {
    if (active == N) return a.store(to);
    for (int i = 0; i < active; i++) to[i] = a[i];
}

}  // namespace etalon
