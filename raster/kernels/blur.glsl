// One pixel of one pass of the separable blur. Specified in raster/blur.h.
// needs: raster/kernels/texture_unit.glsl
// needs: raster/kernels/tap_weights.glsl
// needs: raster/kernels/texture_scope.glsl
// needs: raster/kernels/blur_scope.glsl

// Outermost pair of taps first, the centre last; a mirrored image gives the mirrored bits.
real blurPixelAlong(int radius) {
    if (radius == 0) return blurWeight(0) * blurTap(0);
    real sum = blurWeight(radius) * (blurTap(-radius) + blurTap(radius));
    for (int k = radius - 1; k > 0; k--) sum = sum + blurWeight(k) * (blurTap(-k) + blurTap(k));
    return sum + blurWeight(0) * blurTap(0);
}
