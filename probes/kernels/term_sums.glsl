// Sums of partial sums, whose shape depends on their number only. Specified in probes/term_sums.h.
// needs: probes/kernels/term_sums_scope.glsl

// Folds `parts` partial sums, a power of two, into the first one: sum j + parts / 2 is added to sum j, and so on down to
// one.
void foldInHalves(int parts) {
    for (int left = parts / 2; left > 0; left = left / 2)
        for (int j = 0; j < left; j++) setPartialSum(j, partialSum(j) + partialSum(j + left));
}

// Folds `count` of them in pairs of neighbours, again and again, an odd last one kept as it is.
void foldInPairs(int count) {
    for (int left = count; left > 1; left = (left + 1) / 2)
        for (int pair = 0; 2 * pair < left; pair++) {
            real sum = partialSum(2 * pair);
            if (2 * pair + 1 < left) sum = sum + partialSum(2 * pair + 1);
            setPartialSum(pair, sum);
        }
}
