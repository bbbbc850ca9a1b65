// Shadow textures of planes: from counts to shadows, and several lights' shadows together. Specified in
// shadows/planar_shadow.h and planar_visibility.h.
// needs: shadows/kernels/composition_scope.glsl

// The part of a light's samples that is blocked.
real blockedPart(real blocked, real samples) { return blocked / samples; }
// A blurred shadow: rounding may leave it above 1.
real limitedShadow(real blurred) { return minOf(blurred, real(1.0)); }

// What remains of the lights' irradiance at a texel. What is taken away is added up, so that exactly 1 remains where
// that is nothing; 1 if there is no irradiance.
real remainingLight(int lights) {
    real total = real(0.0);
    real taken = real(0.0);
    for (int i = 0; i < lights; i++) {
        total = total + lightShare(i);
        taken = taken + lightShare(i) * (real(1.0) - lightVisibility(i));
    }
    boolean isLit = total > real(0.0);
    return select(isLit, real(1.0) - taken / select(isLit, total, real(1.0)), real(1.0));
}
