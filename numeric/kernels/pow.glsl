// needs: numeric/kernels/wide.glsl
// Powers over `wide`. Contract, domains and error bound: powOf in numeric/elementary.h.

// significand * 2^exponent, with a significand near [sqrt(1/2), sqrt(2)] and a whole exponent.
struct ScaledNumber {
    wide significand;
    wide exponent;
};

// x = 2^exponent significand, the significand in [sqrt(1/2), sqrt(2)].
ScaledNumber splitNumber(wide x) {
    ScaledNumber r;
    wide significand = significandOf(x);
    boolean high = significand > wideFromBits(0x3FF6A09Eu, 0x667F3BCDu);  // sqrt(2)
    r.significand = select(high, wide(0.5) * significand, significand);
    r.exponent = exponentOf(x) + select(high, wide(1.0), wide(0.0));
    return r;
}

// The number itself. Below 2^lowest it is 0, before it could become subnormal; beyond the range it is
// infinity. 2^1024 is beyond the range, but a number just below it is not: half of it is scaled by 2^1023.
wide joinNumber(ScaledNumber a, wide lowest) {
    boolean tooLow = a.exponent < lowest || (a.exponent == lowest && a.significand < wide(1.0));
    boolean tooHigh = a.exponent > wide(1024.0);
    boolean last = a.exponent == wide(1024.0);
    wide exponent = select(tooLow || tooHigh, wide(0.0), select(last, wide(1023.0), a.exponent));
    wide r = select(last, wide(2.0) * a.significand, a.significand) * powerOfTwo(exponent);
    return select(tooHigh, wideFromBits(0x7FF00000u, 0x00000000u), select(tooLow, wide(0.0), r));
}

// log2(x) for a positive, finite, normal x in plain doubles: relative error below 2^-47; exact where it is a whole
// number.
//   log2 x = e + log2 c + 2/ln(2) atanh(s),  s = (m - c) / (m + c),
// with c the one of 3/4, 1 and 5/4 that is near m, so that |s| <= 0.073.
wide log2OfNumber(wide x) {
    ScaledNumber split = splitNumber(x);
    wide m = split.significand;
    boolean nearLow = m < wide(0.8671875);   // between 3/4 and 1
    boolean nearHigh = m > wide(1.1171875);  // between 1 and 5/4
    wide c = select(nearLow, wide(0.75), select(nearHigh, wide(1.25), wide(1.0)));
    wide log2c = select(nearLow, wideFromBits(0xBFDA8FF9u, 0x71810A5Eu),  // log2(3/4)
                        select(nearHigh, wideFromBits(0x3FD49A78u, 0x4BCD1B8Bu), wide(0.0)));  // log2(5/4)
    wide s = (m - c) / (m + c);

    // atanh(s) = s + s^3/3 + ...: the first term left out is below 2^-48 of the sum.
    wide s2 = s * s;
    wide a = wide(1.0) / wide(11.0);
    a = wide(1.0) / wide(9.0) + s2 * a;
    a = wide(1.0) / wide(7.0) + s2 * a;
    a = wide(1.0) / wide(5.0) + s2 * a;
    a = wide(1.0) / wide(3.0) + s2 * a;
    a = s + (s * s2) * a;
    return split.exponent + (log2c + wideFromBits(0x40071547u, 0x652B82FEu) * a);  // 2 / ln 2
}

// 2^p for |p| <= 1100 in plain doubles, 2^whole e^z with whole the nearest integer: relative error below 2^-45; exact
// where p is a whole number.
ScaledNumber exp2OfNumber(wide p) {
    wide whole = floor(p + wide(0.5));
    wide z = (p - whole) * wideFromBits(0x3FE62E42u, 0xFEFA39EFu);  // ln 2
    ScaledNumber r;
    r.significand = wide(1.0) + z * exponentialSeries11(z);  // the first term left out is below 2^-46
    r.exponent = whole;
    return r;
}

// log2(x) for a result that is rounded to a format: x = 0 or |x| >= 2^-1022. Minus infinity for either zero, NaN for x
// < 0 and NaN, infinity for infinity.
wide log2Wide(wide x) {
    wide infinity = wideFromBits(0x7FF00000u, 0x00000000u);
    boolean hasNumber = x > wide(0.0) && x < infinity;
    wide result = log2OfNumber(select(hasNumber, x, wide(1.0)));
    result = select(x == wide(0.0), -infinity, select(x == infinity, infinity, result));
    return select(x >= wide(0.0), result, wideFromBits(0x7FF80000u, 0x00000000u));
}

