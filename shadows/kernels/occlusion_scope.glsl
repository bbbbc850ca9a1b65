// What shadows/kernels/occlusion.glsl reads of a drawn view, in GLSL. The C++ counterpart is OcclusionKernels in
// shadows/occlusion_kernels.h; the two say the same.

layout(set = 0, binding = 0) uniform sampler2D occlusionDepth;
layout(set = 0, binding = 1) uniform usampler2D occlusionTriangle;
layout(std430, set = 0, binding = 2) readonly buffer OcclusionWeights { real occlusionWeights[]; };

boolean isDrawn(integer column, integer row) {
    return texelFetch(occlusionTriangle, ivec2(column, row), 0).x != 0xffffffffu;
}
real drawnDepth(integer column, integer row) { return texelFetch(occlusionDepth, ivec2(column, row), 0).x; }
real texelWeight(int i) { return occlusionWeights[i]; }
