// The names a kernel text may use, in GLSL. Its C++ counterpart is numeric/kernel_scope.inc; the two say the
// same. A shader that includes a kernel text declares every result `precise` or decorates it NoContraction.
#define real float
#define integer int
#define boolean bool
#define select(c, a, b) ((c) ? (a) : (b))
#define selectInteger(c, a, b) ((c) ? (a) : (b))
#define toInteger(a) int(a)
#define toReal(a) float(a)
#define lessInteger(a, b) ((a) < (b))
#define equalInteger(a, b) ((a) == (b))
integer clampInteger(integer x, integer lo, integer hi) {
    integer atLeast = selectInteger(lessInteger(x, lo), lo, x);
    return selectInteger(lessInteger(hi, atLeast), hi, atLeast);
}
real minOf(real a, real b) { return select(b < a, b, a); }
real maxOf(real a, real b) { return select(a < b, b, a); }
real clampOf(real x, real lo, real hi) { return minOf(hi, maxOf(lo, x)); }
real absOf(real a) { return select(a < real(0.0), -a, a); }
#define isAny(c) (c)
// The upper 32 bits of the product of two of them.
uint upperProduct(uint a, uint b) {
    uint upper;
    uint lower;
    umulExtended(a, b, upper, lower);
    return upper;
}
// For the texts written over `wide` (numeric/elementary.h has the C++ counterparts). They are macros, so that a shader
// without doubles stays one.
#define wide double
#define wideFromBits(high, low) packDouble2x32(uvec2(low, high))
#define exponentOf(a) double(int(unpackDouble2x32(a).y >> 20u) - 1023)
#define significandOf(a) \
    packDouble2x32(uvec2(unpackDouble2x32(a).x, (unpackDouble2x32(a).y & 0x000FFFFFu) | 0x3FF00000u))
#define powerOfTwo(k) packDouble2x32(uvec2(0u, uint(int(k) + 1023) << 20u))
// The double of a float. A function, because a compiler that folds double(float(2.4)) may give the double 2.4; it is left out
// of a shader that does not call it.
double widened(float a) { return double(a); }
// For the texts over pairs of floats (FloatTexts in numeric/elementary.h).
#define bitsOf(a) floatBitsToInt(a)
#define realFromBits(bits) intBitsToFloat(bits)
// The entry of a list of 16 or 32 numbers at an index.
#define table16(index, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p) \
    float[16](a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p)[index]
#define table32(index, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, \
                a2, b2, c2, d2, e2, f2, g2, h2, i2, j2, k2, l2, m2, n2, o2, p2) \
    float[32](a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, \
              a2, b2, c2, d2, e2, f2, g2, h2, i2, j2, k2, l2, m2, n2, o2, p2)[index]
// A text that calls one of these names numeric/kernels/pair.glsl and pair_atan2.glsl, pair_pow.glsl or pair_sine.glsl in
// its "needs" lines.
#define atan2Of(y, x) pairAtan2(y, x)
#define powOf(x, y) pairPower(x, y)
#define sinOf(angle_rad) pairSine(angle_rad)
#define cosOf(angle_rad) pairCosine(angle_rad)
