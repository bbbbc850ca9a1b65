// needs: numeric/kernels/pair.glsl
// Sine and cosine of an angle in radians, over sums of two floats. Contract, domain and error bound: sinOf and cosOf in
// numeric/elementary.h.
//   |angle| = quadrant pi/2 + r,  |r| = c + t,  c the nearest multiple of 1/16,  |t| <= 1/32
// and series of the sine and the cosine of t, whose products with the leading parts of those of c are exact.

// sin(k / 16) and cos(k / 16), k from 0 to 13: the 12 leading bits, rounded to nearest, and the rest.
real sineHigh(integer k) {
    return table16(k, 0.0, 0.062454224, 0.12466431, 0.18640137, 0.24737549, 0.30749512, 0.366333, 0.42370605, 0.47937012,
                   0.5332031, 0.5852051, 0.6345215, 0.6816406, 0.7260742, 0.0, 0.0);
}
real sineLow(integer k) {
    return table16(k, 0.0, 5.0942094e-6, 1.0426745e-5, 1.9295749e-6, 2.8470973e-5, -5.6602606e-5, -6.0478727e-5,
                   -2.9797484e-5, 5.5421417e-5, 9.954854e-5, -0.00010780519, 8.559564e-5, -1.8649766e-6, -6.556349e-5,
                   0.0, 0.0);
}
real cosineHigh(integer k) {
    return table16(k, 1.0, 0.9980469, 0.9921875, 0.9824219, 0.96899414, 0.95166016, 0.9304199, 0.9057617, 0.87768555,
                   0.84594727, 0.81103516, 0.7729492, 0.73168945, 0.68774414, 0.0, 0.0);
}
real cosineLow(integer k) {
    return table16(k, 0.0, 6.357001e-7, 1.0167229e-5, 5.1438103e-5, -8.1718914e-5, -9.22082e-5, 8.7700035e-5,
                   5.1964675e-5, -0.00010298499, -2.2766393e-5, -7.2036746e-5, -0.000114272596, -5.8425115e-7,
                   -5.8578404e-5, 0.0, 0.0);
}

// An angle as a quadrant and the rest, |rest.high| <= pi/4 and a little. pi/2 is a sum of four floats, whose products with
// the number of quadrants, which is below 2^20, are carried exactly but for the last. No float below 2^20 is nearer to a
// multiple of pi/2 than 2^-43 of itself, but 0 (found by trying all).
struct ReducedReal {
    integer quadrant;  // 0, 1, 2 or 3
    RealPair rest;
};
ReducedReal pairReducedAngle(real magnitude) {
    real n = floor(magnitude * real(0.63661975) + real(0.5));
    RealPair first = productOf(n, real(1.5707964));
    RealPair second = productOf(n, real(-4.371139e-8));
    RealPair third = productOf(n, real(-1.7151245e-15));
    RealPair a = sumOf(magnitude - first.high, -first.low);
    RealPair b = sumOf(a.high, -second.high);
    RealPair c = sumOf(b.high, a.low);
    real low = (c.low + b.low) - ((second.low + third.high) + (third.low + n * real(1.0562999e-23)));
    ReducedReal r;
    r.rest = sumOf(c.high, low);
    r.quadrant = toInteger(n) & integer(3);
    return r;
}

// a cos(t) + b sin(t) for |t| <= 1/32, a = aHigh + aLow and b alike, whose high parts have 12 bits; |a| >= |t| or a = 0.
real turnedSum(real aHigh, real aLow, real bHigh, real bLow, RealPair t) {
    real leading = leadingPart(t.high);
    RealPair sum = sumOfOrdered(aHigh, bHigh * leading);
    real t2 = t.high * t.high;
    real even = (aHigh + aLow) * (t2 * (real(-0.5) + t2 * real(0.041666668)));
    real odd = (bHigh + bLow) * ((t.high * t2) * (real(-0.16666667) + t2 * real(0.008333334)));
    real small = bHigh * ((t.high - leading) + t.low) + bLow * t.high;
    return sum.high + (sum.low + ((aLow + small) + (even + odd)));
}

// Sine and cosine of r, |r.high| <= pi/4 and a little.
struct SinePair {
    real sine;
    real cosine;
};
SinePair pairSines(RealPair r) {
    boolean isNegative = r.high < real(0.0);
    real high = select(isNegative, -r.high, r.high);
    real low = select(isNegative, -r.low, r.low);
    // A little less than 1/2: where k is 1, high is not below 1/32, and so has no finer bits than what is left of it.
    integer k = toInteger(high * real(16.0) + real(0.4999999));
    RealPair t = sumOfOrdered(high - toReal(k) * real(0.0625), low);
    real sHigh = sineHigh(k);
    real sLow = sineLow(k);
    real cHigh = cosineHigh(k);
    real cLow = cosineLow(k);
    SinePair result;
    real s = turnedSum(sHigh, sLow, cHigh, cLow, t);
    result.sine = select(isNegative, -s, s);
    result.cosine = turnedSum(cHigh, cLow, -sHigh, -sLow, t);
    return result;
}

// NaN beyond 2^20; 0 where the angle is below 2^-126. Below 2^-15 the sine is the angle but for 2^-32 of it.
real pairSine(real angle) {
    real magnitude = absOf(angle);
    boolean isInside = magnitude <= real(1048576.0);
    boolean isSmall = magnitude < real(3.0517578125e-5);
    ReducedReal a = pairReducedAngle(select(isInside && !isSmall, magnitude, real(1.0)));
    SinePair r = pairSines(a.rest);
    boolean isOdd = equalInteger(a.quadrant & integer(1), integer(1));
    real s = select(isOdd, r.cosine, r.sine);
    s = select(lessInteger(integer(1), a.quadrant), -s, s);
    s = select(isSmall, magnitude, s);
    s = select(angle < real(0.0), -s, s);
    s = select(magnitude < realFromBits(integer(8388608)), real(0.0), s);
    return select(isInside, s, realFromBits(integer(2143289344)));
}
real pairCosine(real angle) {
    real magnitude = absOf(angle);
    boolean isInside = magnitude <= real(1048576.0);
    boolean isSmall = magnitude < real(3.0517578125e-5);
    ReducedReal a = pairReducedAngle(select(isInside && !isSmall, magnitude, real(1.0)));
    SinePair r = pairSines(a.rest);
    boolean isOdd = equalInteger(a.quadrant & integer(1), integer(1));
    real c = select(isOdd, r.sine, r.cosine);
    boolean isTurned = equalInteger(a.quadrant, integer(1)) || equalInteger(a.quadrant, integer(2));
    c = select(isTurned, -c, c);
    c = select(isSmall, real(1.0), c);
    return select(isInside, c, realFromBits(integer(2143289344)));
}
