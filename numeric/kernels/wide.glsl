// Helpers of the elementary functions, over `wide`: double on a GPU, double or lanes of double in C++
// (numeric/elementary.h). Constants that are not whole numbers or quotients of floats are written as the two
// halves of their bits, because a GPU's compiler would read a decimal as a float.

// The 26 leading bits of a, rounded to nearest; a minus it is exact and has 26 bits too, so that products of
// two such parts are exact. |a| < 2^996. [Dekker1971, Eq. 5.7]
wide highPart(wide a) {
    wide scaled = (wide(134217728.0) + wide(1.0)) * a;  // 2^27 + 1
    return scaled - (scaled - a);
}

// a b - product, exactly, where product is a b rounded and no partial product underflows. [Dekker1971, Eq.
// 5.14]
wide productError(wide a, wide b, wide product) {
    wide aHigh = highPart(a);
    wide bHigh = highPart(b);
    wide aLow = a - aHigh;
    wide bLow = b - bHigh;
    return ((aHigh * bHigh - product) + (aHigh * bLow + aLow * bHigh)) + aLow * bLow;
}

// The sum of z^k / (k + 1)! from k = 0 to 10; z times it is e^z - 1 but for the first term left out, z^12 /
// 12!.
wide exponentialSeries11(wide z) {
    wide p = wide(1.0) / wide(39916800.0);  // 1 / 11!
    p = wide(1.0) / wide(3628800.0) + z * p;  // 1 / 10!
    p = wide(1.0) / wide(362880.0) + z * p;  // 1 / 9!
    p = wide(1.0) / wide(40320.0) + z * p;  // 1 / 8!
    p = wide(1.0) / wide(5040.0) + z * p;  // 1 / 7!
    p = wide(1.0) / wide(720.0) + z * p;  // 1 / 6!
    p = wide(1.0) / wide(120.0) + z * p;  // 1 / 5!
    p = wide(1.0) / wide(24.0) + z * p;  // 1 / 4!
    p = wide(1.0) / wide(6.0) + z * p;  // 1 / 3!
    p = wide(0.5) + z * p;  // 1 / 2!
    return wide(1.0) + z * p;
}

// e^(z + zLow) for |z| <= ln(2) / 2 + 2^-20 and |zLow| <= 2^-53 |z|: the Taylor series, whose first term left
// out is below 2^-61 of the result.
wide exponentialOfSum(wide z, wide zLow) {
    wide p = wide(1.0) / (wide(14.0) * wide(6227020800.0));  // 1 / 14!
    p = wide(1.0) / wide(6227020800.0) + z * p;  // 1 / 13!
    p = wide(1.0) / wide(479001600.0) + z * p;  // 1 / 12!
    p = wide(1.0) / wide(39916800.0) + z * p;  // 1 / 11!
    p = wide(1.0) / wide(3628800.0) + z * p;  // 1 / 10!
    p = wide(1.0) / wide(362880.0) + z * p;  // 1 / 9!
    p = wide(1.0) / wide(40320.0) + z * p;  // 1 / 8!
    p = wide(1.0) / wide(5040.0) + z * p;  // 1 / 7!
    p = wide(1.0) / wide(720.0) + z * p;  // 1 / 6!
    p = wide(1.0) / wide(120.0) + z * p;  // 1 / 5!
    p = wide(1.0) / wide(24.0) + z * p;  // 1 / 4!
    p = wide(1.0) / wide(6.0) + z * p;  // 1 / 3!
    p = wide(0.5) + z * p;  // 1 / 2!
    wide high = wide(1.0) + z;
    wide low = z - (high - wide(1.0));
    return high + (low + ((zLow + z * zLow) + (z * z) * p));
}
