// needs: numeric/kernels/pair.glsl
// Powers of floats, over sums of two floats. Contract, domains and error bound: powOf in numeric/elementary.h.
//   x = 2^e m, m near c, the centre of one of 32 intervals:  ln x = e ln 2 + ln c + 2 atanh(s),  s = (m - c) / (m + c)
//   w = y ln x = k ln(2)/16 + r,  x^y = 2^whole 2^(j/16) e^r,  k = 16 whole + j
// The logarithm is within 1.1 2^-38 of itself, which for |w| <= 88.8 moves the power by 1/200 of a unit in the last place;
// what follows moves it by less.

// ln c for the 32 centres, and what the float leaves out.
real logarithmHigh(integer i) {
    return table32(i, -0.3522206, -0.33024168, -0.3087355, -0.2876821, -0.26706278, -0.24686007, -0.22705746,
                   -0.20763937, -0.18859117, -0.16989903, -0.1515499, -0.13353139, -0.115831815, -0.09844007,
                   -0.08134564, -0.06453852, -0.04800922, -0.031748697, -0.015748357, 0.0, 0.030771658, 0.06062462,
                   0.089612156, 0.11778303, 0.14518201, 0.17185026, 0.19782574, 0.22314355, 0.24783616, 0.2719337,
                   0.29546422, 0.31845373);
}
real logarithmLow(integer i) {
    return table32(i, 1.293613e-9, -6.725313e-9, 8.195663e-9, 1.37775436e-8, -2.0077733e-9, -5.91481e-9, 6.3348686e-9,
                   1.6100764e-9, -2.476808e-9, -5.2755076e-9, 7.411358e-9, -1.0038866e-9, -8.187962e-10,
                   6.1728567e-10, 6.6893807e-10, 2.4172309e-9, 1.3243606e-9, -1.1529058e-9, 4.3215895e-10, 0.0,
                   8.422374e-10, 7.905942e-12, 2.536962e-9, 3.2986907e-9, -3.66716e-9, -7.145759e-9, -1.4181957e-9,
                   3.5408485e-9, 6.2250236e-9, 1.0869003e-8, -4.7689754e-9, 1.9658553e-9);
}
// 2^(j / 16): the 12 leading bits, rounded to nearest, and the rest.
real rootOfTwoHigh(integer j) {
    return table16(j, 1.0, 1.0444336, 1.090332, 1.1386719, 1.1889648, 1.2416992, 1.296875, 1.3544922, 1.4140625,
                   1.4770508, 1.5419922, 1.6103516, 1.6816406, 1.7563477, 1.8339844, 1.9150391);
}
real rootOfTwoLow(integer j) {
    return table16(j, 0.0, -0.00015981132, 0.00017570141, 0.00011675976, 0.00024227126, 0.00015859332, -3.5445348e-5,
                   -0.00023664057, 0.00015106237, -0.00022463531, 0.00021863791, 0.00013876945, 0.00015220551,
                   -9.5495874e-5, 2.3711409e-5, 0.0001674989);
}

// ln x for a positive, finite, normal x. The low part is below 2^-15 of the whole.
RealPair pairLogarithm(real x) {
    // The first interval begins at m = 0.6953125; the centres have 6 bits.
    integer start = integer(1060241408);
    integer fromStart = bitsOf(x) - start;
    integer fraction = fromStart & integer(8388607);
    integer i = fraction >> 18;
    real e = toReal(fromStart >> 23);
    real m = realFromBits(fraction + start);
    real c = realFromBits((fraction + (start + integer(131072))) & integer(-262144));

    // s + what is left of it; n and d + dLow are exact. Of atanh, whose slope is 1 / (1 - s^2), the next term is below
    // 2^-42 of the logarithm.
    real n = m - c;
    real d = m + c;
    real dLow = (c - d) + m;
    real reciprocal = real(1.0) / d;
    real s = n * reciprocal;
    real s2 = s * s;
    real rest = differenceOfProduct(n, s, d) - s * dLow;
    real atanhLow = (rest + rest) * (reciprocal + reciprocal * s2);
    real cubic = (s * s2) * (real(0.6666667) + s2 * real(0.4));

    // The product with the leading part of ln 2 is exact.
    RealPair base = sumOfOrdered(e * real(0.69314575), logarithmHigh(i));
    real baseLow = base.low + (e * real(1.4286068e-6) + logarithmLow(i));
    RealPair sum = sumOfOrdered(base.high, s + s);
    sum.low = ((sum.low + baseLow) + cubic) + atanhLow;
    return sum;
}

