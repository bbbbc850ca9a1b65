// Texels of a cube map that shows a lat-long image. Specified in probes/latlong.h.
// needs: numeric/kernels/vector.glsl
// needs: numeric/kernels/wide.glsl
// needs: numeric/kernels/atan2.glsl
// needs: raster/kernels/texture_scope.glsl
// needs: raster/kernels/sampler.glsl
// needs: raster/kernels/cube_face.glsl
// needs: probes/kernels/latlong.glsl
// needs: probes/kernels/cube_of_latlong_scope.glsl

// The mean over the parts x parts equal parts of a texel of a face, row by row; share is 1 / parts^2.
vec3 cubeTexelOfLatLong(texture env, int face, int parts, real share, Sampling s) {
    vec3 sum = vec3(real(0.0), real(0.0), real(0.0));
    for (int j = 0; j < parts; j++)
        for (int i = 0; i < parts; i++) {
            vec3 value = sampleLatLong(env, cubeDirection(integer(face), partU(i), partV(j)), s);
            if (i + j == 0)
                sum = value;
            else
                sum = add3(sum, value);
        }
    if (parts == 1) return sum;
    return scale3(sum, share);
}
