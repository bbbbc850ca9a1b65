// Energies of the texels of a lat-long image, and their sums over a region. Specified in probes/energy_passes.h.
// needs: numeric/kernels/vector.glsl
// needs: probes/kernels/energy_scope.glsl

// Of a texel's counted radiance in a row of this weight [Pedersen2008, Eq. 5.8].
real texelEnergy(vec3 rgb, real rowWeight) {
    return rowWeight * (real(0.2125) * rgb.x + (real(0.7154) * rgb.y + real(0.0721) * rgb.z));
}

// One of `parts` partial sums over a region's texels: of every `parts`-th column from the one where countedRadiance
// begins. Each row is summed from the left, the rows from above.
vec3 regionSum(int columns, int rows, int parts) {
    vec3 sum = vec3(real(0.0), real(0.0), real(0.0));
    for (int y = 0; y < rows; y++) {
        vec3 row = vec3(real(0.0), real(0.0), real(0.0));
        for (int x = 0; x < columns; x += parts) row = add3(row, countedRadiance(x, y));
        sum = add3(sum, scale3(row, regionWeight(y)));
    }
    return sum;
}
