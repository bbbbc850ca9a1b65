// What probes/kernels/harmonics.glsl reads and writes, in GLSL: constants and coefficients in buffers, values in
// an array of the invocation. The C++ counterpart is HarmonicsKernel in probes/spherical_harmonics.h.

layout(std430, set = 1, binding = 0) readonly buffer HarmonicConstants { real harmonicConstants[]; };
layout(std430, set = 1, binding = 1) readonly buffer HarmonicCoefficients { real harmonicCoefficients[]; };
real harmonicValues[121];
// The halves of the inverse of the coefficients' scale.
vec2 coefficientUnscales;
real coefficientUnscale(int part) { return coefficientUnscales[part]; }
real harmonicRise(int i) { return harmonicConstants[2 * i]; }
real harmonicFall(int i) { return harmonicConstants[2 * i + 1]; }
vec3 harmonicCoefficient(int i) {
    return vec3(harmonicCoefficients[3 * i], harmonicCoefficients[3 * i + 1], harmonicCoefficients[3 * i + 2]);
}
real harmonicValue(int i) { return harmonicValues[i]; }
void setHarmonicValue(int i, real value) { harmonicValues[i] = value; }

// One row of texels, seven numbers each: direction, weight and radiance. An invocation is one of the partial sums.
layout(std430, set = 1, binding = 6) readonly buffer RowTexels { real rowTexels[]; };
real radianceScaleOfProbe;
vec3 projectedSums[121];
real radianceScale() { return radianceScaleOfProbe; }
vec3 rowVector(int i) { return vec3(rowTexels[i], rowTexels[i + 1], rowTexels[i + 2]); }
vec3 texelDirection(int x) { return rowVector(7 * x); }
real texelWeight(int x) { return rowTexels[7 * x + 3]; }
vec3 texelRadiance(int x) { return rowVector(7 * x + 4); }
vec3 projectedSum(int i) { return projectedSums[i]; }
void setProjectedSum(int i, vec3 sum) { projectedSums[i] = sum; }
