// Summed-area tables. Specified in probes/summed_area.h.
// needs: probes/kernels/summed_area_scope.glsl

// The sum over a rectangle from the entries at its lower right corner and at the corners just outside of it
// [Pedersen2008, Eq. 6.2].
real boxSum(real lowerRight, real upperRight, real lowerLeft, real upperLeft) {
    return ((lowerRight - upperRight) - lowerLeft) + upperLeft;
}

// Replaces `count` numbers of a row or a column of a table, one behind the other, by their sums from the first one of the
// row or column on; returns the last sum. before: the sum of those in front of them, 0 at first. A table is that of all its
// rows, then of all its columns.
real sumAlong(real before, int count) {
    real sum = before;
    for (int i = 0; i < count; i++) {
        sum = sum + tableNumber(i);
        setTableNumber(i, sum);
    }
    return sum;
}
