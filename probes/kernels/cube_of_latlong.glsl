// Texels of a cube map that shows a lat-long image. Specified in probes/latlong.h.
// needs: numeric/kernels/vector.glsl
// needs: numeric/kernels/wide.glsl
// needs: numeric/kernels/pair.glsl
// needs: numeric/kernels/pair_atan2.glsl
// needs: raster/kernels/texture_unit.glsl
// needs: raster/kernels/tap_weights.glsl
// needs: raster/kernels/texture_scope.glsl
// needs: raster/kernels/sampler.glsl
// needs: raster/kernels/cube_face.glsl
// needs: probes/kernels/latlong.glsl
// needs: probes/kernels/cube_of_latlong_scope.glsl

// The mean over the parts x parts equal parts of a texel of a face, row by row; share is 1 / parts^2.
vec3 cubeTexelOfLatLong(texture env, int face, int parts, real share, Sampling s) {
    integer ofFace = integer(face);
    vec3 sum = sampleLatLong(env, cubeDirection(ofFace, partU(0), partV(0)), s);
    if (parts == 1) return sum;
    for (int part = 1; part < parts * parts; part++)
        sum = add3(sum, sampleLatLong(env, cubeDirection(ofFace, partU(part % parts), partV(part / parts)), s));
    return scale3(sum, share);
}
