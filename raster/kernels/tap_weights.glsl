// The weights of four texels, multiples of 1/256 as the fractions (rule 22), and their sum in the arithmetic.

struct TapWeights {
    real w00;
    real w10;
    real w01;
    real w11;
};
TapWeights tapWeights(real fractionX, real fractionY) {
    integer x = toInteger(fractionX * real(256.0));
    integer y = toInteger(fractionY * real(256.0));
    integer both = (x * y + integer(128)) / integer(256);
    TapWeights w;
    w.w00 = toReal(integer(256) - x - y + both) * real(0.00390625);
    w.w10 = toReal(x - both) * real(0.00390625);
    w.w01 = toReal(y - both) * real(0.00390625);
    w.w11 = toReal(both) * real(0.00390625);
    return w;
}

// The sum of the weighted texels, inside the hull of those that have a weight, so that equal ones give exactly that
// value. A texel without a weight has no influence.
real weightedTap(real v, real w) { return select(w == real(0.0), real(0.0), v * w); }
real weightedSum(real v00, real v10, real v01, real v11, TapWeights w) {
    real sum = (weightedTap(v00, w.w00) + weightedTap(v10, w.w10)) + (weightedTap(v01, w.w01) + weightedTap(v11, w.w11));
    real inside = select(w.w11 == real(0.0), select(w.w10 == real(0.0), select(w.w01 == real(0.0), v00, v01), v10), v11);
    real a = select(w.w00 == real(0.0), inside, v00);
    real b = select(w.w10 == real(0.0), inside, v10);
    real c = select(w.w01 == real(0.0), inside, v01);
    real lo = minOf(minOf(a, b), minOf(c, inside));
    real hi = maxOf(maxOf(a, b), maxOf(c, inside));
    sum = select(sum < lo, lo, sum);
    return select(hi < sum, hi, sum);
}
