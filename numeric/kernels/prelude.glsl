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
// For the texts written over `wide` (numeric/elementary.h has the C++ counterparts). They are macros, or a function
// that no other shader calls and that its compiler leaves out, so that a shader without doubles stays one.
#define wide double
#define wideFromBits(high, low) packDouble2x32(uvec2(low, high))
#define exponentOf(a) double(int(unpackDouble2x32(a).y >> 20u) - 1023)
#define significandOf(a) \
    packDouble2x32(uvec2(unpackDouble2x32(a).x, (unpackDouble2x32(a).y & 0x000FFFFFu) | 0x3FF00000u))
#define powerOfTwo(k) packDouble2x32(uvec2(0u, uint(int(k) + 1023) << 20u))
// The double of a float. A function, because a compiler that folds double(float(2.4)) may give the double 2.4.
double widened(float a) { return double(a); }
// A text that calls one of these names numeric/kernels/wide.glsl and atan2.glsl, pow.glsl or sine.glsl in its
// "needs" lines.
#define atan2Of(y, x) float(atan2Wide(widened(y), widened(x), double(-126.0), false))
#define powOf(x, y) float(powWide(widened(x), widened(y), double(-126.0), false))
#define sinOf(angle_rad) float(sinWide(widened(angle_rad), double(-126.0)))
#define cosOf(angle_rad) float(cosWide(widened(angle_rad), double(-126.0)))
