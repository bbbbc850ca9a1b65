// needs: numeric/kernels/pair.glsl
// The angle of the vector (x, y) of floats, over sums of two floats. Contract, domains and error bound: atan2Of in
// numeric/elementary.h.
// The smaller magnitude over the larger is t in [0, 1]. With c the multiple of 1/8 that is nearest to t,
//   atan(t) = atan(c) + atan(q),  q = (t - c) / (1 + c t),  |q| <= 1/16,
// and the octant says whether the angle is atan(t), pi/2 -+ atan(t) or pi - atan(t). What carries the result is a sum of
// two floats; the series of atan(q) moves it by less than 1/100 of a unit in the last place.

// atan(k / 8) for k from 0 to 8, and what the float leaves out.
real arcTangentHigh(integer k) {
    return table16(k, 0.0, 0.124354996, 0.24497867, 0.35877067, 0.4636476, 0.5585993, 0.6435011, 0.71883, 0.7853982, 0.0,
                   0.0, 0.0, 0.0, 0.0, 0.0, 0.0);
}
real arcTangentLow(integer k) {
    return table16(k, 0.0, -1.2403822e-9, -3.1786778e-9, 1.7639499e-9, 5.0121587e-9, 2.2111598e-8, 5.8689373e-9,
                   1.01883355e-8, -2.1855694e-8, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0);
}

real pairAtan2(real y, real x) {
    real zero = real(0.0);
    real one = real(1.0);
    real smallest = realFromBits(integer(8388608));
    real infinity = realFromBits(integer(2139095040));
    boolean invalid = x != x || y != y;
    boolean left = x <= -smallest;
    boolean below = y <= -smallest;
    real width = select(left, -x, x);
    real height = select(below, -y, y);
    width = select(width < smallest, zero, width);
    height = select(height < smallest, zero, height);

    // The larger magnitude is brought to [2, 4): nothing overflows, and what is a quotient below 2^-126 becomes 0.
    boolean steep = height > width;
    real major = select(steep, height, width);
    real minor = select(steep, width, height);
    boolean unbounded = major == infinity;
    minor = select(unbounded, select(minor == infinity, one, zero), minor);
    minor = select(invalid, zero, minor);
    major = select(invalid || unbounded || major == zero, one, major);
    real scale = realFromBits(integer(2139095040) - (bitsOf(major) & integer(2139095040)));  // 2^(1 - its exponent)
    major = major * scale;
    minor = minor * scale;
    minor = select(minor < smallest, zero, minor);

    // n = minor - c major exactly, d = major + c minor: c has 3 bits, the parts that it is multiplied by 12.
    integer k = toInteger(real(8.0) * (minor / major) + real(0.5));
    real c = real(0.125) * toReal(k);
    real majorHigh = leadingPart(major);
    real minorHigh = leadingPart(minor);
    real n = (minor - c * majorHigh) - c * (major - majorHigh);
    RealPair d = sumOfOrdered(major, c * minorHigh);
    d = sumOfOrdered(d.high, d.low + c * (minor - minorHigh));
    real q = n / d.high;
    real qLow = (differenceOfProduct(n, q, d.high) - q * d.low) / d.high;
    // A quotient that is rounded once is near enough where the angle is one; its rest would be subnormal.
    real isSmall = real(9.0949470e-13);  // 2^-40
    boolean isTiny = q < isSmall && q > -isSmall;
    qLow = select(isTiny, zero, qLow);
    real q2 = select(isTiny, zero, q * q);
    real cubic = -(q * q2) * (real(0.33333334) - q2 * (real(0.2) - q2 * real(0.14285715)));

    // turn + direction (atan(c) + atan(q)), each sum with its rounding error, which joins the small terms.
    RealPair angle = sumOfOrdered(arcTangentHigh(k), q);
    real angleLow = angle.low + (arcTangentLow(k) + (qLow + cubic));
    real turn = select(steep, real(1.5707964), select(left, real(3.1415927), zero));
    real turnLow = select(steep, real(-4.371139e-8), select(left, real(-8.742278e-8), zero));
    boolean isBackward = (steep && !left) || (left && !steep);
    RealPair sum = sumOfOrdered(turn, select(isBackward, -angle.high, angle.high));
    real result = sum.high + (sum.low + (turnLow + select(isBackward, -angleLow, angleLow)));
    result = select(result < smallest, zero, result);
    return select(invalid, realFromBits(integer(2143289344)), select(below, -result, result));
}
