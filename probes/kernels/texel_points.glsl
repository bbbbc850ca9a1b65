// Where the source of a conversion shows the middle of a texel of the result. Specified in probes/convert.h.
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
// needs: probes/kernels/texel_points_scope.glsl

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

// The direction of the middle of the texel in the frame of the result: of lat-long images from sines and cosines of
// longitude and latitude, else from u and v.
vec3 texelDirection(integer layer) {
    int mapping = conversion.target.mapping;
    if (mapping == 0 || mapping == 5) {
        vec3 d = latLongDirection(texelColumn(0), texelColumn(1), texelRow(0), texelRow(1));
        if (mapping == 0) return d;
        return listingAxes(d);
    }
    return mappingDirection(layer, texelColumn(0), texelRow(0), conversion.target);
}
MappingPoint texelPoint(integer layer) {
    vec3 d = texelDirection(layer);
    if (conversion.isTurned != 0) d = turned(d, conversion.turnX, conversion.turnY, conversion.turnZ);
    return mappingPoint(d, conversion.source);
}
