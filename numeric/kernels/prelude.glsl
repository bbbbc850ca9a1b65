// The names a kernel text may use, in GLSL. Its C++ counterpart is numeric/kernel_scope.inc; the two say the
// same. A shader that includes a kernel text declares every result `precise` or decorates it NoContraction.
#define real float
#define integer int
#define boolean bool
#define select(c, a, b) ((c) ? (a) : (b))
#define selectInteger(c, a, b) ((c) ? (a) : (b))
#define toInteger(a) int(a)
#define toReal(a) float(a)
real minOf(real a, real b) { return b < a ? b : a; }
real maxOf(real a, real b) { return a < b ? b : a; }
real clampOf(real x, real lo, real hi) { return minOf(hi, maxOf(lo, x)); }
real absOf(real a) { return a < 0.0 ? -a : a; }
