// UNORM depth (rule 6): floor(z * levels + 0.5) with levels = 2^n - 1, exact for every z of at most 53 bits when
// real is double. The texts of the product's exact parts: z is split into 26 high bits and the rest, so that both
// products with a 24-bit integer are exact.
// z: in [0, 1]; levels: 65535 or 16777215. Returns a whole number in [0, levels].
real unormDepth(real z, real levels) {
    real splitter = real(134217729.0);  // 2^27 + 1
    real shifted = z * splitter;
    real high = shifted - (shifted - z);
    real low = z - high;
    real p = high * levels;
    real q = low * levels;
    real k = floor((p + q) + real(0.5));
    // k is off by one at most; the sign of the exact remainder p + q - k, moved by one half, decides.
    real above = ((p - k) - real(0.5)) + q;
    real below = ((p - k) + real(0.5)) + q;
    real up = select(above >= real(0.0), k + real(1.0), k);
    return select(below < real(0.0), k - real(1.0), up);
}
