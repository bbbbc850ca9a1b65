// The yardstick of the lanes code: 16 pixels at a time in AVX-512 intrinsics, with what a writer by hand
// knows and a compiler does not (the power's argument is in [0, 1], powers below 2^-60 count as 0). The
// operations that remain are those of the texts, in their order, but for the power, which is that of pow.glsl in double
// rounded once: its bits are those of the float's power in all but a few of a thousand cases.
#include <immintrin.h>

#include <initializer_list>

#include "bench/exactness/shading_variant.h"

namespace etalon::bench {
namespace {

struct Vector3 {
    __m512 x, y, z;
};

Vector3 load(const float* const (&from)[3], size_t first) {
    return {_mm512_loadu_ps(from[0] + first), _mm512_loadu_ps(from[1] + first),
            _mm512_loadu_ps(from[2] + first)};
}
Vector3 broadcast(const float* const (&from)[3], size_t i) {
    return {_mm512_set1_ps(from[0][i]), _mm512_set1_ps(from[1][i]), _mm512_set1_ps(from[2][i])};
}
Vector3 broadcast(const double (&v)[3]) {
    return {_mm512_set1_ps(static_cast<float>(v[0])), _mm512_set1_ps(static_cast<float>(v[1])),
            _mm512_set1_ps(static_cast<float>(v[2]))};
}
__m512 dot(const Vector3& a, const Vector3& b) {
    return _mm512_add_ps(_mm512_mul_ps(a.x, b.x),
                         _mm512_add_ps(_mm512_mul_ps(a.y, b.y), _mm512_mul_ps(a.z, b.z)));
}

// a + b * c, in two roundings.
__m512d step(double a, __m512d b, __m512d c) { return _mm512_add_pd(_mm512_set1_pd(a), _mm512_mul_pd(b, c)); }

// x^y for 0 <= x <= 1, y >= 1: numeric/kernels/pow.glsl without the cases that cannot be. Anything below
// 2^-100 is 2^-100.
__m512d power(__m512d x, __m512d y) {
    // x = 2^exponent m, m in [sqrt(1/2), sqrt(2)].
    const __m512d half = _mm512_set1_pd(0.5), one = _mm512_set1_pd(1.0);
    __m512d m = _mm512_getmant_pd(x, _MM_MANT_NORM_1_2, _MM_MANT_SIGN_zero), exponent = _mm512_getexp_pd(x);
    const __mmask8 high = _mm512_cmp_pd_mask(m, _mm512_set1_pd(0x1.6a09e667f3bcdp0), _CMP_GT_OQ);
    m = _mm512_mask_mul_pd(m, high, m, half);
    exponent = _mm512_mask_add_pd(exponent, high, exponent, one);

    // log2 m = log2 c + 2/ln 2 atanh(s), s = (m - c) / (m + c).
    const __mmask8 nearLow = _mm512_cmp_pd_mask(m, _mm512_set1_pd(0.8671875), _CMP_LT_OQ);
    const __mmask8 nearHigh = _mm512_cmp_pd_mask(m, _mm512_set1_pd(1.1171875), _CMP_GT_OQ);
    __m512d c = _mm512_mask_mov_pd(one, nearLow, _mm512_set1_pd(0.75));
    c = _mm512_mask_mov_pd(c, nearHigh, _mm512_set1_pd(1.25));
    __m512d log2c = _mm512_maskz_mov_pd(nearLow, _mm512_set1_pd(-0x1.a8ff971810a5ep-2));
    log2c = _mm512_mask_mov_pd(log2c, nearHigh, _mm512_set1_pd(0x1.49a784bcd1b8bp-2));
    const __m512d s = _mm512_div_pd(_mm512_sub_pd(m, c), _mm512_add_pd(m, c)), s2 = _mm512_mul_pd(s, s);
    __m512d a = step(1.0 / 9, s2, _mm512_set1_pd(1.0 / 11));
    a = step(1.0 / 7, s2, a);
    a = step(1.0 / 5, s2, a);
    a = step(1.0 / 3, s2, a);
    a = _mm512_add_pd(s, _mm512_mul_pd(_mm512_mul_pd(s, s2), a));
    const __m512d log2x =
        _mm512_add_pd(exponent, _mm512_add_pd(log2c, _mm512_mul_pd(_mm512_set1_pd(0x1.71547652b82fep1), a)));

    // 2^p = 2^whole e^z.
    const __m512d p = _mm512_max_pd(_mm512_mul_pd(y, log2x), _mm512_set1_pd(-100.0));
    const __m512d whole =
        _mm512_roundscale_pd(_mm512_add_pd(p, half), _MM_FROUND_TO_NEG_INF | _MM_FROUND_NO_EXC);
    const __m512d z = _mm512_mul_pd(_mm512_sub_pd(p, whole), _mm512_set1_pd(0x1.62e42fefa39efp-1));
    __m512d e = step(1.0 / 3628800, z, _mm512_set1_pd(1.0 / 39916800));
    for (const double factorial : {362880.0, 40320.0, 5040.0, 720.0, 120.0, 24.0, 6.0, 2.0})
        e = step(1.0 / factorial, z, e);
    e = step(1.0, z, e);
    return _mm512_scalef_pd(step(1.0, z, e), whole);
}

__m512 power(__m512 x, __m512d y) {
    const __m256 low = _mm512_castps512_ps256(x), high = _mm512_extractf32x8_ps(x, 1);
    const __m256 lowPower = _mm512_cvtpd_ps(power(_mm512_cvtps_pd(low), y));
    const __m256 highPower = _mm512_cvtpd_ps(power(_mm512_cvtps_pd(high), y));
    return _mm512_insertf32x8(_mm512_castps256_ps512(lowPower), highPower, 1);
}

// sum + reflectance * (irradiance * weight), per channel.
void addReflected(Vector3& sum, const Vector3& reflectance, const Vector3& irradiance, __m512 weight) {
    sum.x = _mm512_add_ps(sum.x, _mm512_mul_ps(reflectance.x, _mm512_mul_ps(irradiance.x, weight)));
    sum.y = _mm512_add_ps(sum.y, _mm512_mul_ps(reflectance.y, _mm512_mul_ps(irradiance.y, weight)));
    sum.z = _mm512_add_ps(sum.z, _mm512_mul_ps(reflectance.z, _mm512_mul_ps(irradiance.z, weight)));
}

void shade(const ShadingInput& in) {
    const Vector3 diffuse = broadcast(in.diffuse), specular = broadcast(in.specular);
    const __m512 zero = _mm512_setzero_ps(), one = _mm512_set1_ps(1);
    const __m512 scale = _mm512_set1_ps(static_cast<float>(in.scale));
    const __m512 reciprocalPi = _mm512_set1_ps(0.3183098861837907f);
    const __m512 smallestLobe = _mm512_set1_ps(0x1p-60f);
    const __m512d exponent = _mm512_set1_pd(static_cast<double>(static_cast<float>(in.exponent)));
    for (size_t first = 0; first < in.count; first += 16) {
        const Vector3 n = load(in.normal, first), v = load(in.toEye, first);
        Vector3 diffuseSum{zero, zero, zero}, specularSum = diffuseSum;
        for (size_t i = 0; i < in.lights; i++) {
            const Vector3 l = broadcast(in.toLight, i), irradiance = broadcast(in.irradiance, i);
            const __m512 cosTheta = _mm512_max_ps(zero, dot(n, l));
            addReflected(diffuseSum, diffuse, irradiance, _mm512_mul_ps(cosTheta, reciprocalPi));

            const Vector3 h{_mm512_add_ps(l.x, v.x), _mm512_add_ps(l.y, v.y), _mm512_add_ps(l.z, v.z)};
            const __m512 square = dot(h, h);
            const __m512 s = _mm512_maskz_div_ps(_mm512_cmp_ps_mask(square, zero, _CMP_GT_OQ), one,
                                                 _mm512_sqrt_ps(square));
            const Vector3 unit{_mm512_mul_ps(h.x, s), _mm512_mul_ps(h.y, s), _mm512_mul_ps(h.z, s)};
            const __m512 cosHalf = _mm512_min_ps(one, _mm512_max_ps(zero, dot(n, unit)));
            const __m512 lobe = power(cosHalf, exponent);
            const __mmask16 counts = _mm512_cmp_ps_mask(lobe, smallestLobe, _CMP_GE_OQ);
            addReflected(specularSum, specular, irradiance,
                         _mm512_maskz_mul_ps(counts, lobe, _mm512_mul_ps(scale, cosTheta)));
        }
        _mm512_storeu_ps(in.radiance[0] + first, _mm512_add_ps(diffuseSum.x, specularSum.x));
        _mm512_storeu_ps(in.radiance[1] + first, _mm512_add_ps(diffuseSum.y, specularSum.y));
        _mm512_storeu_ps(in.radiance[2] + first, _mm512_add_ps(diffuseSum.z, specularSum.z));
    }
}

}  // namespace
}  // namespace etalon::bench

extern "C" __attribute__((visibility("default"))) void etalonShadeByHand(
    const etalon::bench::ShadingInput* input) {
    etalon::bench::shade(*input);
}
