// The irradiance of a plane, summed over the texels of a probe or over directional lights. Specified in
// probes/irradiance.h and probes/light_irradiance.h.
// needs: numeric/kernels/vector.glsl
// needs: probes/kernels/flux_scope.glsl
// needs: probes/kernels/flux.glsl

// The sum with what comes from one more unit direction, which gives `flux` to a plane that faces it
// [Pedersen2008, Eq. 5.13]. Both vectors have length 1.
vec3 addIrradiance(vec3 sum, vec3 normal, vec3 direction, vec3 flux) {
    real cosine = flooredTerm(dot3(normal, direction));
    return add3(sum, scale3(flux, select(cosine > real(0.0), cosine, real(0.0))));
}