// y a. Finite but for products beyond the range, which are infinite or NaN.
RealPair pairMultiple(real y, RealPair a) {
    RealPair r = productOf(y, a.high);
    r.low = r.low + y * a.low;
    return r;
}

// significand 2^exponent with a significand in [0.978, 1.957].
struct ScaledReal {
    real significand;
    integer exponent;
};

// e^w for |w.high| <= 89 and |w.low| <= 2^-9, rounded once but for about 1/500 of a unit in the last place.
ScaledReal pairExponential(RealPair w) {
    // ln(2)/16 in three parts. Products of k with the first two are exact, and so are the differences: all are multiples of
    // the last place of w.high or of 2^-28, and below 2^-5 in the end.
    real k = floor(w.high * real(23.08312) + real(0.5));
    real rest = (w.high - k * real(0.043319702)) - k * real(1.9967556e-6);
    RealPair r = sumOfOrdered(rest, w.low + k * real(1.1904089e-10));

    // e^r = 1 + r.high + q; 2^(j / 16) = t + tLow.
    integer index = toInteger(k);
    integer j = index & integer(15);
    real t = rootOfTwoHigh(j);
    real tLow = rootOfTwoLow(j);
    real r2 = r.high * r.high;
    real q = (r.low + real(0.5) * r2) + (r2 * r.high) * (real(0.16666667) + r.high * real(0.041666668));
    real leading = leadingPart(r.high);
    RealPair sum = sumOfOrdered(t, t * leading);
    real small = t * ((r.high - leading) + q) + (tLow + tLow * (r.high + q));
    ScaledReal result;
    result.significand = sum.high + (sum.low + small);
    result.exponent = index >> 4;
    return result;
}

// The same below 2^-126 or beyond the range: 0 or infinity. Exponents from -127 to 128.
real joinedReal(ScaledReal a) {
    // 2^128 is no float, but a little less than it is.
    boolean isLast = equalInteger(a.exponent, integer(128));
    integer exponent = a.exponent + selectInteger(isLast, integer(-1), integer(0));
    real r = select(isLast, a.significand + a.significand, a.significand) *
             realFromBits((exponent + integer(127)) << 23);
    return select(r < realFromBits(integer(8388608)), real(0.0), r);
}

// The bits of pairPower for 0 <= x <= 1 and 2^-126 <= y <= 2^70: there nothing is invalid, infinite or beyond the range.
real pairPowerOfFraction(real x, real y) {
    boolean isZero = x < realFromBits(integer(8388608));
    RealPair w = pairMultiple(y, pairLogarithm(x));  // of no meaning, but finite, for 0
    // e^-87.6 is below 2^-126.
    boolean isNothing = isZero || w.high < real(-87.6);
    w.high = select(isNothing, real(-87.6), w.high);
    w.low = select(isNothing, real(0.0), w.low);
    ScaledReal power = pairExponential(w);
    real r = power.significand * realFromBits((power.exponent + integer(127)) << 23);
    return select(r < realFromBits(integer(8388608)), real(0.0), r);
}

// x^y.
real pairPower(real x, real y) {
    real zero = real(0.0);
    real one = real(1.0);
    real infinity = realFromBits(integer(2139095040));
    real smallest = realFromBits(integer(8388608));
    boolean invalid = x != x || y != y || x <= -smallest;
    boolean isZero = x < smallest;
    boolean isInfinite = x == infinity;
    boolean rises = y >= smallest;
    boolean falls = y <= -smallest;

    RealPair w = pairMultiple(y, pairLogarithm(select(invalid || isZero || isInfinite, one, x)));
    // e^88.8 is beyond the range, e^-87.6 below it; infinity times the logarithm of 1 is NaN.
    boolean isHigh = w.high > real(88.8);
    boolean isLow = w.high < real(-87.6);
    boolean isInside = w.high >= real(-87.6) && w.high <= real(88.8);
    w.high = select(isInside, w.high, select(isHigh, real(88.8), select(isLow, real(-87.6), zero)));
    w.low = select(isInside, w.low, zero);
    real result = joinedReal(pairExponential(w));

    // Powers of zero and of infinity.
    real ofZero = select(rises, zero, select(falls, infinity, one));
    real ofInfinity = select(rises, infinity, select(falls, zero, one));
    result = select(isZero, ofZero, select(isInfinite, ofInfinity, result));
    return select(invalid, realFromBits(integer(2143289344)), result);
}
