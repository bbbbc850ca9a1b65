// Operations on one vector register that compilers take apart lane by lane: square root, floor and
// conversions. Each specialisation is the IEEE operation on every lane; without one, the loop or the
// compiler's conversion does the same.
#pragma once

#include <cstddef>
#include <cstdint>

#if defined(__x86_64__)
// g++ 12 takes the undefined register that its own header starts from for a use of one.
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#pragma GCC diagnostic ignored "-Wuninitialized"
#endif
#include <immintrin.h>
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic pop
#endif
#elif defined(__aarch64__)
#include <arm_neon.h>
#endif

namespace etalon::registers {

// The vector types have N lanes of S.
template <class S, int N>
struct Functions {
    static constexpr bool kNative = false;
};
template <class To, class From, int N>
struct Conversion {
    static constexpr bool kNative = false;
};

#define ETALON_REGISTER_FUNCTIONS(S, N, Register, root, down)                     \
    template <>                                                                   \
    struct Functions<S, N> {                                                      \
        static constexpr bool kNative = true;                                     \
        template <class Vector>                                                   \
        static Vector squareRoot(Vector v) {                                      \
            return reinterpret_cast<Vector>(root(reinterpret_cast<Register>(v))); \
        }                                                                         \
        template <class Vector>                                                   \
        static Vector floor(Vector v) {                                           \
            return reinterpret_cast<Vector>(down(reinterpret_cast<Register>(v))); \
        }                                                                         \
    };
#define ETALON_REGISTER_CONVERSION(To, From, N, Register, convert)                     \
    template <>                                                                        \
    struct Conversion<To, From, N> {                                                   \
        static constexpr bool kNative = true;                                          \
        template <class ToVector, class FromVector>                                    \
        static ToVector of(FromVector v) {                                             \
            return reinterpret_cast<ToVector>(convert(reinterpret_cast<Register>(v))); \
        }                                                                              \
    };

#if defined(__AVX512F__)
inline __m512 floor512(__m512 v) {
    return _mm512_roundscale_ps(v, _MM_FROUND_TO_NEG_INF | _MM_FROUND_NO_EXC);
}
inline __m512d floor512(__m512d v) {
    return _mm512_roundscale_pd(v, _MM_FROUND_TO_NEG_INF | _MM_FROUND_NO_EXC);
}
ETALON_REGISTER_FUNCTIONS(float, 16, __m512, _mm512_sqrt_ps, floor512)
ETALON_REGISTER_FUNCTIONS(double, 8, __m512d, _mm512_sqrt_pd, floor512)
ETALON_REGISTER_CONVERSION(float, double, 8, __m512d, _mm512_cvtpd_ps)
ETALON_REGISTER_CONVERSION(double, float, 8, __m256, _mm512_cvtps_pd)
ETALON_REGISTER_CONVERSION(double, int32_t, 8, __m256i, _mm512_cvtepi32_pd)
ETALON_REGISTER_CONVERSION(int32_t, double, 8, __m512d, _mm512_cvttpd_epi32)
#endif
#if defined(__AVX2__)
ETALON_REGISTER_FUNCTIONS(float, 8, __m256, _mm256_sqrt_ps, _mm256_floor_ps)
ETALON_REGISTER_FUNCTIONS(double, 4, __m256d, _mm256_sqrt_pd, _mm256_floor_pd)
ETALON_REGISTER_CONVERSION(float, double, 4, __m256d, _mm256_cvtpd_ps)
ETALON_REGISTER_CONVERSION(double, float, 4, __m128, _mm256_cvtps_pd)
ETALON_REGISTER_CONVERSION(double, int32_t, 4, __m128i, _mm256_cvtepi32_pd)
ETALON_REGISTER_CONVERSION(int32_t, double, 4, __m256d, _mm256_cvttpd_epi32)
#endif
#if defined(__SSE4_1__)
ETALON_REGISTER_FUNCTIONS(float, 4, __m128, _mm_sqrt_ps, _mm_floor_ps)
ETALON_REGISTER_FUNCTIONS(double, 2, __m128d, _mm_sqrt_pd, _mm_floor_pd)
#endif
#if defined(__aarch64__)
ETALON_REGISTER_FUNCTIONS(float, 4, float32x4_t, vsqrtq_f32, vrndmq_f32)
ETALON_REGISTER_FUNCTIONS(double, 2, float64x2_t, vsqrtq_f64, vrndmq_f64)
#endif

// Each lane of float rounded to binary16, to nearest even with subnormals kept, and back; NaN stays NaN. Overloads
// for the vectors that the processor has the conversions for.
void throughBinary16();
#define ETALON_THROUGH_BINARY16(N, Register, narrow, wide)                               \
    typedef float Floats##N __attribute__((vector_size(N * sizeof(float))));             \
    inline Floats##N throughBinary16(Floats##N v) {                                      \
        return reinterpret_cast<Floats##N>(wide(narrow(reinterpret_cast<Register>(v)))); \
    }
