// What probes/kernels/harmonics.glsl reads and writes, in GLSL: constants and coefficients in buffers, values in
// an array of the invocation. The C++ counterpart is HarmonicsKernel in probes/spherical_harmonics.h.

layout(std430, set = 1, binding = 0) readonly buffer HarmonicConstants { real harmonicConstants[]; };
layout(std430, set = 1, binding = 1) readonly buffer HarmonicCoefficients { real harmonicCoefficients[]; };
real harmonicValues[121];
real harmonicRise(int i) { return harmonicConstants[2 * i]; }
real harmonicFall(int i) { return harmonicConstants[2 * i + 1]; }
vec3 harmonicCoefficient(int i) {
    return vec3(harmonicCoefficients[3 * i], harmonicCoefficients[3 * i + 1], harmonicCoefficients[3 * i + 2]);
}
real harmonicValue(int i) { return harmonicValues[i]; }
void setHarmonicValue(int i, real value) { harmonicValues[i] = value; }
