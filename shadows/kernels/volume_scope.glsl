// What shadows/kernels/volume_mask.glsl reads of the samples of an invocation's pixel, in GLSL. The C++ counterpart is
// VolumeMaskKernel in shadows/volume_shadows.cpp; the two say the same.

layout(set = 0, binding = 0) uniform usampler2DMS volumeLit;
layout(set = 0, binding = 1) uniform usampler2DMS volumeInstance;
ivec2 volumePixel;
uint pointInstance;
boolean isLitSample(int s) { return texelFetch(volumeLit, volumePixel, s).x != 0u; }
boolean isOwnSample(int s) { return texelFetch(volumeInstance, volumePixel, s).x == pointInstance; }
