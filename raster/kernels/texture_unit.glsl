// What the texture unit and the writes of an NVIDIA H100 compute (rule 22), over `wide`. Every step is exact but the one
// rounding that a result's comment names. Specified in raster/texture_unit.h.

// The steps to 1 that a coordinate is cut to: 2^max(21, ceil(log2 size) + 8). size: 1 .. 32768.
wide coordinateSteps(int size) {
    int steps = 2097152;
    for (int covered = 8192; covered < size; covered = covered * 2) steps = steps * 2;
    return wide(steps);
}

// The coordinate cut to steps, folded by the wrap mode: 0 clamp to [0, steps], 1 repeat to [0, steps), 2 mirror to
// [0, 2 steps), whose second half is mirrored by the texel's index; 3 as it is. What is not a number there gives 0.
wide cutCoordinate(wide u, wide steps, int wrap) {
    wide t = floor(u * steps);
    if (wrap == 3) return t;
    wide most = steps;
    if (wrap == 2) most = steps + steps;
    if (wrap != 0) t = t - most * floor(t / most);
    t = select(t > wide(0.0), t, wide(0.0));
    return select(t < most, t, most);
}

// nearest: the index of the texel before it is wrapped.
wide unitNearest(wide u, int size, int wrap) {
    wide steps = coordinateSteps(size);
    return floor((cutCoordinate(u, steps, wrap) * wide(size)) / steps);
}
// linear: the index of the first of two texels before it is wrapped, and the fraction, a multiple of 1/256 below 1: the
// position from the centre of texel 0, half up to 1/256.
struct WideTexel {
    wide first;
    wide fraction;
};
WideTexel unitLinear(wide u, int size, int wrap) {
    wide steps = coordinateSteps(size);
    wide position = (cutCoordinate(u, steps, wrap) * wide(size)) / steps;
    wide p = floor(position * wide(256.0) + wide(0.5)) - wide(128.0);
    WideTexel t;
    t.first = floor(p * wide(0.00390625));
    t.fraction = p * wide(0.00390625) - t.first;
    return t;
}

wide magnitudeOf(wide a) { return select(a < wide(0.0), -a, a); }
// a without what is below a whole number.
wide truncated(wide a) { return select(a < wide(0.0), -floor(-a), floor(a)); }
boolean isFiniteNumber(wide a) { return a - a == wide(0.0); }

// Four texels and their weights in 1/256.
struct WeightedTexels {
    wide v00;
    wide v10;
    wide v01;
    wide v11;
    wide w00;
    wide w10;
    wide w01;
    wide w11;
};

// The exponent of a texel that has a weight and is a number; at least `least`.
wide weightedExponent(wide v, wide w, wide least) {
    wide e = exponentOf(magnitudeOf(select(isFiniteNumber(v), v, wide(0.0))));
    return select(w > wide(0.0) && e > least, e, least);
}
// A texel's part of the sum; a texel without a weight has none.
wide weightedPart(wide v, wide w, wide scale) {
    return select(w > wide(0.0) && isFiniteNumber(v), truncated(v * scale) * w, wide(0.0));
}
wide plainPart(wide v, wide w) { return select(w > wide(0.0), v * (w * wide(0.00390625)), wide(0.0)); }

