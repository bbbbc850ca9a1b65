// What probes/kernels/texel_overlaps.glsl reads, in GLSL: for each texel of the result where its overlaps begin, and for each
// overlap layer, column and row of the source's texel and its weight (probes/texel_overlaps.h), made in double and rounded
// once. The C++ counterpart is ConversionKernel in probes/laned_directions.h.
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

struct OverlapRecord {
    integer layer;
    integer x;
    integer y;
    real weight;
};
layout(std430, set = 1, binding = 11) readonly buffer Overlaps { OverlapRecord overlapRecords[]; };
int firstOverlap;
CubeTexel overlapTexel(int k) {
    return cubeTexel(overlapRecords[firstOverlap + k].layer, overlapRecords[firstOverlap + k].x,
                     overlapRecords[firstOverlap + k].y);
}
real overlapWeight(int k) { return overlapRecords[firstOverlap + k].weight; }
