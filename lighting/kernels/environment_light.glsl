// Diffuse light of the environment: the irradiance of a plane.
// needs: numeric/kernels/vector.glsl
// needs: raster/kernels/texture_unit.glsl
// needs: raster/kernels/tap_weights.glsl
// needs: raster/kernels/texture_scope.glsl
// needs: raster/kernels/sampler.glsl
// needs: raster/kernels/cube_face.glsl
// needs: probes/kernels/flux_scope.glsl
// needs: probes/kernels/flux.glsl
// needs: probes/kernels/irradiance.glsl
// needs: probes/kernels/irradiance_scope.glsl
// needs: probes/kernels/irradiance_sums.glsl
// needs: probes/kernels/harmonics_scope.glsl
// needs: probes/kernels/harmonics.glsl
// needs: lighting/kernels/environment_scope.glsl

// From the spherical harmonics of a probe, whose sum may fall below what light can be: that counts as 0.
vec3 irradianceOfHarmonics(vec3 n, int degree) {
    vec3 e = sumOfHarmonics(n, degree);
    return vec3(maxOf(real(0.0), e.x), maxOf(real(0.0), e.y), maxOf(real(0.0), e.z));
}
// n: unit normal. 0: there is no such light, 1: harmonics, 2: texels, each of them a source, 3: a cube map of irradiance.
vec3 environmentIrradiance(vec3 n) {
    int kind = environmentKind();
    if (kind == 1) return irradianceOfHarmonics(n, environmentDegree());
    if (kind == 2)
        return scale3(scale3(irradianceOfRuns(n, texelRunCount(), texelRunLength()), texelUnscale(0)), texelUnscale(1));
    if (kind == 3) return mapAlong(n);
    return vec3(real(0.0), real(0.0), real(0.0));
}
