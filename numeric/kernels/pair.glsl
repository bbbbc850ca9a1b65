// Helpers of the elementary functions of float, over sums of two floats. Contract of those: numeric/elementary.h. The
// float it is written over is `real`: of a GPU, or float and its lanes in C++ (FloatTexts). No operation here is fused,
// and no intermediate that counts is subnormal.

// high + low, where high is the sum rounded.
struct RealPair {
    real high;
    real low;
};

// The 12 leading bits of the significand; the rest of a has 12, too, so that products of such parts are exact.
real leadingPart(real a) { return realFromBits(bitsOf(a) & integer(-4096)); }

// a + b, exactly, for |a| >= |b| or a = 0. [Dekker1971, Eq. 4.14]
RealPair sumOfOrdered(real a, real b) {
    RealPair r;
    r.high = a + b;
    r.low = b - (r.high - a);
    return r;
}

// a + b, exactly. [Knuth1998, sec. 4.2.2, Theorem B]
RealPair sumOf(real a, real b) {
    RealPair r;
    r.high = a + b;
    real partOfB = r.high - a;
    r.low = (a - (r.high - partOfB)) + (b - partOfB);
    return r;
}

// c - a b, exactly, for c within half a unit in the last place of a b. Each difference is exact.
real differenceOfProduct(real c, real a, real b) {
    real aHigh = leadingPart(a);
    real bHigh = leadingPart(b);
    real aLow = a - aHigh;
    real bLow = b - bHigh;
    return (((c - aHigh * bHigh) - aHigh * bLow) - aLow * bHigh) - aLow * bLow;
}

// a b, exactly.
RealPair productOf(real a, real b) {
    RealPair r;
    r.high = a * b;
    r.low = -differenceOfProduct(r.high, a, b);
    return r;
}
