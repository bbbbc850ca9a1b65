// Multisample resolve.
// needs: raster/kernels/sample_scope.glsl

// The mean of samples 0 .. count - 1, added in the order of their index.
real resolvedSamples(SampleBuffer samples, int count, real reciprocalCount) {
    real sum = sampleAt(samples, 0);
    for (int s = 1; s < count; s++) sum = sum + sampleAt(samples, s);
    return sum * reciprocalCount;
}
