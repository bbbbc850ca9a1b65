// What probes/kernels/mip.glsl reads, in GLSL: the finer level through textures, the solid angles of the parts of one
// texel in a buffer, row by row. The C++ counterpart is MipKernel in probes/mip_pyramid.cpp.

layout(std430, set = 1, binding = 7) readonly buffer PartWeights { real partWeights_sr[]; };
layout(set = 1, binding = 8) uniform sampler2DArray mipRadiance;
layout(set = 1, binding = 9) uniform sampler2DArray mipValid;
int mipLayer;
int mipColumns;
ivec2 mipFirst;
real partWeight_sr(int column, int row) { return partWeights_sr[row * mipColumns + column]; }
boolean partIsValid(int column, int row) {
    return texelFetch(mipValid, ivec3(mipFirst + ivec2(column, row), mipLayer), 0).x != real(0.0);
}
vec3 partRadiance(int column, int row) {
    return texelFetch(mipRadiance, ivec3(mipFirst + ivec2(column, row), mipLayer), 0).xyz;
}
