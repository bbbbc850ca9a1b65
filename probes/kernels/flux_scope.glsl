// What probes/kernels/flux.glsl reads, in GLSL: the limits of a GPU's single precision. The C++ counterpart is
// probes/flux_scope.inc.

// The largest finite number, and 0 below 2^-50: the product of two such terms is never subnormal, nor is the
// difference of two products.
real largestReal() { return real(3.4028234663852886e38); }
real flooredTerm(real a) { return select(absOf(a) < real(8.881784197001252e-16), real(0.0), a); }