// 2^p for a result that is rounded to a format with exponents inside +-1000: finite p are cut off there. Infinity for
// infinity, 0 for minus infinity, NaN for NaN.
wide exp2Wide(wide p) {
    wide infinity = wideFromBits(0x7FF00000u, 0x00000000u);
    wide bound = wide(1000.0);
    wide bounded = select(p < bound, select(p > -bound, p, -bound), bound);
    wide result = joinNumber(exp2OfNumber(bounded), wide(-1022.0));
    result = select(p == infinity, infinity, select(p == -infinity, wide(0.0), result));
    return select(p == p, result, wideFromBits(0x7FF80000u, 0x00000000u));
}

// x^y = 2^(y log2 x) in plain doubles for a positive, finite, normal x and |y| <= 2^70, for results that are rounded to
// float: with |y log2 x| <= 150 the relative error is below 2^-43. y log2(x) is cut off at +-1100.
ScaledNumber scaledPower(wide x, wide y) {
    wide p = y * log2OfNumber(x);
    p = select(p > wide(1100.0), wide(1100.0), select(p < wide(-1100.0), wide(-1100.0), p));
    return exp2OfNumber(p);
}

// The same with log2 x and the product carried as sums of two numbers: relative error about 2^-55 before
// the last rounding. The scheme, splitting the leading terms so that their products are exact, is that of
// [FDLIBM, e_pow.c]; the intervals and series are our own.
ScaledNumber scaledPowerExtended(wide x, wide y) {
    wide one = wide(1.0);
    wide zero = wide(0.0);
    ScaledNumber split = splitNumber(x);
    wide m = split.significand;
    wide e = split.exponent;
    boolean nearLow = m < wide(0.8671875);   // between 3/4 and 1
    boolean nearHigh = m > wide(1.1171875);  // between 1 and 5/4
    wide c = select(nearLow, wide(0.75), select(nearHigh, wide(1.25), one));

    // s + sLow = (m - c) / (m + c), with a leading part of 26 bits; the numerator is exact, the denominator d
    // + dLow.
    wide n = m - c;
    wide d = m + c;
    wide dLow = m - (d - c);
    wide reciprocal = one / d;
    wide s = n * reciprocal;
    wide sd = s * d;
    wide sHigh = highPart(s);
    wide sLow = (s - sHigh) + (((n - sd) - productError(s, d, sd)) - s * dLow) * reciprocal;

    // ln(m / c) = 2 atanh(s) = 2/3 s (3 + s^2 + r), r = 3/5 s^4 + 3/7 s^6 + ...: |s| <= 0.073, and the first
    // term left out is below 2^-70 of the whole. a + aLow = s (3 + s^2 + r).
    wide s2 = s * s;
    wide r = wide(3.0) / wide(17.0);
    r = wide(3.0) / wide(15.0) + s2 * r;
    r = wide(3.0) / wide(13.0) + s2 * r;
    r = wide(3.0) / wide(11.0) + s2 * r;
    r = wide(3.0) / wide(9.0) + s2 * r;
    r = wide(3.0) / wide(7.0) + s2 * r;
    r = wide(3.0) / wide(5.0) + s2 * r;
    r = (s2 * s2) * r + sLow * (sHigh + s);
    wide s2High = sHigh * sHigh;
    wide t = highPart((wide(3.0) + s2High) + r);
    wide tLow = r - ((t - wide(3.0)) - s2High);
    wide u = sHigh * t;
    wide v = sLow * t + tLow * s;
    wide a = highPart(u + v);
    wide aLow = v - (a - u);

    // log2(x) = l + lLow = e + log2(c) + 2/(3 ln 2) (a + aLow), with 26 bits in l.
    wide k = wideFromBits(0x3FEEC709u, 0xE0000000u);     // 2 / (3 ln 2), 26 bits
    wide kLow = wideFromBits(0xBE3E2FE0u, 0x145B01F5u);  // ... and the rest
    wide log2c = select(nearLow, wideFromBits(0xBFDA8FF9u, 0x70000000u),  // log2(3/4), 26 bits
                        select(nearHigh, wideFromBits(0x3FD49A78u, 0x48000000u), zero));  // log2(5/4)
    wide log2cLow = select(nearLow, wideFromBits(0xBE1810A5u, 0xE1817FD4u),
                           select(nearHigh, wideFromBits(0x3E2E68DCu, 0x57F24960u), zero));
    wide b = k * a;
    wide bLow = kLow * a + ((k + kLow) * aLow + log2cLow);
    wide l = highPart(((b + bLow) + log2c) + e);
    wide lLow = bLow - (((l - e) - log2c) - b);

    // p + pLow = y log2(x).
    wide yHigh = highPart(y);
    wide p = yHigh * l;
    wide pLow = (y - yHigh) * l + y * lLow;
    boolean beyond = p > wide(1100.0) || p < wide(-1100.0);
    p = select(beyond, select(p > zero, wide(1100.0), wide(-1100.0)), p);
    pLow = select(beyond, zero, pLow);

    // 2^(p + pLow) = 2^whole e^(z + zLow), whole the nearest integer.
    wide whole = floor((p + pLow) + wide(0.5));
    wide fraction = p - whole;
    wide f = highPart(fraction + pLow);
    wide fLow = pLow - (f - fraction);
    wide ln2 = wideFromBits(0x3FE62E42u, 0xFEFA39EFu);
    wide ln2High = wideFromBits(0x3FE62E43u, 0x00000000u);  // 26 bits
    wide ln2Low = wideFromBits(0xBE205C61u, 0x0CA86C39u);   // ... and the rest
    wide w = f * ln2High;
    wide wLow = fLow * ln2 + f * ln2Low;
    wide z = w + wLow;
    ScaledNumber result;
    result.significand = exponentialOfSum(z, wLow - (z - w));
    result.exponent = whole;
    return result;
}

