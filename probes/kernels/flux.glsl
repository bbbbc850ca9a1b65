// What a texel of a probe adds to sums over directions. Specified in probes/flux.h.
// needs: probes/kernels/flux_scope.glsl

vec3 flooredTerm3(vec3 a) { return vec3(flooredTerm(a.x), flooredTerm(a.y), flooredTerm(a.z)); }
// Inside the finite numbers; NaN stays.
real finiteTerm(real a) {
    return select(a > largestReal(), largestReal(), select(a < -largestReal(), -largestReal(), a));
}
// Radiance times the weight of its texel. radianceScale: a power of two.
real scaledFlux(real radiance, real radianceScale, real weight) {
    return flooredTerm(finiteTerm(radiance) * radianceScale * weight);
}
vec3 texelFlux(vec3 radiance, real radianceScale, real weight) {
    return vec3(scaledFlux(radiance.x, radianceScale, weight), scaledFlux(radiance.y, radianceScale, weight),
                scaledFlux(radiance.z, radianceScale, weight));
}
