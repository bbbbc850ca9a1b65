// UNORM depth (rule 6): floor(z levels + 1/2) with levels = 2^n - 1, exact over every binary format with at least n bits
// that holds z, float and double among them: z levels = 2^n z - z, the power of two costs no bit, and the whole number
// below 2^n z is off by one at most.
// z: in [0, 1]; levels: 65535 or 16777215. Returns a whole number in [0, levels].
real unormDepth(real z, real levels) {
    real scaled = z * (levels + real(1.0));
    real k = floor(scaled);
    real part = scaled - k;
    // part - z decides. The halves are subtracted where that is exact: the difference of two numbers within a factor of
    // two has no rounding, and where they are farther apart it only has to be below 0, which it is.
    real up = select(part - real(0.5) >= z, k + real(1.0), k);
    return select(z - real(0.5) > part, k - real(1.0), up);
}