// Texels of a float format of `bits` significand bits: each is cut toward zero to bits + 4 bits below the largest
// exponent of those with a weight, and the exact sum is rounded once to the format, ties away from zero. Where one with
// a weight is no finite number, the sum of the products in double.
wide sumOfFloats(WeightedTexels t, wide bits, wide leastExponent) {
    wide e = weightedExponent(t.v00, t.w00, leastExponent);
    e = weightedExponent(t.v10, t.w10, e);
    e = weightedExponent(t.v01, t.w01, e);
    e = weightedExponent(t.v11, t.w11, e);
    wide scale = powerOfTwo(bits + wide(3.0) - e);
    // In units of 1 / (256 scale).
    wide sum = (weightedPart(t.v00, t.w00, scale) + weightedPart(t.v10, t.w10, scale)) +
               (weightedPart(t.v01, t.w01, scale) + weightedPart(t.v11, t.w11, scale));
    wide magnitude = magnitudeOf(sum);
    // The exponent of the result, and with it the distance of neighbouring numbers of the format.
    wide own = exponentOf(magnitude) + e - bits - wide(11.0);
    own = select(own > leastExponent, own, leastExponent);
    wide rounded = floor(magnitude * powerOfTwo(e - own - wide(12.0)) + wide(0.5)) * powerOfTwo(own + wide(1.0) - bits);
    wide plain = (plainPart(t.v00, t.w00) + plainPart(t.v10, t.w10)) + (plainPart(t.v01, t.w01) + plainPart(t.v11, t.w11));
    return select(isFiniteNumber(plain), select(sum < wide(0.0), -rounded, rounded), plain);
}

// Texels of 8 or 16 bits, c / 255 or c / 65535 to within 2^-18: a sum of 16-bit codes, 257 c of 8 bits, rounded half up.
wide codeOf16(wide v) { return floor(v * wide(65535.0) + wide(0.5)); }
wide sumOfCodes(WeightedTexels t) {
    wide sum = (codeOf16(t.v00) * t.w00 + codeOf16(t.v10) * t.w10) + (codeOf16(t.v01) * t.w01 + codeOf16(t.v11) * t.w11);
    return floor((sum + wide(128.0)) * wide(0.00390625)) / wide(65535.0);
}

// texels: 0 float, 1 half, 2 of 16 bits, 3 of 8 bits.
wide unitSum(WeightedTexels t, int texels) {
    if (texels == 0) return sumOfFloats(t, wide(24.0), wide(-126.0));
    if (texels == 1) return sumOfFloats(t, wide(11.0), wide(-14.0));
    return sumOfCodes(t);
}

// The code that x is written as in a UNORM format of levels = 2^n - 1, or in D16: x cut to n + 4 bits, steps = 2^(n + 4),
// its exact product with the levels, to nearest, ties down. NaN is 0; of SNORM, magnitudes are written so.
wide unormCode(wide x, wide levels, wide steps) {
    wide inside = select(x > wide(0.0), select(x < wide(1.0), x, wide(1.0)), wide(0.0));
    wide product = (floor(inside * steps) / steps) * levels;
    return -floor(wide(0.5) - product);
}
// In D24, for x in [0, 1] of at most 24 bits: the exact product to nearest, ties to even; but up where x < 1/16 lies in the
// middle between two multiples of 2^-24.
wide depth24Code(wide x) {
    wide scaled = x * wide(16777216.0);
    wide product = scaled - x;
    wide k = floor(product);
    wide part = product - k;
    boolean isOdd = k - wide(2.0) * floor(k * wide(0.5)) > wide(0.0);
    boolean isMiddle = x < wide(0.0625) && scaled - floor(scaled) == wide(0.5);
    boolean isUp = part > wide(0.5) || (part == wide(0.5) && isOdd) || isMiddle;
    return select(isUp, k + wide(1.0), k);
}
// In fp16: toward zero, and numbers beyond the largest one become it.
wide halfWritten(wide x) {
    wide magnitude = magnitudeOf(x);
    wide e = exponentOf(select(isFiniteNumber(x), magnitude, wide(1.0)));
    e = select(e > wide(-14.0), e, wide(-14.0));
    wide cut = floor(magnitude * powerOfTwo(wide(10.0) - e)) * powerOfTwo(e - wide(10.0));
    cut = select(cut > wide(65504.0), wide(65504.0), cut);
    return select(isFiniteNumber(x), select(x < wide(0.0), -cut, cut), x);
}

// What is read of a texel that x was written to; texels as in unitSum.
wide writtenTexel(wide x, int texels) {
    if (texels == 0) return x;
    if (texels == 1) return halfWritten(x);
    if (texels == 2) return unormCode(x, wide(65535.0), wide(1048576.0)) / wide(65535.0);
    return unormCode(x, wide(255.0), wide(4096.0)) / wide(255.0);
}
