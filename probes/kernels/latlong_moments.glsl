// Spherical harmonics of a lat-long image by the azimuthal moments of its rows: the sums over a row of radiance times 1,
// cos, sin, cos 2, sin 2, ... of the longitude. Specified in probes/spherical_harmonics.h.
// needs: numeric/kernels/vector.glsl
// needs: probes/kernels/flux_scope.glsl
// needs: probes/kernels/flux.glsl
// needs: probes/kernels/harmonics_scope.glsl
// needs: probes/kernels/harmonics.glsl
// needs: probes/kernels/latlong_moments_scope.glsl

// Sets the functions 0 .. 2 degree of a column's longitude. direction: of its texel on the equator.
void findLongitudes(vec3 direction, int degree) {
    real cosine = real(1.0);
    real sine = real(0.0);
    setLongitudeValue(0, real(1.0));
    for (int m = 1; m <= degree; m++) {
        real turned = cosine * direction.z - sine * direction.x;
        sine = cosine * direction.x + sine * direction.z;
        cosine = turned;
        setLongitudeValue(2 * m - 1, cosine);
        setLongitudeValue(2 * m, sine);
    }
}

// The moments of up to three functions, those from `function` on; others are 0.
struct Moments {
    vec3 ofFirst;
    vec3 ofSecond;
    vec3 ofThird;
};
// The sums over every `parts`-th column of a row, from `first` on, in order from 0.
Moments momentsOf(int function, int functions, int first, int end, int parts) {
    Moments sum;
    sum.ofFirst = vec3(real(0.0), real(0.0), real(0.0));
    sum.ofSecond = sum.ofFirst;
    sum.ofThird = sum.ofFirst;
    for (int x = first; x < end; x += parts) {
        vec3 radiance = texelRadiance(x);
        sum.ofFirst = add3(sum.ofFirst, scale3(radiance, longitudeValue(function, x)));
        if (functions > 1) sum.ofSecond = add3(sum.ofSecond, scale3(radiance, longitudeValue(function + 1, x)));
        if (functions > 2) sum.ofThird = add3(sum.ofThird, scale3(radiance, longitudeValue(function + 2, x)));
    }
    return sum;
}

// Sets projectedSum(i) to what a row gives coefficient i: its moment times the harmonic's function of latitude and the
// solid angle of a texel. direction: of longitude 0 at the row's latitude, where the harmonics of m >= 0 are those
// functions; its axes are x, y, z of the formulas.
void projectMoments(vec3 direction, real solidAngle, int degree) {
    findHarmonics(direction, degree);
    for (int l = 0; l <= degree; l++)
        for (int m = -l; m <= l; m++) {
            int order = m < 0 ? -m : m;
            real weight = harmonicValue(l * l + l + order) * solidAngle;
            vec3 moment = azimuthalMoment(m > 0 ? 2 * m - 1 : 2 * order);
            setProjectedSum(l * l + l + m, scale3(moment, weight));
        }
}
