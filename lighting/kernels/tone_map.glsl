// From radiance to display bytes. Specified in lighting/tone_map.h.
// needs: numeric/kernels/pair.glsl
// needs: numeric/kernels/pair_pow.glsl

// The sRGB transfer function [IEC61966-2-1]: linear [0, 1] to encoded [0, 1], and back.
real encodeSrgb(real x) {
    real perGamma = real(0.4166666666666667);  // 1 / 2.4
    real curve = real(1.055) * powOf(maxOf(x, real(0.0031308)), perGamma) - real(0.055);
    return select(x <= real(0.0031308), real(12.92) * x, curve);
}
real decodeSrgb(real x) {
    real curve = powOf((maxOf(x, real(0.04045)) + real(0.055)) / real(1.055), real(2.4));
    return select(x <= real(0.04045), x / real(12.92), curve);
}

// x / (1 + x) per channel, for x >= 0; 1 where 1 + x is x.
real reinhard(real x) {
    real more = real(1.0) + x;
    return select(more > x, x / more, real(1.0));
}

// The fit of [Narkowicz2015], for x >= 0. It passes 1 at x = 7.24, so limiting x to 8 changes no
// result below 1.
real filmic(real x) {
    real y = minOf(x, real(8.0));
    return (y * (real(2.51) * y + real(0.03))) / (y * (real(2.43) * y + real(0.59)) + real(0.14));
}

// Linear display value in [0, 1]: exposed, then mapped by operation 0 linear, 1 Reinhard, 2 filmic. NaN and
// negative radiance give 0.
real displayLinear(real radiance, real exposure, int operation) {
    real x = radiance * exposure;
    x = select(x > real(0.0), x, real(0.0));
    real mapped = x;
    if (operation == 1) mapped = reinhard(x);
    if (operation == 2) mapped = filmic(x);
    return minOf(mapped, real(1.0));
}

// 0 .. 255, rounded half up.
integer displayByte(real radiance, real exposure, int operation) {
    real encoded = encodeSrgb(displayLinear(radiance, exposure, operation));
    return toInteger(clampOf(floor(encoded * real(255.0) + real(0.5)), real(0.0), real(255.0)));
}