// x^y for a positive, finite, normal x and |y| <= 2^70.
ScaledNumber scaledPowerOf(wide x, wide y, bool extended) {
    ScaledNumber scaled;
    if (extended) {
        scaled = scaledPowerExtended(x, y);
    } else {
        scaled = scaledPower(x, y);
    }
    return scaled;
}

// The bits of powWide for 0 <= x <= 1 and 2^lowest, 2^-100 <= y <= 2^70: there nothing is invalid, infinite or
// beyond the range.
wide powOfFraction(wide x, wide y, wide lowest, bool extended) {
    wide zero = wide(0.0);
    wide one = wide(1.0);
    boolean isZero = x < powerOfTwo(lowest);
    ScaledNumber scaled = scaledPowerOf(select(isZero, one, x), y, extended);
    boolean tooLow = scaled.exponent < lowest || (scaled.exponent == lowest && scaled.significand < one);
    wide exponent = select(tooLow, zero, scaled.exponent);
    return select(isZero || tooLow, zero, scaled.significand * powerOfTwo(exponent));
}

// x^y for a result format whose smallest normal number is 2^lowest: smaller arguments and results are 0.
// `extended` is false where the result is rounded to float.
wide powWide(wide x, wide y, wide lowest, bool extended) {
    wide zero = wide(0.0);
    wide one = wide(1.0);
    wide infinity = wideFromBits(0x7FF00000u, 0x00000000u);
    wide smallest = powerOfTwo(lowest);
    boolean invalid = x != x || y != y || x <= -smallest;
    boolean isZero = x < smallest;
    boolean isInfinite = x == infinity;
    boolean rises = y >= smallest;
    boolean falls = y <= -smallest;

    // |y| beyond 2^70 or below 2^-100 changes no result any more.
    wide base = select(invalid || isZero || isInfinite, one, x);
    wide decisive = powerOfTwo(wide(70.0));
    wide negligible = powerOfTwo(wide(-100.0));
    wide power = select(y > decisive, decisive, select(y < -decisive, -decisive, y));
    power = select(power < negligible && power > -negligible, zero, power);
    wide result = joinNumber(scaledPowerOf(base, power, extended), lowest);

    // Powers of zero and of infinity.
    wide ofZero = select(rises, zero, select(falls, infinity, one));
    wide ofInfinity = select(rises, infinity, select(falls, zero, one));
    result = select(isZero, ofZero, select(isInfinite, ofInfinity, result));
    return select(invalid, wideFromBits(0x7FF80000u, 0x00000000u), result);
}
