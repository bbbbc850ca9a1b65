// The samples of a pixel for kernel texts, in GLSL. The C++ counterpart is raster/sample_scope.inc; the two say the
// same.
struct SampleBuffer {
    int first;
    int stride;
};
layout(std430, set = 4, binding = 0) readonly buffer Samples { real sampleValues[]; };
real sampleAt(SampleBuffer samples, int s) { return sampleValues[samples.first + s * samples.stride]; }
