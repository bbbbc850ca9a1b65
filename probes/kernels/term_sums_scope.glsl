// What probes/kernels/term_sums.glsl folds, in GLSL: sums of `termsPerSum` terms each, one behind the other; an
// invocation folds one term of them. The C++ counterpart is TermSumsKernel in probes/term_sums.h.

layout(std430, set = 1, binding = 4) buffer PartialSums { real partialSums[]; };
int termsPerSum;
int foldedTerm;
real partialSum(int i) { return partialSums[i * termsPerSum + foldedTerm]; }
void setPartialSum(int i, real a) { partialSums[i * termsPerSum + foldedTerm] = a; }
