// The irradiance of a plane, summed over the texels of a probe. Specified in probes/irradiance.h.
// needs: numeric/kernels/vector.glsl
// needs: probes/kernels/flux_scope.glsl
// needs: probes/kernels/flux.glsl

vec3 addIrradiance(vec3 sum, vec3 normal, vec3 direction, vec3 flux) {
    real cosine = flooredTerm(dot3(normal, direction));
    return add3(sum, scale3(flux, select(cosine > real(0.0), cosine, real(0.0))));
}
