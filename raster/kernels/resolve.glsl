// Multisample resolve: the mean of the samples, added in the order of their index.
real resolveAdd(real sum, real value) { return sum + value; }
real resolveMean(real sum, real reciprocalCount) { return sum * reciprocalCount; }
