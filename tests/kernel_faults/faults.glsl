// One function for each fault that scripts/check_kernels must find; the CMakeLists.txt beside it lists the messages.
// needs: numeric/kernels/wide.glsl

real dividedLiterals(real x) { return x * (real(1.0) / real(2.4)); }
real literalOfNoType(real x) { return x * 0.5; }
real literalOfNoFloat(real x) { return x * real(134217729.0); }
real tableOfNoFloat(int i) { return table16(i, 1.0, 268435457.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0); }
real foldedRoot(real x) { return x * sqrt(real(2.0)); }
real tinyLiteral(real x) { return x + real(1e-40); }
real hugeLiteral(real x) { return x + real(1e39); }
wide literalReadAsDouble(wide x) { return x * wide(real(2.4)); }
wide wideLiteral(wide x) { return x * wide(0.1); }
wide foldedWideLiterals(wide x) { return x * (wide(1.0) / wide(2.4)); }
// This one is none: the quotient of two floats, rounded to double by every compiler.
wide third(wide x) { return x * (wide(1.0) / wide(3.0)); }

real fused(real x, real y) { return fma(x, y, x); }
real mixed(real x, real y) { return mix(x, y, real(0.5)); }
real dotOfVectors(vec3 a, vec3 b) { return dot(a, b); }
real power(real x, real y) { return pow(x, y); }
real exponential(real x) { return exp2(x); }
real sineOfHardware(real x) { return sin(x); }
real reciprocalRoot(real x) { return inversesqrt(x); }
real smaller(real x, real y) { return min(x, y); }
real remainder(real x, real y) { return mod(x, y); }
vec3 sumOfVectors(vec3 a, vec3 b) { return a + b; }
vec3 scaledVector(vec3 a, real s) { return a * s; }
vec2 swizzled(vec3 a) { return a.xy; }
