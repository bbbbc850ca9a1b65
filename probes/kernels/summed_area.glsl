// Summed-area tables. Specified in probes/summed_area.h.
// needs: probes/kernels/summed_area_scope.glsl

// The sum over a rectangle from the entries at its lower right corner and at the corners just outside of it
// [Pedersen2008, Eq. 6.2].
real boxSum(real lowerRight, real upperRight, real lowerLeft, real upperLeft) {
    return ((lowerRight - upperRight) - lowerLeft) + upperLeft;
}

// Replaces the `count` numbers of a row or a column of a table by their sums from the first one on. A table is that of
// all its rows, then of all its columns.
void sumAlong(int count) {
    real sum = real(0.0);
    for (int i = 0; i < count; i++) {
        sum = sum + tableNumber(i);
        setTableNumber(i, sum);
    }
}
