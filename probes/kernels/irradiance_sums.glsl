// Sums of irradiance over directional sources: the texels of a probe, or lights. Specified in probes/irradiance.h and
// probes/light_irradiance.h.
// needs: numeric/kernels/vector.glsl
// needs: probes/kernels/flux_scope.glsl
// needs: probes/kernels/flux.glsl
// needs: probes/kernels/irradiance.glsl
// needs: probes/kernels/irradiance_scope.glsl

// From sources [first, last), added in their order from 0.
vec3 irradianceOfSources(vec3 normal, int first, int last) {
    vec3 sum = vec3(real(0.0), real(0.0), real(0.0));
    for (int i = first; i < last; i++) sum = addIrradiance(sum, normal, sourceDirection(i), sourceFlux(i));
    return sum;
}

// Sets pendingSum(plane, 0) of planes 0 .. planes - 1 to the irradiance from `runs` runs of `length` sources each, at
// least one. The sums of runs are added in pairs of neighbours, again and again, an odd last one kept as it is: the sums
// of 2^k runs wait, the longest first, for the bits k that are set in the number of runs so far.
void irradianceOfPlanes(int planes, int runs, int length) {
    int waiting = 0;
    for (int run = 0; run < runs; run++) {
        int full = 0;
        for (int carry = run; carry % 2 == 1; carry = carry / 2) full++;
        for (int plane = 0; plane < planes; plane++) {
            vec3 sum = irradianceOfSources(planeNormal(plane), run * length, run * length + length);
            for (int i = 1; i <= full; i++) sum = add3(pendingSum(plane, waiting - i), sum);
            setPendingSum(plane, waiting - full, sum);
        }
        waiting = waiting - full + 1;
    }
    for (int plane = 0; plane < planes; plane++) {
        vec3 sum = pendingSum(plane, waiting - 1);
        for (int i = waiting - 2; i >= 0; i--) sum = add3(pendingSum(plane, i), sum);
        setPendingSum(plane, 0, sum);
    }
}

// The irradiance of one plane from `runs` runs of `length` sources each, at least one.
vec3 irradianceOfRuns(vec3 normal, int runs, int length) {
    setPlaneNormal(normal);
    irradianceOfPlanes(1, runs, length);
    return pendingSum(0, 0);
}
