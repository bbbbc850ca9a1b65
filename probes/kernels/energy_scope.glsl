// What probes/kernels/energy.glsl reads, in GLSL: a layer of an image and the weights of its rows. An invocation is one
// of the partial sums. The C++ counterpart is EnergyKernel in probes/energy_lanes.h.

layout(std430, set = 1, binding = 2) readonly buffer RegionWeights { real regionWeights[]; };
layout(set = 1, binding = 3) uniform sampler2DArray energyImage;
// The first texel of the region and behind its last one; the first column of this partial sum.
ivec2 regionFirst;
ivec2 regionEnd;
int regionPart;
real countedValue(real a) { return select(a >= real(0.0) && a <= real(3.4028234663852886e38), a, real(0.0)); }
vec3 countedRadiance(int x, int y) {
    ivec2 at = regionFirst + ivec2(regionPart + x, y);
    if (at.x >= regionEnd.x) return vec3(real(0.0), real(0.0), real(0.0));
    vec3 rgb = texelFetch(energyImage, ivec3(at, 0), 0).xyz;
    return vec3(countedValue(rgb.x), countedValue(rgb.y), countedValue(rgb.z));
}
real regionWeight(int y) { return regionWeights[regionFirst.y + y]; }
