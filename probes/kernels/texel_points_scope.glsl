// What probes/kernels/texel_points.glsl reads, in GLSL: two numbers of each column and then of each row in a buffer (sine and
// cosine, or u or v), made in double and rounded once. An invocation is a texel. The C++ counterpart is ConversionKernel in
// probes/laned_directions.h.

layout(std430, set = 1, binding = 10) readonly buffer TexelNumbers { real texelNumbers[]; };
ivec2 texelPlace;
int texelsPerRow;
real texelColumn(int k) { return texelNumbers[2 * texelPlace.x + k]; }
real texelRow(int k) { return texelNumbers[2 * (texelsPerRow + texelPlace.y) + k]; }