#if defined(__AVX512F__)
inline __m256i toBinary16(__m512 v) {
    return _mm512_cvtps_ph(v, _MM_FROUND_TO_NEAREST_INT | _MM_FROUND_NO_EXC);
}
ETALON_THROUGH_BINARY16(16, __m512, toBinary16, _mm512_cvtph_ps)
#endif
#if defined(__F16C__)
inline __m128i toBinary16(__m256 v) {
    return _mm256_cvtps_ph(v, _MM_FROUND_TO_NEAREST_INT | _MM_FROUND_NO_EXC);
}
ETALON_THROUGH_BINARY16(8, __m256, toBinary16, _mm256_cvtph_ps)
#endif
#if defined(__aarch64__)
ETALON_THROUGH_BINARY16(4, float32x4_t, vcvt_f16_f32, vcvt_f32_f16)
#endif

// The entry of a table of 16 or 32 floats at each lane's index. Overloads for the vectors that the processor permutes.
void entriesOf();
#if defined(__AVX512F__)
typedef float Floats16 __attribute__((vector_size(64)));
typedef int32_t Indices16 __attribute__((vector_size(64)));
template <size_t Count>
[[gnu::always_inline]] inline Floats16 entriesOf(const float (&table)[Count], Indices16 index) {
    const auto at = reinterpret_cast<__m512i>(index);
    if constexpr (Count == 16)
        return reinterpret_cast<Floats16>(_mm512_permutexvar_ps(at, _mm512_loadu_ps(table)));
    else
        return reinterpret_cast<Floats16>(
            _mm512_permutex2var_ps(_mm512_loadu_ps(table), at, _mm512_loadu_ps(table + 16)));
}
#endif
#if defined(__AVX2__)
typedef float Floats8 __attribute__((vector_size(32)));
typedef int32_t Indices8 __attribute__((vector_size(32)));
template <size_t Count>
[[gnu::always_inline]] inline Floats8 entriesOf(const float (&table)[Count], Indices8 index) {
    const auto at = reinterpret_cast<__m256i>(index);
    // Bit 3 or 4 of the index, as the sign that a blend reads.
    const __m256 isOdd = _mm256_castsi256_ps(_mm256_slli_epi32(at, 31 - 3));
    const auto pair = [&](size_t first) {
        return _mm256_blendv_ps(_mm256_permutevar8x32_ps(_mm256_loadu_ps(table + first), at),
                                _mm256_permutevar8x32_ps(_mm256_loadu_ps(table + first + 8), at), isOdd);
    };
    if constexpr (Count == 16)
        return reinterpret_cast<Floats8>(pair(0));
    else
        return reinterpret_cast<Floats8>(
            _mm256_blendv_ps(pair(0), pair(16), _mm256_castsi256_ps(_mm256_slli_epi32(at, 31 - 4))));
}
#endif

#undef ETALON_THROUGH_BINARY16
#undef ETALON_REGISTER_FUNCTIONS
#undef ETALON_REGISTER_CONVERSION

}  // namespace etalon::registers
