// needs: numeric/kernels/wide.glsl
// Sine and cosine of an angle in radians, over `wide`. Contract, domain and error bound: sinOf and cosOf in
// numeric/elementary.h.

// |angle| = quadrant pi/2 + (high + low), |high| <= pi/4 and a little. [Cody1980, sec. 8.2]
// pi/2 is a sum of three parts of 33 bits, whose products with a whole number below 2^20 are exact, and a
// rest. No double is nearer to a multiple of pi/2 than 2^-62 but 0 [Muller2016, ch. 11]; the parts leave out
// less than 2^-157, times 2^20. Where the first differences cancel they are exact.
struct ReducedAngle {
    wide quadrant;  // 0, 1, 2 or 3
    wide high;
    wide low;
};

// a - b rounded and its rounding error, exactly. [Knuth1998, sec. 4.2.2, Theorem B]
struct WideDifference {
    wide value;
    wide error;
};
WideDifference wideDifference(wide a, wide b) {
    WideDifference d;
    d.value = a - b;
    wide minusB = d.value - a;
    d.error = (a - (d.value - minusB)) + (-b - minusB);
    return d;
}

ReducedAngle reduceAngle(wide magnitude) {
    wide halfPi1 = wideFromBits(0x3FF921FBu, 0x54400000u);     // 0x1.921fb544p+0
    wide halfPi2 = wideFromBits(0x3DD0B461u, 0x1A600000u);     // 0x1.0b4611a6p-34
    wide halfPi3 = wideFromBits(0x3BA3198Au, 0x2E000000u);     // 0x1.3198a2ep-69
    wide halfPi4 = wideFromBits(0x397B839Au, 0x252049C1u);     // 0x1.b839a252049c1p-104
    wide twoOverPi = wideFromBits(0x3FE45F30u, 0x6DC9C883u);   // 2 / pi
    wide n = floor(magnitude * twoOverPi + wide(0.5));
    WideDifference first = wideDifference(magnitude - n * halfPi1, n * halfPi2);
    WideDifference second = wideDifference(first.value, n * halfPi3);
    wide rest = (first.error + second.error) - n * halfPi4;
    ReducedAngle a;
    a.high = second.value + rest;
    a.low = (second.value - a.high) + rest;
    a.quadrant = n - wide(4.0) * floor(n * wide(0.25));
    return a;
}

// Taylor series of the sine of a sum, |sum| <= pi/4 and a little: the first term left out is below 2^-63.
wide sineOfSum(wide high, wide low) {
    wide x2 = high * high;
    wide s = wide(1.0) / (wide(57120.0) * wide(6227020800.0));       // 1 / 17!
    s = wide(1.0) / (wide(210.0) * wide(6227020800.0)) - x2 * s;     // 1 / 15!
    s = wide(1.0) / wide(6227020800.0) - x2 * s;                     // 1 / 13!
    s = wide(1.0) / wide(39916800.0) - x2 * s;                       // 1 / 11!
    s = wide(1.0) / wide(362880.0) - x2 * s;                         // 1 / 9!
    s = wide(1.0) / wide(5040.0) - x2 * s;                           // 1 / 7!
    s = wide(1.0) / wide(120.0) - x2 * s;                            // 1 / 5!
    s = wide(1.0) / wide(6.0) - x2 * s;                              // 1 / 3!
    return high + (low * (wide(1.0) - wide(0.5) * x2) - (high * x2) * s);
}

// The same for the cosine: the first term left out is below 2^-67.
wide cosineOfSum(wide high, wide low) {
    wide x2 = high * high;
    wide x2Low = productError(high, high, x2);
    wide s = wide(1.0) / (wide(1028160.0) * wide(6227020800.0));     // 1 / 18!
    s = wide(1.0) / (wide(3360.0) * wide(6227020800.0)) - x2 * s;    // 1 / 16!
    s = wide(1.0) / (wide(14.0) * wide(6227020800.0)) - x2 * s;      // 1 / 14!
    s = wide(1.0) / wide(479001600.0) - x2 * s;                      // 1 / 12!
    s = wide(1.0) / wide(3628800.0) - x2 * s;                        // 1 / 10!
    s = wide(1.0) / wide(40320.0) - x2 * s;                          // 1 / 8!
    s = wide(1.0) / wide(720.0) - x2 * s;                            // 1 / 6!
    s = wide(1.0) / wide(24.0) - x2 * s;                             // 1 / 4!
    wide near = wide(1.0) - wide(0.5) * x2;
    wide nearLow = (wide(1.0) - near) - wide(0.5) * x2;
    return near + (nearLow + ((x2 * x2) * s - (wide(0.5) * x2Low + high * low)));
}

// NaN beyond 2^20; 0 where the result is below the smallest normal number 2^lowest.
wide sinWide(wide angle, wide lowest) {
    boolean isNegative = angle < wide(0.0);
    wide magnitude = select(isNegative, -angle, angle);
    boolean isInside = magnitude <= wide(1048576.0);
    ReducedAngle a = reduceAngle(select(isInside, magnitude, wide(0.0)));
    boolean isOdd = a.quadrant == wide(1.0) || a.quadrant == wide(3.0);
    wide s = select(isOdd, cosineOfSum(a.high, a.low), sineOfSum(a.high, a.low));
    s = select(a.quadrant < wide(2.0), s, -s);
    s = select(isNegative, -s, s);
    wide smallest = powerOfTwo(lowest);
    s = select(s < smallest && s > -smallest, wide(0.0), s);
    return select(isInside, s, wideFromBits(0x7FF80000u, 0x00000000u));
}
wide cosWide(wide angle, wide lowest) {
    wide magnitude = select(angle < wide(0.0), -angle, angle);
    boolean isInside = magnitude <= wide(1048576.0);
    ReducedAngle a = reduceAngle(select(isInside, magnitude, wide(0.0)));
    boolean isOdd = a.quadrant == wide(1.0) || a.quadrant == wide(3.0);
    wide c = select(isOdd, sineOfSum(a.high, a.low), cosineOfSum(a.high, a.low));
    c = select(a.quadrant == wide(0.0) || a.quadrant == wide(3.0), c, -c);
    wide smallest = powerOfTwo(lowest);
    c = select(c < smallest && c > -smallest, wide(0.0), c);
    return select(isInside, c, wideFromBits(0x7FF80000u, 0x00000000u));
}
