// A texel of a probe that is converted, part by part. Specified in probes/convert.h.
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
// needs: probes/kernels/texel_parts_scope.glsl

// The mappings of result and source; where isTurned is not 0, the rows of the matrix from directions of the one to
// directions of the other.
struct TexelConversion {
    MappingSettings target;
    MappingSettings source;
    int isTurned;
    vec3 turnX;
    vec3 turnY;
    vec3 turnZ;
};
TexelConversion conversion;

// The direction of the middle of part (i, j) in the frame of the result: of lat-long images from sines and cosines of
// longitude and latitude, else from u and v.
vec3 partDirection(integer layer, int i, int j) {
    int mapping = conversion.target.mapping;
    if (mapping == 0 || mapping == 5) {
        vec3 d = latLongDirection(partColumn(i, 0), partColumn(i, 1), partRow(j, 0), partRow(j, 1));
        if (mapping == 0) return d;
        return listingAxes(d);
    }
    return mappingDirection(layer, partColumn(i, 0), partRow(j, 0), conversion.target);
}
// In proportion to the part's solid angle.
real partWeight(int i, int j) {
    int mapping = conversion.target.mapping;
    if (mapping == 0 || mapping == 5) return partRow(j, 1);
    if (mapping == 1) return partSolidAngle(i, j);
    return discWeight(partColumn(i, 0), partRow(j, 0), conversion.target);
}
MappingPoint partPoint(integer layer, int i, int j) {
    vec3 d = partDirection(layer, i, j);
    if (conversion.isTurned != 0) d = turned(d, conversion.turnX, conversion.turnY, conversion.turnZ);
    return mappingPoint(d, conversion.source);
}
// The mean over parts x parts equal parts, row by row.
ProbeMean meanOfParts(integer layer, int parts) {
    ProbeMean mean;
    mean.rgb = vec3(real(0.0), real(0.0), real(0.0));
    mean.weight = real(0.0);
    for (int j = 0; j < parts; j++)
        for (int i = 0; i < parts; i++)
            mean = addSample(mean, sourceSample(partPoint(layer, i, j)), partWeight(i, j));
    return mean;
}
