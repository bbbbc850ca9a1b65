// What probes/kernels/texel_parts.glsl reads, in GLSL: numbers of all columns' and then all rows' parts in a buffer, two
// each (sine and cosine, or u or v), made in double and rounded once; solid angles of the parts of a row of texels; the
// source. An invocation is a texel. The C++ counterpart is ConversionKernel in probes/laned_directions.h.
// needs: numeric/kernels/wide.glsl
// needs: numeric/kernels/pair.glsl
// needs: numeric/kernels/pair_atan2.glsl
// needs: numeric/kernels/pair_sine.glsl
// needs: raster/kernels/texture_unit.glsl
// needs: raster/kernels/tap_weights.glsl
// needs: raster/kernels/texture_scope.glsl
// needs: raster/kernels/sampler.glsl
// needs: raster/kernels/cube_face.glsl
// needs: probes/kernels/latlong.glsl
// needs: probes/kernels/mapping.glsl
// needs: probes/kernels/probe_sampler.glsl

layout(std430, set = 1, binding = 10) readonly buffer PartNumbers { real partNumbers[]; };
layout(std430, set = 1, binding = 11) readonly buffer PartSolidAngles { real partSolidAngles[]; };
layout(set = 1, binding = 12) uniform sampler2DArray sourceRadiance;
layout(set = 1, binding = 13) uniform sampler2DArray sourceShown;
ivec2 texelPlace;
int partsPerTexel;
int texelsPerRow;
ProbeSampling sourceSampling;
real partColumn(int i, int k) { return partNumbers[2 * (texelPlace.x * partsPerTexel + i) + k]; }
real partRow(int j, int k) { return partNumbers[2 * ((texelsPerRow + texelPlace.y) * partsPerTexel + j) + k]; }
real partSolidAngle(int i, int j) {
    return partSolidAngles[(j * texelsPerRow + texelPlace.x) * partsPerTexel + i];
}
ProbeSample sourceSample(MappingPoint p) { return sampleProbe(sourceRadiance, sourceShown, p, sourceSampling); }
