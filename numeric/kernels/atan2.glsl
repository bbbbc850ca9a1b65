// needs: numeric/kernels/wide.glsl
// The angle of the vector (x, y), over `wide`. Contract, domains and error bound: atan2Of in
// numeric/elementary.h.

// atan2(y, x) for a result format whose smallest normal number is 2^lowest: smaller arguments and results are
// 0. `extended` is false where the result is rounded to float: relative error then below 2^-48.
// The smaller magnitude over the larger is t in [0, 1]. With c the one of 0, 1/2 and 1 that is near t,
//   atan(t) = atan(c) + atan(q),  q = (t - c) / (1 + c t),  |q| <= 1/4,
// and the octant says whether the angle is atan(t), pi/2 -+ atan(t) or pi - atan(t). The quotient and the
// constants are carried as sums of two numbers, and only the last addition rounds visibly.
wide atan2Wide(wide y, wide x, wide lowest, bool extended) {
    wide zero = wide(0.0);
    wide one = wide(1.0);
    wide smallest = powerOfTwo(lowest);
    wide infinity = wideFromBits(0x7FF00000u, 0x00000000u);
    boolean invalid = x != x || y != y;
    boolean left = x <= -smallest;
    boolean below = y <= -smallest;
    wide width = select(left, -x, x);
    wide height = select(below, -y, y);
    width = select(width < smallest, zero, width);
    height = select(height < smallest, zero, height);

    // The larger magnitude is brought to [1, 4), so that no product overflows or underflows.
    boolean steep = height > width;
    wide major = select(steep, height, width);
    wide minor = select(steep, width, height);
    boolean unbounded = major == infinity;
    minor = select(unbounded, select(minor == infinity, one, zero), minor);
    major = select(unbounded || major == zero, one, major);
    wide exponent = exponentOf(major);
    wide scale = powerOfTwo(-select(exponent > wide(1022.0), wide(1022.0), exponent));
    minor = select(exponentOf(minor) < exponent - wide(900.0), zero, minor);
    major = major * scale;
    minor = minor * scale;

    // q + qLow = (minor - c major) / (major + c minor); the numerator is exact, the denominator is d + dLow.
    boolean nearZero = wide(4.0) * minor < major;
    boolean nearOne = wide(4.0) * minor > wide(3.0) * major;
    wide c = select(nearZero, zero, select(nearOne, one, wide(0.5)));
    wide n = minor - c * major;
    wide d = major + c * minor;
    wide dLow = c * minor - (d - major);
    wide reciprocal = one / d;
    wide q = n * reciprocal;
    wide qLow = zero;
    if (extended) {
        wide qd = q * d;
        qLow = (((n - qd) - productError(q, d, qd)) - q * dLow) * reciprocal;
    }

    // atan(q) = q + q s: the Taylor series to q^27 or q^21, whose first term left out is below 2^-60 or 2^-48
    // of q.
    wide q2 = q * q;
    wide s = one / wide(21.0);
    if (extended) {
        s = one / wide(27.0);
        s = one / wide(25.0) - q2 * s;
        s = one / wide(23.0) - q2 * s;
        s = one / wide(21.0) - q2 * s;
    }
    s = one / wide(19.0) - q2 * s;
    s = one / wide(17.0) - q2 * s;
    s = one / wide(15.0) - q2 * s;
    s = one / wide(13.0) - q2 * s;
    s = one / wide(11.0) - q2 * s;
    s = one / wide(9.0) - q2 * s;
    s = one / wide(7.0) - q2 * s;
    s = one / wide(5.0) - q2 * s;
    s = one / wide(3.0) - q2 * s;
    s = -q2 * s;

    wide atanHalf = wideFromBits(0x3FDDAC67u, 0x0561BB4Fu);     // atan(1/2) = 0.463647609...
    wide atanHalfLow = wideFromBits(0x3C7A2B7Fu, 0x222F65E2u);  // ... and what its 53 bits leave out
    wide pi = wideFromBits(0x400921FBu, 0x54442D18u);           // pi
    wide piLow = wideFromBits(0x3CA1A626u, 0x33145C07u);
    wide base = select(nearZero, zero, select(nearOne, wide(0.25) * pi, atanHalf));
    wide baseLow = select(nearZero, zero, select(nearOne, wide(0.25) * piLow, atanHalfLow));
    wide turn = select(steep, wide(0.5) * pi, select(left, pi, zero));
    wide turnLow = select(steep, wide(0.5) * piLow, select(left, piLow, zero));
    wide direction = select(steep, select(left, one, -one), select(left, -one, one));

    // turn + direction (base + q), each sum with its rounding error, which joins the small terms.
    wide angle = base + q;
    wide angleLow = (q - (angle - base)) + (baseLow + (qLow + q * s));
    wide sum = turn + direction * angle;
    wide sumLow = (direction * angle - (sum - turn)) + (turnLow + direction * angleLow);
    wide result = sum + sumLow;
    result = select(result < smallest, zero, result);
    return select(invalid, wideFromBits(0x7FF80000u, 0x00000000u), select(below, -result, result));
}
