// Real spherical harmonics and sums of them. Specified in probes/spherical_harmonics.h.
// needs: numeric/kernels/vector.glsl
// needs: probes/kernels/flux_scope.glsl
// needs: probes/kernels/flux.glsl
// needs: probes/kernels/harmonics_scope.glsl

// Sets harmonic values 0 .. (degree + 1)^2 - 1 at the unit direction d.
void findHarmonics(vec3 direction, int degree) {
    vec3 d = flooredTerm3(direction);
    // The real and imaginary parts of (x + i y)^m, the sine of the polar angle included.
    real cosine = real(1.0);
    real sine = real(0.0);
    for (int m = 0; m <= degree; m++) {
        // Legendre functions without that sine, and with the constants of the harmonics, from degree m upwards.
        real previous = real(0.0);
        real legendre = harmonicRise(m * m + 2 * m);
        for (int l = m; l <= degree; l++) {
            int i = l * l + l;
            if (l > m) {
                real next = harmonicRise(i + m) * (d.z * legendre) - harmonicFall(i + m) * previous;
                previous = legendre;
                legendre = next;
            }
            if (m > 0) setHarmonicValue(i - m, flooredTerm(legendre * sine));
            setHarmonicValue(i + m, flooredTerm(legendre * cosine));
        }
        real turned = flooredTerm(d.x * cosine - d.y * sine);
        sine = flooredTerm(d.x * sine + d.y * cosine);
        cosine = turned;
    }
}

// The function whose coefficients are harmonicCoefficient(0 .. (degree + 1)^2 - 1), scaled, at the unit direction d.
// Terms are added in the order of their indices.
vec3 sumOfHarmonics(vec3 d, int degree) {
    findHarmonics(d, degree);
    vec3 sum = scale3(harmonicCoefficient(0), harmonicValue(0));
    int count = (degree + 1) * (degree + 1);
    for (int i = 1; i < count; i++) sum = add3(sum, scale3(harmonicCoefficient(i), harmonicValue(i)));
    return scale3(scale3(sum, coefficientUnscale(0)), coefficientUnscale(1));
}

// Sets projectedSum(i) to the sum of flux times harmonic i over every `parts`-th texel of a row, from `first` on, in
// order from 0.
void projectTexels(int first, int end, int parts, int degree) {
    int count = (degree + 1) * (degree + 1);
    for (int i = 0; i < count; i++) setProjectedSum(i, vec3(real(0.0), real(0.0), real(0.0)));
    for (int x = first; x < end; x += parts) {
        vec3 flux = texelFlux(texelRadiance(x), radianceScale(), texelWeight(x));
        findHarmonics(texelDirection(x), degree);
        for (int i = 0; i < count; i++)
            setProjectedSum(i, add3(projectedSum(i), scale3(flux, harmonicValue(i))));
    }
}
