// What probes/kernels/flux.glsl reads, in GLSL: the limits of a GPU's single precision. The C++ counterpart is
// probes/flux_scope.inc.

// 2^-50.
real smallestTerm() { return real(8.881784197001252e-16); }
// The largest finite number.
real largestReal() { return real(3.4028234663852886e38); }
