// What shadows/kernels/planar_composition.glsl reads, in GLSL: of each light its share of the irradiance, and the part
// of it that reaches the invocation's texel. The C++ counterpart is CompositionKernel in
// shadows/composition_kernel.h; the two say the same.

layout(std430, set = 0, binding = 0) readonly buffer LightShares { real lightShares[]; };
layout(std430, set = 0, binding = 1) readonly buffer LightVisibilities { real lightVisibilities[]; };
int compositionTexel;
int compositionTexels;
real lightShare(int light) { return lightShares[light]; }
real lightVisibility(int light) { return lightVisibilities[light * compositionTexels + compositionTexel]; }
