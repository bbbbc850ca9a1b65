// The texel of probes/kernels/cube_of_latlong.glsl that an invocation makes, in GLSL: coordinates of the middles of its
// equal parts, in [0, 1] to the right and downwards, from a buffer of all columns' and then all rows' parts, made in
// double and rounded once. The C++ counterpart is CubeOfLatLongKernel in probes/latlong.h.

layout(std430, set = 1, binding = 10) readonly buffer PartCoordinates { real partCoordinates[]; };
ivec2 partsTexel;
int partsPerAxis;
int partsColumns;
real partU(int i) { return partCoordinates[partsTexel.x * partsPerAxis + i]; }
real partV(int j) { return partCoordinates[(partsColumns + partsTexel.y) * partsPerAxis + j]; }
